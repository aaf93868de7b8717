// Two framings of Ethernet, and the passt process.
#include "net_relay.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/uio.h>
#include <sys/wait.h>

#include <array>
#include <cstdint>
#include <vector>

namespace drover::lab {
namespace {

constexpr std::size_t kFrameMax = 65535;

/// `other`: what is chosen already, and not yet in use.
int free_port(int other = 0) {
  Fd fd(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (::bind(fd.get(), reinterpret_cast<sockaddr*>(&address), size) != 0) fail("bind");
  if (::getsockname(fd.get(), reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    fail("getsockname");
  }
  const int port = ntohs(address.sin_port);
  return port == other ? free_port(other) : port;  // this one is in use until then
}

std::string forward(int from, int to) {
  return "127.0.0.1/" + std::to_string(from) + ":" + std::to_string(to);
}

}  // namespace

NetRelay::NetRelay(Fd kernel, int port, int second_port, const std::string& log_path)
    : kernel_(std::move(kernel)),
      port_(port > 0 ? port : free_port()),
      second_port_(second_port == 0 ? free_port(port_) : second_port) {
  auto [ours, theirs] = make_socket_pair(SOCK_STREAM);
  const std::string ports = forward(port_, 1883);
  const std::string second = forward(second_port_, 1884);
  const std::string fd_text = std::to_string(theirs.get());
  const int log = ::open(log_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  pid_ = ::fork();
  if (pid_ < 0) fail("fork");
  if (pid_ == 0) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    ::fcntl(theirs.get(), F_SETFD, 0);
    ::dup2(log, 1);
    ::dup2(log, 2);
    std::vector<const char*> words{"passt", "-f", "-1", "-F", fd_text.c_str(), "-t", ports.c_str()};
    if (second_port_ > 0) words.insert(words.end(), {"-t", second.c_str()});
    words.insert(words.end(), {"-u", "none", "-4", "-a", "10.0.2.15", "-n", "24", "-g", "10.0.2.2",
                               "--no-map-gw", nullptr});
    ::execvp("passt", const_cast<char* const*>(words.data()));
    ::_exit(127);
  }
  ::close(log);
  passt_ = std::move(ours);
}

NetRelay::~NetRelay() {
  passt_.reset();
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void NetRelay::from_kernel() {
  std::array<char, kFrameMax> frame;
  const ssize_t n = ::recv(kernel_.get(), frame.data(), frame.size(), MSG_DONTWAIT);
  if (n <= 0 || !passt_.open()) return;
  std::uint32_t length = htonl(static_cast<std::uint32_t>(n));
  std::array<iovec, 2> parts{
      {{&length, sizeof length}, {frame.data(), static_cast<std::size_t>(n)}}};
  msghdr message{};
  message.msg_iov = parts.data();
  message.msg_iovlen = parts.size();
  std::size_t left = sizeof length + static_cast<std::size_t>(n);
  // A stream must not lose half a frame, so this waits; passt always reads.
  while (left > 0) {
    const ssize_t sent = ::sendmsg(passt_.get(), &message, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return passt_.reset();
    left -= static_cast<std::size_t>(sent);
    std::size_t skip = static_cast<std::size_t>(sent);
    for (auto& part : parts) {
      const std::size_t used = skip < part.iov_len ? skip : part.iov_len;
      part.iov_base = static_cast<char*>(part.iov_base) + used;
      part.iov_len -= used;
      skip -= used;
    }
  }
}

void NetRelay::from_passt() {
  std::array<char, kFrameMax> buffer;
  const ssize_t n = ::recv(passt_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (n <= 0) return passt_.reset();
  stream_.append(buffer.data(), static_cast<std::size_t>(n));
  std::size_t at = 0;
  while (stream_.size() - at >= sizeof(std::uint32_t)) {
    std::uint32_t length = 0;
    std::memcpy(&length, stream_.data() + at, sizeof length);
    length = ntohl(length);
    if (length > kFrameMax) return passt_.reset();
    if (stream_.size() - at - sizeof length < length) break;
    // A full queue drops the frame, as any wire may; TCP repairs it.
    (void)::send(kernel_.get(), stream_.data() + at + sizeof length, length,
                 MSG_DONTWAIT | MSG_NOSIGNAL);
    at += sizeof length + length;
  }
  stream_.erase(0, at);
}

}  // namespace drover::lab
