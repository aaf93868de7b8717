// Every number of the engine, with its default. Field names are the configuration file's keys.
#pragma once

#include <array>

#include "drover/actuator.h"
#include "drover/command.h"
#include "drover/fixed_text.h"
#include "drover/fixed_vector.h"
#include "drover/measurement.h"
#include "drover/path.h"
#include "drover/role.h"
#include "drover/snapshot.h"

namespace drover::engine {

/// What keeps the base on a slope when its drives have no power.
enum class HoldBy : std::uint8_t {
  brake,              ///< holding brakes that engage without power
  worm_gear,          ///< gears that cannot be turned from the wheel
  level_ground_only,  ///< nothing: it rolls
};

/// How a base moves: src/engine/base has what follows from it.
enum class BaseKind : std::uint8_t {
  skid_steer,    ///< wheels of two sides, which skid in a turn
  differential,  ///< two wheels on one axle, which do not
  twist,         ///< a device that takes a twist and tells one: it has no joints
  ackermann,     ///< likewise, and it steers: it turns on a curve only
  mecanum,       ///< four wheels with rollers round them, which go sideways, too
};
/// It is told how the whole of it shall move.
constexpr bool takes_twist(BaseKind kind) {
  return kind == BaseKind::twist || kind == BaseKind::ackermann;
}

/// Driven wheels of one side.
inline constexpr std::size_t kMaxSide = kMaxAxes / 2;

/// The base. Axes are indices into the configuration's joints.
struct BaseConfig {
  BaseKind kind = BaseKind::skid_steer;
  double wheel_radius_m = 0.165;
  double track_m = 0.60;      ///< between the centres of the left and right wheels
  double wheelbase_m = 0.65;  ///< between the axles, of a base that steers or goes sideways
  // Of a base that steers. The angle is that of the inner wheel, as makers tell it.
  double max_steering_rad = 0.5;     ///< the most that is asked, so that a little is left
  double steering_rate_radps = 0.4;  ///< how fast that wheel is turned at least
  /// How much wider than `track_m` the base behaves when it turns, because wheels skid.
  /// The estimate refines it while driving.
  double yaw_slip_factor = 1.0;
  HoldBy hold = HoldBy::level_ground_only;
  /// What the drives were holding is held again after a restart or a dip of their supply.
  bool hold_again = true;
  /// With level_ground_only steeper ground refuses a start and ends a task. Wheels on firm ground
  /// roll by themselves from about this on: a twentieth of the weight is what rolling takes.
  double max_tilt_deg = 3.0;
  // Of one that goes sideways the front wheel first.
  FixedVector<AxisId, kMaxSide> left;
  FixedVector<AxisId, kMaxSide> right;
};

/// What it does when its commands cease.
enum class OnSilence : std::uint8_t {
  hold,     ///< the place where it is
  damp,     ///< sinks slowly under its weight
  release,  ///< the drive lets go
};

/// A joint outside the base. Limits clamp.
struct JointRules {
  AxisId axis = 0;
  JointFollows follows = JointFollows::impedance;
  double min_rad = -3.14;
  double max_rad = 3.14;
  double max_velocity_radps = 1.0;
  double max_acceleration_radps2 = 5.0;
  double max_effort_Nm = 5.0;
  // Of holding, and of following a position or a velocity.
  double stiffness_Nmprad = 20.0;
  double damping_Nmsprad = 1.0;
  double rise_s = 0.5;     ///< in which stiffness and effort come up from nothing
  double timeout_s = 0.1;  ///< longer without a command: they have ceased
  OnSilence on_silence = OnSilence::hold;
  bool carries_weight = false;  ///< without power it falls; held, it keeps its effort
  ImpedanceRange drive;         ///< what its drive can be told at all
};

inline constexpr std::size_t kMaxOfGroup = 16;
/// Joints outside the base that belong together: an arm, a mast.
struct GroupConfig {
  Name name;
  FixedVector<JointRules, kMaxOfGroup> joints;
};
inline constexpr std::size_t kMaxGroups = kMaxGroupsShown;

struct LimitsConfig {
  double max_speed_mps = 0.8;   ///< faster requests are clamped to this, and it is said
  double min_speed_mps = 0.05;  ///< slower requests are refused: the base cannot hold them
  double max_yaw_rate_radps = 0.8;
  double acceleration_mps2 = 0.4;
  double deceleration_mps2 = 0.8;  ///< controlled stop; an e-stop is immediate
  double jerk_mps3 = 2.0;
  double yaw_acceleration_radps2 = 1.5;
};

/// Where a receiver's antenna is, in base_link, and its line of two antennas.
struct AntennaConfig {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  double heading_baseline_offset_deg = 0.0;
};

struct EstimateConfig {
  // Antenna (reference point of the receiver's position) in base_link, REP 103: x ahead, y left; of
  // the receiver that steers.
  double antenna_x_m = 0.0;
  double antenna_y_m = 0.0;
  double antenna_z_m = 0.0;
  double heading_baseline_offset_deg = 0.0;         ///< of the antenna line from ahead, clockwise
  FixedVector<AntennaConfig, kMaxOfKind> antennas;  ///< of each receiver; empty: all have that
  /// Of antenna_x_m and antenna_y_m, until turns have told where it is: the bound for people, four
  /// sigma, then has room for a tape that was held to the wrong mark. 0: it was calibrated.
  double antenna_sigma_m = 0.06;
  double heading_sigma_deg = 0.5;
  /// Of how the antenna line is mounted, until it was learned: 2 cm in a metre. The bound for
  /// people, four sigma, then just has room for all that can be learned. 0: it was calibrated.
  double heading_mount_sigma_deg = 1.2;
  double max_correction_age_s = 30.0;  ///< an older RTK fix counts as float
  // The predicted error (two sigma, larger axis) inside which the position counts as good. Of two
  // places that contradict each other: of dead reckoning; both have to be inside of the corridor.
  double bound_start_m = 0.10;
  double bound_run_m = 0.25;
  double bound_yaw_deg = 5.0;
  double max_measurement_delay_s = 0.5;
  double gate_sigma = 5.0;     ///< innovations beyond this are not believed
  double jump_time_s = 1.0;    ///< believed again after disagreeing, consistently, this long
  double wheel_stale_s = 0.1;  ///< older wheel speeds say nothing about the motion
  // One sigma of a position by quality: a floor under what the receiver claims in GST.
  double sigma_fixed_m = 0.01;
  double sigma_float_m = 0.30;
  double sigma_dgps_m = 0.60;
  double sigma_single_m = 2.0;
  double gnss_inflation = 1.25;       ///< times that floor or GST: receivers are optimists
  double gnss_correlation_s = 30.0;   ///< how long a position error stays the same (multipath)
  double gnss_white_share = 0.5;      ///< uncorrelated noise on top, as a share of the sigma
  double gnss_timing_sigma_s = 0.01;  ///< how well the instant of a position is known
  /// Of how much later positions are than their stamps say, until it was learned. 0: calibrated.
  double gnss_late_sigma_s = 0.1;
  double fix_settle_s = 1.0;           ///< the old error fades so fast when the quality improves
  double heading_correlation_s = 0.1;  ///< how long a heading error stays the same
  // Odometry noise: per square root of metre driven or of radian turned.
  double odometry_along_m = 0.01;
  double odometry_across_m = 0.01;
  double odometry_yaw_rad = 0.01;
  double turning_shift_m = 0.02;  ///< the base does not turn exactly about its middle
  double turning_yaw_rad = 0.03;
  double yaw_slip_sigma = 0.3;      ///< of the yaw gain (1 / yaw_slip_factor), at the start
  double yaw_slip_walk = 0.03;      ///< of the yaw gain, per square root of radian turned
  double wheel_scale_sigma = 0.02;  ///< of wheel radius and longitudinal slip, at the start
  double wheel_scale_walk = 0.002;  ///< per square root of metre
  /// The most that wheels slip, as a share of the way: without a fix nothing shows it.
  double unseen_slip_share = 0.4;
  // Inertial sensor. The noise is that of a moving machine, not of the data sheet.
  double imu_stale_s = 0.1;                   ///< older rates say nothing about the turn
  double imu_gyro_noise_rad = 0.0005;         ///< of the heading, per square root of second
  double imu_gyro_bias_sigma_radps = 0.02;    ///< before it was learned at rest
  double imu_gyro_bias_walk_radps = 0.00005;  ///< per square root of second
  double imu_gyro_scale_sigma = 0.01;         ///< of the true turn over the measured one
  double imu_orientation_sigma_deg = 0.5;     ///< of roll and pitch
  double imu_rate_sigma_radps = 0.005;        ///< of one sample, for those who read them
  double imu_acceleration_sigma_mps2 = 0.05;  ///< of one sample
};

struct NavigateConfig {
  TrackDrive drive = TrackDrive::ahead;
  double start_distance_m = 2.0;  ///< farther from the track: refused
  double start_angle_deg = 30.0;  ///< worse turned: refused
  double goal_tolerance_m = 0.10;
  double lookahead_s = 1.0;
  double min_lookahead_m = 0.35;
  double drive_lag_s = 0.12;      ///< from a set point to the wheels' motion, foreseen
  double pivot_angle_deg = 60.0;  ///< sharper corners are turned on the spot; 180: none
  double braking_fraction = 0.5;  ///< of the deceleration, used to slow for bends and the end
  double lateral_acceleration_mps2 = 0.3;  ///< slows for curvature
  double creep_speed_mps = 0.10;           ///< slowest speed while approaching the goal
  double far_zone_speed_mps = 0.25;        ///< cap while the scanner's far zone is occupied
  double backwards_speed_mps = 0.2;        ///< cap where a track is driven backwards
  double corridor_m = 0.50;                ///< farther off the track while driving: the task fails
  double resume_after_s = 1.0;             ///< of health, before a pause ends by itself
  double obstacle_timeout_s = 120.0;       ///< a longer obstacle ends the task
  double locate_timeout_s = 60.0;          ///< a longer loss of localisation ends the task
  double start_timeout_s = 3.0;            ///< drives not running by then: start_nav_failse
  double blocked_timeout_s = 2.0;          ///< commanded but not moving for so long: the task fails
  double find_heading_speed_mps = 0.2;     ///< of the straight way that shows the heading
  double find_heading_distance_m = 3.0;    ///< its longest
  /// Driven slowly, with a little turn, to see whether wheels, gyro and receiver agree; 0: not.
  double first_way_m = 0.3;
  double arrival_timeout_s = 20.0;  ///< creeping near the goal longer than this: the task fails
};

/// How fast the robot may be towards what is in its way. Only with
/// EngineConfig::clearance_required.
struct ClearanceConfig {
  double reaction_s = 0.28;  ///< sensor, scene, cycle and drives, one after the other
  double max_age_s = 0.1;    ///< with an older answer nothing moves,
  double silent_s = 0.25;    ///< and after so long nobody looks around any more
  /// How far beside what was looked along the base may come to be: of the margin that the answers
  /// keep about it, the most that is left for curves that change.
  double beside_m = 0.05;
  double reach_m = 0.6;   ///< of its farthest corner from the middle of its axles
  double again_m = 0.05;  ///< so much freer than at the least, or 0.4 m in all, and
  double again_s = 1.0;   ///< so long, before what was blocked is free again
  double wait_s = 3.0;    ///< a task that is not answered for so long ends
};

struct HealthConfig {
  double drive_stale_s = 0.1;
  double gnss_stale_s = 0.3;
  double imu_stale_s = 0.3;
  double line_stale_s = 0.02;
  double joint_command_timeout_s = 0.1;  ///< a stream silent for longer has ended
  double follow_timeout_s = 0.4;  ///< one wheel commanded but not following for so long: failed
  double tilt_limit_deg = 25.0;   ///< steeper for 0.3 s: stops and holds
  double hit_mps2 = 20.0;         ///< across the ground: stops; 0: nobody looks
  bool guard_required = true;
  double battery_stale_s = 5.0;          ///< of its thread; the driver judges the device
  double battery_low_percent = 20.0;     ///< below: told, and no task starts
  double battery_critical_percent = 10;  ///< below: a task ends
  double battery_hot_degC = 50.0;        ///< above: told
  double battery_too_hot_degC = 60.0;    ///< above: a task ends, and none starts
  double battery_cell_spread_V = 0.5;    ///< between lowest and highest cell: the same
  double battery_hold_s = 20.0;          ///< so long beyond, or back, before it counts
};

/// One of several receivers, inertial sensors or batteries.
struct SensorConfig {
  Name name;
  Role role = Role::steers;
};
using SensorList = FixedVector<SensorConfig, kMaxOfKind>;

/// The antenna of that receiver; kMaxOfKind: of the one that steers.
inline AntennaConfig antenna_of(const EstimateConfig& config, std::size_t receiver) {
  if (receiver < config.antennas.size()) return config.antennas[receiver];
  return {config.antenna_x_m, config.antenna_y_m, config.antenna_z_m,
          config.heading_baseline_offset_deg};
}

struct EngineConfig {
  BaseConfig base;
  LimitsConfig limits;
  EstimateConfig estimate;
  NavigateConfig navigate;
  HealthConfig health;
  ClearanceConfig clearance;
  bool clearance_required = false;  ///< somebody looks around, and nothing moves without his word
  bool clearance_aside = false;     ///< and to the sides, so that a base may go there that can
  /// Names, by AxisId: those of the base come first.
  FixedVector<Name, kMaxAxes> joints;
  FixedVector<GroupConfig, kMaxGroups> groups;         ///< beside the base
  std::array<bool, kLineCount> line_configured{};      ///< by Line
  std::array<bool, kOutputCount> output_configured{};  ///< by Output
  bool battery_configured = false;
  // In the configuration's order, which numbers them; empty: one without a name, if any.
  SensorList receivers;
  SensorList imus;
  SensorList batteries;
  double tick_Hz = 200.0;
};

/// Joints outside the base.
inline std::size_t joints_of_groups(const EngineConfig& config) {
  std::size_t joints = 0;
  for (const GroupConfig& group : config.groups) joints += group.joints.size();
  return joints;
}

}  // namespace drover::engine
