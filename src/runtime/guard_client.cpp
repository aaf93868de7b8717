#include "runtime/guard_client.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>

#include "link/can_wire.h"
#include "link/opened.h"

namespace drover::runtime {

GuardMemory::GuardMemory() : fd_(::memfd_create("drover-guard", MFD_CLOEXEC | MFD_ALLOW_SEALING)) {
  if (!fd_ || ::ftruncate(fd_.get(), sizeof(GuardShared)) != 0 ||
      ::fcntl(fd_.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW) != 0)
    throw std::runtime_error(link::problem_text("guard", "no shared memory", errno));
  void* memory =
      ::mmap(nullptr, sizeof(GuardShared), PROT_READ | PROT_WRITE, MAP_SHARED, fd_.get(), 0);
  if (memory == MAP_FAILED)
    throw std::runtime_error(link::problem_text("guard", "cannot map shared memory", errno));
  shared_ = new (memory) GuardShared{};
}

GuardMemory::~GuardMemory() {
  ::munmap(shared_, sizeof(GuardShared));
}

GuardClient::GuardClient(std::string socket_path, int limit_ms, const GuardMemory& memory)
    : path_(std::move(socket_path)), limit_ms_(limit_ms), memory_(memory) {}

bool GuardClient::connect(std::string& problem) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path_.size() >= sizeof address.sun_path) {
    problem = "guard.socket: the path is too long: " + path_;
    return false;
  }
  std::memcpy(address.sun_path, path_.c_str(), path_.size());
  link::UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  if (!fd || ::connect(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    problem = link::problem_text("drover-guard at " + path_, "cannot connect", errno);
    return false;
  }
  // A guard that is stopped must not hold up who supplies it.
  ::fcntl(fd.get(), F_SETFL, O_NONBLOCK);
  socket_ = std::move(fd);
  return true;
}

bool GuardClient::send(const GuardMessage& message, int descriptor) {
  iovec vector{const_cast<GuardMessage*>(&message), sizeof message};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
  msghdr header{};
  header.msg_iov = &vector;
  header.msg_iovlen = 1;
  if (descriptor >= 0) {
    header.msg_control = control.data();
    header.msg_controllen = control.size();
    auto* c = CMSG_FIRSTHDR(&header);
    c->cmsg_level = SOL_SOCKET;
    c->cmsg_type = SCM_RIGHTS;
    c->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(c), &descriptor, sizeof descriptor);
  }
  if (::sendmsg(socket_.get(), &header, MSG_NOSIGNAL) == static_cast<ssize_t>(sizeof message))
    return true;
  disconnect();
  return false;
}

bool GuardClient::hand_over(std::span<const GuardedLink> links, std::string& problem) {
  if (!connected() && !connect(problem)) return false;
  GuardMessage hello;
  hello.verb = GuardVerb::hello;
  hello.limit_ms = static_cast<std::uint32_t>(limit_ms_);
  bool sent = send(hello, memory_.fd());
  for (std::uint32_t i = 0; sent && i < links.size(); ++i) {
    if (!links[i].descriptor) continue;
    GuardMessage message;
    message.verb = GuardVerb::descriptor;
    message.descriptor = i;
    sent = send(message, links[i].descriptor.get());
    for (const auto& frame : links[i].stop_frames) {
      if (!sent) break;
      canfd_frame wire{};
      GuardMessage stop;
      stop.verb = GuardVerb::stop_frame;
      stop.descriptor = i;
      stop.size = static_cast<std::uint32_t>(link::to_wire(frame, wire));
      std::memcpy(stop.bytes.data(), &wire, stop.size);
      sent = send(stop);
    }
  }
  GuardMessage watch;
  watch.verb = GuardVerb::watch;
  sent = sent && send(watch);
  if (!sent) problem = "drover-guard at " + path_ + " closed the connection";
  return sent;
}

bool GuardClient::give_pulse_line(int line) {
  GuardMessage message;
  message.verb = GuardVerb::pulse_line;
  return connected() && send(message, line);
}

bool GuardClient::hand_back() {
  GuardMessage message;
  message.verb = GuardVerb::hand_back;
  return connected() && send(message);
}

}  // namespace drover::runtime
