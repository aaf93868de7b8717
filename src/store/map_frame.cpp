#include "store/map_frame.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

namespace drover::store {
namespace {

constexpr double kMetresPerDegree = 111'320;
constexpr int kFineDecimals = 10;  // a hundredth of a millimetre in degrees: fine for anything

/// Digits behind the point of the shortest text that is this number.
int decimals(double value) {
  std::array<char, 400> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  const std::string_view view(text.data(), static_cast<std::size_t>(end.ptr - text.data()));
  const auto dot = view.find('.');
  return dot == view.npos ? 0 : static_cast<int>(view.size() - dot - 1);
}

/// One unit of the last digit, of the number with the most of them.
template <class Get>
double finest_step(const Track& track, Get get) {
  int most = 0;
  for (const TrackPoint& point : track.points) {
    most = std::max(most, decimals(get(point)));
    if (most >= kFineDecimals) break;
  }
  return std::pow(10.0, -most);
}

}  // namespace

Local base_of(Local antenna, const AntennaOffset& arm, double yaw_rad) {
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  return {antenna.x_m - (c * arm.x_m - s * arm.y_m), antenna.y_m - (s * arm.x_m + c * arm.y_m)};
}

double place_step_m(const Track& track) {
  const double latitude_deg = finest_step(track, [](const auto& p) { return p.latitude_deg; });
  const double longitude_deg = finest_step(track, [](const auto& p) { return p.longitude_deg; });
  return kMetresPerDegree * std::hypot(latitude_deg, longitude_deg);
}

double map_step_m(const Track& track) {
  return std::hypot(finest_step(track, [](const auto& p) { return p.x_m; }),
                    finest_step(track, [](const auto& p) { return p.y_m; }));
}

Heading better_heading(const TrackPoint& point, Local antenna, const AntennaOffset& arm) {
  const Local told{point.x_m, point.y_m};
  const Heading by_yaw{point.yaw_rad, apart_m(base_of(antenna, arm, point.yaw_rad), told)};
  const double yaw_rad = yaw_rad_from_angle(arm.heading, point.angle_deg);
  const Heading by_angle{yaw_rad, apart_m(base_of(antenna, arm, yaw_rad), told)};
  return by_angle.apart_m < by_yaw.apart_m ? by_angle : by_yaw;
}

}  // namespace drover::store
