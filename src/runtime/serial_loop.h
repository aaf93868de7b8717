// The thread of the serial lines: reads what comes and notes when, so that the control thread asks
// no terminal. In the kernel a poll or a read of one waits for a worker of the common pool to pass
// on what the device has, and such a worker may wait for others: beside a busy pool that took up
// to 12 s.
#pragma once

#include <poll.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "drover/spsc_ring.h"
#include "drover/time.h"
#include "gateway/slots.h"
#include "runtime/wake.h"

namespace drover::runtime {

/// What one read of a line gave.
struct HeardBytes {
  Time first = kNever;  ///< when the first of the bytes came in
  int error = 0;        ///< an errno: the line is dead, and nothing more comes
  std::uint16_t size = 0;
  std::array<std::uint8_t, 1024> bytes{};
  std::span<const std::uint8_t> view() const { return {bytes.data(), size}; }
};

/// A thread's wait for bytes, and how many it then found.
struct Listened {
  Time began = kNever;
  Time ended = kNever;
  std::size_t size = 0;
  Duration byte_time{};  ///< on the wire
};
/// When the first of the bytes came in. Who stood still does not know for how long they waited: as
/// early as it can have been, so that nothing old is taken for young.
Time first_came_in(const Listened& listened);

class SerialLoop final {
 public:
  /// Of the links whose wire is bytes.
  explicit SerialLoop(const gateway::Wiring& wiring);

  // Control thread:
  /// From now on the open line `fd` is read; what an earlier one of this link said is forgotten.
  void listen(std::size_t link, int fd, int baud);
  /// To be asked until it says true: then nobody reads the line any more, and it may be closed.
  [[nodiscard]] bool leave(std::size_t link);
  /// The next of what was read. False: there is no more.
  [[nodiscard]] bool take(std::size_t link, HeardBytes& heard);
  /// Is readable when there is something to take.
  int ready_fd() const { return ready_.fd(); }
  void clear_ready() const { ready_.clear(); }

  // Its own thread:
  void run(const std::atomic<bool>& stop);
  void wake() const { wake_.notify(); }
  /// Counts some twenty times a second while the thread lives.
  const std::atomic<std::uint64_t>& turns() const { return turns_; }

  /// So long a thread may stand whose lines nobody may need. What hangs on them is too old before.
  static constexpr Duration kLongestTurn = std::chrono::seconds(5);

 private:
  struct Line {
    std::atomic<int> wanted{-1};  ///< control → serial: what to read; -1: nothing
    std::atomic<int> held{-1};    ///< serial → control: what it does read
    std::atomic<int> baud{1};     ///< control → serial, before `wanted`
    SpscRing<HeardBytes, 16> heard;
    // Of the thread:
    HeardBytes untold;  ///< for which there was no room
    bool waits = false;
    bool dead = false;
  };
  void take_orders();
  void wait();
  void hear(Line& line, Time ended);
  /// False: what was heard has to wait for room.
  bool told(Line& line);
  static bool is_read(const Line& line) {
    return line.held.load(std::memory_order_relaxed) >= 0 && !line.dead && !line.waits;
  }

  std::vector<std::unique_ptr<Line>> lines_;  ///< by the gateway's links; nullptr: of another wire
  std::vector<pollfd> wait_;
  Time began_ = kNever;
  Wake ready_;
  Wake wake_;
  std::atomic<std::uint64_t> turns_{0};
};

}  // namespace drover::runtime
