#include "scene/plane/track_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drover::scene {
namespace {

// As the tracker has them.
constexpr double kSmoothing_m = 0.5;
constexpr double kChord_m = 0.25;
constexpr double kShortestChord_m = 0.1;  // less line tells no corner from noise
constexpr double kCornerSpread_m = 0.3;   // points this close belong to one corner
constexpr double kTestSpacing_m = 0.02;

constexpr double kSamePlace_m = 1e-3;

Point2 unit(Point2 v, Point2 otherwise) {
  const double v_m = length_m(v);
  return v_m > 1e-9 ? 1 / v_m * v : otherwise;
}

}  // namespace

TrackLine::TrackLine(const std::vector<Point2>& points, double pivot_rad) {
  for (const Point2 point : points) {
    const double away_m = points_.empty() ? 0 : length_m(point - points_.back());
    if (!points_.empty() && !(away_m > kSamePlace_m)) continue;
    at_m_.push_back(points_.empty() ? 0 : at_m_.back() + away_m);
    points_.push_back(point);
  }
  if (!empty()) split(pivot_rad);
}

std::size_t TrackLine::segment(double s_m) const {
  const auto after = std::upper_bound(at_m_.begin(), at_m_.end(), s_m);
  const auto k = static_cast<std::size_t>(after - at_m_.begin());
  return std::min(k == 0 ? 0 : k - 1, points_.size() - 2);
}

Point2 TrackLine::point(const Leg& leg, double s_m) const {
  if (s_m < first_m(leg)) return points_[leg.first] + (s_m - first_m(leg)) * leg.enter;
  if (s_m > last_m(leg)) return points_[leg.last] + (s_m - last_m(leg)) * leg.leave;
  const std::size_t k = segment(s_m);
  const double part = (s_m - at_m_[k]) / (at_m_[k + 1] - at_m_[k]);
  return points_[k] + part * (points_[k + 1] - points_[k]);
}

/// From a point of the line to an arc length of it; 0 where that is too near.
Point2 TrackLine::chord(std::size_t point, double to_m) const {
  const std::size_t k = segment(to_m);
  const double part = (to_m - at_m_[k]) / (at_m_[k + 1] - at_m_[k]);
  const Point2 way = points_[k] + part * (points_[k + 1] - points_[k]) - points_[point];
  return length_m(way) < kShortestChord_m ? Point2{} : way;
}

double TrackLine::corner_rad(std::size_t point, double first_m) const {
  const Point2 before = -1 * chord(point, std::max(at_m_[point] - kChord_m, first_m));
  const Point2 after = chord(point, std::min(at_m_[point] + kChord_m, end_m()));
  if (squared(before) == 0 || squared(after) == 0) return 0;
  return std::abs(std::atan2(cross(before, after), dot(before, after)));
}

TrackLine::Leg TrackLine::leg_between(std::size_t first, std::size_t last) const {
  Leg leg{first, last, {}, {}};
  const Point2 whole = unit(points_[last] - points_[first], {1, 0});
  leg.enter = unit(chord(first, std::min(at_m_[first] + kChord_m, at_m_[last])), whole);
  leg.leave = unit(-1 * chord(last, std::max(at_m_[last] - kChord_m, at_m_[first])), leg.enter);
  return leg;
}

/// At the corners that are turned on the spot: of points close together the sharpest.
void TrackLine::split(double pivot_rad) {
  const std::size_t end = points_.size() - 1;
  std::size_t first = 0;
  while (true) {
    std::size_t corner = 0;
    double sharpest_rad = 0;
    double tested_m = at_m_[first];
    double until_m = end_m();
    for (std::size_t k = first + 1; k < end && at_m_[k] <= until_m; ++k) {
      if (at_m_[k] - tested_m < kTestSpacing_m) continue;
      tested_m = at_m_[k];
      const double turn_rad = corner_rad(k, at_m_[first]);
      if (turn_rad < pivot_rad || turn_rad <= sharpest_rad) continue;
      if (corner == 0) until_m = at_m_[k] + kCornerSpread_m;
      corner = k;
      sharpest_rad = turn_rad;
    }
    legs_.push_back(leg_between(first, corner != 0 ? corner : end));
    if (corner == 0) return;
    first = corner;
  }
}

TrackLine::Mean TrackLine::mean(const Leg& leg, double from_m, double to_m, bool rising,
                                Point2 about) const {
  const double width_m = to_m - from_m;
  const auto weight = [&](double s_m) { return (rising ? s_m - from_m : to_m - s_m) / width_m; };
  Mean sum;
  double a_m = from_m;
  Point2 a = point(leg, a_m) - about;
  auto next = static_cast<std::size_t>(
      std::upper_bound(at_m_.begin() + static_cast<std::ptrdiff_t>(leg.first),
                       at_m_.begin() + static_cast<std::ptrdiff_t>(leg.last) + 1, a_m) -
      at_m_.begin());
  while (a_m < to_m) {
    const bool corner = next <= leg.last && at_m_[next] < to_m;
    const double b_m = corner ? at_m_[next] : to_m;
    const Point2 b = (corner ? points_[next] : point(leg, b_m)) - about;
    const Point2 middle = 0.5 * (a + b);
    const double part = (b_m - a_m) / width_m;
    sum.plain = sum.plain + part * middle;
    // Simpson's rule is exact for a linear weight on a straight piece.
    sum.weighted =
        sum.weighted +
        part / 6 * (weight(a_m) * a + 4 * weight(0.5 * (a_m + b_m)) * middle + weight(b_m) * b);
    a_m = b_m;
    a = b;
    ++next;
  }
  return sum;
}

/// The polyline averaged under a triangle, moved out again by what that cuts off a bend.
TrackLine::Place TrackLine::place(const Leg& leg, double s_m) const {
  constexpr double h_m = kSmoothing_m;
  const Point2 here = point(leg, s_m);
  const Mean behind = mean(leg, s_m - h_m, s_m, true, here);
  const Mean ahead = mean(leg, s_m, s_m + h_m, false, here);
  const Point2 slope = 1 / h_m * (ahead.plain - behind.plain);
  const Point2 bend =
      1 / (h_m * h_m) * (point(leg, s_m + h_m) - here + (point(leg, s_m - h_m) - here));
  const double size = std::max(length_m(slope), 0.3);
  const double curvature_radpm = cross(slope, bend) / (size * size * size);
  const Point2 direction = unit(slope, leg.enter);
  const double cut_m = std::clamp(curvature_radpm, -4.0, 4.0) * h_m * h_m / 12;
  const Point2 aside =
      behind.weighted + ahead.weighted + cut_m * Point2{direction.y_m, -direction.x_m};
  return {here + aside, std::atan2(direction.y_m, direction.x_m)};
}

double TrackLine::foot_m(Point2 from, double least_m, double most_m) const {
  double best_m = std::clamp(least_m, 0.0, end_m());
  double best2 = std::numeric_limits<double>::infinity();
  for (std::size_t k = segment(best_m); k + 1 < points_.size() && at_m_[k] <= most_m; ++k) {
    const double side_m = at_m_[k + 1] - at_m_[k];
    const Point2 side = points_[k + 1] - points_[k];
    const double least = std::max(0.0, (least_m - at_m_[k]) / side_m);
    const double most = std::min(1.0, (most_m - at_m_[k]) / side_m);
    const double part =
        std::min(std::max(dot(from - points_[k], side) / squared(side), least), most);
    const double away2 = squared(points_[k] + part * side - from);
    if (!(away2 < best2)) continue;
    best_m = at_m_[k] + part * side_m;
    best2 = away2;
  }
  return best_m;
}

}  // namespace drover::scene
