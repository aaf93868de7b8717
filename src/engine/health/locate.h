// Whether the position is good enough, without flapping.
#pragma once

#include "engine/config.h"
#include "engine/estimate/estimator.h"

namespace drover::engine {

/// What was lost is good again below this share of its bound.
inline constexpr double kGoodAgain = 0.8;

/// `uninit` until there is a position and a heading; then `good` while the predicted errors (two
/// sigma) are inside their bounds, else `lost`. What was lost is good again only well inside.
class LocateMonitor final {
 public:
  explicit LocateMonitor(const EstimateConfig& config) : config_(config) {}

  /// `task_active` chooses the bound: bound_run_m, else bound_start_m.
  LocateState update(const Estimate& estimate, bool has_origin, bool task_active);
  LocateState state() const { return state_; }
  /// Why it is not good; empty when it is.
  const Reason& reason() const { return reason_; }
  /// Share of the error budget that is used up: 0 none, 1 all of it or no position at all.
  double used() const { return used_; }

 private:
  EstimateConfig config_;
  LocateState state_ = LocateState::uninit;
  Reason reason_;
  double used_ = 1;
};

}  // namespace drover::engine
