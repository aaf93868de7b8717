// How long the control thread itself stood still, and what that means for a robot that moved. Pure:
// time is an argument.
#pragma once

#include "drover/time.h"
#include "runtime/guard_watch.h"

namespace drover::runtime {

struct HoldUp {
  enum class Kind : std::uint8_t {
    none,
    told,   ///< nobody steered for longer than the guard waits at the least
    stops,  ///< a guard that lived would have taken the drives over
    slept,  ///< the whole computer: nothing that was heard before is true any more
  };
  Kind kind = Kind::none;
  Duration lasted{};
};

/// Whatever stops droverd may stop the guard as well (a virtual machine that is paused), and drives
/// go on by their last command meanwhile. So droverd does to itself what a guard that lived would
/// have done: not earlier, since that one takes a busy computer's hold-ups, too.
class HoldUps final {
 public:
  static constexpr Duration kSleep = std::chrono::seconds(1);
  static constexpr Duration kToldAgain = std::chrono::seconds(10);

  /// `guard_limit`: what the guard gives the daemon's heartbeat.
  explicit HoldUps(Duration guard_limit)
      : told_(guard_limit), stops_(guard_limit + GuardWatch::kCycles) {}

  /// Each cycle, at its begin. `asleep`: since the computer booted; the monotonic clock stood still
  /// meanwhile. `moved`: something did in the cycle before.
  HoldUp update(Time now, Duration asleep, bool moved) {
    const Duration slept = asleep - asleep_;
    const Time before = begun_;
    asleep_ = asleep;
    begun_ = now;
    if (before == kNever) return {};
    const Duration lasted = now - before + slept;
    if (slept > kSleep) return {HoldUp::Kind::slept, slept};
    if (!moved || lasted <= told_) return {};
    if (lasted > stops_) return {HoldUp::Kind::stops, lasted};
    if (told_at_ != kNever && now - told_at_ < kToldAgain) return {};
    told_at_ = now;
    return {HoldUp::Kind::told, lasted};
  }

 private:
  Duration told_;
  Duration stops_;
  Duration asleep_{};
  Time begun_ = kNever;
  Time told_at_ = kNever;
};

}  // namespace drover::runtime
