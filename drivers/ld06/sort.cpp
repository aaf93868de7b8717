#include "drivers/ld06/sort.h"

#include <cmath>

#include "drivers/ld06/gaps.h"

namespace drover::ld06 {
namespace {

bool is_own(const Settings& settings, const ScanPoint& point) {
  const ScanMount& mount = settings.mount;
  const double bearing_rad = mount.yaw_rad + point.bearing_rad;
  return is_inside(settings.self_filter, mount.x_m + point.range_m * std::cos(bearing_rad),
                   mount.y_m + point.range_m * std::sin(bearing_rad));
}

}  // namespace

bool is_inside(const Outline& outline, double x_m, double y_m) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Corner& a = outline[i];
    const Corner& b = outline[(i + 1) % outline.size()];
    if ((a.y_m > y_m) == (b.y_m > y_m)) continue;
    if (x_m < a.x_m + (y_m - a.y_m) / (b.y_m - a.y_m) * (b.x_m - a.x_m)) inside = !inside;
  }
  return inside;
}

TurnCounts sort_beams(const Settings& settings, Scan& turn) {
  TurnCounts counts;
  counts.sectors.resize(settings.sectors);
  TurnBeams beams;
  for (ScanPoint& point : turn.points) {
    (void)beams.push_back(BeamIs::nothing);  // there is room for each point
    SectorCount& sector = counts.sectors[sector_of(point.bearing_rad, settings.sectors)];
    ++counts.beams;
    if (point.range_m <= 0) continue;
    ++counts.returns;
    if (point.range_m < kRing_m) ++counts.ring;
    if (point.range_m < settings.range_min_m) {
      ++counts.lens;
      point.range_m = 0;
    } else if (is_own(settings, point)) {
      ++counts.own;
      ++sector.own;
      beams.back() = BeamIs::own;
      point.range_m = 0;
    } else {
      ++sector.seen;
      beams.back() = BeamIs::seen;
      // The way to there was free, as far as it is believed.
      if (point.range_m > settings.range_max_m) point.range_m = 0;
    }
  }
  measure_gaps(settings, turn, beams, counts);
  return counts;
}

}  // namespace drover::ld06
