#include "ros2/daemon_link.h"

#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "link/unix_address.h"

namespace drover::ros2 {

namespace {
/// No line is so long.
constexpr std::size_t kMostWaiting = 1024 * 1024;
}  // namespace

void DaemonLink::keep(Time now) {
  if (fd_ || !retry_.due(now)) return;
  retry_.tried(now);
  const auto address = link::unix_address(path_);
  if (!address) return lose("the path is too long");
  link::UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!fd ||
      ::connect(fd.get(), reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0)
    return lose(std::strerror(errno));
  fd_ = std::move(fd);
  in_.clear();
  problem_.clear();
}

bool DaemonLink::read() {
  std::array<char, 65536> block{};
  const auto n = ::recv(fd_.get(), block.data(), block.size(), MSG_DONTWAIT);
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return false;
  if (n <= 0) {
    lose(n == 0 ? "droverd has closed the connection" : std::strerror(errno));
    return false;
  }
  retry_.succeeded();
  in_.append(block.data(), static_cast<std::size_t>(n));
  return true;
}

void DaemonLink::hear(const std::function<void(std::string_view)>& on_line) {
  if (fd_) (void)read();
  const std::string came = std::exchange(in_, {});  // `on_line` may send, which reads
  std::size_t begin = 0;
  for (;;) {
    const auto end = came.find('\n', begin);
    if (end == std::string::npos) break;
    on_line(std::string_view(came).substr(begin, end - begin));
    begin = end + 1;
  }
  in_.insert(0, came, begin);
  if (in_.size() <= kMostWaiting) return;
  lose("droverd sends a line without an end");
  in_.clear();
}

bool DaemonLink::send(const std::string& line) {
  if (!fd_) return false;
  const std::string text = line + "\n";
  const auto n = ::send(fd_.get(), text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  if (n == static_cast<ssize_t>(text.size())) return true;
  // What it said before it went is heard all the same.
  while (in_.size() <= kMostWaiting && read()) {
  }
  if (fd_) lose("droverd does not read");
  return false;
}

void DaemonLink::lose(const std::string& why) {
  fd_.reset();
  problem_ = path_ + ": " + why;
}

}  // namespace drover::ros2
