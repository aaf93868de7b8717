#include "scene/plane/track_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "track/legs.h"

namespace drover::scene {
namespace {

constexpr double kSamePlace_m = 1e-3;

}  // namespace

TrackLine::TrackLine(const std::vector<Point2>& points, double pivot_rad,
                     std::span<const std::uint8_t> backwards) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2 point = points[i];
    double s_m = 0;
    if (!points_.empty()) {
      const double away_m = length_m(point - Point2{points_.back().x_m, points_.back().y_m});
      if (!(away_m > kSamePlace_m)) continue;
      s_m = at_m_.back() + away_m;
      if (!backwards.empty()) backwards_.push_back(i <= backwards.size() ? backwards[i - 1] : 0);
    }
    points_.push_back({point.x_m, point.y_m});
    at_m_.push_back(s_m);
  }
  if (empty()) return;
  // At the corners that are turned on the spot.
  each_leg(route(), pivot_rad, at_m_.back(), [this](const Leg& leg) { legs_.push_back(leg); });
}

std::size_t TrackLine::segment(double s_m) const {
  const auto after = std::upper_bound(at_m_.begin(), at_m_.end(), s_m);
  const auto k = static_cast<std::size_t>(after - at_m_.begin());
  return std::min(k == 0 ? 0 : k - 1, points_.size() - 2);
}

TrackLine::Place TrackLine::place(const Leg& leg, double s_m) const {
  const std::size_t k = segment(s_m);
  const track::Reference on = smooth(route(), leg, {k, at_m_[k]}, s_m);
  return {from_track(on.point), std::atan2(on.ahead.y, on.ahead.x)};
}

double TrackLine::foot_m(Point2 from, double least_m, double most_m) const {
  const track::Route line = route();
  double best_m = std::clamp(least_m, 0.0, end_m());
  double best2 = std::numeric_limits<double>::infinity();
  for (std::size_t k = segment(best_m); k + 1 < points_.size() && at_m_[k] <= most_m; ++k) {
    const double side_m = at_m_[k + 1] - at_m_[k];
    const Point2 begin = from_track(line.point(k));
    const Point2 side = from_track(line.point(k + 1)) - begin;
    const double least = std::max(0.0, (least_m - at_m_[k]) / side_m);
    const double most = std::min(1.0, (most_m - at_m_[k]) / side_m);
    const double part = std::min(std::max(dot(from - begin, side) / squared(side), least), most);
    const double away2 = squared(begin + part * side - from);
    if (!(away2 < best2)) continue;
    best_m = at_m_[k] + part * side_m;
    best2 = away2;
  }
  return best_m;
}

}  // namespace drover::scene
