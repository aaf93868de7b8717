// Four wheels with rollers round them at 45 degrees, which together make an X when they are seen
// from above: what a twist asks of them, and what they say of the motion.
#pragma once

#include <array>

#include "engine/base/two_sides.h"

namespace drover::engine {

/// It turns as wheels of two sides do that are a track and a wheelbase apart. On each side the
/// front wheel is the first, the rear one the second.
struct Mecanum {
  TwoSides sides;
};

Mecanum mecanum_of(const BaseConfig& base);

/// rad/s by AxisId. No rim is faster than `max_rim_mps`: all are scaled then. At rest when a number
/// is not finite, or when the limit permits no motion.
FixedVector<double, kMaxAxes> setpoints(const Mecanum& base, const Twist& twist,
                                        double yaw_slip_factor, double max_rim_mps);

/// To the left, by joints at these velocities: rad/s by AxisId, missing ones at rest.
double sideways_mps(const Mecanum& base, std::span<const double> radps);

/// The motion at `at`; not known without one of the wheels, as no other tells what it does. That
/// they work against each other makes it uncertain, and so does all that goes sideways: rollers
/// slip.
BodyMotion body_motion(const Mecanum& base, const JointMotions& joints, Time at, Duration stale);

}  // namespace drover::engine
