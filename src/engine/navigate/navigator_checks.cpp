// Whether a task may start: each refusal with its reason.
#include "engine/navigate/navigator_checks.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "track/path_search.h"
#include "track/tight.h"

namespace drover::engine {
namespace {

constexpr double kAlong_deg = 5.0;  // less is along the track

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

Reason check_curves(const Path& path, std::uint32_t target, const Pose& pose,
                    const NavigateConfig& config, const BodyLimits& body) {
  Reason reason;
  if (body.pivots) return reason;
  const track::PathStart start =
      find_start(path.points, target, {pose.x_m, pose.y_m}, pose.yaw_rad, track::gears_of(path));
  const track::Route route(path.points, target, start.forwards, path.backwards, start.flipped);
  const std::size_t first = start.forwards ? start.segment : path.points.size() - 2 - start.segment;
  const track::Tight tight =
      find_tight(route, first, to_rad(config.pivot_angle_deg), body.smallest_radius_m);
  switch (tight.kind) {
    case track::Tight::Kind::none: break;
    case track::Tight::Kind::corner:
      reason.format(
          "at point %zu the track turns by %.0f degrees at once: this base steers, and cannot turn "
          "on the spot",
          tight.point + 1, to_deg(tight.turn_rad));
      break;
    case track::Tight::Kind::curve:
      reason.format("at point %zu the track's radius is %.2f m, this base needs %.2f m",
                    tight.point + 1, tight.radius_m, body.smallest_radius_m);
      break;
  }
  return reason;
}

Reason check_joining(std::uint32_t target, const TrackProgress& progress,
                     const NavigateConfig& config, const BodyLimits& body) {
  Reason reason;
  if (body.pivots || progress.arrived) return reason;
  // Turned along the line first, which leads away from it where it is turned away; then two arcs,
  // to it and along it.
  const double radius_m = body.smallest_radius_m;
  const double turned_rad = std::abs(progress.heading_error_rad);
  const bool away = progress.cross_track_m * progress.heading_error_rad > 0;
  const double beside_m = std::abs(progress.cross_track_m) +
                          (away ? radius_m * (1 - std::cos(turned_rad)) : 0.0) -
                          config.goal_tolerance_m;
  const double aside_m = std::clamp(beside_m, 0.0, 2 * radius_m);
  const double needed_m =
      radius_m * std::sin(turned_rad) + std::sqrt(aside_m * (4 * radius_m - aside_m));
  if (needed_m <= progress.distance_left_m) return reason;
  if (!(beside_m > 0) && turned_rad < to_rad(kAlong_deg)) return reason;
  reason.format(
      "the robot is %.2f m beside its track and turned by %.0f degrees: to be on it takes %.1f m, "
      "and point %llu is %.1f m away",
      std::abs(progress.cross_track_m), to_deg(turned_rad), needed_m,
      static_cast<unsigned long long>(target) + 1, progress.distance_left_m);
  return reason;
}

}  // namespace drover::engine
