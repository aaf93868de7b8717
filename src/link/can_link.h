// An open CAN descriptor: SocketCAN, or a SOCK_SEQPACKET socket that carries `struct can_frame`s.
//
// Not in epoll: the control loop drains it once a cycle with one recvmmsg per batch, and sends with
// one sendmmsg, because a wake-up for each frame would cost more than everything else.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "drover/can_frame.h"
#include "drover/fixed_vector.h"
#include "drover/time.h"
#include "link/can_stamp.h"
#include "link/unique_fd.h"

namespace drover::link {

struct ReceivedFrame {
  CanFrame frame;
  Time received = kNever;
};
using FrameBatch = FixedVector<ReceivedFrame, 64>;

struct CanCounters {
  std::uint64_t received = 0;
  std::uint64_t sent = 0;
  std::uint64_t receive_overflows = 0;  ///< dropped by the kernel because nobody read (SO_RXQ_OVFL)
  std::uint64_t send_refused = 0;       ///< EAGAIN or ENOBUFS: the bus does not take our frames
  std::uint64_t clamped_stamps = 0;     ///< kernel stamps outside [previous drain, now]
  std::uint64_t malformed = 0;          ///< datagrams that are no frame
};

class CanLink final {
 public:
  /// `fd` is open, bound and non-blocking. Allocates its buffers here, never again.
  explicit CanLink(UniqueFd fd);
  ~CanLink();

  /// Fills `batch` with what waits, at most its capacity. False when the descriptor is dead
  /// (interface removed, peer gone); error() tells why.
  [[nodiscard]] bool receive(const StampWindow& window, FrameBatch& batch);
  /// Sends in order; what the kernel does not take is dropped and counted: a command must not wait,
  /// it would be old when it leaves. False when the descriptor is dead.
  [[nodiscard]] bool send(std::span<const CanFrame> frames);

  int error() const { return error_; }
  const CanCounters& counters() const { return counters_; }
  int fd() const { return fd_.get(); }

 private:
  struct Buffers;
  UniqueFd fd_;
  std::unique_ptr<Buffers> buffers_;
  CanCounters counters_;
  int error_ = 0;
};

}  // namespace drover::link
