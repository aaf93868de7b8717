// A track as it is driven: smooth where it bends, from one true corner to the next.
//
// The same line as the engine's tracker makes (src/engine/navigate/path_geometry.h), which no file
// here may include; tests/unit/scene/plane/tracker_test.cpp holds them together.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/plane/point.h"

namespace drover::scene {

/// So far beside a place the line has a say in where the robot is there.
inline constexpr double kLineReach_m = 1.5;

class TrackLine final {
 public:
  /// Without a true corner inside. Beyond its ends it goes on straight.
  struct Leg {
    std::size_t first = 0;  ///< points of the line
    std::size_t last = 0;
    Point2 enter{1, 0};  ///< direction at the first point, of unit length
    Point2 leave{1, 0};  ///< at the last one
  };
  struct Place {
    Point2 point;
    double yaw_rad = 0;
  };

  /// In the order of travel, finite. What turns by `pivot_rad` and more is a true corner.
  TrackLine(const std::vector<Point2>& points, double pivot_rad);

  /// Less than two different points are no line.
  bool empty() const { return points_.size() < 2; }
  /// Its arc length as a polyline; that is what places on it are counted in.
  double end_m() const { return at_m_.back(); }
  const std::vector<Leg>& legs() const { return legs_; }
  double first_m(const Leg& leg) const { return at_m_[leg.first]; }
  double last_m(const Leg& leg) const { return at_m_[leg.last]; }
  Point2 last_point(const Leg& leg) const { return points_[leg.last]; }

  Place place(const Leg& leg, double s_m) const;
  /// Arc length of the polyline's point that is nearest to `from`, between two arc lengths.
  double foot_m(Point2 from, double least_m, double most_m) const;

 private:
  /// Mean over a window, and the same weighted by a ramp.
  struct Mean {
    Point2 plain;
    Point2 weighted;
  };

  Point2 point(const Leg& leg, double s_m) const;
  std::size_t segment(double s_m) const;
  Point2 chord(std::size_t point, double to_m) const;
  double corner_rad(std::size_t point, double first_m) const;
  Mean mean(const Leg& leg, double from_m, double to_m, bool rising, Point2 about) const;
  Leg leg_between(std::size_t first, std::size_t last) const;
  void split(double pivot_rad);

  std::vector<Point2> points_;  ///< none twice
  std::vector<double> at_m_;    ///< arc length at each
  std::vector<Leg> legs_;
};

}  // namespace drover::scene
