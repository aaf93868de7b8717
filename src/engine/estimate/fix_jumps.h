// RTK positions that jump while the base drives, from one to the next or while they were lost.
#pragma once

#include "engine/config.h"
#include "engine/estimate/state.h"

namespace drover::engine::estimate {

/// An RTK position beside what is expected of it.
struct FixBeside {
  Dispute::Offset offset;
  bool inside = false;  ///< the gate would let it pass
  bool near = false;    ///< so would a narrow one
  double sigma_m = 0;   ///< of the position
  double sways_m2 = 0;  ///< variance by tilt and timing
  double speed_mps = 0;
  LeverArm arm;  ///< of the antenna, as it is tilted
};

enum class FixVerdict : std::uint8_t {
  plain,    ///< nothing jumped: the gate decides
  waits,    ///< it says nothing yet
  doubted,  ///< it jumped, and neither place is believed
  renewed,  ///< the place is where it says
};

/// The receiver's filters have settled since its positions became better.
bool has_settled(const State& state, const EstimateConfig& config);
/// Since the last believed RTK fix there were none, or poorer positions: it may be another one.
bool found_again(const State& state);
/// It was, and wheels that slipped meanwhile explain where it is.
bool slipped_meanwhile(const State& state, const Dispute::Offset& beside,
                       const EstimateConfig& config);
FixVerdict judge_jump(State& state, const FixBeside& fix, const EstimateConfig& config);

}  // namespace drover::engine::estimate
