// Geometry by GeographicLib and plane polylines.
#include "mission/track.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drover::mission {
namespace {

double to_segment_m(const Place& a, const Place& b, const Place& at) {
  const double dx = b.x_m - a.x_m;
  const double dy = b.y_m - a.y_m;
  const double square = dx * dx + dy * dy;
  const double along = ((at.x_m - a.x_m) * dx + (at.y_m - a.y_m) * dy) / square;
  const double share = square > 0 ? std::clamp(along, 0.0, 1.0) : 0.0;
  return std::hypot(at.x_m - a.x_m - share * dx, at.y_m - a.y_m - share * dy);
}

}  // namespace

Earth::Earth(const nlohmann::json& scenario) {
  const auto& origin = scenario.at("origin");
  altitude_m_ = origin.value("altitude_m", 0.0);
  frame_ = {origin.at("latitude_deg").get<double>(), origin.at("longitude_deg").get<double>(),
            altitude_m_};
  const auto& antenna = scenario.at("gnss").at("antenna");
  antenna_x_m_ = antenna.value("x_m", 0.0);
  antenna_y_m_ = antenna.value("y_m", 0.0);
}

Place Earth::base(double latitude_deg, double longitude_deg, double yaw_rad) const {
  Place at;
  double up_m = 0;
  frame_.Forward(latitude_deg, longitude_deg, altitude_m_, at.x_m, at.y_m, up_m);
  at.x_m -= std::cos(yaw_rad) * antenna_x_m_ - std::sin(yaw_rad) * antenna_y_m_;
  at.y_m -= std::sin(yaw_rad) * antenna_x_m_ + std::cos(yaw_rad) * antenna_y_m_;
  return at;
}

std::vector<Place> read_track(const nlohmann::json& save_message, const Earth& earth) {
  std::vector<Place> track;
  for (const auto& point : save_message.at("data").at("data"))
    track.push_back(earth.base(point.at("latitude").get<double>(),
                               point.at("longitude").get<double>(), point.at("yaw").get<double>()));
  return track;
}

double Beside::distance_m(const Place& place) {
  // Points are half a metre apart.
  constexpr std::size_t kWindow = 4;
  const auto& track = *track_;
  if (track.size() < 2) return track.empty() ? NAN : mission::distance_m(track[0], place);
  const std::size_t segments = track.size() - 1;
  const std::size_t from = !found_ || segment_ < kWindow ? 0 : segment_ - kWindow;
  const std::size_t to = found_ ? std::min(segments, segment_ + kWindow + 1) : segments;
  double best_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = from; i < to; ++i) {
    const double d_m = to_segment_m(track[i], track[i + 1], place);
    if (d_m >= best_m) continue;
    best_m = d_m;
    segment_ = i;
  }
  found_ = true;
  return best_m;
}

}  // namespace drover::mission
