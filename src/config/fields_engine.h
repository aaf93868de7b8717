// Keys of the engine's numbers: range and meaning of each, in one table per struct.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "engine/config.h"

namespace drover::config {

/// Inclusive.
struct Range {
  double min = 0;
  double max = 0;
};
/// How many entries a list may have, inclusive.
struct Count {
  std::size_t min = 0;
  std::size_t max = 0;
};
enum class Presence : std::uint8_t {
  optional,
  required,
  alternative,  ///< one of the keys of an object that are marked so is required
  of_kind,      ///< required by some kinds and refused by others: the object's own table says
  inherited,    ///< left out, it has another key's value
};

template <class V>
void visit(V& v, engine::LimitsConfig& c) {
  v.number("max_speed_mps", c.max_speed_mps, Range{0.05, 5},
           "faster requests are clamped, and it is said");
  v.number("min_speed_mps", c.min_speed_mps, Range{0.01, 1}, "slower requests are refused");
  v.number("max_yaw_rate_radps", c.max_yaw_rate_radps, Range{0.05, 5}, "fastest turn");
  v.number("acceleration_mps2", c.acceleration_mps2, Range{0.05, 5}, "speeding up");
  v.number("deceleration_mps2", c.deceleration_mps2, Range{0.05, 10},
           "controlled stop; an emergency stop is immediate");
  v.number("jerk_mps3", c.jerk_mps3, Range{0.1, 100}, "change of acceleration");
  v.number("yaw_acceleration_radps2", c.yaw_acceleration_radps2, Range{0.1, 20}, "change of turn");
}

/// Of a receiver, whoever has them.
template <class V, class C>
void visit_antenna(V& v, C& c, Presence presence) {
  v.number("antenna_x_m", c.antenna_x_m, Range{-10, 10}, "antenna ahead of base_link", presence);
  v.number("antenna_y_m", c.antenna_y_m, Range{-10, 10}, "antenna left of base_link", presence);
  v.number("antenna_z_m", c.antenna_z_m, Range{-10, 10},
           "antenna above base_link; without an inertial sensor it has no effect", presence);
  v.number("heading_baseline_offset_deg", c.heading_baseline_offset_deg, Range{-360, 360},
           "antenna line from ahead, clockwise", presence);
}

template <class V>
void visit_gnss(V& v, engine::EstimateConfig& c) {
  visit_antenna(v, c, Presence::optional);
  v.number("antenna_sigma_m", c.antenna_sigma_m, Range{0, 1},
           "one sigma of antenna_x_m and antenna_y_m, until turns have told where the antenna is; "
           "0: calibrated");
  v.number("heading_sigma_deg", c.heading_sigma_deg, Range{0.05, 20}, "one sigma of the heading");
  v.number("heading_mount_sigma_deg", c.heading_mount_sigma_deg, Range{0, 5},
           "one sigma of how the antenna line is mounted, until that was learned; 0: calibrated");
  v.number(
      "gnss_late_sigma_s", c.gnss_late_sigma_s, Range{0, 0.5},
      "one sigma of how much later positions and headings are than the gateway takes them for, "
      "until that was learned; 0: calibrated");
  v.number("heading_correlation_s", c.heading_correlation_s, Range{0.001, 60},
           "how long a heading error stays the same");
  v.number("max_correction_age_s", c.max_correction_age_s, Range{1, 600},
           "an RTK fix with older corrections counts as float");
  v.number("sigma_fixed_m", c.sigma_fixed_m, Range{0.001, 1},
           "one sigma of an RTK fix: a floor under what the receiver claims");
  v.number("sigma_float_m", c.sigma_float_m, Range{0.01, 10}, "the same of an RTK float");
  v.number("sigma_dgps_m", c.sigma_dgps_m, Range{0.01, 20},
           "the same with differential corrections");
  v.number("sigma_single_m", c.sigma_single_m, Range{0.1, 50}, "the same without corrections");
  v.number("gnss_inflation", c.gnss_inflation, Range{1, 10},
           "times the larger of that floor and the receiver's claim");
  v.number("gnss_correlation_s", c.gnss_correlation_s, Range{0.1, 600},
           "how long a position error stays the same (multipath)");
  v.number("gnss_white_share", c.gnss_white_share, Range{0.01, 1},
           "uncorrelated noise on top, as a share of the sigma");
  v.number("gnss_timing_sigma_s", c.gnss_timing_sigma_s, Range{0, 0.5},
           "one sigma of the instant of a position");
  v.number("fix_settle_s", c.fix_settle_s, Range{0.1, 60},
           "the old error fades so fast when the quality improves");
}

template <class V>
void visit_odometry(V& v, engine::EstimateConfig& c) {
  v.number("wheel_stale_s", c.wheel_stale_s, Range{0.02, 2},
           "older wheel speeds say nothing about the motion");
  v.number("odometry_along_m", c.odometry_along_m, Range{0.0001, 1},
           "one sigma along, per square root of metre driven");
  v.number("odometry_across_m", c.odometry_across_m, Range{0.0001, 1},
           "one sigma across, per square root of metre driven");
  v.number("odometry_yaw_rad", c.odometry_yaw_rad, Range{0.0001, 1},
           "one sigma of the heading, per square root of metre driven");
  v.number("turning_shift_m", c.turning_shift_m, Range{0, 1},
           "one sigma of the place, per square root of radian turned");
  v.number("turning_yaw_rad", c.turning_yaw_rad, Range{0, 1},
           "one sigma of the heading, per square root of radian turned");
  v.number("yaw_slip_sigma", c.yaw_slip_sigma, Range{0.001, 1},
           "one sigma of 1 / groups.base.yaw_slip_factor at the start");
  v.number("yaw_slip_walk", c.yaw_slip_walk, Range{0, 1},
           "how much it changes, per square root of radian turned");
  v.number("wheel_scale_sigma", c.wheel_scale_sigma, Range{0.0001, 0.5},
           "one sigma of wheel radius and longitudinal slip at the start, as a share");
  v.number("wheel_scale_walk", c.wheel_scale_walk, Range{0, 0.1},
           "how much it changes, per square root of metre driven");
  v.number(
      "unseen_slip_share", c.unseen_slip_share, Range{0, 1},
      "the most that wheels slip, as a share of the way: what was driven without an RTK fix may "
      "be wrong by it");
}

template <class V>
void visit_imu(V& v, engine::EstimateConfig& c) {
  v.number("imu_stale_s", c.imu_stale_s, Range{0.02, 2}, "older rates say nothing about the turn");
  v.number("imu_gyro_noise_rad", c.imu_gyro_noise_rad, Range{0.00001, 0.1},
           "one sigma of the heading by the gyro's noise, per square root of second");
  v.number("imu_gyro_bias_sigma_radps", c.imu_gyro_bias_sigma_radps, Range{0.0001, 0.2},
           "one sigma of the gyro's bias before it was learned at rest");
  v.number("imu_gyro_bias_walk_radps", c.imu_gyro_bias_walk_radps, Range{0, 0.01},
           "how much the bias changes, per square root of second");
  v.number("imu_gyro_scale_sigma", c.imu_gyro_scale_sigma, Range{0.0001, 0.2},
           "one sigma of the gyro's scale at the start, as a share");
  v.number("imu_orientation_sigma_deg", c.imu_orientation_sigma_deg, Range{0.05, 20},
           "one sigma of roll and pitch");
  v.number("imu_rate_sigma_radps", c.imu_rate_sigma_radps, Range{0.0001, 1},
           "one sigma of a sample of the angular velocity, as published");
  v.number("imu_acceleration_sigma_mps2", c.imu_acceleration_sigma_mps2, Range{0.001, 10},
           "one sigma of a sample of the acceleration, as published");
}

template <class V>
void visit(V& v, engine::EstimateConfig& c) {
  v.number("bound_start_m", c.bound_start_m, Range{0.01, 10},
           "largest predicted position error (two sigma) to start with");
  v.number(
      "bound_run_m", c.bound_run_m, Range{0.01, 10},
      "largest predicted position error (two sigma) to drive with; while two places contradict "
      "each other, of dead reckoning: both have to be inside of navigate.corridor_m");
  v.number("bound_yaw_deg", c.bound_yaw_deg, Range{0.5, 45},
           "largest predicted heading error (two sigma)");
  v.number("max_measurement_delay_s", c.max_measurement_delay_s, Range{0.05, 1},
           "older measurements are not used");
  v.number("gate_sigma", c.gate_sigma, Range{2, 20},
           "measurements farther from the prediction are not believed");
  v.number("jump_time_s", c.jump_time_s, Range{0.2, 10},
           "disagreement, all in one direction, that ends a task; at rest it is believed then");
  visit_gnss(v, c);
  visit_odometry(v, c);
  visit_imu(v, c);
}

/// As `drive` is written, by TrackDrive.
inline constexpr std::array<std::string_view, 3> kDriveWords{"ahead", "recorded", "either"};

template <class V>
void visit(V& v, engine::NavigateConfig& c) {
  std::string drive(kDriveWords[static_cast<std::size_t>(c.drive)]);
  v.choice("drive", drive, {kDriveWords.begin(), kDriveWords.end()},
           "ahead: a robot looks where it drives and turns round at a cusp; recorded: backwards "
           "where a track was recorded so; either: as it stands at the start, and at a cusp it "
           "goes on the other way");
  for (std::size_t i = 0; i < kDriveWords.size(); ++i)
    if (drive == kDriveWords[i]) c.drive = static_cast<TrackDrive>(i);
  v.number("start_distance_m", c.start_distance_m, Range{0.1, 20},
           "a start farther from the track is refused");
  v.number("start_angle_deg", c.start_angle_deg, Range{5, 180}, "a start worse turned is refused");
  v.number("goal_tolerance_m", c.goal_tolerance_m, Range{0.02, 2}, "so near the goal is arrived");
  v.number("lookahead_s", c.lookahead_s, Range{0.2, 5}, "look-ahead of the tracker");
  v.number("min_lookahead_m", c.min_lookahead_m, Range{0.1, 5}, "shortest look-ahead");
  v.number("drive_lag_s", c.drive_lag_s, Range{0, 1},
           "from a set point to the wheels' motion; the tracker foresees it");
  v.number("pivot_angle_deg", c.pivot_angle_deg, Range{20, 180},
           "sharper corners are turned on the spot; 180: none");
  v.number("braking_fraction", c.braking_fraction, Range{0.1, 1},
           "share of limits.deceleration_mps2 used to slow for bends and the end");
  v.number("lateral_acceleration_mps2", c.lateral_acceleration_mps2, Range{0.05, 3},
           "slows for curves to stay below");
  v.number("creep_speed_mps", c.creep_speed_mps, Range{0.02, 1}, "slowest speed near the goal");
  v.number("far_zone_speed_mps", c.far_zone_speed_mps, Range{0, 5},
           "cap while the far zone is occupied");
  v.number("backwards_speed_mps", c.backwards_speed_mps, Range{0.05, 0.2},
           "cap where a track is driven backwards: nobody looks behind the robot");
  v.number("corridor_m", c.corridor_m, Range{0.05, 10}, "farther off the track the task fails");
  v.number("resume_after_s", c.resume_after_s, Range{0.2, 60}, "health before a pause ends");
  v.number("obstacle_timeout_s", c.obstacle_timeout_s, Range{1, 3600},
           "a longer obstacle ends the task");
  v.number("locate_timeout_s", c.locate_timeout_s, Range{1, 3600},
           "a longer loss of localisation ends the task");
  v.number("start_timeout_s", c.start_timeout_s, Range{0.5, 60},
           "drives not running by then: the task does not start");
  v.number("blocked_timeout_s", c.blocked_timeout_s, Range{0.2, 60},
           "commanded but not moving for so long: the task fails");
  v.number("find_heading_speed_mps", c.find_heading_speed_mps, Range{0.05, 0.5},
           "speed of the straight way that shows the heading");
  v.number("find_heading_distance_m", c.find_heading_distance_m, Range{1, 10},
           "longest way that is driven to find the heading");
  v.number("first_way_m", c.first_way_m, Range{0, 2},
           "after a boot or a changed configuration driven at 0.05 m/s with 5 degrees of turn to "
           "each side (one antenna and no gyro: 12, and as far again until its places show them), "
           "to see whether wheels, gyro and receiver agree; 0: not");
  v.number("arrival_timeout_s", c.arrival_timeout_s, Range{1, 600},
           "creeping near the goal for longer: the task fails");
}

template <class V>
void visit(V& v, engine::HealthConfig& c) {
  v.number("drive_stale_s", c.drive_stale_s, Range{0.02, 2}, "longest silence of a drive");
  v.number("gnss_stale_s", c.gnss_stale_s, Range{0.1, 5}, "longest silence of the receiver");
  v.number("imu_stale_s", c.imu_stale_s, Range{0.05, 5}, "longest silence of the inertial sensor");
  v.number("line_stale_s", c.line_stale_s, Range{0.01, 1}, "longest silence of a digital input");
  v.number("joint_command_timeout_s", c.joint_command_timeout_s, Range{0.02, 1},
           "longest silence within a stream of joint commands");
  v.number(
      "follow_timeout_s", c.follow_timeout_s, Range{0.1, 10},
      "a wheel that is commanded but does not follow for so long, and 0.12 m of way, is a fault");
  v.number("tilt_limit_deg", c.tilt_limit_deg, Range{5, 60},
           "tilted farther for 0.3 s: the robot stops and holds");
  v.number(
      "hit_mps2", c.hit_mps2, Range{0, 200},
      "an acceleration across the ground beyond this is a hit: the robot stops as on a bumper, "
      "and a person starts it again; 0: nobody looks");
  v.number("battery_stale_s", c.battery_stale_s, Range{2, 120}, "longest silence of the battery");
  v.number("battery_low_percent", c.battery_low_percent, Range{0, 100},
           "below: told, and no task starts");
  v.number("battery_critical_percent", c.battery_critical_percent, Range{0, 100},
           "below: a task ends with a controlled stop");
  v.number("battery_hot_degC", c.battery_hot_degC, Range{20, 100}, "hotter: told");
  v.number("battery_too_hot_degC", c.battery_too_hot_degC, Range{20, 100},
           "hotter: a task ends, and none starts");
  v.number("battery_cell_spread_V", c.battery_cell_spread_V, Range{0.02, 3},
           "lowest and highest cell farther apart: a task ends, and none starts");
  v.number("battery_hold_s", c.battery_hold_s, Range{0, 600},
           "beyond a battery limit, or back, for so long before it counts: a sag is no end");
}

/// The base names joints; the engine wants axis numbers: `left` and `right` are resolved
/// afterwards.
struct BaseNames {
  engine::BaseConfig* base = nullptr;
  std::string kind;
  std::string hold;
  std::vector<std::string> left;
  std::vector<std::string> right;
  std::string device;
};

/// As `kind` is written.
inline constexpr std::string_view kBaseKinds[] = {"skid_steer", "differential", "twist",
                                                  "ackermann", "mecanum"};
inline constexpr std::string_view kTwistKind = kBaseKinds[2];
inline constexpr std::string_view kAckermannKind = kBaseKinds[3];
inline constexpr std::string_view kMecanumKind = kBaseKinds[4];
/// A device takes its twist.
constexpr bool is_told_a_twist(std::string_view kind) {
  return kind == kTwistKind || kind == kAckermannKind;
}

/// A key that bases with wheels need, or those that take a twist, or of them those that steer, or
/// those of which the way between the axles counts; the others have no use for it.
struct BaseKey {
  enum class Of : std::uint8_t { wheels, twist, steering, axles };
  std::string_view key;
  Of of = Of::wheels;

