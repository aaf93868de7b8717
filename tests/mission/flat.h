// Things and the robot seen from above, at the robot's heights, and the gap between them: exact,
// and by geometry of its own. Knows nothing of src/scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mission/robot.h"
#include "mission/track.h"

namespace drover::mission {

/// A convex polygon, counter-clockwise, grown by a radius: one corner alone makes a disc.
struct Flat {
  std::vector<Place> corners;
  double radius_m = 0;
};

/// Between two of them; negative: they overlap, by about so much. Exact while they do not.
double gap_m(const Flat& a, const Flat& b);

Flat outline(double x_m, double y_m, double yaw_rad, const RobotShape& robot = {});

/// As the simulator put it there: upright, on flat ground.
struct TrueSolid {
  std::string name;
  std::string kind;  ///< box, cylinder, sphere, cone, prism
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;  ///< of the middle of its height
  double yaw_rad = 0;
  std::vector<double> sizes;  ///< as objects.log has them
};
/// What of it is at the robot's heights; nothing: it is above or below them.
std::optional<Flat> flat(const TrueSolid& solid, const RobotShape& robot = {});

}  // namespace drover::mission
