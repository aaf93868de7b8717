#include "scene/sensor/own_way.h"

#include <algorithm>
#include <cmath>

#include "scene/plane/steps.h"

namespace drover::scene::sensor {
namespace {

/// At the mean of both twists: on the arc, of which it goes the chord.
Pose2 moved_on(const Pose2& from, const Twist& before, const Twist& after, double dt_s) {
  const double way_m = 0.5 * (before.vx_mps + after.vx_mps) * dt_s;
  const double turn_rad = 0.5 * (before.wz_radps + after.wz_radps) * dt_s;
  const double left_m = 0.5 * (before.vy_mps + after.vy_mps) * dt_s;
  const Point2 ahead = direction(from.yaw_rad + 0.5 * turn_rad);
  return {from.x_m + way_m * ahead.x_m - left_m * ahead.y_m,
          from.y_m + way_m * ahead.y_m + left_m * ahead.x_m, from.yaw_rad + turn_rad};
}

}  // namespace

void OwnWay::forget() {
  marks_.clear();
  ++frame_;
}

void OwnWay::note(Time t, const Twist& moves, double fastest_mps) {
  if (!std::isfinite(moves.vx_mps + moves.wz_radps + moves.vy_mps + fastest_mps)) return forget();
  fastest_mps = std::max({fastest_mps, moves.vx_mps, 0.0});
  if (!marks_.empty() && (t < marks_.back().t || t - marks_.back().t > kPause)) forget();
  if (marks_.empty()) {
    marks_.push_back({t, {}, 0, moves, fastest_mps});
    return;
  }
  Mark& last = marks_.back();
  if (t == last.t) {
    last.moves = moves;
    last.fastest_mps = fastest_mps;
    return;
  }
  const double dt_s = to_s(t - last.t);
  marks_.push_back({t, moved_on(last.pose, last.moves, moves, dt_s),
                    last.ahead_m + dt_s * std::max(last.fastest_mps, fastest_mps), moves,
                    fastest_mps});
  while (t - marks_.front().t > kReach) marks_.pop_front();
}

std::optional<Pose2> OwnWay::pose(Time t) const {
  if (marks_.empty() || t < marks_.front().t || t - marks_.back().t > kAhead) return std::nullopt;
  const auto after =
      std::find_if(marks_.begin(), marks_.end(), [t](const Mark& mark) { return mark.t > t; });
  if (after == marks_.end()) return marks_.back().pose;
  const Mark& before = *(after - 1);
  return between(before.pose, after->pose, to_s(t - before.t) / to_s(after->t - before.t));
}

std::optional<Pose2> OwnWay::pose() const {
  if (marks_.empty()) return std::nullopt;
  return marks_.back().pose;
}

double OwnWay::ahead_m(Time since) const {
  if (marks_.empty() || since == kNever || !(since < marks_.back().t)) return 0;
  double fastest_mps = 0;
  for (auto mark = marks_.rbegin(); mark != marks_.rend(); ++mark) {
    if (mark->t <= since) {
      const double dt_s = to_s((mark - 1)->t - since);
      return marks_.back().ahead_m - (mark - 1)->ahead_m +
             dt_s * std::max(mark->fastest_mps, (mark - 1)->fastest_mps);
    }
    fastest_mps = std::max(fastest_mps, mark->fastest_mps);
  }
  // Of what was before the first note nothing is known but that.
  return marks_.back().ahead_m - marks_.front().ahead_m +
         fastest_mps * to_s(marks_.front().t - since);
}

}  // namespace drover::scene::sensor
