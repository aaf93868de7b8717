#include "engine/group/joint_leap.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {
namespace {

// Beside the way that it may have gone by the speeds that are told with both places:
constexpr double kAtOnce_rad = 0.05;
constexpr double kStays_s = 0.03;  ///< who leapt, and stays there, for so long
constexpr double kMany = 5;        ///< leaps, each forgotten after twenty places that follow
constexpr double kForgotten = 0.05;

}  // namespace

JointMeasured JointLeap::look(const JointMeasured& told, Time at) {
  why_.clear();
  if (taken_ != kNever && at == heard_) return last_;
  heard_ = at;
  const double since_s = taken_ == kNever ? 0 : to_s(at - taken_);
  const double away_rad = told.position_rad - last_.position_rad;
  const double may_rad =
      kAtOnce_rad +
      (std::abs(last_.velocity_radps) + std::abs(told.velocity_radps)) * std::max(since_s, 0.0);
  const bool leaps = taken_ != kNever && std::abs(away_rad) > may_rad;
  if (leaps) ++leaps_;
  if (leaps && since_s <= kStays_s && leaps_ <= kMany) return last_;
  if (leaps) {
    why_.format(
        "its place leapt by %.2f rad at once: its encoder is not to be believed, or another "
        "device speaks for it",
        away_rad);
    leaps_ = 0;
  }
  leaps_ = std::max(leaps_ - kForgotten, 0.0);
  last_ = told;
  taken_ = at;
  return told;
}

}  // namespace drover::engine
