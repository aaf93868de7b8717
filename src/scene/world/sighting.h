// How well a thing's place is known that came in a frame of the robot.
//
// The robot was somewhat beside where it believed to be, and looked somewhat otherwise: the thing
// is off by the first, and by its distance from the robot times the second.
#pragma once

#include <string>

#include "drover/result.h"
#include "scene/message/header.h"
#include "scene/message/shapes.h"
#include "scene/plane/point.h"

namespace drover::scene {

/// From where, and how well known that was. All zero: it came in `map`.
struct Sighting {
  Point2 from;
  double position_sigma_m = 0;
  double yaw_sigma_rad = 0;
};

/// Two sigma: what the heading's error throws farther aside is not placed at all.
inline constexpr double kMostAside_m = 0.3;
/// A plane has no end: it is as far away as a robot looks, or as it is itself, if that is more.
inline constexpr double kPlaneReach_m = 10;

/// Level, from there to the shape's farthest point.
double farthest_m(const SolidPrimitive& shape, const Pose& in_map, Point2 from);
double farthest_m(const Mesh& shape, const Pose& in_map, Point2 from);
double farthest_m(const Plane& shape, const Pose& in_map, Point2 from);

/// One sigma of the place of a thing that reaches so far; or why that is too much.
Result<double, std::string> sigma_of_place(const Sighting& seen, double farthest_m);

}  // namespace drover::scene
