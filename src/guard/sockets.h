// Unix sockets: one listener a path, and messages that carry a descriptor.
#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <array>
#include <cstddef>
#include <string>

namespace drover::guard {

/// A non-blocking SOCK_SEQPACKET listener at `path`, for its owner and group. -1 with the reason in
/// `problem`. Another guard's socket is left alone: who holds `path`.lock has the path.
int listen_at(const std::string& path, std::string& problem);
/// The next client, non-blocking; -1 when there is none. `uid` is who asked, as the kernel knows.
int accept_from(int listener, uid_t& uid);

/// One message and one descriptor with it. Valid while the bytes are.
class PassedMessage final {
 public:
  PassedMessage(void* bytes, std::size_t size);
  PassedMessage(const PassedMessage&) = delete;
  PassedMessage& operator=(const PassedMessage&) = delete;
  msghdr& header() { return header_; }
  /// To be sent with it; -1: none. Without this the room for one to be received stays.
  void pass(int fd);
  /// The descriptor that was received, or -1; the caller owns it.
  int passed();

 private:
  iovec vector_{};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control_{};
  msghdr header_{};
};

}  // namespace drover::guard
