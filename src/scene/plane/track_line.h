// A track as it is driven: smooth where it bends, from one true corner to the next.
//
// The line of the engine's tracker (src/track), with the arc length kept at each point, so that any
// place on it is found at once and not only one near to the last.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "drover/path.h"
#include "scene/plane/point.h"
#include "track/legs.h"
#include "track/path_geometry.h"

namespace drover::scene {

/// So far beside a place the line has a say in where the robot is there.
inline constexpr double kLineReach_m = 1.5;

inline Point2 from_track(track::Vector v) {
  return {v.x, v.y};
}

class TrackLine final {
 public:
  using Leg = track::Leg;  ///< of points of the line
  struct Place {
    Point2 point;
    double yaw_rad = 0;
  };

  /// In the order of travel, finite. What turns by more than `pivot_rad` is a true corner.
  /// `backwards`: of each segment of `points`; empty: none is driven so.
  TrackLine(const std::vector<Point2>& points, double pivot_rad,
            std::span<const std::uint8_t> backwards = {});

  /// Less than two different points are no line.
  bool empty() const { return points_.size() < 2; }
  /// Its arc length as a polyline; that is what places on it are counted in.
  double end_m() const { return at_m_.back(); }
  const std::vector<Leg>& legs() const { return legs_; }
  double first_m(const Leg& leg) const { return leg.first_m; }
  /// The robot looks the other way on it.
  bool is_backwards(const Leg& leg) const { return track::is_backwards(route(), leg); }
  Point2 last_point(const Leg& leg) const { return from_track(route().point(leg.last)); }

  Place place(const Leg& leg, double s_m) const;
  /// Arc length of the polyline's point that is nearest to `from`, between two arc lengths.
  double foot_m(Point2 from, double least_m, double most_m) const;

 private:
  track::Route route() const { return {points_, points_.size() - 1, true, backwards_}; }
  std::size_t segment(double s_m) const;

  std::vector<PathPoint> points_;  ///< none twice
  std::vector<double> at_m_;       ///< arc length at each
  std::vector<std::uint8_t> backwards_;
  std::vector<Leg> legs_;
};

}  // namespace drover::scene
