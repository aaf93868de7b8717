// The service manager, spoken to by a datagram of our own that never waits: its library does, when
// nobody reads the socket. It also keeps descriptors for us over our own death.
#pragma once

#include <sys/un.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace drover::guard {

class Notify final {
 public:
  /// To the socket that $NOTIFY_SOCKET names; without one everything is accepted and nothing done.
  Notify();
  ~Notify();
  Notify(const Notify&) = delete;
  Notify& operator=(const Notify&) = delete;

  /// "READY=1", "WATCHDOG=1". False when it was not taken; counted.
  bool say(std::string_view words) { return send(words, -1); }
  /// Keeps a duplicate of `fd` under `name`, also when it hangs up.
  bool store(std::string_view name, int fd);
  /// Drops everything that is kept under `name`.
  bool forget(std::string_view name);
  /// Datagrams that were not taken.
  std::uint64_t unsaid() const { return unsaid_; }

 private:
  bool send(std::string_view words, int fd);

  int fd_ = -1;
  sockaddr_un address_{};
  unsigned address_size_ = 0;
  std::uint64_t unsaid_ = 0;
};

/// A descriptor that the service manager kept for us.
struct Kept {
  std::string name;
  int fd = -1;
};

/// What it gave at start ($LISTEN_FDS, $LISTEN_FDNAMES); the caller owns the descriptors.
std::vector<Kept> take_kept();

}  // namespace drover::guard
