// Turns of a scanner in a world of boxes that a test puts together.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/plane/piece.h"
#include "scene/sensor/near_things.h"

namespace drover::scene::sensor {

/// Upright, its sides along x and y.
struct Box {
  Point2 centre;
  double half_m = 0.25;
};

/// Where a ray meets it; infinite: it misses.
inline double ray_m(const Box& box, Point2 from, double direction_rad) {
  const Point2 d = direction(direction_rad);
  double near = 0;
  double far = std::numeric_limits<double>::infinity();
  const auto cut = [&](double at, double along, double middle) {
    if (std::abs(along) < 1e-12) {
      if (std::abs(at - middle) > box.half_m) far = -1;
      return;
    }
    const double a = (middle - box.half_m - at) / along;
    const double b = (middle + box.half_m - at) / along;
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  };
  cut(from.x_m, d.x_m, box.centre.x_m);
  cut(from.y_m, d.y_m, box.centre.y_m);
  return near <= far ? near : std::numeric_limits<double>::infinity();
}

/// Of a scanner in a hall with walls 10 m away, 450 beams from ahead on to the left; `blind_rad`:
/// to each side of behind from where nothing comes back.
class World {
 public:
  std::vector<Box> boxes;
  ScanMount mount{0.4, 0, 0.3, 0};
  double blind_rad = 0;
  double turn_s = 0.1;

  /// From a pose that moves by the twist while it turns; `end` is when it ended there.
  SeenTurn turn(const Pose2& end_pose, Time end, const Twist& twist = {}) const {
    constexpr int kBeams = 450;
    SeenTurn seen;
    seen.device = "lidar";
    seen.mount = mount;
    seen.scan.begin = end - from_s(turn_s);
    seen.scan.end = end;
    for (int i = 0; i < kBeams; ++i) {
      const double left_s = turn_s * (1 - static_cast<double>(i) / kBeams);
      Pose2 at = end_pose;
      at.yaw_rad -= twist.wz_radps * left_s;
      const Point2 back =
          (twist.vx_mps * left_s) * direction(0.5 * (at.yaw_rad + end_pose.yaw_rad));
      at.x_m -= back.x_m;
      at.y_m -= back.y_m;
      const double bearing_rad = wrap_rad(2 * kPi * i / kBeams);
      (void)seen.scan.points.push_back({bearing_rad, range_m(at, bearing_rad), 100});
    }
    return seen;
  }

 private:
  double range_m(const Pose2& at, double bearing_rad) const {
    if (std::abs(bearing_rad) > kPi - blind_rad) return 0;
    const Point2 x = direction(at.yaw_rad);
    const Point2 eye{at.x_m + mount.x_m * x.x_m - mount.y_m * x.y_m,
                     at.y_m + mount.x_m * x.y_m + mount.y_m * x.x_m};
    double least_m = 10;
    for (const Box& box : boxes)
      least_m = std::min(least_m, ray_m(box, eye, at.yaw_rad + mount.yaw_rad + bearing_rad));
    return least_m;
  }
};

}  // namespace drover::scene::sensor
