// A route from one true corner to the next.
#include "track/legs.h"

namespace drover::track {
namespace {

constexpr double kCornerSpread_m = 0.3;  // points this close belong to one corner

}  // namespace

Leg leg_to_target(const Route& route, std::size_t first, double first_m, double end_m) {
  const std::size_t last = route.size() - 1;
  const Vector fallback = unit(route.point(last) - route.point(first), {1, 0});
  Leg leg = {first, last, first_m, end_m, {}, {}};
  leg.enter = unit(chord_after(route, first, last, kEndChord_m), fallback);
  leg.leave = unit(chord_before(route, last, first, kEndChord_m), leg.enter);
  return leg;
}

Leg leg_to_corner(const Route& route, const Leg& leg, const Station& corner) {
  Leg shorter = leg;
  shorter.last = corner.segment;
  shorter.last_m = corner.start_m;
  shorter.leave = unit(chord_before(route, shorter.last, leg.first, kEndChord_m), leg.enter);
  return shorter;
}

Station find_corner(const Route& route, const Leg& leg, double sharp_rad, double until_m,
                    CornerScan& scan) {
  Station found;
  double found_rad = sharp_rad;
  while (scan.known.segment + 2 < route.size() && scan.known.start_m < until_m) {
    Station& at = scan.known;
    const Station next{at.segment + 1, at.start_m + route.segment_m(at.segment)};
    if (found.segment != 0 && next.start_m > until_m) break;
    at = next;
    if (at.start_m - scan.tested_m < kTestSpacing_m) continue;
    scan.tested_m = at.start_m;
    const double angle_rad = corner_rad(route, at.segment, leg.first);
    if (angle_rad <= found_rad) continue;
    // Dense points: the sharpest of those around is the corner.
    if (found.segment == 0) until_m = at.start_m + kCornerSpread_m;
    found = at;
    found_rad = angle_rad;
  }
  if (found.segment != 0) scan = {found, found.start_m};
  return found;
}

}  // namespace drover::track
