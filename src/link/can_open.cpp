#include "link/can_open.h"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>

#include "link/unix_address.h"

namespace drover::link {

namespace {

constexpr std::string_view kUnixPrefix = "unix:";

template <class T>
bool set_option(int fd, int level, int name, const T& value) {
  return ::setsockopt(fd, level, name, &value, sizeof value) == 0;
}

UniqueFd open_unix(const std::string& path, std::string& problem) {
  const auto address = unix_address(path);
  if (!address) {
    problem = path + ": the socket's path is too long";
    return {};
  }
  UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!fd ||
      ::connect(fd.get(), reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0) {
    problem = problem_text(path, "cannot connect", errno);
    return {};
  }
  return fd;
}

/// Frames that wait in the kernel leave later, even after a restart: keep room for one cycle only.
/// The kernel doubles the value, and a queued frame costs about 1 KiB of it.
void limit_send_buffer(int fd, std::size_t frames_per_cycle) {
  constexpr int kBytesAFrame = 512;
  set_option(fd, SOL_SOCKET, SO_SNDBUF, static_cast<int>(frames_per_cycle) * kBytesAFrame);
}

}  // namespace

UniqueFd open_can_descriptor(const CanSettings& settings, std::string& problem) {
  const auto& name = settings.interface;
  if (name.starts_with(kUnixPrefix)) return open_unix(name.substr(kUnixPrefix.size()), problem);

  UniqueFd fd(::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW));
  if (!fd) {
    problem =
        problem_text(name, errno == EAFNOSUPPORT ? "this kernel has no CAN" : "cannot open", errno);
    return {};
  }
  ifreq request{};
  if (name.size() >= IFNAMSIZ) {
    problem = name + ": the interface's name is too long";
    return {};
  }
  std::copy(name.begin(), name.end(), request.ifr_name);
  if (::ioctl(fd.get(), SIOCGIFINDEX, &request) != 0) {
    problem = name + ": no such CAN interface";
    return {};
  }
  const int index = request.ifr_ifindex;
  if (::ioctl(fd.get(), SIOCGIFFLAGS, &request) == 0 && (request.ifr_flags & IFF_UP) == 0) {
    problem = name + ": the interface is down; bring it up with: ip link set " + name + " up";
    return {};
  }
  if (::ioctl(fd.get(), SIOCGIFMTU, &request) == 0 && request.ifr_mtu == CANFD_MTU)
    set_option(fd.get(), SOL_CAN_RAW, CAN_RAW_FD_FRAMES, 1);
  // Options before bind: no frame may come in without its stamp.
  set_option(fd.get(), SOL_SOCKET, SO_TIMESTAMPNS, 1);
  set_option(fd.get(), SOL_SOCKET, SO_RXQ_OVFL, 1);
  if (!settings.hears) ::setsockopt(fd.get(), SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0);
  if (settings.hears && settings.error_frames) {
    set_option(fd.get(), SOL_CAN_RAW, CAN_RAW_ERR_FILTER,
               static_cast<can_err_mask_t>(CAN_ERR_MASK));
  }
  constexpr int kReceiveBytes =
      2 * 1024 * 1024;  // a control thread held up for 100 ms loses nothing
  if (settings.hears) set_option(fd.get(), SOL_SOCKET, SO_RCVBUF, kReceiveBytes);
  limit_send_buffer(fd.get(), settings.frames_per_cycle);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = index;
  if (::bind(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    problem = problem_text(name, "cannot bind", errno);
    return {};
  }
  return fd;
}

Opened<CanLink> open_can(const CanSettings& settings) {
  Opened<CanLink> opened;
  if (auto fd = open_can_descriptor(settings, opened.problem))
    opened.link = std::make_unique<CanLink>(std::move(fd));
  return opened;
}

}  // namespace drover::link
