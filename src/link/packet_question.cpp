#include "link/packet_question.h"

#include <sys/socket.h>
#include <sys/time.h>

#include <array>
#include <cerrno>

#include "link/unique_fd.h"
#include "link/unix_address.h"

namespace drover::link {

Result<std::string, int> ask_packet(const std::string& path, std::string_view word,
                                    std::chrono::milliseconds patience) {
  const auto address = unix_address(path);
  if (!address) return ENAMETOOLONG;
  const UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  const timeval limit{patience.count() / 1000, patience.count() % 1000 * 1000};
  ::setsockopt(fd.get(), SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
  ::setsockopt(fd.get(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  if (::connect(fd.get(), reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0 ||
      ::send(fd.get(), word.data(), word.size(), MSG_NOSIGNAL) < 0)
    return errno;
  std::array<char, 1024> bytes{};
  const ssize_t n = ::recv(fd.get(), bytes.data(), bytes.size(), 0);
  if (n < 0) return errno;
  return std::string(bytes.data(), static_cast<std::size_t>(n));
}

}  // namespace drover::link
