#include "sim/robot/control_socket.h"

#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "link/unix_address.h"

namespace drover::sim {
namespace {

constexpr std::size_t kMaxClients = 16;

sockaddr_un address_of(const std::string& path) {
  const auto address = link::unix_address(path);
  if (!address) throw std::runtime_error(path + ": the socket's path is too long");
  return *address;
}

}  // namespace

ControlSocket::ControlSocket(const std::string& path, int epoll_fd)
    : path_(path),
      epoll_fd_(epoll_fd),
      listen_(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  const auto address = address_of(path_);
  ::unlink(path_.c_str());
  if (::bind(listen_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listen_.get(), 8) != 0)
    throw std::runtime_error(path_ + ": cannot listen: " + std::strerror(errno));
  watch(listen_.get());
}

ControlSocket::~ControlSocket() {
  ::unlink(path_.c_str());
}

void ControlSocket::watch(int fd) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.fd = fd;
  ::epoll_ctl(epoll_fd_, EPOLL_CTL_ADD, fd, &event);
}

bool ControlSocket::on_event(int fd, const std::function<std::string(std::string_view)>& answer) {
  if (fd == listen_.get()) {
    link::UniqueFd client(::accept4(fd, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (client && clients_.size() < kMaxClients) {
      watch(client.get());
      clients_.push_back(std::move(client));
    }
    return true;
  }
  const auto client = std::find_if(clients_.begin(), clients_.end(),
                                   [fd](const link::UniqueFd& one) { return one.get() == fd; });
  if (client == clients_.end()) return false;
  std::array<char, 1024> text{};
  const auto n = ::recv(fd, text.data(), text.size(), 0);
  if (n > 0) {
    const auto reply = answer({text.data(), static_cast<std::size_t>(n)});
    (void)::send(fd, reply.data(), reply.size(), MSG_NOSIGNAL);
  } else if (n == 0 || (errno != EAGAIN && errno != EINTR)) {
    clients_.erase(client);  // closing takes it out of the epoll set
  }
  return true;
}

std::string ask(const std::string& path, std::string_view command) {
  const auto address = address_of(path);
  link::UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  const timeval limit{5, 0};
  ::setsockopt(fd.get(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  if (::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error(path + ": cannot connect: " + std::strerror(errno));
  std::array<char, 4096> text{};
  if (::send(fd.get(), command.data(), command.size(), MSG_NOSIGNAL) < 0)
    throw std::runtime_error(path + ": cannot send: " + std::strerror(errno));
  const auto n = ::recv(fd.get(), text.data(), text.size(), 0);
  if (n <= 0) throw std::runtime_error(path + ": no answer");
  return {text.data(), static_cast<std::size_t>(n)};
}

}  // namespace drover::sim
