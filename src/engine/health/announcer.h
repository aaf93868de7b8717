// Tells the journal when something begins to be wrong and when it is over.
#pragma once

#include "engine/event_queue.h"
#include "engine/health/health.h"

namespace drover::engine {

/// One notice at each change of a cause, and of one cause at most one pair a second: a source that
/// flaps each cycle must not flood the journal.
class Announcer final {
 public:
  void update(Time now, const HealthReport& report, EventQueue& events);

 private:
  Time begun_ = kNever;
  std::uint64_t told_ = 0;  ///< bits by Cause
  std::array<Time, kCauseCount> told_at_ = [] {
    std::array<Time, kCauseCount> times{};
    times.fill(kNever);
    return times;
  }();
};

}  // namespace drover::engine
