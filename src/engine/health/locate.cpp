// Whether the position is good enough, without flapping.
#include "engine/health/locate.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::engine {
namespace {

// A heading that only way tells gets no better by waiting: with RTK fixes a task goes on slowly.
constexpr double kOnTheWay = 2;

bool finite(const Pose& pose) {
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.yaw_rad) &&
         std::isfinite(pose.vx_mps + pose.wz_radps + pose.vy_mps);
}

}  // namespace

LocateState LocateMonitor::update(const Estimate& estimate, bool has_origin, bool task_active) {
  reason_.clear();
  used_ = 1;
  if (!has_origin || !estimate.has_position || !estimate.has_heading) {
    reason_ = !has_origin              ? "no origin is set"
              : !estimate.has_position ? "no position yet"
                                       : "no heading yet (with one antenna: drover heading find)";
    return state_ = LocateState::uninit;
  }
  const double bound_m = task_active ? config_.bound_run_m : config_.bound_start_m;
  const bool goes_on = task_active && estimate.way_heals;
  const double bound_rad = to_rad(config_.bound_yaw_deg) * (goes_on ? kOnTheWay : 1.0);
  const double share = state_ == LocateState::good ? 1.0 : kGoodAgain;
  // Whether both of two places are inside of the corridor is the task's to say.
  const double error_m = estimate.disputed ? estimate.own_error_m : estimate.predicted_error_m;
  const double error_rad = estimate.yaw_error_rad;
  // Written so that a value that is not a number is never good.
  if (!finite(estimate.pose)) {
    reason_ = "the position estimate is not a number";
  } else if (estimate.disagrees && !(estimate.disputed && task_active)) {
    reason_ = estimate.reason;
    if (reason_.empty()) reason_ = "position disagrees with odometry";
  } else if (!estimate.looks.empty()) {
    reason_ = estimate.looks;
  } else if (estimate.disputed && !(error_m <= share * bound_m && error_rad <= share * bound_rad)) {
    reason_ = estimate.reason;
  } else if (!(error_m <= share * bound_m) && !(error_rad / bound_rad > error_m / bound_m)) {
    reason_.format("position uncertain by %.3f m, allowed %.3f m", error_m, share * bound_m);
  } else if (!(error_rad <= share * bound_rad)) {  // the place of base_link may follow from it
    reason_.format("heading uncertain by %.1f degrees, allowed %.1f%s", to_deg(error_rad),
                   to_deg(share * bound_rad), estimate.way_heals ? ": drover heading find" : "");
  } else {
    used_ = std::max(error_m / bound_m, error_rad / to_rad(config_.bound_yaw_deg));
    used_ = std::min(used_, 1.0);
    return state_ = LocateState::good;
  }
  return state_ = LocateState::lost;
}

}  // namespace drover::engine
