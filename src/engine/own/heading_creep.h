// The short straight way that shows a receiver with one antenna where the robot is heading.
#pragma once

#include "drover/angle.h"
#include "drover/command.h"
#include "drover/twist.h"
#include "engine/event_queue.h"
#include "engine/health/arm_wait.h"
#include "engine/health/health.h"
#include "engine/health/locate.h"

namespace drover::engine {

/// Straight ahead, slowly, until the estimate has a heading that a task may begin with; asked for
/// by a person, who watches.
class HeadingCreep final {
 public:
  explicit HeadingCreep(const EngineConfig& config)
      : config_(config.navigate),
        deceleration_mps2_(config.limits.deceleration_mps2),
        good_rad_(kGoodAgain * to_rad(config.estimate.bound_yaw_deg)) {}

  /// `hindrance`: why nothing may move now; empty: it may.
  void start(const RequestId& id, std::string_view hindrance, const Estimate& estimate,
             const HealthReport& health, Time now, EventQueue& events);
  void end(std::string_view why, Time now, EventQueue& events);

  /// What to drive now; zero while the drives are armed and when it is over.
  Twist step(Time now, Duration dt, const Estimate& estimate, const HealthReport& health,
             EventQueue& events);
  bool active() const { return active_; }
  /// Why the last search ended without a heading, until there is one or it is looked for again.
  const Reason& failed() const { return failed_; }
  /// It ended in this cycle because a drive that ran does no more.
  bool lost() const { return lost_; }
  /// Total time after which it gives up.
  double timeout_s() const;

 private:
  /// Well enough for a task to begin.
  bool knows_heading(const Estimate& estimate) const {
    return estimate.has_heading && estimate.yaw_error_rad <= good_rad_;
  }

  NavigateConfig config_;
  double deceleration_mps2_;
  double good_rad_;  ///< two sigma of a heading that is found
  bool active_ = false;
  bool lost_ = false;
  Reason failed_;
  ArmWait drives_;
  Time began_ = kNever;
  double driven_m_ = 0;
};

}  // namespace drover::engine
