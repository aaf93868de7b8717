#include "link/can_link.h"

#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>

#include "link/can_wire.h"

namespace drover::link {

namespace {
constexpr std::size_t kBatch = FrameBatch::capacity();
constexpr std::size_t kControlBytes =
    CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t));
}  // namespace

struct CanLink::Buffers {
  std::array<canfd_frame, kBatch> frames{};
  std::array<iovec, kBatch> vectors{};
  std::array<mmsghdr, kBatch> messages{};
  alignas(cmsghdr) std::array<std::array<char, kControlBytes>, kBatch> control{};
  std::uint32_t last_overflow = 0;
  std::size_t used = kBatch;  ///< by the last call, from the first on: to be made ready again

  /// For the next drain. What no call has touched since is ready, and stays out of the cache.
  void make_ready() {
    for (std::size_t i = 0; i < used; ++i) {
      vectors[i].iov_len = sizeof(canfd_frame);
      messages[i].msg_hdr.msg_control = control[i].data();
      messages[i].msg_hdr.msg_controllen = kControlBytes;
      messages[i].msg_hdr.msg_flags = 0;
    }
    used = 0;
  }
};

CanLink::CanLink(UniqueFd fd) : fd_(std::move(fd)), buffers_(std::make_unique<Buffers>()) {
  for (std::size_t i = 0; i < kBatch; ++i) {
    buffers_->vectors[i].iov_base = &buffers_->frames[i];
    buffers_->messages[i].msg_hdr.msg_iov = &buffers_->vectors[i];
    buffers_->messages[i].msg_hdr.msg_iovlen = 1;
  }
}

CanLink::~CanLink() = default;

[[gnu::hot]] bool CanLink::receive(const StampWindow& window, FrameBatch& batch) {
  batch.clear();
  auto& b = *buffers_;
  b.make_ready();
  const int n = ::recvmmsg(fd_.get(), b.messages.data(), kBatch, MSG_DONTWAIT, nullptr);
  // Of the one after the last the kernel may have begun.
  b.used = std::min(kBatch, static_cast<std::size_t>(std::max(n, 0)) + 1);
  if (n < 0) {
    if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR || errno == ENOBUFS) return true;
    error_ = errno;
    return false;
  }
  for (int i = 0; i < n; ++i) {
    const auto& message = b.messages[i];
    if (message.msg_len == 0) {  // the peer of a socket pair closed
      error_ = EPIPE;
      return false;
    }
    ReceivedFrame received;
    received.received = window.now;
    for (auto* c = CMSG_FIRSTHDR(&message.msg_hdr); c != nullptr;
         c = CMSG_NXTHDR(const_cast<msghdr*>(&message.msg_hdr), c)) {
      if (c->cmsg_level != SOL_SOCKET) continue;
      if (c->cmsg_type == SO_TIMESTAMPNS) {
        timespec stamp{};
        std::memcpy(&stamp, CMSG_DATA(c), sizeof stamp);
        const Duration wall = std::chrono::seconds(stamp.tv_sec) + Duration(stamp.tv_nsec);
        received.received = monotonic_stamp(wall, window, counters_.clamped_stamps);
      } else if (c->cmsg_type == SO_RXQ_OVFL) {
        std::uint32_t total = 0;
        std::memcpy(&total, CMSG_DATA(c), sizeof total);
        counters_.receive_overflows += static_cast<std::uint32_t>(total - b.last_overflow);
        b.last_overflow = total;
      }
    }
    if (!from_wire(b.frames[i], message.msg_len, received.frame)) {
      ++counters_.malformed;
      continue;
    }
    ++counters_.received;
    (void)batch.push_back(received);
  }
  return true;
}

bool CanLink::send(std::span<const CanFrame> frames) {
  auto& b = *buffers_;
  std::size_t done = 0;
  while (done < frames.size()) {
    const std::size_t count = std::min(frames.size() - done, kBatch);
    b.used = std::max(b.used, count);
    for (std::size_t i = 0; i < count; ++i) {
      b.vectors[i].iov_len = to_wire(frames[done + i], b.frames[i]);
      b.messages[i].msg_hdr.msg_control = nullptr;
      b.messages[i].msg_hdr.msg_controllen = 0;
    }
    const int n = ::sendmmsg(fd_.get(), b.messages.data(), static_cast<unsigned>(count),
                             MSG_DONTWAIT | MSG_NOSIGNAL);
    if (n > 0) {
      counters_.sent += static_cast<std::uint64_t>(n);
      done += static_cast<std::size_t>(n);
      continue;
    }
    if (errno == EINTR) continue;
    if (errno == EAGAIN || errno == EWOULDBLOCK || errno == ENOBUFS) {
      counters_.send_refused += frames.size() - done;
      return true;
    }
    error_ = errno;
    return false;
  }
  return true;
}

}  // namespace drover::link
