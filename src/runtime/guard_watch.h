// The control thread's view of the guard: whether it lives, holds the bus, was told to stop; and
// when the bus is asked back.
#pragma once

#include <cstdint>

#include "drover/time.h"

namespace drover::runtime {

/// What the guard writes into the shared memory.
struct GuardSigns {
  std::uint64_t beats = 0;
  bool holds = false;        ///< it sends the stop frames itself
  bool latched = false;      ///< `drover stop` reached it
  bool set_refused = false;  ///< it keeps the stop set that it has: this program's lacks axes
};

class GuardWatch final {
 public:
  /// The bus is asked back when it was the guard's for this long.
  static constexpr Duration kHandBackAfter = std::chrono::milliseconds(500);
  /// What moves on under the guard's frames cannot wait.
  static constexpr Duration kHandBackAtOnce = std::chrono::milliseconds(30);
  /// The guard's own cycle is 10 ms. It is given what it gives us, and three cycles more; then it
  /// is not there.
  static constexpr Duration kCycles = std::chrono::milliseconds(30);

  /// `limit`: what the guard gives the daemon's heartbeat.
  explicit GuardWatch(Duration limit) : silent_after_(limit + kCycles) {}

  /// Each cycle. True when the guard was told to stop and this program was not yet.
  bool update(const GuardSigns& signs, Time now) {
    const Duration gap = updated_ == kNever ? Duration{} : now - updated_;
    const bool held_up = gap > kCycles;
    // By the guard's own count.
    missed_us_ = gap >= silent_after_ - kCycles;
    updated_ = now;
    if (signs.beats != beats_) {
      beats_ = signs.beats;
      heard_ = now;
      graced_ = kNever;
    } else if (held_up && graced_ == kNever && heard_ != kNever) {
      graced_ = now;
    }
    if (signs.holds && !holds_) held_since_ = now;
    holds_ = signs.holds;
    const bool newly_latched = signs.latched && !latched_;
    latched_ = signs.latched;
    set_refused_ = signs.set_refused;
    return newly_latched;
  }
  /// Who was held up himself may have been so together with the guard, which has to be heard in
  /// three of its cycles then.
  bool alive(Time now) const {
    return heard_recently(now) || (graced_ != kNever && now - graced_ < kCycles);
  }
  /// A guard that is gone sends nothing more, whatever it wrote last: then the drives are ours.
  bool holds(Time now) const { return holds_ && heard_recently(now); }
  /// The same by what it writes at this moment: one that was frozen and goes on is back.
  bool holds(const GuardSigns& signs, Time now) const {
    return signs.holds && (signs.beats != beats_ || heard_recently(now));
  }
  bool latched() const { return latched_; }
  /// Since the cycle before it had no heartbeat of ours for too long: it plays all, also what it
  /// leaves to this program by a stop from outside, and what it damped has gone on meanwhile.
  bool missed_us() const { return missed_us_; }
  /// It keeps the stop set of another program, until it is reset.
  bool refuses_set() const { return set_refused_; }

  /// True when the bus is to be asked back now; `calm`: no task, and the program is well.
  /// `at_once`: see cannot_wait().
  bool ask_back(bool calm, bool at_once, Time now) {
    const Duration pause = at_once ? kHandBackAtOnce : kHandBackAfter;
    if (!holds(now) || latched_ || !calm) return false;
    if (now - held_since_ <= pause || now - asked_ <= pause) return false;
    asked_ = now;
    return true;
  }

 private:
  bool heard_recently(Time now) const { return heard_ + silent_after_ > now; }

  Duration silent_after_;
  std::uint64_t beats_ = 0;
  Time heard_ = kNever;
  Time updated_ = kNever;
  Time graced_ = kNever;  ///< once for each silence
  Time held_since_ = kNever;
  Time asked_ = kNever;
  bool holds_ = false;
  bool latched_ = false;
  bool set_refused_ = false;
  bool missed_us_ = false;  ///< this program stood still for so long that it was taken for gone
};

}  // namespace drover::runtime
