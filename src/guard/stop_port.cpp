#include "guard/stop_port.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

#include "guard/sockets.h"

namespace drover::guard {

StopPort::StopPort(int listener, StopListener& answers) : listener_(listener), answers_(answers) {}

void StopPort::poll_fds(pollfd* fds) const {
  fds[0] = {listener_, POLLIN, 0};
  for (std::size_t i = 0; i < kClients; ++i) fds[1 + i] = {clients_[i].fd, POLLIN, 0};
}

void StopPort::serve(const pollfd* fds) {
  for (std::size_t i = 0; i < kClients; ++i)
    if (fds[1 + i].revents != 0) hear(clients_[i]);
  if (fds[0].revents != 0) accept();
}

/// Who connects and says nothing must not keep others out: the oldest makes room.
void StopPort::accept() {
  uid_t uid = 0;
  const int fd = accept_from(listener_, uid);
  if (fd < 0) return;
  auto& client = clients_[oldest_];
  oldest_ = (oldest_ + 1) % kClients;
  if (client.fd >= 0) ::close(client.fd);
  client = {fd, uid};
  hear(client);
}

void StopPort::hear(Client& client) {
  std::array<char, 16> bytes{};
  const auto n = ::recv(client.fd, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_TRUNC);
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
  const auto size = static_cast<std::size_t>(n);
  const std::string_view word(bytes.data(), n > 0 && size <= bytes.size() ? size : 0);
  if (word == "stop") answers_.stop(client.uid);
  if (word == "reset") answers_.reset(client.uid);
  if (word == "stop" || word == "reset" || word == "state") {
    const auto line = answers_.state();
    // Who does not read his answer gets none.
    ::send(client.fd, line.data(), line.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    return;
  }
  ::close(client.fd);
  client.fd = -1;
}

}  // namespace drover::guard
