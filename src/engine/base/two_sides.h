// Driven wheels on two sides: what a twist asks of them, and what they say of the motion.
#pragma once

#include <span>

#include "drover/fixed_vector.h"
#include "drover/measurement.h"
#include "drover/time.h"
#include "drover/twist.h"
#include "engine/config.h"

namespace drover::engine {

/// All wheels of a side turn alike; it turns by the difference.
struct TwoSides {
  double wheel_radius_m = 0;
  double track_m = 0;  ///< between the centres of the left and right wheels
  FixedVector<AxisId, kMaxSide> left;
  FixedVector<AxisId, kMaxSide> right;
};

/// Joint velocities (rad/s) of left and right wheels for a twist of base_link. When a wheel would
/// be faster than `max_wheel_mps`, both are scaled so that the curvature stays. Zero when any
/// number is not finite, or when the limit or the wheel permits no motion.
struct WheelSpeeds {
  double left_radps = 0;
  double right_radps = 0;
};
WheelSpeeds wheels_from_twist(const TwoSides& sides, double yaw_slip_factor, const Twist& twist,
                              double max_wheel_mps);
/// `left_mps`, `right_mps`: rim speeds.
Twist twist_from_wheels(const TwoSides& sides, double yaw_slip_factor, double left_mps,
                        double right_mps);

/// The last that a joint told.
struct JointMotion {
  double velocity_radps = 0;
  Time at = kNever;
};
/// By AxisId; those beyond its size told nothing.
using JointMotions = FixedVector<JointMotion, kMaxAxes>;

/// The motion at `at`. A wheel that has been silent for longer than `stale` is left out; a side
/// with no wheel left makes the motion unknown. Wheels of a side that contradict each other, or of
/// which one is silent, make it uncertain.
BodyMotion body_motion(const TwoSides& sides, const JointMotions& joints, Time at, Duration stale);

/// The largest speed ahead and the largest turn that any wheel on the left makes with any on the
/// right: wheels of one side that work against each other hide nothing. `radps` by AxisId.
Twist largest_twist(const TwoSides& sides, double yaw_slip_factor, std::span<const double> radps);

}  // namespace drover::engine
