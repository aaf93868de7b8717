// What the beams of a turn are: obstacles, the robot itself, the lens, or nothing.
#pragma once

#include "drivers/ld06/settings.h"

namespace drover::ld06 {

/// Of one sector.
struct SectorCount {
  int seen = 0;  ///< came back from an obstacle, or from beyond the range that is believed
  int own = 0;   ///< from the robot itself
  /// The widest part of the turn that reaches into it and from which nothing was seen: from one
  /// beam that was to the next (gaps.h).
  double gap_rad = 0;
  bool gap_is_own = false;  ///< that is mostly the robot itself
};

struct TurnCounts {
  FixedVector<SectorCount, kMaxScanSectors> sectors;
  int beams = 0;
  int returns = 0;  ///< anything came back
  int lens = 0;     ///< from nearer than is believed: dirt, drops
  int ring = 0;     ///< from so near all round that it would be a cover
  int own = 0;
};

/// Nobody drives with something this near on all sides (m): a cap, a bag, mud. It is looked at
/// before the self-filter, in whose outline a cover lies.
inline constexpr double kRing_m = 0.30;

/// Even-odd: a corner that is named twice, or lines that cross, are no failure.
bool is_inside(const Outline& outline, double x_m, double y_m);

/// Counts, and leaves a range only to what is an obstacle.
TurnCounts sort_beams(const Settings& settings, Scan& turn);

}  // namespace drover::ld06
