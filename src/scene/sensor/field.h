// The field of a scanner: what is in the robot's way right now, by its own eyes, without a pose.
#pragma once

#include <cstddef>

#include "drover/scan.h"
#include "scene/plane/point.h"

namespace drover::scene::sensor {

/// A rectangle in base_link.
struct SensorField {
  /// Where it begins: the robot's front edge, and not behind the scanner, since no scanner sees
  /// through its own robot.
  double from_x_m = 0;
  double ahead_m = 2.0;   ///< its length from there
  double beside_m = 0.4;  ///< to each side of base_link's x axis
};

struct FieldState {
  bool blocked = false;
  std::size_t points = 0;  ///< inside
  Point2 nearest;          ///< when blocked: of them the one with the least way ahead; base_link
  double free_m = 0;       ///< to that one from the field's beginning; without one the whole length
  /// Part of the field is not seen: a sector across it is unknown, or something between scanner and
  /// field is in the way. Neither blocked nor unknown is free.
  bool unknown = true;
};

/// In base_link.
Point2 to_base(const ScanMount& mount, const ScanPoint& point);

/// O(points + sectors), allocates nothing. A turn without sectors is unknown. A field that is no
/// rectangle (NaN, negative), or of a scanner that is nowhere, is blocked and unknown.
FieldState look(const Scan& scan, const ScanMount& mount, const SensorField& field);

/// How far beyond its foot a ramp meets the beams of a scanner on level ground, m: beam height by
/// slope. A ramp of 15 % (`slope` 0.15) is an obstacle 2.0 m beyond its foot to beams at 0.3 m: a
/// field of 2 m from the scanner on is free until the robot is at the foot, and with lower beams
/// it is blocked before. Infinite on level ground and downwards.
double ramp_distance_m(double beam_height_m, double slope);

}  // namespace drover::scene::sensor
