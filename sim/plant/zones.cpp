// Each box is clipped to the corridor ahead; the nearest corner that is left decides.
#include "sim/plant/zones.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "drover/fixed_vector.h"

namespace drover::sim {
namespace {

struct Point {
  double x = 0;
  double y = 0;
};
// Four corners, and at most one more for each of the three edges of the corridor.
using Polygon = FixedVector<Point, 8>;

/// Keeps the part of `polygon` where a*x + b*y <= c.
Polygon clip(const Polygon& polygon, double a, double b, double c) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& p = polygon[i];
    const Point& q = polygon[(i + 1) % polygon.size()];
    const double dp = a * p.x + b * p.y - c;
    const double dq = a * q.x + b * q.y - c;
    if (dp <= 0) (void)kept.push_back(p);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) {
      const double t = dp / (dp - dq);
      (void)kept.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
  }
  return kept;
}

Polygon corners(const Footprint& box) {
  const double c = std::cos(box.yaw_rad);
  const double s = std::sin(box.yaw_rad);
  Polygon polygon;
  constexpr std::array<Point, 4> kSigns{{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
  for (const auto& sign : kSigns) {
    const double x = sign.x * box.half_length_m;
    const double y = sign.y * box.half_width_m;
    (void)polygon.push_back({box.x_m + c * x - s * y, box.y_m + s * x + c * y});
  }
  return polygon;
}

}  // namespace

double free_distance_m(std::span<const Footprint> boxes, double front_m, double width_m) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& box : boxes) {
    Polygon polygon = clip(corners(box), 0, 1, width_m / 2);
    polygon = clip(polygon, 0, -1, width_m / 2);
    polygon = clip(polygon, -1, 0, -front_m);
    for (const auto& point : polygon) nearest = std::min(nearest, point.x - front_m);
  }
  return std::max(nearest, 0.0);
}

}  // namespace drover::sim
