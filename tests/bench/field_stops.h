// Where a task stood still, and whether it had to.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "bench/field_plan.h"
#include "drover/angle.h"
#include "drover/snapshot.h"
#include "engine/config.h"

namespace drover::bench {

struct Stop {
  /// By where it truly was, and what was published of how well that is known, when it began.
  enum class Kind {
    needless,  ///< both inside of what a task may have
    careful,   ///< it was where it thought it was, but did not know it well enough
    right,     ///< it truly was farther off than a task may be
  } kind = Kind::needless;
  double at_s = 0;
  double for_s = 0;
  std::string why;
  double error_m = 0;  ///< true
  double error_rad = 0;
  double doubt_m = 0;  ///< published
  double doubt_rad = 0;
  bool is_end = false;  ///< of the task, not a pause
};

/// Motion with the true error beyond the published bound.
struct Beyond {
  double from_s = 0;
  double to_s = 0;
  double error_m = 0;  ///< the worst, and the bound then
  double bound_m = 0;
};

class StopWatch final {
 public:
  StopWatch(const engine::EstimateConfig& config, FieldPlan plan)
      : most_m_(config.bound_run_m),
        most_rad_(to_rad(config.bound_yaw_deg)),
        plan_(std::move(plan)) {}

  /// Each tick of a task.
  void look(const Snapshot& seen, const Pose& truth, double since_s) {
    const double tick_s = since_s - last_s_;
    last_s_ = since_s;
    const Stop now = measured(seen, truth, since_s);
    const bool moves = std::abs(truth.vx_mps) > 0.02;
    if (moves && now.error_m > seen.nav.error_bound_m) {
      remember(now.error_m, seen.nav.error_bound_m, since_s);
      if (plan_.slips_unseen(since_s)) unseen_s_ += tick_s;
    }
    if (seen.nav.status == NavStatus::error && !ended_) stops_.push_back(now);
    ended_ = seen.nav.status == NavStatus::error;
    if (ended_) stops_.back().is_end = true;
    if (seen.nav.paused && !paused_) stops_.push_back(now);
    paused_ = seen.nav.paused;
    if (!paused_) return;
    stops_.back().for_s = since_s - stops_.back().at_s;
    if (now.kind == Stop::Kind::needless) needless_s_ += tick_s;
  }

  const std::vector<Stop>& stops() const { return stops_; }
  const std::vector<Beyond>& beyond() const { return beyond_; }
  /// Moved beyond the bound after a slip that nobody could see.
  double unseen_s() const { return unseen_s_; }
  /// Paused while there was no need.
  double needless_s() const { return needless_s_; }

 private:
  void remember(double error_m, double bound_m, double since_s) {
    constexpr double kOther_s = 1;  // a shorter gap parts nothing
    if (beyond_.empty() || since_s - beyond_.back().to_s > kOther_s)
      beyond_.push_back({since_s, since_s, 0, 0});
    Beyond& last = beyond_.back();
    last.to_s = since_s;
    if (error_m - bound_m <= last.error_m - last.bound_m) return;
    last.error_m = error_m;
    last.bound_m = bound_m;
  }
  Stop measured(const Snapshot& seen, const Pose& truth, double since_s) const {
    Stop stop;
    stop.at_s = since_s;
    if (!seen.why.empty()) stop.why = std::string(seen.why[0].view());
    stop.error_m = std::hypot(seen.pose.x_m - truth.x_m, seen.pose.y_m - truth.y_m);
    stop.error_rad = std::abs(wrap_rad(seen.pose.yaw_rad - truth.yaw_rad));
    // Two sigma, or what lies between sources that contradict each other: the bound for people is
    // four sigma and that.
    const double sigma_m = seen.pose.position_sigma_m;
    stop.doubt_m = std::max(2 * sigma_m, seen.nav.error_bound_m - 4 * sigma_m);
    stop.doubt_rad = 2 * seen.pose.yaw_sigma_rad;
    const bool right = !(stop.error_m <= most_m_ && stop.error_rad <= most_rad_);
    const bool known = stop.doubt_m <= most_m_ && stop.doubt_rad <= most_rad_;
    stop.kind = right ? Stop::Kind::right : known ? Stop::Kind::needless : Stop::Kind::careful;
    return stop;
  }

  double most_m_;
  double most_rad_;
  FieldPlan plan_;
  double last_s_ = 0;
  bool paused_ = false;
  bool ended_ = false;
  double needless_s_ = 0;
  double unseen_s_ = 0;
  std::vector<Stop> stops_;
  std::vector<Beyond> beyond_;
};

}  // namespace drover::bench
