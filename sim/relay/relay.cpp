// Joins whoever connects to one address to another, byte for byte:
//   drover-sim-relay unix:PATH|tcp:ADDRESS:PORT unix:PATH|tcp:ADDRESS:PORT
// The first is listened on. It ends with whoever started it.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <list>
#include <stdexcept>
#include <string>
#include <vector>

#include "link/unique_fd.h"

namespace {

using drover::link::UniqueFd;

/// More than this does not wait here: nothing further is read until it has left.
constexpr std::size_t kMostWaiting = 1 << 20;

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what + ": " + std::strerror(errno));
}

struct Address {
  std::string text;
  sockaddr_storage storage{};
  socklen_t size = 0;

  const sockaddr* generic() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

Address read_address(const std::string& text) {
  Address address{text};
  const auto no = [&text] { return std::runtime_error(text + ": is no address"); };
  if (text.starts_with("unix:")) {
    auto& un = reinterpret_cast<sockaddr_un&>(address.storage);
    const std::string path = text.substr(5);
    if (path.empty() || path.size() >= sizeof un.sun_path) throw no();
    un.sun_family = AF_UNIX;
    std::memcpy(un.sun_path, path.c_str(), path.size() + 1);
    address.size = sizeof un;
    return address;
  }
  const auto colon = text.rfind(':');
  if (!text.starts_with("tcp:") || colon < 4) throw no();
  auto& in = reinterpret_cast<sockaddr_in&>(address.storage);
  in.sin_family = AF_INET;
  in.sin_port = htons(static_cast<std::uint16_t>(std::stoi(text.substr(colon + 1))));
  if (::inet_pton(AF_INET, text.substr(4, colon - 4).c_str(), &in.sin_addr) != 1) throw no();
  address.size = sizeof in;
  return address;
}

UniqueFd make_socket(const Address& address) {
  UniqueFd fd(::socket(address.storage.ss_family, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!fd) fail(address.text);
  const int one = 1;
  if (address.storage.ss_family == AF_INET) {
    ::setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &one, sizeof one);
    ::setsockopt(fd.get(), IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
  }
  return fd;
}

UniqueFd listen_on(const Address& address) {
  if (address.storage.ss_family == AF_UNIX) ::unlink(address.text.c_str() + 5);
  UniqueFd fd = make_socket(address);
  if (::bind(fd.get(), address.generic(), address.size) != 0 || ::listen(fd.get(), 8) != 0)
    fail(address.text);
  return fd;
}

/// One direction.
struct Way {
  int from = -1;
  int to = -1;
  std::string waiting;

  /// False: one of both has ended.
  bool carry(short from_ready, short to_ready) {
    std::array<char, 65536> block{};
    if ((from_ready & (POLLIN | POLLHUP | POLLERR)) != 0 && waiting.size() < kMostWaiting) {
      const auto n = ::recv(from, block.data(), block.size(), MSG_DONTWAIT);
      if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR)) return false;
      if (n > 0) waiting.append(block.data(), static_cast<std::size_t>(n));
    }
    if (waiting.empty() || (to_ready & POLLERR) != 0) return (to_ready & POLLERR) == 0;
    const auto n = ::send(to, waiting.data(), waiting.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (n > 0) waiting.erase(0, static_cast<std::size_t>(n));
    return n > 0 || errno == EAGAIN || errno == EINTR;
  }
  short wants_of_from() const { return waiting.size() < kMostWaiting ? POLLIN : 0; }
  short wants_of_to() const { return waiting.empty() ? 0 : POLLOUT; }
};

struct Pair {
  UniqueFd caller;
  UniqueFd called;
  Way in{caller.get(), called.get(), {}};
  Way out{called.get(), caller.get(), {}};
};

void serve(const Address& here, const Address& there) {
  const UniqueFd listener = listen_on(here);
  std::list<Pair> pairs;
  for (;;) {
    std::vector<pollfd> polls{{listener.get(), POLLIN, 0}};
    for (const Pair& pair : pairs) {
      const auto wants = [](const Way& from, const Way& to) {
        return static_cast<short>(from.wants_of_from() | to.wants_of_to());
      };
      polls.push_back({pair.caller.get(), wants(pair.in, pair.out), 0});
      polls.push_back({pair.called.get(), wants(pair.out, pair.in), 0});
    }
    if (::poll(polls.data(), polls.size(), -1) < 0 && errno != EINTR) fail("poll");
    std::size_t i = 1;
    for (auto pair = pairs.begin(); pair != pairs.end(); i += 2) {
      const short caller = polls[i].revents;
      const short called = polls[i + 1].revents;
      const bool both = pair->in.carry(caller, called) && pair->out.carry(called, caller);
      pair = both ? std::next(pair) : pairs.erase(pair);
    }
    if (polls[0].revents == 0) continue;
    UniqueFd caller(::accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC));
    UniqueFd called = make_socket(there);
    // He is told by the end of his connection, and comes again.
    if (!caller || ::connect(called.get(), there.generic(), there.size) != 0) continue;
    pairs.push_back({std::move(caller), std::move(called)});
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) throw std::runtime_error("two addresses are needed");
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  serve(read_address(argv[1]), read_address(argv[2]));
} catch (const std::exception& error) {
  std::fprintf(stderr, "drover-sim-relay: %s\n", error.what());
  return 2;
}
