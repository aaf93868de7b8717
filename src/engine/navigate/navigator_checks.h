// Whether a task may start: each refusal with its reason.
#pragma once

#include "drover/command.h"
#include "engine/health/health.h"
#include "engine/navigate/tracker.h"

namespace drover::engine {

/// The asked speed as it will be driven, or why not. Too fast is clamped, and `note` says so.
struct SpeedCheck {
  double speed_mps = 0;
  Reason refusal;  ///< empty: accepted
  Reason note;
};
SpeedCheck check_speed(double asked_mps, const LimitsConfig& limits);

/// Whether the robot itself is fit to start; empty when it is.
Reason check_robot(const HealthReport& health, bool has_origin);

/// Whether the robot stands where the track can be joined, `progress` from a tracker that began
/// there; empty when it does. `path` must have passed check_path.
Reason check_place(const Path& path, std::uint32_t target, const Pose& pose,
                   const TrackProgress& progress, const NavigateConfig& config);

/// Whether a base that steers can drive the way from there to the target: no corner but where it
/// goes on the other way, and no curve tighter than its smallest. Others can drive any. O(points).
Reason check_curves(const Path& path, std::uint32_t target, const Pose& pose,
                    const NavigateConfig& config, const BodyLimits& body);

/// Whether a base that steers, beside its track or turned away from it, is on it before the target.
Reason check_joining(std::uint32_t target, const TrackProgress& progress,
                     const NavigateConfig& config, const BodyLimits& body);

}  // namespace drover::engine
