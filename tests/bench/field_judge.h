// Who knows where the robot of a field truly is, and what became of its task.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "drover/event.h"
#include "drover/snapshot.h"
#include "support/tracks.h"

namespace drover::bench {

inline constexpr double kWide_m = 0.10;

struct Judgement {
  bool success = false;
  bool ended = false;
  std::string words;  ///< how the task ended, or that it was refused
  double time_s = 0;  ///< from the start to the end
  double rms_m = 0;   ///< of the truth beside the track, over the way
  double p95_m = 0;
  double max_m = 0;
  double goal_m = 0;  ///< from the target, at the end
  int pauses = 0;
  double paused_s = 0;
  double outside_s = 0;  ///< moved while the true error was beyond the published bound
  double worst_outside_m = 0;
  double beyond_s = 0;  ///< moved beyond the corridor
  double wide_s = 0;    ///< moved beyond kWide_m beside the track
  double moving_s = 0;
  double inside_two_sigma = 0;  ///< share of time while moving
  double inside_three_sigma = 0;
  std::vector<std::string> said;  ///< notices, with the time
};

class FieldJudge final {
 public:
  /// `path` is borrowed.
  FieldJudge(const Path& path, double corridor_m) : path_(path), corridor_m_(corridor_m) {}

  bool ended() const { return judged_.ended; }

  void hear(const Event& event, double since_s) {
    if (const auto* refused = std::get_if<CommandRefused>(&event.body)) {
      end(false, "refused: " + std::string(refused->reason.view()), since_s);
    } else if (const auto* not_started = std::get_if<NavigationNotStarted>(&event.body)) {
      end(false, "not started: " + std::string(not_started->reason.view()), since_s);
    } else if (const auto* ended = std::get_if<TaskEnded>(&event.body)) {
      end(ended->how == TaskEnded::How::success, std::string(ended->reason.view()), since_s);
    } else if (const auto* notice = std::get_if<Notice>(&event.body)) {
      judged_.said.push_back(std::to_string(since_s) + " " + std::string(notice->text.view()));
    }
  }

  /// Each tick of so long.
  void look(const Snapshot& seen, const Pose& truth, double tick_s) {
    if (seen.nav.paused && !was_paused_) ++judged_.pauses;
    was_paused_ = seen.nav.paused;
    if (seen.nav.paused) judged_.paused_s += tick_s;
    if (std::abs(truth.vx_mps) <= 0.02) return;
    moving_s_ += tick_s;
    compare(seen, std::hypot(seen.pose.x_m - truth.x_m, seen.pose.y_m - truth.y_m), tick_s);
    constexpr int kTicksEach = 4;
    if (++moving_ticks_ % kTicksEach != 0) return;
    const double off_m = test::distance_m(path_.points, truth.x_m, truth.y_m);
    if (off_m > corridor_m_) judged_.beyond_s += kTicksEach * tick_s;
    if (off_m > kWide_m) judged_.wide_s += kTicksEach * tick_s;
    off_.push_back({off_m, std::abs(truth.vx_mps) * kTicksEach * tick_s});
  }

  Judgement conclude(const Snapshot& last, const Pose& truth, double since_s) {
    if (!judged_.ended) {
      judged_.words = "did not end";
      if (!last.why.empty()) judged_.words += ": " + std::string(last.why[0].view());
      judged_.time_s = since_s;
    }
    const PathPoint& goal = path_.points.back();
    judged_.goal_m = std::hypot(truth.x_m - goal.x_m, truth.y_m - goal.y_m);
    judged_.moving_s = moving_s_;
    if (moving_s_ > 0) {
      judged_.inside_two_sigma /= moving_s_;
      judged_.inside_three_sigma /= moving_s_;
    }
    weigh();
    return judged_;
  }

 private:
  void end(bool success, const std::string& words, double since_s) {
    judged_.ended = true;
    judged_.success = success;
    judged_.words = words;
    judged_.time_s = since_s;
  }

  void compare(const Snapshot& seen, double error_m, double tick_s) {
    if (error_m <= 2 * seen.pose.position_sigma_m) judged_.inside_two_sigma += tick_s;
    if (error_m <= 3 * seen.pose.position_sigma_m) judged_.inside_three_sigma += tick_s;
    if (error_m <= seen.nav.error_bound_m) return;
    judged_.outside_s += tick_s;
    judged_.worst_outside_m = std::max(judged_.worst_outside_m, error_m);
  }

  void weigh() {
    std::sort(off_.begin(), off_.end());
    double whole_m = 0;
    double square = 0;
    for (const auto& [off_m, weight_m] : off_) {
      whole_m += weight_m;
      square += weight_m * off_m * off_m;
    }
    if (whole_m > 0) judged_.rms_m = std::sqrt(square / whole_m);
    double passed_m = 0;
    for (const auto& [off_m, weight_m] : off_) {
      passed_m += weight_m;
      judged_.max_m = off_m;
      if (passed_m <= 0.95 * whole_m) judged_.p95_m = off_m;
    }
  }

  const Path& path_;
  double corridor_m_;
  Judgement judged_;
  bool was_paused_ = false;
  int moving_ticks_ = 0;
  double moving_s_ = 0;
  std::vector<std::pair<double, double>> off_;  ///< beside the track, and the way there
};

}  // namespace drover::bench
