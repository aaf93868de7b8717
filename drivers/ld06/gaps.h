// Holes in a turn: how wide is what gave nothing back, wherever the sectors' borders lie.
#pragma once

#include "drivers/ld06/sort.h"

namespace drover::ld06 {

enum class BeamIs : std::uint8_t { nothing, own, seen };
/// Of each point of a turn, in its order.
using TurnBeams = FixedVector<BeamIs, kMaxScanPoints>;

/// Fills in the gaps of `counts.sectors`. Beams that never came, because their packet was lost,
/// are a gap as well. O(points).
void measure_gaps(const Settings& settings, const Scan& turn, const TurnBeams& beams,
                  TurnCounts& counts);

}  // namespace drover::ld06
