// Which paths are refused before anything moves.
#include <cmath>
#include <cstddef>

#include "engine/navigate/path_geometry.h"
#include "engine/navigate/tracker.h"

namespace drover::engine {
namespace {

// Nobody records a track like this; two tracks or two origins in one file look so.
constexpr double kLongestGap_m = 1000;
constexpr double kSamePoint_m = 1e-3;

}  // namespace

Reason check_path(const Path& path, std::uint32_t target) {
  Reason reason;
  const auto& points = path.points;
  if (points.size() < 2) {
    reason = points.empty() ? "the track has no points" : "the track has only one point";
    return reason;
  }
  if (target >= points.size()) {
    reason.format("the track has no point %llu, only 1 to %zu",
                  static_cast<unsigned long long>(target) + 1, points.size());
    return reason;
  }
  bool has_length = false;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!std::isfinite(points[k].x_m) || !std::isfinite(points[k].y_m)) {
      reason.format("point %zu of the track has no valid position", k + 1);
      return reason;
    }
    if (k == 0) continue;
    const Vector gap = {points[k].x_m - points[k - 1].x_m, points[k].y_m - points[k - 1].y_m};
    const double gap_m2 = dot(gap, gap);
    if (gap_m2 >= kLongestGap_m * kLongestGap_m) {
      reason.format("point %zu of the track is %.0f m away from the one before it", k + 1,
                    std::sqrt(gap_m2));
      return reason;
    }
    has_length = has_length || gap_m2 > kSamePoint_m * kSamePoint_m;
  }
  if (!has_length) reason = "all points of the track are the same";
  return reason;
}

}  // namespace drover::engine
