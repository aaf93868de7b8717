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
#include "runtime/line_hold.h"
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

/// When the first of some bytes came in, the last of which did at `last`. What lay in a line for
/// long, because nobody read it, has no time that anybody could give it, and gets that of its read:
/// who knows the time of day in it (a receiver's sentences) sees by itself that it is late. Told as
/// old as it can be it would be taken for a faster line, thrown away the robot would miss where it
/// went.
Time first_came_in(Time last, std::size_t size, Duration byte_time);

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
  /// A line has room for so much that was not taken. Who took it all lets the line go on.
  static constexpr std::size_t kRoom = 16;
  void go_on() const {
    ready_.notify();
    wake_.notify();
  }

  // Its own thread:
  void run(const std::atomic<bool>& stop);
  void wake() const { wake_.notify(); }
  /// Counts some twenty times a second while the thread lives.
  const std::atomic<std::uint64_t>& turns() const { return turns_; }

  /// So long a thread may stand whose lines nobody may need. What hangs on them is too old before.
  static constexpr Duration kLongestTurn = std::chrono::seconds(20);

 private:
  struct Line {
    LineHold hold;
    int fd = -1;  ///< this and the next are the control thread's while nobody holds the line
    int baud = 1;
    SpscRing<HeardBytes, kRoom> heard;
    // Of the thread:
    HeardBytes untold;  ///< for which there was no room
    bool waits = false;
    bool dead = false;
  };
  void take_orders();
  void wait();
  void hear(Line& line, Time now);
  /// False: what was heard has to wait for room.
  bool told(Line& line);
  static bool is_read(const Line& line) { return line.hold.holds() && !line.dead && !line.waits; }

  std::vector<std::unique_ptr<Line>> lines_;  ///< by the gateway's links; nullptr: of another wire
  std::vector<pollfd> wait_;
  Wake ready_;
  Wake wake_;
  std::atomic<std::uint64_t> turns_{0};
};

}  // namespace drover::runtime
