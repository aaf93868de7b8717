// Follows a polyline: where the robot is along it, and the twist that keeps it there.
#include "engine/navigate/tracker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "drover/angle.h"
#include "engine/still.h"
#include "track/path_search.h"

namespace drover::engine {
namespace {

using track::kEndChord_m;
using track::kSmoothing_m;
using track::LineFoot;
using track::Reference;
using track::Station;
using track::Vector;

constexpr double kLookBack_m = 1.0;
constexpr double kJoined_m = 0.2;
constexpr double kApproach_rad = 1.0;    // steepest way back to the line
constexpr double kSteeringShare = 0.7;   // of its rate, of a base that steers: the rest is feedback
constexpr double kSlowestTurned = 0.25;  // of the speed, when a base that steers is badly turned
constexpr double kTurnedBack = 0.7;      // of the offset in which it can be turned along the line
// Of a base that goes sideways: of an offset this much is turned out, which is little more than
// what a position is uncertain by; as much more is gone out sideways, and the rest is turned out.
constexpr double kTurnedOut_m = 0.005;
constexpr double kGoneOut_m = 0.15;
constexpr double kGoneOut_ps = 2.0;      // of that
constexpr double kAsideShare = 0.3;      // of the speed, at the most
constexpr double kMostAside_mps = 0.15;  // and in any case

Vector place(const Pose& pose) {
  return {pose.x_m, pose.y_m};
}
double direction_rad(Vector v) {
  return std::atan2(v.y, v.x);
}

/// What of an offset is gone out sideways.
double gone_out_m(double offset_m) {
  return std::copysign(std::clamp(std::abs(offset_m) - kTurnedOut_m, 0.0, kGoneOut_m), offset_m);
}

/// To the left. What is as slow as what goes aside by itself is none.
double aside_mps(double out_m, double heading_rad, double vx_mps) {
  const double most_mps = std::min(kAsideShare * vx_mps, kMostAside_mps);
  const double across = std::max(std::cos(heading_rad), 0.0);
  const double vy_mps = std::clamp(-kGoneOut_ps * out_m * across, -most_mps, most_mps);
  return std::abs(vy_mps) > kDrives_mps ? vy_mps : 0.0;
}

/// As fast in its direction as it was ahead: so no wheel is faster than it may be.
Twist aslant(double vx_mps, double wz_radps, double vy_mps) {
  if (vy_mps == 0) return {vx_mps, wz_radps};
  const double share = vx_mps / std::hypot(vx_mps, vy_mps);
  return {share * vx_mps, wz_radps, share * vy_mps};
}

bool usable(const Pose& pose) {
  constexpr double kFarthest_m = 1e7;  // beyond it sums lose millimetres
  return std::abs(pose.x_m) < kFarthest_m && std::abs(pose.y_m) < kFarthest_m &&
         std::isfinite(pose.yaw_rad) && std::isfinite(pose.vx_mps) && std::isfinite(pose.vy_mps) &&
         std::isfinite(pose.wz_radps);
}

}  // namespace

Tracker::Tracker(const NavigateConfig& config, const LimitsConfig& limits, const BodyLimits& body)
    : config_(config),
      limits_(limits),
      body_(body),
      braking_mps2_(config.braking_fraction * limits.deceleration_mps2),
      horizon_m_(limits.max_speed_mps * limits.max_speed_mps / (2 * braking_mps2_) + 2.0) {}

void Tracker::begin(const Path& path, std::uint32_t target, double speed_mps, const Pose& pose) {
  const track::PathStart start =
      find_start(path.points, target, place(pose), pose.yaw_rad, track::gears_of(path));
  route_ = track::Route(path.points, target, start.forwards, path.backwards, start.flipped);
  const std::size_t last_segment = path.points.size() - 2;
  // Arc length 0 is the first point, in the order of travel, of the segment the robot starts on.
  station_ = {start.forwards ? start.segment : last_segment - start.segment, 0};
  s_m_ = start.forwards ? start.along_m : route_.segment_m(station_.segment) - start.along_m;
  goal_ = route_.point(route_.size() - 1);
  goal_m_ = s_m_ + start.left_m;
  // The leg begins at a corner just behind, or far enough behind not to matter.
  const double sharp_rad = to_rad(config_.pivot_angle_deg);
  std::size_t first = station_.segment;
  double first_m = 0;
  double tested_m = INFINITY;
  while (first > 0 && first_m > -kLookBack_m) {
    if (tested_m - first_m >= track::kTestSpacing_m) {
      tested_m = first_m;
      if (corner_rad(route_, first, 0) >= sharp_rad) break;
    }
    --first;
    first_m -= route_.segment_m(first);
  }
  begin_leg(leg_to_target(route_, first, first_m, goal_m_));
  scan_ = {station_, 0};
  phase_ = Phase::follow;
  speed_mps_ = speed_mps;
  joined_ = false;
  active_ = true;
  s_m_ = find_foot(route_, leg_, station_, s_m_, place(pose), 16).s_m;
  look_for_corner();
}

void Tracker::begin_leg(const track::Leg& leg) {
  leg_ = leg;
  backwards_ = is_backwards(route_, leg_);
}

/// Of a robot that looks where it drives.
Pose Tracker::as_driven(const Pose& pose) const {
  if (!backwards_) return pose;
  Pose turned = pose;
  turned.yaw_rad = wrap_rad(pose.yaw_rad + kPi);
  turned.vx_mps = -pose.vx_mps;
  turned.vy_mps = -pose.vy_mps;
  return turned;
}

Twist Tracker::as_told(const Twist& twist) const {
  return backwards_ ? Twist{-twist.vx_mps, twist.wz_radps, 0 - twist.vy_mps} : twist;
}

void Tracker::end() {
  active_ = false;
  route_ = {};
}

WayLeft Tracker::way() const {
  WayLeft way;
  if (!active_) return way;
  way.forwards = route_.forwards();
  way.flipped = route_.flipped();
  way.target = static_cast<std::uint32_t>(route_.index(route_.size() - 1));
  way.segment = static_cast<std::uint32_t>(route_.index(station_.segment));
  way.along_m = std::clamp(s_m_ - station_.start_m, 0.0, route_.segment_m(station_.segment));
  return way;
}

void Tracker::look_for_corner() {
  if (!is_last_leg()) return;  // one is known already
  const double sharp_rad = to_rad(config_.pivot_angle_deg);
  const Station corner = find_corner(route_, leg_, sharp_rad, s_m_ + horizon_m_, scan_);
  if (corner.segment == 0) return;
  begin_leg(leg_to_corner(route_, leg_, corner));
  station_ = seek(route_, leg_, station_, std::min(s_m_, leg_.last_m));
}

/// What a stop from creeping takes: the drives' lag, then a ramp whose jerk is limited. A faster
/// robot brakes for its creeping speed already and needs no more.
double Tracker::stop_distance_m(double speed_mps) const {
  const double v = std::clamp(speed_mps, 0.0, config_.creep_speed_mps);
  const double a = limits_.deceleration_mps2;
  const double j = limits_.jerk_mps3;
  const double ramp_m = v < a * a / j ? v * std::sqrt(v / j) : v * v / (2 * a) + v * a / (2 * j);
  return v * config_.drive_lag_s + ramp_m;
}

double Tracker::beside_m(const Pose& other) const {
  if (!active_ || !usable(other)) return 0;
  constexpr int kIterations = 12;  // of a quarter of a metre
  const LineFoot foot = find_foot(route_, leg_, station_, s_m_, place(other), kIterations);
  if (is_last_leg() && foot.s_m > goal_m_) return length(goal_ - place(other));
  return std::abs(offset_m(route_, leg_, station_, foot, place(other)));
}

TrackProgress Tracker::locate(const Pose& seen) {
  TrackProgress progress;
  progress.joined = joined_;
  if (!active_ || !usable(seen)) return progress;
  const Pose pose = as_driven(seen);
  track::Reference here;
  if (phase_ == Phase::pivot) {
    here = smooth(route_, leg_, station_, s_m_);
  } else {
    look_for_corner();
    const LineFoot foot = find_foot(route_, leg_, station_, s_m_, place(pose), 3);
    s_m_ = foot.s_m;
    here = foot.line;
    station_ = seek(route_, leg_, station_, s_m_);
  }
  progress.cross_track_m = offset_m(route_, leg_, station_, {s_m_, here}, place(pose));
  progress.heading_error_rad = wrap_rad(pose.yaw_rad - direction_rad(here.ahead));
  progress.backwards = backwards_;
  progress.distance_left_m = std::max(goal_m_ - s_m_, 0.0);
  progress.distance_to_goal_m = length(goal_ - place(pose));
  joined_ = joined_ || std::abs(progress.cross_track_m) < kJoined_m;
  progress.joined = joined_;
  // On a loop the goal is near all the time: what counts is what is left along the track.
  const double left_m = goal_m_ - s_m_;
  if (!is_last_leg() || left_m > 2 * config_.goal_tolerance_m) return progress;
  progress.goal_passed = left_m <= 0;
  const bool stops_there = left_m <= stop_distance_m(pose.vx_mps);
  const bool rests_there = std::abs(pose.vx_mps) < kAtGoal_mps;
  const bool inside = progress.distance_to_goal_m <= config_.goal_tolerance_m;
  const bool beside = progress.distance_to_goal_m <= 2 * config_.goal_tolerance_m;
  progress.arrived = (inside && (stops_there || rests_there)) || (beside && progress.goal_passed);
  return progress;
}

Twist Tracker::follow(const Pose& seen, const TrackProgress&, double speed_cap_mps, Duration dt,
                      bool may_go_aside) {
  double cap_mps = std::min({speed_mps_, speed_cap_mps, limits_.max_speed_mps});
  if (backwards_) cap_mps = std::min(cap_mps, config_.backwards_speed_mps);
  if (!active_ || !usable(seen) || !(speed_cap_mps > 0) || !(cap_mps > 0)) return {};
  const Pose pose = as_driven(seen);
  if (phase_ == Phase::pivot) return pivot(pose);
  // Once it brakes for the end it does not creep on because its stop distance shrank meanwhile.
  const double left_m = leg_.last_m - s_m_;
  if (phase_ == Phase::halt && left_m > config_.goal_tolerance_m) phase_ = Phase::follow;
  if (left_m <= stop_distance_m(pose.vx_mps)) phase_ = Phase::halt;
  if (phase_ == Phase::follow) return as_told(steer(pose, cap_mps, dt, may_go_aside));
  if (is_last_leg() || std::hypot(pose.vx_mps, pose.vy_mps) > kStands_mps) return {};
  if (!body_.pivots) {
    begin_next_leg();
    return {};
  }
  phase_ = Phase::pivot;
  next_looks_rad_ = is_backwards(route_, next_leg()) == backwards_ ? 0 : kPi;
  return pivot(pose);
}

void Tracker::begin_next_leg() {
  phase_ = Phase::follow;
  s_m_ = leg_.last_m;
  station_ = {leg_.last, leg_.last_m};
  begin_leg(leg_to_target(route_, leg_.last, leg_.last_m, goal_m_));
  look_for_corner();
}

/// With its corner, where that is so near that it says which way the leg is driven.
track::Leg Tracker::next_leg() const {
  constexpr double kNear_m = 0.35;
  const track::Leg leg = leg_to_target(route_, leg_.last, leg_.last_m, goal_m_);
  track::CornerScan scan{{leg_.last, leg_.last_m}, leg_.last_m};
  const Station corner =
      find_corner(route_, leg, to_rad(config_.pivot_angle_deg), leg_.last_m + kNear_m, scan);
  return corner.segment == 0 ? leg : leg_to_corner(route_, leg, corner);
}

/// To how it looks on the leg that comes next: driven the other way than this one, it may look as
/// it does already.
Twist Tracker::pivot(const Pose& pose) {
  constexpr double kDone_rad = 1.0 * kPi / 180;
  constexpr double kDone_radps = 0.1;
  constexpr double kGain_ps = 3.0;
  const Vector next =
      unit(chord_after(route_, leg_.last, route_.size() - 1, kEndChord_m), leg_.leave);
  const double left_rad = wrap_rad(direction_rad(next) + next_looks_rad_ - pose.yaw_rad);
  if (std::abs(left_rad) < kDone_rad && std::abs(pose.wz_radps) < kDone_radps) {
    begin_next_leg();
    return {};
  }
  // Foresee the lag, so that the turn does not swing past its end.
  const double foreseen_rad = left_rad - pose.wz_radps * config_.drive_lag_s;
  const double braking_radps = std::sqrt(limits_.yaw_acceleration_radps2 * std::abs(foreseen_rad));
  const double rate_radps =
      std::min({limits_.max_yaw_rate_radps, braking_radps, kGain_ps * std::abs(foreseen_rad)});
  return {0, std::copysign(rate_radps, foreseen_rad)};
}

/// The fastest that bends and the end of the leg permit at `s_m`.
double Tracker::path_speed_mps(double cap_mps, double s_m) const {
  constexpr double kStep_m = 0.1;
  constexpr std::size_t kSide = 5;  // steps in kSmoothing_m
  constexpr std::size_t kStations = 50;
  static_assert(kSide * 0.1 == kSmoothing_m);
  const double steering_radps = 0.85 * limits_.max_yaw_rate_radps;  // the rest is for feedback
  const double reach_m = cap_mps * cap_mps / (2 * braking_mps2_) + kStep_m;
  const std::size_t stations = std::min(
      kStations, 2 * kSide + 1 + static_cast<std::size_t>(std::min(reach_m / kStep_m, 100.0)));
  std::array<Vector, kStations> line;
  sample(route_, leg_, station_, s_m - kSmoothing_m, kStep_m, std::span(line).first(stations));
  double fastest_mps = cap_mps;
  std::array<double, kStations> curvatures_radpm{};
  for (std::size_t i = kSide; i + kSide < stations; ++i) {
    const Vector slope = 1 / (2 * kSmoothing_m) * (line[i + kSide] - line[i - kSide]);
    const Vector bend =
        1 / (kSmoothing_m * kSmoothing_m) * (line[i + kSide] - 2 * line[i] + line[i - kSide]);
    const double size = std::max(length(slope), 0.3);
    curvatures_radpm[i] = cross(slope, bend) / (size * size * size);
    const double curvature_radpm = std::abs(curvatures_radpm[i]);
    // Wheels that have to be steered to it until then: how fast the curve changes.
    const double change_radpm2 =
        i < 2 * kSide ? 0.0
                      : std::abs(curvatures_radpm[i] - curvatures_radpm[i - kSide]) / kSmoothing_m;
    double bend_mps = kSteeringShare * body_.curvature_rate_radpms / std::max(change_radpm2, 1e-3);
    if (curvature_radpm >= 1e-3)
      bend_mps = std::min({bend_mps, std::sqrt(config_.lateral_acceleration_mps2 / curvature_radpm),
                           steering_radps / curvature_radpm});
    if (!(bend_mps < cap_mps)) continue;
    const double ahead_m = kStep_m * static_cast<double>(i - kSide);
    fastest_mps =
        std::min(fastest_mps, std::sqrt(bend_mps * bend_mps + 2 * braking_mps2_ * ahead_m));
  }
  // Down to creeping where the stop begins.
  const double creep_mps = std::min(config_.creep_speed_mps, cap_mps);
  const double left_m = std::max(leg_.last_m - s_m - stop_distance_m(creep_mps), 0.0);
  return std::min(fastest_mps, std::sqrt(creep_mps * creep_mps + 2 * braking_mps2_ * left_m));
}

/// How the robot is to be turned against the line; one that steers no more than it can be turned
/// along it again until it is there.
double Tracker::back_to_line_rad(double offset_m, double damping, double stiffness) const {
  const double back_rad =
      -kApproach_rad * std::tanh(stiffness / damping * offset_m / kApproach_rad);
  if (body_.pivots) return back_rad;
  const double share = kTurnedBack * std::abs(offset_m) / body_.smallest_radius_m;
  const double most_rad = std::acos(std::clamp(1 - share, -1.0, 1.0));
  return std::clamp(back_rad, -most_rad, most_rad);
}

Twist Tracker::steer(const Pose& pose, double cap_mps, Duration dt, bool may_go_aside) {
  constexpr double kDamping = 2.4;      // of the heading, over the look-ahead
  constexpr double kStiffness = 2.0;    // of the offset, over its square
  constexpr double kTurning_mps = 0.2;  // heading is corrected as if at least so fast

  // The drives answer late: steer for where the base will be then.
  const double lag_s = config_.drive_lag_s;
  const double turned_rad = pose.yaw_rad + 0.5 * pose.wz_radps * lag_s;
  const Vector ahead{std::cos(turned_rad), std::sin(turned_rad)};
  Vector at = place(pose) + pose.vx_mps * lag_s * ahead;
  if (body_.sideways) at = at + pose.vy_mps * lag_s * Vector{-ahead.y, ahead.x};
  const LineFoot foot = find_foot(route_, leg_, station_, s_m_ + pose.vx_mps * lag_s, at, 2);
  const double s_m = foot.s_m;
  const Reference& line = foot.line;
  const double offset_m = cross(line.ahead, at - line.point);
  const double heading_rad =
      wrap_rad(pose.yaw_rad + pose.wz_radps * lag_s - direction_rad(line.ahead));

  // A ramp whose jerk is limited is behind its profile.
  const double ramp_s = braking_mps2_ / (2 * limits_.jerk_mps3);
  double vx_mps = path_speed_mps(cap_mps, s_m + std::max(pose.vx_mps, 0.0) * ramp_s);
  vx_mps /= 1 + std::max(std::abs(offset_m) - 0.1, 0.0);
  // The gate ramps the speed; turning goes with the speed there is, so that the curvature is right.
  const double speed_mps = pose.vx_mps + std::clamp(vx_mps - pose.vx_mps, -0.1, 0.1);
  const double rolling_mps = std::max(speed_mps, 0.0);

  const double lookahead_m = std::max(config_.lookahead_s * rolling_mps, config_.min_lookahead_m);
  const double damping = kDamping / lookahead_m;
  const double stiffness = kStiffness / (lookahead_m * lookahead_m);
  const double out_m = body_.sideways && may_go_aside ? gone_out_m(offset_m) : 0.0;
  const double back_rad = back_to_line_rad(offset_m - out_m, damping, stiffness);
  const double off_rad = wrap_rad(heading_rad - back_rad);
  const double correction_radpm = -damping * off_rad;

  const double bend_radpm = line.curvature_radpm * std::cos(heading_rad) /
                            std::max(1 - line.curvature_radpm * offset_m, 0.5);
  // Skidding wheels turn the base less than asked; what feedback adds in bends, they need always.
  if (std::abs(offset_m) < 0.1 && std::abs(heading_rad) < 0.2 && pose.vx_mps > 0.1) {
    constexpr double kLearning_m = 0.3;
    yaw_gain_ += kLearning_m * line.curvature_radpm * correction_radpm * pose.vx_mps * to_s(dt);
    yaw_gain_ = std::clamp(yaw_gain_, -0.15, 0.35);
  }

  if (!body_.pivots) {
    const double most_radpm = body_.most_radpm();
    const double radpm =
        std::clamp(bend_radpm * (1 + yaw_gain_) + correction_radpm, -most_radpm, most_radpm);
    vx_mps *= std::clamp(1 - (std::abs(off_rad) - 0.5) / 0.7, kSlowestTurned, 1.0);
    if (std::abs(radpm) * vx_mps > limits_.max_yaw_rate_radps)
      vx_mps = limits_.max_yaw_rate_radps / std::abs(radpm);
    return {vx_mps, radpm * vx_mps};
  }
  // Badly turned: rather turn than go.
  vx_mps *= std::clamp(1 - (std::abs(off_rad) - 0.5) / 0.7, 0.0, 1.0);
  double wz_radps = rolling_mps * bend_radpm * (1 + yaw_gain_) +
                    std::max(rolling_mps, kTurning_mps) * correction_radpm;
  if (std::abs(wz_radps) > limits_.max_yaw_rate_radps) {
    vx_mps *= limits_.max_yaw_rate_radps / std::abs(wz_radps);
    wz_radps = std::copysign(limits_.max_yaw_rate_radps, wz_radps);
  }
  return aslant(vx_mps, wz_radps, aside_mps(out_m, heading_rad, vx_mps));
}

}  // namespace drover::engine
