#include "guard/sockets.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace drover::guard {

int listen_at(const std::string& path, std::string& problem) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) {
    problem = path + ": the path is too long";
    return -1;
  }
  std::memcpy(address.sun_path, path.c_str(), path.size());
  // The lock is held as long as this process lives, so it is never closed.
  const auto lock_path = path + ".lock";
  const int lock = ::open(lock_path.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC, 0640);
  if (lock < 0) {
    problem = lock_path + ": " + std::strerror(errno);
    return -1;
  }
  if (::flock(lock, LOCK_EX | LOCK_NB) != 0) {
    problem = "another drover-guard listens at " + path;
    ::close(lock);
    return -1;
  }
  const int fd = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  ::unlink(path.c_str());
  if (::bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
      ::chmod(path.c_str(), 0660) != 0 || ::listen(fd, 8) != 0) {
    problem = "cannot listen at " + path + ": " + std::strerror(errno);
    ::close(fd);
    return -1;
  }
  return fd;
}

int accept_from(int listener, uid_t& uid) {
  const int fd = ::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (fd < 0) return -1;
  ucred peer{};
  socklen_t size = sizeof peer;
  if (::getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) {
    ::close(fd);
    return -1;
  }
  uid = peer.uid;
  return fd;
}

PassedMessage::PassedMessage(void* bytes, std::size_t size) : vector_{bytes, size} {
  header_.msg_iov = &vector_;
  header_.msg_iovlen = 1;
  header_.msg_control = control_.data();
  header_.msg_controllen = control_.size();
}

void PassedMessage::pass(int fd) {
  if (fd < 0) {
    header_.msg_control = nullptr;
    header_.msg_controllen = 0;
    return;
  }
  auto* c = CMSG_FIRSTHDR(&header_);
  c->cmsg_level = SOL_SOCKET;
  c->cmsg_type = SCM_RIGHTS;
  c->cmsg_len = CMSG_LEN(sizeof(int));
  std::memcpy(CMSG_DATA(c), &fd, sizeof fd);
}

int PassedMessage::passed() {
  int fd = -1;
  if (const auto* c = CMSG_FIRSTHDR(&header_);
      c != nullptr && c->cmsg_type == SCM_RIGHTS && c->cmsg_len == CMSG_LEN(sizeof fd))
    std::memcpy(&fd, CMSG_DATA(c), sizeof fd);
  return fd;
}

}  // namespace drover::guard
