#include "runtime/guard_client.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <stdexcept>

#include "link/can_wire.h"
#include "link/opened.h"
#include "link/unix_address.h"
#include "runtime/guard_watch.h"

namespace drover::runtime {

namespace {

bool set_name(GuardMessage& message, const std::string& name) {
  if (name.empty() || name.size() >= message.name.size()) return false;
  message.name.fill('\0');
  std::copy(name.begin(), name.end(), message.name.begin());
  return true;
}

std::string address_of(const CanFrame& frame) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), frame.extended ? " %08X" : " %03X",
                static_cast<unsigned>(frame.id));
  return text.data();
}

}  // namespace

GuardedAxis guarded_axis(const std::string& link, const StopRecipe& stop) {
  GuardedAxis axis;
  axis.name = link;
  axis.period = std::chrono::ceil<std::chrono::milliseconds>(stop.period);
  if (!stop.rounds.empty() && !stop.rounds[0].frames.empty())
    axis.name += address_of(stop.rounds[0].frames[0]);
  for (const StopRound& from : stop.rounds) {
    auto& round = axis.rounds.emplace_back();
    for (const CanFrame& frame : from.frames) {
      canfd_frame wire{};
      const auto size = link::to_wire(frame, wire);
      auto& bytes = round.emplace_back(size);
      std::memcpy(bytes.data(), &wire, size);
    }
    for (const Packet& packet : from.packets) round.emplace_back(packet.begin(), packet.end());
  }
  return axis;
}

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
  const auto address = link::unix_address(path_);
  if (!address) {
    problem = "guard.socket: the path is too long: " + path_;
    return false;
  }
  // A guard that is stopped must not hold up who supplies it.
  link::UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!fd ||
      ::connect(fd.get(), reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0) {
    problem = link::problem_text("drover-guard at " + path_, "cannot connect", errno);
    return false;
  }
  socket_ = std::move(fd);
  supplied_ = false;
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

bool GuardClient::send_link(std::uint32_t index, const GuardedLink& link) {
  GuardMessage message;
  message.verb = link.descriptor ? GuardVerb::link : GuardVerb::absent;
  message.index = index;
  message.kind = link.kind;
  return set_name(message, link.name) && send(message, link.descriptor.get());
}

bool GuardClient::send_axis(std::uint32_t index, std::uint32_t link, const GuardedAxis& axis) {
  GuardMessage message;
  message.verb = GuardVerb::axis;
  message.index = index;
  message.link = link;
  message.rounds = static_cast<std::uint32_t>(axis.rounds.size());
  message.period_ms = static_cast<std::uint32_t>(axis.period.count());
  message.held_by_daemon = axis.held_by_daemon ? 1 : 0;
  message.runs_on = axis.runs_on ? 1 : 0;
  if (!set_name(message, axis.name) || !send(message)) return false;
  message.verb = GuardVerb::stop_message;
  for (message.round = 0; message.round < axis.rounds.size(); ++message.round) {
    for (const auto& bytes : axis.rounds[message.round]) {
      if (bytes.size() > message.bytes.size()) return false;
      message.size = static_cast<std::uint32_t>(bytes.size());
      std::copy(bytes.begin(), bytes.end(), message.bytes.begin());
      if (!send(message)) return false;
    }
  }
  return true;
}

bool GuardClient::hand_over(std::span<const GuardedLink> links, std::string& problem) {
  if (!connected() && !connect(problem)) return false;
  GuardMessage hello;
  hello.verb = GuardVerb::hello;
  hello.limit_ms = static_cast<std::uint32_t>(limit_ms_);
  bool sent = send(hello, memory_.fd());
  std::uint32_t axes = 0;
  std::string at = "the beginning";
  for (std::uint32_t i = 0; sent && i < links.size(); ++i) {
    if (!links[i].descriptor && links[i].axes.empty()) continue;
    at = links[i].name;
    sent = send_link(i, links[i]);
    for (std::size_t k = 0; sent && k < links[i].axes.size(); ++k) {
      at = links[i].axes[k].name;
      sent = send_axis(axes++, i, links[i].axes[k]);
    }
  }
  GuardMessage watch;
  watch.verb = GuardVerb::watch;
  sent = sent && send(watch);
  supplied_ = sent;
  // What a message has no room for is not sent, and the connection stands.
  if (!sent)
    problem = "drover-guard at " + path_ +
              (connected() ? " cannot be told of " + at + ": its name or its stop is too long"
                           : " does not take the stop set (at " + at + ")");
  return sent;
}

bool GuardClient::give_pulse_line(int line) {
  GuardMessage message;
  message.verb = GuardVerb::pulse_line;
  return connected() && send(message, line);
}

bool GuardClient::give_relay_line(const std::string& name, int line) {
  GuardMessage message;
  message.verb = GuardVerb::relay_line;
  return connected() && set_name(message, name) && send(message, line);
}

bool GuardClient::let_go(const std::string& name) {
  GuardMessage message;
  message.verb = GuardVerb::let_go;
  return connected() && set_name(message, name) && send(message);
}

/// A busy machine holds it up for less than half a second.
bool GuardClient::answers(const std::function<void()>& late) const {
  constexpr int kPatience_ms = 500;
  const auto signs = std::chrono::milliseconds(limit_ms_) + GuardWatch::kCycles;
  const int first_ms = std::min(
      kPatience_ms, static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(signs).count()));
  pollfd fds{socket_.get(), POLLIN, 0};
  if (::poll(&fds, 1, first_ms) > 0) return true;
  late();
  return ::poll(&fds, 1, kPatience_ms - first_ms) > 0;
}

link::UniqueFd GuardClient::borrow(const std::string& name, const std::function<void()>& late) {
  GuardMessage message;
  message.verb = GuardVerb::lend;
  if (!connected() || !set_name(message, name) || !send(message)) return {};
  if (!answers(late)) {
    disconnect();  // its answer, when it comes, would be taken for another one's
    return {};
  }
  GuardMessage answer;
  iovec vector{&answer, sizeof answer};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
  msghdr header{};
  header.msg_iov = &vector;
  header.msg_iovlen = 1;
  header.msg_control = control.data();
  header.msg_controllen = control.size();
  const auto n = ::recvmsg(socket_.get(), &header, MSG_CMSG_CLOEXEC | MSG_DONTWAIT);
  int fd = -1;
  if (n > 0)
    if (const auto* c = CMSG_FIRSTHDR(&header); c != nullptr && c->cmsg_type == SCM_RIGHTS)
      std::memcpy(&fd, CMSG_DATA(c), sizeof fd);
  link::UniqueFd lent(fd);
  if (n != sizeof answer || answer.verb != GuardVerb::lend || answer.name != message.name) {
    disconnect();
    return {};
  }
  return lent;
}

bool GuardClient::hand_back() {
  GuardMessage message;
  message.verb = GuardVerb::hand_back;
  return connected() && send(message);
}

}  // namespace drover::runtime
