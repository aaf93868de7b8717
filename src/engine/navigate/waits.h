// What a task waits for, and when that has lasted too long.
#pragma once

#include "engine/config.h"
#include "engine/navigate/corridor.h"
#include "engine/navigate/nav_input.h"

namespace drover::engine {

/// A reason to wait, from its beginning until there was health for long enough.
class Wait final {
 public:
  /// One cycle; `after`: of health before it ends, by what is bad now.
  void update(bool bad, Time now, Duration after);
  bool holds() const { return since_ != kNever; }
  Time since() const { return since_; }
  bool longer_than(double limit_s, Time now) const {
    return holds() && now - since_ > from_s(limit_s);
  }

 private:
  Time since_ = kNever;  ///< kNever: not waiting
  Time last_bad_ = kNever;
  Duration resume_after_{};
};

/// All of a task's. Pure.
class Waits final {
 public:
  explicit Waits(const EngineConfig& config)
      : config_(config.navigate), unasked_limit_s_(config.clearance.wait_s) {}

  /// A task begins, and waits for nothing.
  void begin();
  /// One cycle.
  void update(const NavInput& input, const OnTrack& on);

  /// The task pauses for one of them.
  bool holds() const { return obstacle_.holds() || constraint_.holds() || place_.holds(); }
  bool for_obstacle() const { return obstacle_.holds(); }
  bool for_constraint() const { return constraint_.holds(); }
  bool for_place() const { return place_.holds(); }
  /// Which is told.
  const Reason& why(const HealthReport& health) const;
  /// Why the robot may be outside of its corridor, as of the last update; empty: it may not.
  const Reason& outside() const { return outside_; }
  /// What the task fails for; empty: it may wait on.
  Reason too_long(const NavInput& input, const OnTrack& on) const;

 private:
  bool place_too_long(const NavInput& input, const OnTrack& on) const;

  NavigateConfig config_;
  double unasked_limit_s_;
  Wait obstacle_;
  Wait constraint_;
  Wait place_;  ///< it is not known well enough
  Reason outside_;
  Wait unasked_;
};

}  // namespace drover::engine
