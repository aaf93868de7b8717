#include "mission/scene_way.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drover::mission {
namespace {

constexpr double kStep_m = 0.01;

double gap_on_way_m(const Way& way, double s_m, double beside_m, const Flat& thing) {
  const TruePose pose = way.pose(s_m);
  return gap_m(outline(pose.x_m - beside_m * std::sin(pose.yaw_rad),
                       pose.y_m + beside_m * std::cos(pose.yaw_rad), pose.yaw_rad),
               thing);
}

}  // namespace

Way::Way(std::vector<Place> points) : points_(std::move(points)) {
  for (std::size_t i = 0; i < points_.size(); ++i)
    at_m_.push_back(i == 0 ? 0 : at_m_.back() + distance_m(points_[i - 1], points_[i]));
}

TruePose Way::pose(double s_m) const {
  s_m = std::clamp(s_m, 0.0, length_m());
  const auto above = std::upper_bound(at_m_.begin(), at_m_.end(), s_m);
  const auto i = std::min(static_cast<std::size_t>(above - at_m_.begin()), at_m_.size() - 1);
  const Place& a = points_[i - 1];
  const Place& b = points_[i];
  const double share = (s_m - at_m_[i - 1]) / (at_m_[i] - at_m_[i - 1]);
  TruePose pose;
  pose.x_m = a.x_m + share * (b.x_m - a.x_m);
  pose.y_m = a.y_m + share * (b.y_m - a.y_m);
  pose.yaw_rad = std::atan2(b.y_m - a.y_m, b.x_m - a.x_m);
  return pose;
}

double Way::nearest_m(const Place& at, double from_m, double reach_m) const {
  double best_s_m = from_m;
  double best_m = std::numeric_limits<double>::infinity();
  for (double s_m = from_m; s_m <= std::min(from_m + reach_m, length_m()); s_m += kStep_m) {
    const TruePose pose = this->pose(s_m);
    const double d_m = std::hypot(pose.x_m - at.x_m, pose.y_m - at.y_m);
    if (!(d_m < best_m)) continue;
    best_m = d_m;
    best_s_m = s_m;
  }
  return best_s_m;
}

std::optional<double> way_to_contact_m(const Way& way, double s_m, double end_m, double beside_m,
                                       const Flat& thing) {
  for (double at_m = s_m; at_m <= end_m; at_m += kStep_m)
    if (gap_on_way_m(way, at_m, beside_m, thing) < 0) return at_m - s_m;
  return std::nullopt;
}

double nearest_on_way_m(const Way& way, double s_m, double end_m, double beside_m,
                        const Flat& thing) {
  double least_m = std::numeric_limits<double>::infinity();
  for (double at_m = s_m; at_m <= end_m; at_m += kStep_m)
    least_m = std::min(least_m, gap_on_way_m(way, at_m, beside_m, thing));
  return least_m;
}

}  // namespace drover::mission
