// From a recorded track to the line that is driven: latitude and longitude are the truth, x and y
// must fit them.
#include "store/drivable.h"

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace drover::store {
namespace {

constexpr double kMetresPerDegree = 111'320;
constexpr int kFineDecimals = 10;      // a hundredth of a millimetre in degrees: fine for anything
constexpr double kSmoothest_m = 0.02;  // coarser latitudes would make steps in the line

struct Local {
  double x_m = 0;
  double y_m = 0;
};

double apart_m(Local a, Local b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

/// A map frame. A track knows no height above the ellipsoid; the origin's own is right to
/// centimetres in x, y.
class Frame {
 public:
  explicit Frame(const GeodeticPoint& origin)
      : altitude_m_(origin.altitude_m),
        frame_(origin.latitude_deg, origin.longitude_deg, origin.altitude_m) {}

  Local local(double latitude_deg, double longitude_deg) const {
    Local at;
    double up_m = 0;
    frame_.Forward(latitude_deg, longitude_deg, altitude_m_, at.x_m, at.y_m, up_m);
    return at;
  }
  /// The same place in another frame.
  Local in(const Frame& other, Local at) const {
    double latitude_deg = 0;
    double longitude_deg = 0;
    double height_m = 0;
    frame_.Reverse(at.x_m, at.y_m, 0, latitude_deg, longitude_deg, height_m);
    return other.local(latitude_deg, longitude_deg);
  }

 private:
  double altitude_m_;
  GeographicLib::LocalCartesian frame_;
};

Local base_of(Local antenna, const AntennaOffset& arm, double yaw_rad) {
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  return {antenna.x_m - (c * arm.x_m - s * arm.y_m), antenna.y_m - (s * arm.x_m + c * arm.y_m)};
}

bool has_place(const TrackPoint& point) {
  return point.latitude_deg != 0 || point.longitude_deg != 0;
}
bool has_angle(const TrackPoint& point) {
  return point.yaw_rad != 0 || point.angle_deg != 0;
}
bool on_earth(const TrackPoint& point) {
  return std::abs(point.latitude_deg) <= 90 && std::abs(point.longitude_deg) <= 360;
}

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

double place_step_m(const Track& track) {
  const double latitude_deg = finest_step(track, [](const auto& p) { return p.latitude_deg; });
  const double longitude_deg = finest_step(track, [](const auto& p) { return p.longitude_deg; });
  return kMetresPerDegree * std::hypot(latitude_deg, longitude_deg);
}

double map_step_m(const Track& track) {
  return std::hypot(finest_step(track, [](const auto& p) { return p.x_m; }),
                    finest_step(track, [](const auto& p) { return p.y_m; }));
}

struct Heading {
  double yaw_rad = 0;
  double apart_m = 0;  ///< of x, y from the base's place under this yaw
};

/// Clients fill in yaw, angle or both, and not all of them consistently: the one that explains x,
/// y.
Heading better_heading(const TrackPoint& point, Local antenna, const AntennaOffset& arm) {
  const Local told{point.x_m, point.y_m};
  const Heading by_yaw{point.yaw_rad, apart_m(base_of(antenna, arm, point.yaw_rad), told)};
  const double yaw_rad = yaw_rad_from_angle(arm.heading, point.angle_deg);
  const Heading by_angle{yaw_rad, apart_m(base_of(antenna, arm, yaw_rad), told)};
  return by_angle.apart_m < by_yaw.apart_m ? by_angle : by_yaw;
}

std::string told_point(std::size_t index) {
  return "point " + std::to_string(index + 1);
}

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text,
                value < 1000  ? "%.2f m"
                : value < 1e6 ? "%.0f m"
                              : "%.3g m",
                value);
  return text;
}

}  // namespace

double resolution_m(const Track& track) {
  return place_step_m(track) + map_step_m(track);
}

std::optional<Disagreement> find_disagreement(const Track& track, const AntennaOffset& antenna) {
  if (!track.origin) return std::nullopt;
  const Frame frame(*track.origin);
  const double arm_m = std::hypot(antenna.x_m, antenna.y_m);
  const double allowed_m = kAgreement_m + std::min(resolution_m(track), kCoarsest_m);
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    const TrackPoint& point = track.points[i];
    if (!has_place(point) || !on_earth(point)) continue;
    const Local place = frame.local(point.latitude_deg, point.longitude_deg);
    const bool turned = has_angle(point);
    const double off_m = turned ? better_heading(point, place, antenna).apart_m
                                : apart_m(place, {point.x_m, point.y_m});
    const double may_m = turned ? allowed_m : allowed_m + arm_m;
    if (!(off_m <= may_m)) return Disagreement{i, off_m, may_m};
  }
  return std::nullopt;
}

Result<std::unique_ptr<Path>, std::string> build_path(const Track& track,
                                                      const GeodeticPoint& origin,
                                                      const AntennaOffset& antenna) {
  const auto wrong = find_disagreement(track, antenna);
  if (wrong) {
    return told_point(wrong->index) + ": x, y are " + metres(wrong->distance_m) +
           " away from its latitude and longitude, allowed " + metres(wrong->allowed_m) +
           ": were they recorded before the origin was set, or with the antenna elsewhere?";
  }
  const Frame now(origin);
  const std::optional<Frame> then =
      track.origin ? std::optional<Frame>(*track.origin) : std::nullopt;
  const bool same = track.origin && holds_under(track, origin);
  const bool coarse = then && place_step_m(track) > kSmoothest_m;
  auto path = std::make_unique<Path>();
  path->name = track.name;
  path->points.reserve(track.points.size());
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    const TrackPoint& point = track.points[i];
    if (has_place(point) && !on_earth(point))
      return told_point(i) + ": its latitude or longitude is no place on earth";
    const Local told{point.x_m, point.y_m};
    Local at;
    if (has_place(point) && (!then || (has_angle(point) && !coarse))) {
      const Local place = now.local(point.latitude_deg, point.longitude_deg);
      const double yaw_rad =
          then
              ? better_heading(point, then->local(point.latitude_deg, point.longitude_deg), antenna)
                    .yaw_rad
              : point.yaw_rad;
      at = base_of(place, antenna, yaw_rad);
    } else if (then) {
      at = same ? told : then->in(now, told);
    } else {
      return told_point(i) + ": it has no latitude and longitude, and x, y are of no known origin";
    }
    path->points.push_back({at.x_m, at.y_m});
  }
  return std::unique_ptr<Path>(std::move(path));
}

}  // namespace drover::store
