// Free distance ahead of the robot: what a planar safety scanner's zones would see.
#pragma once

#include <span>

namespace drover::sim {

/// A standing box seen from above, in base_link (x ahead, y left).
struct Footprint {
  double x_m = 0;  ///< of its centre
  double y_m = 0;
  double yaw_rad = 0;
  double half_length_m = 0;  ///< along its own x
  double half_width_m = 0;
};

/// Distance from `front_m` (the bumper's face, along x) to the nearest part of any box inside the
/// corridor |y| <= width_m / 2; infinity when it is free, 0 when a box reaches over the face.
double free_distance_m(std::span<const Footprint> boxes, double front_m, double width_m);

}  // namespace drover::sim
