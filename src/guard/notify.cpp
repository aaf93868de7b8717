#include "guard/notify.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

#include "guard/sockets.h"

namespace drover::guard {

Notify::Notify() {
  const char* path = std::getenv("NOTIFY_SOCKET");
  if (path == nullptr || path[0] == '\0' || std::strlen(path) >= sizeof address_.sun_path) return;
  address_.sun_family = AF_UNIX;
  std::memcpy(address_.sun_path, path, std::strlen(path));
  address_size_ = static_cast<unsigned>(offsetof(sockaddr_un, sun_path) + std::strlen(path));
  if (path[0] == '@') address_.sun_path[0] = '\0';
  fd_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}

Notify::~Notify() {
  if (fd_ >= 0) ::close(fd_);
}

bool Notify::store(std::string_view name, int fd) {
  // Without FDPOLL=0 a descriptor that hangs up would be dropped, and a CAN interface that was down
  // for a moment with it.
  return send("FDSTORE=1\nFDPOLL=0\nFDNAME=" + std::string(name), fd);
}

bool Notify::forget(std::string_view name) {
  return send("FDSTOREREMOVE=1\nFDNAME=" + std::string(name), -1);
}

bool Notify::send(std::string_view words, int fd) {
  if (fd_ < 0) return true;
  PassedMessage message(const_cast<char*>(words.data()), words.size());
  message.pass(fd);
  message.header().msg_name = &address_;
  message.header().msg_namelen = address_size_;
  if (::sendmsg(fd_, &message.header(), MSG_DONTWAIT | MSG_NOSIGNAL) >= 0) return true;
  ++unsaid_;
  return false;
}

std::vector<Kept> take_kept() {
  constexpr int kFirst = 3;
  const char* pid = std::getenv("LISTEN_PID");
  const char* count = std::getenv("LISTEN_FDS");
  const char* names = std::getenv("LISTEN_FDNAMES");
  std::vector<Kept> kept;
  if (pid == nullptr || count == nullptr || std::atoi(pid) != ::getpid()) return kept;
  std::string_view rest(names == nullptr ? "" : names);
  for (int i = 0; i < std::atoi(count); ++i) {
    const auto end = rest.find(':');
    const int fd = kFirst + i;
    ::fcntl(fd, F_SETFD, FD_CLOEXEC);
    kept.push_back({std::string(rest.substr(0, end)), fd});
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
  }
  return kept;
}

}  // namespace drover::guard
