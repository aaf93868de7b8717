#include "sim/scenario/track.h"

#include <GeographicLib/LocalCartesian.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::sim {
namespace {

constexpr double kSpacing_m = 0.5;
constexpr double kSmall_m = 1e-6;
// How many segments ahead and behind the last one are looked at: 3 m.
constexpr std::size_t kWindow = 6;

double length_m(const Shape& shape) {
  return shape.straight_m > 0 ? shape.straight_m : std::abs(shape.turn_rad) * shape.radius_m;
}

TrackPose along(const TrackPose& from, const Shape& shape, double s_m) {
  const double ahead = shape.backwards ? -1 : 1;
  if (shape.straight_m > 0)
    return {from.x_m + ahead * s_m * std::cos(from.yaw_rad),
            from.y_m + ahead * s_m * std::sin(from.yaw_rad), from.yaw_rad};
  if (shape.radius_m <= 0) return {from.x_m, from.y_m, wrap_rad(from.yaw_rad + shape.turn_rad)};
  const double side = shape.turn_rad < 0 ? -1 : 1;
  const double yaw_rad = from.yaw_rad + side * s_m / shape.radius_m;
  const double reach_m = ahead * side * shape.radius_m;
  return {from.x_m + reach_m * (std::sin(yaw_rad) - std::sin(from.yaw_rad)),
          from.y_m - reach_m * (std::cos(yaw_rad) - std::cos(from.yaw_rad)), wrap_rad(yaw_rad)};
}

TrackPose antenna_place(const TrackPose& base, const Antenna& antenna) {
  const double c = std::cos(base.yaw_rad);
  const double s = std::sin(base.yaw_rad);
  return {base.x_m + c * antenna.x_m - s * antenna.y_m,
          base.y_m + s * antenna.x_m + c * antenna.y_m, base.yaw_rad};
}

GeographicLib::LocalCartesian frame_of(const Origin& origin) {
  return {origin.latitude_deg, origin.longitude_deg, origin.altitude_m};
}

double distance_to_segment_m(const TrackPose& a, const TrackPose& b, double x_m, double y_m) {
  const double dx = b.x_m - a.x_m;
  const double dy = b.y_m - a.y_m;
  const double square = dx * dx + dy * dy;
  const double along =
      square > 0 ? std::clamp(((x_m - a.x_m) * dx + (y_m - a.y_m) * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(x_m - a.x_m - along * dx, y_m - a.y_m - along * dy);
}

}  // namespace

std::vector<TrackPose> make_track(const TrackPose& start, const std::vector<Shape>& shapes) {
  std::vector<TrackPose> track{start};
  TrackPose at = start;
  double since_point_m = 0;
  for (const auto& shape : shapes) {
    const double length = length_m(shape);
    double s_m = kSpacing_m - since_point_m;
    for (; s_m < length - kSmall_m; s_m += kSpacing_m) track.push_back(along(at, shape, s_m));
    since_point_m = length - (s_m - kSpacing_m);
    at = along(at, shape, length);
  }
  const auto& last = track.back();
  if (std::hypot(at.x_m - last.x_m, at.y_m - last.y_m) > kSmall_m) track.push_back(at);
  return track;
}

TrackPose map_shift(const Fix& fix, const Origin& origin, const Antenna& antenna) {
  TrackPose at{0, 0, fix.yaw_rad};
  double up_m = 0;
  frame_of(origin).Forward(fix.latitude_deg, fix.longitude_deg, origin.altitude_m, at.x_m, at.y_m,
                           up_m);
  const auto base = antenna_place(at, {-antenna.x_m, -antenna.y_m});
  return {fix.x_m - base.x_m, fix.y_m - base.y_m, 0};
}

std::string save_message(const std::string& name, const std::vector<TrackPose>& track,
                         const TrackPose& shift, const Origin& origin, const Antenna& antenna) {
  const auto frame = frame_of(origin);
  auto points = nlohmann::ordered_json::array();
  for (const auto& pose : track) {
    const auto at = antenna_place(pose, antenna);
    double latitude_deg = 0;
    double longitude_deg = 0;
    double height_m = 0;
    frame.Reverse(at.x_m, at.y_m, 0, latitude_deg, longitude_deg, height_m);
    points.push_back({{"longitude", longitude_deg},
                      {"latitude", latitude_deg},
                      {"angle", compass_deg_from_yaw_rad(pose.yaw_rad)},
                      {"x", pose.x_m + shift.x_m},
                      {"y", pose.y_m + shift.y_m},
                      {"yaw", pose.yaw_rad}});
  }
  const nlohmann::ordered_json message{{"cmd_type", "trajectory_control"},
                                       {"cmd", "save_trajectory"},
                                       {"data", {{"name", name}, {"data", points}}}};
  return message.dump();
}

double CrossTrack::distance_m(double x_m, double y_m) {
  const auto& track = *track_;
  if (track.empty()) return 0;
  if (track.size() == 1) return std::hypot(x_m - track[0].x_m, y_m - track[0].y_m);
  const std::size_t segments = track.size() - 1;
  const std::size_t from = !found_ || segment_ < kWindow ? 0 : segment_ - kWindow;
  const std::size_t to = found_ ? std::min(segments, segment_ + kWindow + 1) : segments;
  double best_m = INFINITY;
  for (std::size_t i = from; i < to; ++i) {
    const double d_m = distance_to_segment_m(track[i], track[i + 1], x_m, y_m);
    if (d_m >= best_m) continue;
    best_m = d_m;
    segment_ = i;
  }
  found_ = true;
  return best_m;
}

}  // namespace drover::sim
