#include "scene/sensor/field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace drover::scene::sensor {
namespace {

struct Rectangle {
  double min_x_m;
  double max_x_m;
  double half_width_m;
};

bool is_rectangle(const SensorField& field) {
  return std::isfinite(field.from_x_m) && std::isfinite(field.ahead_m) &&
         std::isfinite(field.beside_m) && field.ahead_m >= 0 && field.beside_m >= 0;
}

bool is_place(const ScanMount& mount) {
  return std::isfinite(mount.x_m) && std::isfinite(mount.y_m) && std::isfinite(mount.yaw_rad);
}

bool is_inside(const Rectangle& r, const Point2& p) {
  return p.x_m >= r.min_x_m && p.x_m <= r.max_x_m && std::abs(p.y_m) <= r.half_width_m;
}

/// Cuts [near, far] of a ray to where one of its coordinates is between min and max.
void cut(double from, double direction, double min, double max, double& near, double& far) {
  if (direction == 0) {
    if (from < min || from > max) far = -1;
    return;
  }
  const double a = (min - from) / direction;
  const double b = (max - from) / direction;
  near = std::max(near, std::min(a, b));
  far = std::min(far, std::max(a, b));
}

/// How far from the mount a ray enters the rectangle, m; nothing when it misses it.
std::optional<double> entry_m(const Rectangle& r, const ScanMount& mount, double bearing_rad) {
  const double angle_rad = mount.yaw_rad + bearing_rad;
  double near = 0;
  double far = std::numeric_limits<double>::infinity();
  cut(mount.x_m, std::cos(angle_rad), r.min_x_m, r.max_x_m, near, far);
  cut(mount.y_m, std::sin(angle_rad), -r.half_width_m, r.half_width_m, near, far);
  if (near > far) return std::nullopt;
  return near;
}

/// Whether the wedge of bearings [from, to] (rad, narrower than half a turn) meets the rectangle:
/// one of its sides does, or a corner is inside.
bool meets(const Rectangle& r, const ScanMount& mount, double from_rad, double to_rad) {
  if (entry_m(r, mount, from_rad) || entry_m(r, mount, to_rad)) return true;
  for (const double x_m : {r.min_x_m, r.max_x_m}) {
    for (const double y_m : {-r.half_width_m, r.half_width_m}) {
      const double corner_rad =
          wrap_rad(std::atan2(y_m - mount.y_m, x_m - mount.x_m) - mount.yaw_rad);
      if (corner_rad >= from_rad && corner_rad <= to_rad) return true;
    }
  }
  return false;
}

bool crosses_unknown(const Scan& scan, const ScanMount& mount, const Rectangle& r) {
  const std::size_t count = scan.sectors.size();
  if (count == 0) return true;
  const double width_rad = 2 * kPi / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (scan.sectors[i] == SectorState::seen_free) continue;
    const double from_rad = -kPi + static_cast<double>(i) * width_rad;
    if (meets(r, mount, from_rad, from_rad + width_rad)) return true;
  }
  return false;
}

}  // namespace

Point2 to_base(const ScanMount& mount, const ScanPoint& point) {
  const double angle_rad = mount.yaw_rad + point.bearing_rad;
  return {mount.x_m + point.range_m * std::cos(angle_rad),
          mount.y_m + point.range_m * std::sin(angle_rad)};
}

FieldState look(const Scan& scan, const ScanMount& mount, const SensorField& field) {
  FieldState state;
  if (!is_rectangle(field) || !is_place(mount)) {
    state.blocked = true;
    return state;
  }
  const Rectangle r{field.from_x_m, field.from_x_m + field.ahead_m, field.beside_m};
  state.free_m = field.ahead_m;
  state.unknown = crosses_unknown(scan, mount, r);
  for (const ScanPoint& point : scan.points) {
    if (!(point.range_m > 0)) continue;
    const Point2 at = to_base(mount, point);
    if (is_inside(r, at)) {
      if (!state.blocked || at.x_m < state.nearest.x_m) state.nearest = at;
      state.blocked = true;
      ++state.points;
    } else if (const auto entry = entry_m(r, mount, point.bearing_rad);
               entry && point.range_m < *entry) {
      state.unknown = true;
    }
  }
  if (state.blocked) state.free_m = state.nearest.x_m - field.from_x_m;
  return state;
}

double ramp_distance_m(double beam_height_m, double slope) {
  if (!(slope > 0)) return std::numeric_limits<double>::infinity();
  return std::max(0.0, beam_height_m) / slope;
}

}  // namespace drover::scene::sensor
