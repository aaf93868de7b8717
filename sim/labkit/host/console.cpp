// Both ends of the second console's Unix socket.
#include "console.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <sys/un.h>

#include <cstdio>
#include <cstdlib>

#include "terminal.h"

namespace drover::lab {
namespace {

// What the lab's init writes after the shell ended; an unknown OSC is invisible on terminals.
constexpr const char* kEndMark = "\033]drover-lab-end\007";
constexpr char kDetach = 0x1d;  // Ctrl-]

sockaddr_un address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) throw std::runtime_error("path too long: " + path);
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return address;
}

void send_all(int fd, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = ::write(fd, data, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    data += n;
    size -= static_cast<std::size_t>(n);
  }
}

std::string hello_line() {
  winsize size{};
  ::ioctl(0, TIOCGWINSZ, &size);
  const char* term = std::getenv("TERM");
  return std::to_string(size.ws_row ? size.ws_row : 24) + " " +
         std::to_string(size.ws_col ? size.ws_col : 80) + " " + (term ? term : "dumb") + "\n";
}

}  // namespace

ConsoleServer::ConsoleServer(Fd kernel, const std::string& socket_path)
    : kernel_(std::move(kernel)), listen_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const sockaddr_un address = address_of(socket_path);
  if (::bind(listen_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listen_.get(), 4) != 0) {
    fail("cannot listen on " + socket_path);
  }
}

void ConsoleServer::accept_visitor() {
  Fd fd(::accept4(listen_.get(), nullptr, nullptr, SOCK_CLOEXEC));
  if (!fd.open()) return;
  if (visitor_.open()) {
    constexpr char kBusy[] = "somebody else is in this lab\r\n";
    send_all(fd.get(), kBusy, sizeof kBusy - 1);
    return;
  }
  visitor_ = std::move(fd);
  hello_pending_ = true;
  hello_.clear();
}

void ConsoleServer::from_visitor() {
  char buffer[4096];
  const ssize_t n = ::read(visitor_.get(), buffer, sizeof buffer);
  if (n <= 0) return visitor_.reset();
  std::size_t at = 0;
  while (hello_pending_ && at < static_cast<std::size_t>(n)) {
    const char c = buffer[at++];
    hello_ += c;
    if (c != '\n') continue;
    hello_pending_ = false;
    if (!shell_runs_) send_all(kernel_.get(), hello_.data(), hello_.size());
    // A running shell shows nothing until asked: an empty line brings its prompt back.
    if (shell_runs_) send_all(kernel_.get(), "\r", 1);
    shell_runs_ = true;
  }
  send_all(kernel_.get(), buffer + at, static_cast<std::size_t>(n) - at);
}

void ConsoleServer::from_kernel() {
  char buffer[4096];
  const ssize_t n = ::read(kernel_.get(), buffer, sizeof buffer);
  if (n <= 0) return kernel_.reset();
  if (visitor_.open()) send_all(visitor_.get(), buffer, static_cast<std::size_t>(n));
  tail_.append(buffer, static_cast<std::size_t>(n));
  if (tail_.find(kEndMark) != std::string::npos) {
    shell_runs_ = false;
    visitor_.reset();
    tail_.clear();
  }
  if (tail_.size() > 64) tail_.erase(0, tail_.size() - 64);
}

int attach(const std::string& socket_path) {
  const Fd lab(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const sockaddr_un address = address_of(socket_path);
  if (::connect(lab.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    fail("this lab has no second console (start it with --shell-socket)");
  }
  std::fprintf(stderr, "in the lab; Ctrl-D ends the shell, Ctrl-] leaves it running\n");
  const RawTerminal raw;
  const std::string hello = hello_line();
  send_all(lab.get(), hello.data(), hello.size());
  pollfd look[2]{{0, POLLIN, 0}, {lab.get(), POLLIN, 0}};
  char buffer[4096];
  while (::poll(look, 2, -1) > 0 || errno == EINTR) {
    if (look[1].revents != 0) {
      const ssize_t n = ::read(lab.get(), buffer, sizeof buffer);
      if (n <= 0) break;
      send_all(1, buffer, static_cast<std::size_t>(n));
    }
    if (look[0].revents != 0) {
      const ssize_t n = ::read(0, buffer, sizeof buffer);
      if (n <= 0 || std::memchr(buffer, kDetach, static_cast<std::size_t>(n))) break;
      send_all(lab.get(), buffer, static_cast<std::size_t>(n));
    }
  }
  return 0;
}

}  // namespace drover::lab
