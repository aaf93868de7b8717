// The robot of the missions as its judges count with it: its measures and the defaults of its
// configuration, written down once, and not taken from the program that is judged.
#pragma once

namespace drover::mission {

/// Of field_scene.xml's robot, seen from above and in height.
struct RobotShape {
  double front_m = 0.45;
  double rear_m = 0.415;
  double side_m = 0.35;
  double low_m = 0.05;  ///< over the ground
  double top_m = 1.0;
};

/// Of the robot with hub motors: a motor turns ten times as often as its wheel.
inline constexpr double kGear = 10;
inline constexpr double kWheelRadius_m = 0.165;

/// limits.deceleration_mps2, default.
inline constexpr double kBrakes_mps2 = 0.8;
/// scene.margin_m, default; and the farthest from what is ahead that it may stand.
inline constexpr double kMargin_m = 0.1;
inline constexpr double kFarFrom_m = kMargin_m + 0.5;
/// The delay of the whole chain, from what is seen to the wheels.
inline constexpr double kChain_s = 0.28;
/// Two sigma of the position, and what a judge does not know better.
inline constexpr double kBlur_m = 0.1;

/// The way of a ramp to zero.
constexpr double braking_way_m(double v_mps) {
  return v_mps * v_mps / (2 * kBrakes_mps2);
}

}  // namespace drover::mission
