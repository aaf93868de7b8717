// Where on a whole path a robot begins: the only search that looks at every point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "track/path_geometry.h"

namespace drover::track {

/// Which way the robot looks along a path: see Path.
struct Gears {
  std::span<const std::uint8_t> backwards = {};
  bool either = false;
};
inline Gears gears_of(const Path& path) {
  return {path.backwards, path.either};
}

struct PathStart {
  std::size_t segment = 0;  ///< of the list: between its points `segment` and `segment + 1`
  double along_m = 0;       ///< from point `segment`
  double left_m = 0;        ///< along the path to the target
  bool forwards = true;     ///< the target lies towards the end of the list
  double turned_rad = 0;    ///< of the robot against how it is to look there, 0..pi
  bool flipped = false;     ///< with `either`: its back is turned to the way
};

/// The point of the path nearest to `at`. Where several legs are about equally near (0.3 m), the
/// one whose direction, or on which driving backwards, fits `yaw_rad` best (10 degrees are no
/// difference); where that fits alike too, one with way left before the target itself (a loop is
/// driven), then the nearer, and of equally near ones (0.1 m) the one with more way left. Needs at
/// least two different points.
PathStart find_start(std::span<const PathPoint> points, std::size_t target, Vector at,
                     double yaw_rad, const Gears& gears = {});

/// First and last point are one place (0.3 m).
bool is_closed(std::span<const PathPoint> points);

/// The point to drive to so that `target` is reached ahead: itself, or on a closed loop the other
/// end of the list, where that is the same place, the way to `target` lies behind the robot and the
/// way to the other end ahead. From a robot that stands at the target already (0.1 m) nothing is
/// driven around.
std::size_t target_ahead(std::span<const PathPoint> points, std::size_t target, Vector at,
                         double yaw_rad, const Gears& gears = {});

}  // namespace drover::track