  constexpr bool is_of(std::string_view kind) const {
    if (of == Of::steering) return kind == kAckermannKind;
    if (of == Of::axles) return kind == kAckermannKind || kind == kMecanumKind;
    return is_told_a_twist(kind) == (of == Of::twist);
  }
};
inline constexpr BaseKey kBaseKeys[] = {{"wheel_radius_m", BaseKey::Of::wheels},
                                        {"left", BaseKey::Of::wheels},
                                        {"right", BaseKey::Of::wheels},
                                        {"device", BaseKey::Of::twist},
                                        {"wheelbase_m", BaseKey::Of::axles},
                                        {"max_steering_rad", BaseKey::Of::steering},
                                        {"steering_rate_radps", BaseKey::Of::steering}};

inline constexpr Count kSideCount{1, decltype(engine::BaseConfig::left)::capacity()};

template <class V>
void visit(V& v, BaseNames& c) {
  v.choice("kind", c.kind, {std::begin(kBaseKinds), std::end(kBaseKinds)},
           "skid_steer: several wheels on a side; differential: one, which turns without skidding; "
           "twist: a device that is told how the whole base shall move; ackermann: likewise, and "
           "it steers; mecanum: four wheels with rollers at 45 degrees, which go sideways, too",
           Presence::required);
  v.number("wheel_radius_m", c.base->wheel_radius_m, Range{0.01, 2}, "wheel radius",
           Presence::of_kind);
  v.number("track_m", c.base->track_m, Range{0.05, 5}, "between left and right wheels",
           Presence::required);
  v.number("wheelbase_m", c.base->wheelbase_m, Range{0.2, 5},
           "ackermann and mecanum: between the axles", Presence::of_kind);
  v.number(
      "max_steering_rad", c.base->max_steering_rad, Range{0.1, 1},
      "ackermann: the most that its inner wheel is steered; less than it can, so that a little "
      "is left to keep the track",
      Presence::of_kind);
  v.number("steering_rate_radps", c.base->steering_rate_radps, Range{0.05, 5},
           "ackermann: how fast its inner wheel is steered at least", Presence::of_kind);
  v.number("yaw_slip_factor", c.base->yaw_slip_factor, Range{0.5, 4},
           "how much wider than track_m the base behaves when it turns; refined while driving");
  v.choice("hold", c.hold, {"brake", "worm_gear", "level_ground_only"},
           "what keeps the base on a slope when its drives have no power", Presence::required);
  v.flag("hold_again", c.base->hold_again,
         "take the drives back after a restart or a dip of their supply; false on blocks");
  v.number("max_tilt_deg", c.base->max_tilt_deg, Range{1, 45},
           "level_ground_only: steeper ground refuses a start and ends a task");
  v.names("left", c.left, kSideCount,
          "joints of the left side; mecanum: the front wheel, then the rear one",
          Presence::of_kind);
  v.names("right", c.right, kSideCount, "joints of the right side, likewise", Presence::of_kind);
  v.text("device", c.device, "name of the device that takes the twist", Presence::of_kind);
  v.keys_of_base(c.kind);
}

}  // namespace drover::config
