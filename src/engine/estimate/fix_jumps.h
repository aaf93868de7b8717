// RTK positions that jump while the base drives, from one to the next or while they were lost.
#pragma once

#include "engine/config.h"
#include "engine/estimate/state.h"

namespace drover::engine::estimate {

/// An RTK position beside what is expected of it.
struct FixBeside {
  Dispute::Offset offset;
  bool inside = false;  ///< the gate would let it pass
  double sigma_m = 0;   ///< of the position
  double sways_m2 = 0;  ///< variance by tilt and timing
  double speed_mps = 0;
};

enum class FixVerdict : std::uint8_t {
  plain,    ///< nothing jumped: the gate decides
  waits,    ///< it says nothing yet
  doubted,  ///< it jumped, and neither place is believed
  renewed,  ///< the place is where it says
};

FixVerdict judge_jump(State& state, const FixBeside& fix, const EstimateConfig& config);

}  // namespace drover::engine::estimate
