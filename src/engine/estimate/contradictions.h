// Which sources contradict each other, as far as the estimate knows.
#pragma once

#include "engine/estimate/state.h"

namespace drover::engine::estimate {

/// A run of refused measurements so long is no outlier.
inline constexpr Duration kContradicted = std::chrono::milliseconds(300);

struct Contradictions {
  bool disputed = false;  ///< of two places neither is believed
  bool position = false;  ///< positions and odometry, a dispute or another jump
  bool heading = false;   ///< headings and odometry
  bool stuck = false;     ///< wheels roll and the position does not, or hardly
  bool drifted = false;   ///< the position went aside slowly, and on while the base stood

  bool any() const { return position || heading || stuck || drifted; }
};

/// Those that lasted for `patience`.
Contradictions contradictions_of(const State& state, Duration patience, Time now);

}  // namespace drover::engine::estimate
