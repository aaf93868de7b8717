#include "drivers/ld06/gaps.h"

#include <algorithm>
#include <cmath>

#include "drivers/ld06/codec.h"
#include "drover/angle.h"

namespace drover::ld06 {
namespace {

struct Gap {
  double from_rad = 0;  ///< bearing of the beam that was seen before it
  double width_rad = 0;
  int own = 0;
};

/// Goes round the turn with the motor, from one beam that was seen to the next.
class GapFinder final {
 public:
  GapFinder(const Settings& settings, const Scan& turn, TurnCounts& counts)
      : sense_(settings.upside_down ? 1 : -1),
        spacing_rad_(2 * kPi * std::max(turn.turn_Hz, 1.0) / kPoints_Hz),
        counts_(counts) {}

  /// From a beam to the next one; its angle may tremble.
  double step_rad(const ScanPoint& from, const ScanPoint& to) const {
    return std::max(0.0, wrap_rad(sense_ * (to.bearing_rad - from.bearing_rad)));
  }

  /// Every sector that a beam of the gap belongs to, whether that came or not.
  void mark(const Gap& gap) {
    const bool is_own = gap.own * spacing_rad_ > gap.width_rad / 2;
    for (double at_rad = spacing_rad_; at_rad < gap.width_rad - spacing_rad_ / 2;
         at_rad += spacing_rad_)
      widen(
          counts_
              .sectors[sector_of(wrap_rad(gap.from_rad + sense_ * at_rad), counts_.sectors.size())],
          gap.width_rad, is_own);
  }

  void mark_all() {
    for (SectorCount& sector : counts_.sectors) widen(sector, 2 * kPi, false);
  }

 private:
  static void widen(SectorCount& sector, double width_rad, bool is_own) {
    if (width_rad <= sector.gap_rad) return;
    sector.gap_rad = width_rad;
    sector.gap_is_own = is_own;
  }

  double sense_;  ///< of the motor, seen from above
  double spacing_rad_;
  TurnCounts& counts_;
};

}  // namespace

void measure_gaps(const Settings& settings, const Scan& turn, const TurnBeams& beams,
                  TurnCounts& counts) {
  GapFinder finder(settings, turn, counts);
  const auto first =
      static_cast<std::size_t>(std::find(beams.begin(), beams.end(), BeamIs::seen) - beams.begin());
  if (first == beams.size()) return finder.mark_all();
  // Round to the first one again: what the end of the turn lacks goes on at its beginning.
  Gap gap{turn.points[first].bearing_rad};
  std::size_t before = first;
  for (std::size_t k = 1; k <= beams.size(); ++k) {
    const std::size_t i = (first + k) % beams.size();
    gap.width_rad += finder.step_rad(turn.points[before], turn.points[i]);
    before = i;
    if (beams[i] == BeamIs::own) ++gap.own;
    if (beams[i] != BeamIs::seen) continue;
    finder.mark(gap);
    gap = {turn.points[i].bearing_rad};
  }
}

}  // namespace drover::ld06
