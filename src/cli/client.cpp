#include "cli/client.h"

#include <sys/socket.h>
#include <sys/time.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "link/unix_address.h"

namespace drover::cli {

namespace {

std::string why(const std::string& path, int error, int patience_s) {
  if (error == ENOENT || error == ECONNREFUSED)
    return "droverd does not run (no answer at " + path + ")";
  if (error == EACCES)
    return path +
           ": droverd answers only root and members of the group drover: run this with sudo, or "
           "join with: sudo usermod -a -G drover \"$USER\" (from the next login on)";
  if (error == EAGAIN) return "droverd did not answer within " + std::to_string(patience_s) + " s";
  return path + ": " + std::strerror(error);
}

NoAnswer unreached(const std::string& path, int error, int patience_s) {
  return {.text = why(path, error, patience_s), .absent = error == ENOENT || error == ECONNREFUSED};
}

}  // namespace

Connection::Connection(const std::string& socket_path, int patience_s)
    : path_(socket_path), patience_s_(patience_s) {
  const auto address = link::unix_address(path_);
  if (!address) throw NoAnswer{path_ + ": the socket's path is too long"};
  fd_ = link::UniqueFd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const timeval patience{patience_s, 0};
  ::setsockopt(fd_.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  ::setsockopt(fd_.get(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);  // connect, too
  if (::connect(fd_.get(), reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0)
    throw unreached(path_, errno, patience_s_);
}

/// A line that was not read to its end was not obeyed: then the system calls the end of the
/// connection a reset.
NoAnswer Connection::unanswered(int error) const {
  if (error == ECONNRESET || error == EPIPE)
    return {"droverd let this connection go, and has not read the request: try again"};
  if (error == 0)
    return {
        "droverd closed the connection before it answered: it may have done it; see: drover "
        "status",
        true};
  return {why(path_, error, patience_s_), true};
}

std::string Connection::ask(const std::string& request) {
  const std::string line = request + "\n";
  for (std::size_t sent = 0; sent < line.size();) {
    const auto n = ::send(fd_.get(), line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) throw NoAnswer{why(path_, errno, patience_s_)};
    if (n < 0) throw unanswered(errno);
    sent += static_cast<std::size_t>(n);  // a large one goes in parts
  }

  std::string reply;
  std::array<char, 65536> buffer{};
  while (reply.empty() || reply.back() != '\n') {
    const auto n = ::recv(fd_.get(), buffer.data(), buffer.size(), 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw unanswered(n == 0 ? 0 : errno);
    reply.append(buffer.data(), static_cast<std::size_t>(n));
  }
  reply.pop_back();
  return reply;
}

std::string ask(const std::string& socket_path, const std::string& request, int patience_s) {
  return Connection(socket_path, patience_s).ask(request);
}

}  // namespace drover::cli
