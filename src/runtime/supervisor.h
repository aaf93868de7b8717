// Which of the daemon's threads stands still. Pure: the main thread looks ten times a second.
//
// Not watched: the storage, log and name threads, which may wait as long as a disk, a reader or a
// name server does, and which nobody waits for.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string_view>

#include "drover/fixed_vector.h"
#include "drover/time.h"

namespace drover::runtime {

/// A thread that counts its turns, and how long it may stand still.
struct WatchedThread {
  const char* trouble = "";  ///< what to say when it stands still; of static lifetime
  const std::atomic<std::uint64_t>* turns = nullptr;
  Duration limit{};
};

class Supervisor final {
 public:
  /// How often to look; the limits of persons' threads leave a second less this and a cycle.
  static constexpr Duration kPeriod = std::chrono::milliseconds(100);

  /// At most sixteen; the row must outlive the supervisor's use.
  void watch(const WatchedThread& thread) { (void)rows_.push_back({thread, 0, kNever}); }

  /// The first that stands still beyond its limit. Whoever was held up himself judges nobody: the
  /// time of a long pause between two looks counts for none.
  const WatchedThread* stalled(Time now);

 private:
  struct Row {
    WatchedThread thread;
    std::uint64_t turns = 0;
    Time moved = kNever;
  };
  FixedVector<Row, 24> rows_;
  Time looked_ = kNever;
};

}  // namespace drover::runtime
