// Whether a task may start: each refusal with its reason.
#include "engine/navigate/navigator_checks.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "track/path_search.h"

namespace drover::engine {
namespace {

/// From `at` to the segment that the tracker would begin on, m.
double distance_m(const Path& path, std::uint32_t target, const Pose& pose) {
  const track::Vector at{pose.x_m, pose.y_m};
  const track::PathStart start =
      find_start(path.points, target, at, pose.yaw_rad, track::gears_of(path));
  const PathPoint& a = path.points[start.segment];
  const PathPoint& b = path.points[start.segment + 1];
  const track::Vector from{a.x_m, a.y_m};
  const track::Vector along = track::Vector{b.x_m, b.y_m} - from;
  const double squared = dot(along, along);
  const double share = squared > 0 ? std::clamp(dot(at - from, along) / squared, 0.0, 1.0) : 0.0;
  return length(at - (from + share * along));
}

}  // namespace

SpeedCheck check_speed(double asked_mps, const LimitsConfig& limits) {
  SpeedCheck check;
  if (!std::isfinite(asked_mps)) {
    check.refusal = "the speed is not a number";
  } else if (asked_mps <= 0) {
    check.refusal.format("the speed must be above zero, not %.3g m/s", asked_mps);
  } else if (asked_mps < limits.min_speed_mps) {
    check.refusal.format("the base cannot hold %.3g m/s; the least is %.2f m/s", asked_mps,
                         limits.min_speed_mps);
  } else if (asked_mps > limits.max_speed_mps) {
    check.note.format("speed limited to %.2f m/s, %.3g m/s was asked", limits.max_speed_mps,
                      asked_mps);
  }
  if (check.refusal.empty()) check.speed_mps = std::min(asked_mps, limits.max_speed_mps);
  return check;
}

Reason check_robot(const HealthReport& health, bool has_origin) {
  if (const Reason why = health.hinders_all(); !why.empty()) return why;
  if (!health.no_start.empty()) return health.no_start;
  // A drive that reports a fault is no refusal: arming clears what can be cleared.
  if (!has_origin) return "no origin is set";
  if (!health.gnss_ok) {
    return health.texts[static_cast<std::size_t>(Cause::receiver)];
  }
  if (health.holds(Cause::imu)) return health.text(Cause::imu);
  if (health.locate != LocateState::good) {
    return health.locate_reason.empty() ? Reason("the position is not good") : health.locate_reason;
  }
  return {};
}

Reason check_place(const Path& path, std::uint32_t target, const Pose& pose,
                   const TrackProgress& progress, const NavigateConfig& config) {
  Reason reason;
  const double off_m = distance_m(path, target, pose);
  if (!(off_m <= config.start_distance_m)) {
    reason.format("the robot is %.1f m away from the track, allowed %.1f m", off_m,
                  config.start_distance_m);
    return reason;
  }
  if (progress.arrived && progress.distance_to_goal_m <= config.goal_tolerance_m) return reason;
  if (progress.goal_passed) {
    reason.format(
        "point %llu lies %.1f m behind the robot: choose a point ahead, or bring the robot "
        "back to before it",
        static_cast<unsigned long long>(target) + 1, progress.distance_to_goal_m);
    return reason;
  }
  const double turned_deg = to_deg(std::abs(progress.heading_error_rad));
  if (!(turned_deg <= config.start_angle_deg)) {
    const char* advice = progress.backwards
                             ? "it is driven backwards there: turn its back to the way"
                         : turned_deg > 90 ? "turn it round, or choose a point ahead of it"
                                           : "turn it into the way";
    reason.format(
        "the robot is turned %.0f degrees away from the way to point %llu, allowed %.0f: %s",
        turned_deg, static_cast<unsigned long long>(target) + 1, config.start_angle_deg, advice);
  }
  return reason;
}

}  // namespace drover::engine
