// What the engine knows of the way a base moves: everybody else asks here. A new kind of base is
// one more alternative and its answers.
#pragma once

#include <bitset>
#include <limits>
#include <variant>

#include "engine/base/mecanum.h"
#include "engine/base/two_sides.h"
#include "engine/config.h"

namespace drover::engine {

/// Wheels that skid sideways when the base turns: how much they do is learned while it drives.
struct SkidSteer {
  TwoSides sides;
};
/// Wheels on one axle, which turn without skidding.
struct Differential {
  TwoSides sides;
};
/// A device that takes a twist and tells one: how it does it is its own affair. Its left and right
/// edge stand for wheels, so that whoever watches wheels watches them, too: joints 0 and 1, whose
/// radius is a metre, and which nobody outside the engine sees.
struct TwistBase {
  TwoSides sides;
};
/// The same, of a device that steers its front wheels: it turns on a curve only, and the edges that
/// stand for wheels are those of its rear axle, the middle of which is base_link.
struct Ackermann {
  TwoSides sides;
  double wheelbase_m = 0;
  double max_steering_rad = 0;     ///< of the inner wheel
  double steering_rate_radps = 0;  ///< of the inner wheel, at least
};
using Kinematics = std::variant<SkidSteer, Differential, TwistBase, Ackermann, Mecanum>;

TwoSides sides_of(const BaseConfig& base);
Kinematics kinematics_of(const BaseConfig& base);

/// What a base can drive at all.
struct BodyLimits {
  bool pivots = true;            ///< it turns on the spot
  bool sideways = false;         ///< it goes sideways
  double smallest_radius_m = 0;  ///< of the curve of base_link
  /// How fast the curvature changes, whatever it is; infinite: as fast as the speeds do.
  double curvature_rate_radpms = std::numeric_limits<double>::infinity();

  double most_radpm() const {
    return smallest_radius_m > 0 ? 1 / smallest_radius_m : std::numeric_limits<double>::infinity();
  }
};
BodyLimits limits(const Kinematics& base);

/// Its wheels roll in a turn: they do not skid.
bool rolls_in_turns(const Kinematics& base);
/// Between the axles of a base that steers; 0: it does not.
double steered_wheelbase_m(const Kinematics& base);

/// Of a base that steers: the angle of a wheel in the middle of its steered axle, and back.
double steering_rad(double wheelbase_m, double curvature_radpm);
double curvature_radpm(double wheelbase_m, double steering_rad);

/// It is told a twist, and has no joints that anybody sees.
bool takes_twist(const Kinematics& base);
/// The unit of a joint's velocity, for people.
const char* joint_unit(const Kinematics& base);

/// How many joints there have to be, so that all that the base names exist.
std::size_t joints_needed(const BaseConfig& base);

/// The joints that move the base, by AxisId.
using JointSet = std::bitset<kMaxAxes>;
JointSet joints_of(const Kinematics& base);

/// What the estimator has learned of the base and the inverse has to make up for.
struct Learned {
  double yaw_slip_factor = 1;  ///< how much wider than its track the base behaves in a turn
};

/// rad/s by AxisId; zero for joints that do not belong to the base, and none behind its last.
using JointVelocities = FixedVector<double, kMaxAxes>;

/// What the joints have to do for a twist of base_link. No rim is faster than `max_rim_mps`: all
/// are scaled then, so that curvature and direction stay. One that steers turns on no tighter curve
/// than it can, and at rest not at all. At rest when a number is not finite, or when the limit
/// permits no motion.
JointVelocities setpoints(const Kinematics& base, const Twist& twist, const Learned& learned,
                          double max_rim_mps);

/// What the edges of a base that takes a twist do in such a motion, m/s; and the twist that they
/// make together.
JointVelocities edges_of(const Kinematics& base, const Twist& twist);
Twist twist_of_edges(const Kinematics& base, const JointVelocities& mps);

/// The most that joints at these velocities can make of the base: both numbers positive.
Twist largest_twist(const Kinematics& base, const JointVelocities& radps, const Learned& learned);

/// The twist that joints at these velocities make: of each side the mean; sideways what rollers
/// make of the difference of front and rear.
Twist twist_of(const Kinematics& base, const JointVelocities& radps, const Learned& learned);

/// The last that a base told of its motion: by its joints, or by itself.
struct Told {
  JointMotions joints;
  BodyMotion body;
  Time body_at = kNever;
};
/// What the base did at `at`, by what it told until then. What is older than `stale` says nothing.
BodyMotion body_motion(const Kinematics& base, const Told& told, Time at, Duration stale);
/// The next instant after `at` when something that counts now will have gone stale, or the far
/// future.
Time next_stale(const Told& told, Time at, Duration stale);

/// Speed over ground of a joint's rim, and back.
double rim_mps(const Kinematics& base, double radps);
double joint_radps(const Kinematics& base, double rim_mps);

/// What the kinematics know of their own errors, put in place of what holds for a base that skids.
/// A configuration that asks for less keeps it.
EstimateConfig tuned(const Kinematics& base, const EstimateConfig& config);

/// What a turn that the base tells of gets wrong for seconds.
struct TurnErrors {
  double pull_radpm = 0;  ///< turned on the way without a word, because one side pulls
  double share = 0;       ///< of the turn, between a wide curve and a turn on the spot
};
TurnErrors turn_errors(const Kinematics& base);

/// How far apart wheels of two sides would be that turned as fast as its own when it turns.
double track_of_turn_m(const Kinematics& base);

/// The fastest wheel on the ground in such a motion, m/s.
double fastest_mps(const Kinematics& base, const Twist& twist);

/// Rim speed that no joint is commanded beyond: full speed in the tightest permitted turn, m/s.
double max_rim_mps(const Kinematics& base, const LimitsConfig& limits, const Learned& learned);

}  // namespace drover::engine
