// Tracks for tests.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "track/path_geometry.h"

namespace drover::track {

using Points = std::vector<PathPoint>;

/// From one end of the list to the other.
inline Route forwards_along(const Points& points) {
  return {points, points.size() - 1, true};
}

/// Through all of it, without a corner.
inline Leg whole_leg(const Route& route) {
  Leg leg{0, route.size() - 1, 0, 0, {}, {}};
  for (std::size_t k = 0; k < leg.last; ++k) leg.last_m += route.segment_m(k);
  leg.enter = unit(chord_after(route, 0, leg.last, 0.25), {1, 0});
  leg.leave = unit(chord_before(route, leg.last, 0, 0.25), {1, 0});
  return leg;
}

/// To the left about (0, radius), from the origin on, in chords of `spacing_m`.
inline Points arc(double radius_m, double angle_rad, double spacing_m = 0.5) {
  Points points;
  const int chords = static_cast<int>(std::lround(radius_m * angle_rad / spacing_m));
  for (int i = 0; i <= chords; ++i) {
    const double at_rad = angle_rad * i / chords;
    points.push_back({radius_m * std::sin(at_rad), radius_m * (1 - std::cos(at_rad))});
  }
  return points;
}

/// A walk that turns and crosses itself, some points twice, at times a loop.
inline Points any_walk(std::mt19937& random) {
  std::uniform_real_distribution<> turn_rad(-1.5, 1.5);
  std::uniform_real_distribution<> step_m(0, 1);
  Points points;
  double yaw_rad = turn_rad(random);
  PathPoint at;
  const int count = 3 + static_cast<int>(random() % 60);
  for (int i = 0; i < count; ++i) {
    points.push_back(at);
    yaw_rad += turn_rad(random);
    const double way_m = random() % 9 == 0 ? 0 : step_m(random);
    at.x_m += way_m * std::cos(yaw_rad);
    at.y_m += way_m * std::sin(yaw_rad);
  }
  points.push_back({at.x_m + 1, at.y_m});  // not all one place
  if (random() % 2 == 0) points.push_back(points.front());
  return points;
}

}  // namespace drover::track
