// A polyline as it is driven: walking along it, its true corners, and a smooth line through it.
//
// Nothing is copied and nothing is stored per point: a recorded track may have 100 000 points and
// the control thread may not allocate. Places are arc lengths `s` (m) that grow with travel, found
// from a Station that moves along with the robot.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drover/path.h"

namespace drover::track {

/// A point or a free vector in the `map` frame, metres (directions: unit length).
struct Vector {
  double x = 0;
  double y = 0;
};
inline Vector operator+(Vector a, Vector b) {
  return {a.x + b.x, a.y + b.y};
}
inline Vector operator-(Vector a, Vector b) {
  return {a.x - b.x, a.y - b.y};
}
inline Vector operator*(double k, Vector a) {
  return {k * a.x, k * a.y};
}
inline double dot(Vector a, Vector b) {
  return a.x * b.x + a.y * b.y;
}
/// Positive when `b` points to the left of `a`.
inline double cross(Vector a, Vector b) {
  return a.x * b.y - a.y * b.x;
}
inline double length(Vector a) {
  return std::sqrt(dot(a, a));
}
/// Of an arc so long, on which the line turns by so much (m, rad): its two ends are so far apart.
inline double chord_m(double arc_m, double turned_rad) {
  const double half_rad = turned_rad / 2;
  return std::abs(half_rad) < 1e-6 ? arc_m : arc_m * std::sin(half_rad) / half_rad;
}
/// `otherwise` where `a` has no direction.
Vector unit(Vector a, Vector otherwise);

/// A path's points in the order of travel; the last one is the target.
class Route final {
 public:
  Route() = default;
  /// Borrows `points` and `backwards` (as Path::backwards; `flipped`: the other way round). Travel
  /// is from the list's one end to `target`.
  Route(std::span<const PathPoint> points, std::size_t target, bool forwards,
        std::span<const std::uint8_t> backwards = {}, bool flipped = false)
      : points_(points),
        backwards_(backwards),
        size_(forwards ? target + 1 : points.size() - target),
        forwards_(forwards),
        flipped_(flipped) {}
  std::size_t size() const { return size_; }
  Vector point(std::size_t k) const {
    const PathPoint& p = points_[index(k)];
    return {p.x_m, p.y_m};
  }
  /// Of the list, of that point.
  std::size_t index(std::size_t k) const { return forwards_ ? k : points_.size() - 1 - k; }
  bool forwards() const { return forwards_; }
  double segment_m(std::size_t k) const { return length(point(k + 1) - point(k)); }
  /// The robot drives backwards from point `k` to the next.
  bool backwards(std::size_t k) const {
    const std::size_t segment = forwards_ ? k : index(k) - 1;
    return segment < backwards_.size() && (backwards_[segment] != 0) != flipped_;
  }
  bool flipped() const { return flipped_; }

 private:
  std::span<const PathPoint> points_;
  std::span<const std::uint8_t> backwards_;
  std::size_t size_ = 0;
  bool forwards_ = true;
  bool flipped_ = false;
};

/// A segment of the route, by its first point, and the arc length at that point.
struct Station {
  std::size_t segment = 0;
  double start_m = 0;
};

/// A stretch without a true corner inside. Beyond its ends it goes on straight. One that ends at
/// the target may end in an arc (line_end), which takes the place of its last points.
struct Leg {
  std::size_t first = 0;  ///< point of the route
  std::size_t last = 0;
  double first_m = 0;  ///< arc length there
  double last_m = 0;
  Vector enter{1, 0};            ///< direction at the first point
  Vector leave{1, 0};            ///< direction at the last point
  double arc_from_m = INFINITY;  ///< from there on it is the arc; as far beyond its end, too
  Vector arc_end{};
  double arc_radpm = 0;  ///< curvature, counter-clockwise positive
};

/// Moves a station to where `s_m` is, inside the leg.
Station seek(const Route& route, const Leg& leg, Station station, double s_m);
Vector position(const Route& route, const Leg& leg, Station& station, double s_m);

/// Places along the polyline, one each `step_m` from `from_m` on.
void sample(const Route& route, const Leg& leg, Station station, double from_m, double step_m,
            std::span<Vector> places);

/// Directions of the chords of `reach_m` before and after a point, not going beyond `first`/`last`.
/// Length 0 where there is less than 0.1 m of line: too little to tell a direction from noise.
Vector chord_before(const Route& route, std::size_t point, std::size_t first, double reach_m);
Vector chord_after(const Route& route, std::size_t point, std::size_t last, double reach_m);
/// How sharply the route turns at a point, 0..pi; `first` is the first point of the leg.
double corner_rad(const Route& route, std::size_t point, std::size_t first);

/// The smooth line at one place.
struct Reference {
  Vector point;
  Vector ahead{1, 0};          ///< direction of travel
  double curvature_radpm = 0;  ///< counter-clockwise positive
};

/// Half the width of the window over which the line is smoothed. Tracks are recorded each 0.5 m:
/// a triangle of exactly this half-width makes an arc of such chords into an arc of one curvature.
inline constexpr double kSmoothing_m = 0.5;

/// The polyline averaged under a triangle (so the 1 cm noise of recording does not reach the
/// wheels), moved out again by what averaging cuts off a bend.
Reference smooth(const Route& route, const Leg& leg, Station station, double s_m);

/// The place on the smooth line square to a point.
struct LineFoot {
  double s_m = 0;
  Reference line;  ///< there
};

/// The foot of `point`, searched near `s_m` only: a line that crosses or comes back beside itself
/// cannot catch the search. Moves at most 0.25 m an iteration.
LineFoot find_foot(const Route& route, const Leg& leg, Station station, double s_m, Vector point,
                   int iterations);

/// Distance of `point` from the polyline itself near its foot, left of travel positive (m).
double offset_m(const Route& route, const Leg& leg, Station station, const LineFoot& foot,
                Vector point);

}  // namespace drover::track
