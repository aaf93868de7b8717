// Both ends of the visitors' Unix socket.
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

ConsoleServer::ConsoleServer(std::vector<Fd> kernel_ends, const std::string& socket_path)
    : listen_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  for (auto& end : kernel_ends) {
    seats_.emplace_back();
    seats_.back().kernel = std::move(end);
  }
  const sockaddr_un address = address_of(socket_path);
  if (::bind(listen_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listen_.get(), 4) != 0) {
    fail("cannot listen on " + socket_path);
  }
}

ConsoleServer::Seat* ConsoleServer::free_seat() {
  for (const bool left_running : {true, false})
    for (auto& seat : seats_)
      if (!seat.visitor.open() && seat.shell_runs == left_running) return &seat;
  return nullptr;
}

void ConsoleServer::accept_visitor() {
  Fd fd(::accept4(listen_.get(), nullptr, nullptr, SOCK_CLOEXEC));
  if (!fd.open()) return;
  Seat* seat = free_seat();
  if (seat == nullptr) {
    const std::string full = std::to_string(seats_.size()) + " people are in this lab already\r\n";
    send_all(fd.get(), full.data(), full.size());
    return;
  }
  seat->visitor = std::move(fd);
  seat->hello_pending = true;
  seat->hello.clear();
}

void ConsoleServer::from_visitor(std::size_t number) {
  Seat& seat = seats_[number];
  char buffer[4096];
  const ssize_t n = ::read(seat.visitor.get(), buffer, sizeof buffer);
  if (n <= 0) return seat.visitor.reset();
  std::size_t at = 0;
  while (seat.hello_pending && at < static_cast<std::size_t>(n)) {
    const char c = buffer[at++];
    seat.hello += c;
    if (c != '\n') continue;
    seat.hello_pending = false;
    if (!seat.shell_runs) send_all(seat.kernel.get(), seat.hello.data(), seat.hello.size());
    // A running shell shows nothing until asked: an empty line brings its prompt back.
    if (seat.shell_runs) send_all(seat.kernel.get(), "\r", 1);
    seat.shell_runs = true;
  }
  send_all(seat.kernel.get(), buffer + at, static_cast<std::size_t>(n) - at);
}

void ConsoleServer::from_kernel(std::size_t number) {
  Seat& seat = seats_[number];
  char buffer[4096];
  const ssize_t n = ::read(seat.kernel.get(), buffer, sizeof buffer);
  if (n <= 0) return seat.kernel.reset();
  if (seat.visitor.open()) send_all(seat.visitor.get(), buffer, static_cast<std::size_t>(n));
  seat.tail.append(buffer, static_cast<std::size_t>(n));
  if (seat.tail.find(kEndMark) != std::string::npos) {
    seat.shell_runs = false;
    seat.visitor.reset();
    seat.tail.clear();
  }
  if (seat.tail.size() > 64) seat.tail.erase(0, seat.tail.size() - 64);
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
