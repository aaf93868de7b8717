// Which paths are refused before anything moves, in the words of who counts points from 1.
#include <cstddef>

#include "track/flaw.h"

namespace drover::track {

Reason check_path(const Path& path, std::uint32_t target) {
  using Kind = Flaw::Kind;
  Reason reason;
  const auto& points = path.points;
  const Flaw flaw = find_flaw(points);
  if (flaw.kind != Kind::too_few && target >= points.size()) {
    reason.format("the track has no point %llu, only 1 to %zu",
                  static_cast<unsigned long long>(target) + 1, points.size());
    return reason;
  }
  switch (flaw.kind) {
    case Kind::none: break;
    case Kind::too_few:
      reason = points.empty() ? "the track has no points"
                              : "the track has only one point, two are needed";
      break;
    case Kind::not_finite:
      reason.format("point %zu of the track has no valid position", flaw.point + 1);
      break;
    case Kind::far_apart:
      reason.format("point %zu of the track is %.0f m away from the one before it", flaw.point + 1,
                    flaw.gap_m);
      break;
    case Kind::one_place: reason = "all points of the track are the same"; break;
    case Kind::crowd:
      reason.format("points %zu to %zu of the track are one place", flaw.point + 1, flaw.last + 1);
      break;
  }
  return reason;
}

}  // namespace drover::track
