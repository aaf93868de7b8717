// A DDS domain that no other test of this computer is in at the same time: two in one domain hear
// each other, and a stop of the one is a stop of the other. Who holds the abstract socket of a
// domain's number has the domain; the kernel takes it back with the process, however that ends.
#pragma once

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <stdexcept>

namespace drover::test {

class OwnDomain {
 public:
  OwnDomain() {
    for (int tried = 0; tried < kCount; ++tried) {
      number_ = kFirst + (::getpid() + tried) % kCount;
      socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
      if (socket_ >= 0 && is_taken()) return;
      ::close(socket_);
    }
    throw std::runtime_error("each DDS domain from 100 to 199 belongs to another test");
  }
  ~OwnDomain() { ::close(socket_); }
  OwnDomain(const OwnDomain&) = delete;
  OwnDomain& operator=(const OwnDomain&) = delete;

  int number() const { return number_; }

 private:
  static constexpr int kFirst = 100;
  static constexpr int kCount = 100;

  bool is_taken() const {
    sockaddr_un name{};
    name.sun_family = AF_UNIX;
    // The first byte is 0: a name without a file.
    const int length = std::snprintf(name.sun_path + 1, sizeof name.sun_path - 1,
                                     "drover test: DDS domain %d", number_);
    const auto size = offsetof(sockaddr_un, sun_path) + 1 + static_cast<std::size_t>(length);
    return ::bind(socket_, reinterpret_cast<const sockaddr*>(&name),
                  static_cast<socklen_t>(size)) == 0;
  }

  int number_ = kFirst;
  int socket_ = -1;
};

}  // namespace drover::test
