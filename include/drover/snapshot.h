// The state of the robot at one instant: the only thing publishers read.
#pragma once

#include <array>
#include <cstdint>
#include <variant>

#include "drover/driver.h"
#include "drover/fixed_text.h"
#include "drover/fixed_vector.h"
#include "drover/learned.h"
#include "drover/measurement.h"
#include "drover/path.h"
#include "drover/role.h"
#include "drover/time.h"
#include "drover/twist.h"

namespace drover {

/// The RTK navigation protocol's `nav.locate`.
enum class LocateState : std::uint8_t { uninit, lost, good };
/// The RTK navigation protocol's `nav.status`.
enum class NavStatus : std::uint8_t { free, run, success, error };
/// Who owns the drives, highest rank first.
enum class Owner : std::uint8_t { estop, manual, task, cmd_vel, joint_command, nobody };

/// Whether the drives keep the robot where it is.
enum class HoldState : std::uint8_t {
  idle,      ///< the power stages are off, as after a boot: nothing but mechanics holds it
  held,      ///< closed loop at zero speed, or driving
  catching,  ///< it was held, the drives let go, and are being taken back
  released,  ///< a person let it go
  lost,      ///< it was held, and could not be held again: a person has to arm it
};

/// Planar pose and twist in the `map` frame (ENU about the origin), twist in `base_link`.
struct Pose {
  Time time = kNever;
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;  ///< counter-clockwise from east, [-pi, pi)
  double vx_mps = 0;
  double wz_radps = 0;
  double vy_mps = 0;                  ///< to the left: of a base that goes sideways
  double position_sigma_m = kAbsent;  ///< one sigma, larger horizontal axis
  double yaw_sigma_rad = kAbsent;
};

/// Where wheels and gyro alone have the robot, in a frame of their own that begins where `droverd`
/// did (REP 105: `odom`): it drifts and never jumps, whatever a receiver says.
struct Odometry {
  Time time = kNever;
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;  ///< counter-clockwise from how it stood at first, [-pi, pi)
  double vx_mps = 0;   ///< in base_link, on the level
  double wz_radps = 0;
  double vy_mps = 0;
  bool known = false;  ///< false: the base is silent, nobody knows how it moves
  // Variances since the beginning, m2 and rad2, and of the speeds.
  double x_var = 0;
  double xy_var = 0;
  double y_var = 0;
  double x_yaw_var = 0;
  double y_yaw_var = 0;
  double yaw_var = 0;
  double vx_var = 0;
  double wz_var = 0;
  double vy_var = 0;
};

/// What a device's driver says of itself: why it is not fresh or what is odd (empty when all is
/// well), what it understood and what not, and how many measurements it gave.
struct SourceSnapshot {
  Reason reason;
  std::uint64_t samples = 0;
  std::uint64_t bad = 0;
  std::uint64_t overflows = 0;  ///< what the driver had to say and had no room for
};

/// Measurements that did not get into the estimate, since the start.
struct EstimatorCounters {
  std::uint64_t absurd = 0;    ///< not finite, or nothing a robot or receiver can mean
  std::uint64_t late = 0;      ///< older than max_measurement_delay_s
  std::uint64_t repeated = 0;  ///< a second one of the same kind and instant
  std::uint64_t refused = 0;   ///< by the innovation gates
  std::uint64_t broken = 0;    ///< times the filter lost its numbers and began anew
};

struct AxisSnapshot {
  AxisMotion motion;
  Time last_motion = kNever;
  Name joint;
  std::uint8_t group = 0;  ///< 0: the base; else 1 + the number in Snapshot::groups
  AxisState state = AxisState::unknown;
  Reason fault;
  std::uint64_t error_code = 0;  ///< with that fault; 0: it may lie in another axis of its device
  bool lapsed = false;           ///< that fault is only a want of set points or of supply
  bool powered = false;          ///< with that fault its power stage is still on
  bool stops_all = false;        ///< that fault is a person's stop of all of the robot
  double commanded_velocity_radps = 0;
  /// Of a joint that follows an impedance: what its drive is asked to run with now. Else absent.
  double stiffness_Nmprad = kAbsent;
  double damping_Nmsprad = kAbsent;
  double inverter_degC = kAbsent;
  double motor_degC = kAbsent;
  double bus_V = kAbsent;
  double bus_A = kAbsent;
  SourceState health = SourceState::never_heard;
  SourceSnapshot source;  ///< samples: motions
};

/// A base that takes a twist, as its device tells of itself. It has no axes.
struct BaseSnapshot {
  bool configured = false;
  Twist measured{kAbsent, kAbsent};
  double steering_rad = kAbsent;  ///< as BodyMotion::steering_rad
  AxisState state = AxisState::unknown;
  Reason fault;
  Twist commanded;
  double bus_V = kAbsent;
  double bus_A = kAbsent;
  SourceState health = SourceState::never_heard;
  SourceSnapshot source;  ///< samples: motions
  Time last_motion = kNever;
};

struct GnssSnapshot {
  bool configured = false;
  SourceState health = SourceState::never_heard;
  SourceSnapshot source;        ///< samples: positions
  GnssPosition position;        ///< last one, for display
  Time position_time = kNever;  ///< when it was true
  GnssVelocity velocity;        ///< last one, for display
  Time velocity_time = kNever;  ///< when it was true; for who calibrates, and not published
  /// Of its antennas' baseline, as the receiver tells it, clockwise from true north; absent when it
  /// never told one.
  double receiver_heading_deg = kAbsent;
  double heading_deg = kAbsent;       ///< of the vehicle: that less the baseline's mounting
  Time heading_time = kNever;         ///< when both were true
  double pose_heading_deg = kAbsent;  ///< the fused one, of the pose's own instant; absent: unknown
  /// Antenna position of the pose's own instant, so that pose and rtk belong together.
  double pose_latitude_deg = 0;
  double pose_longitude_deg = 0;
};

struct ImuSnapshot {
  bool configured = false;
  SourceState health = SourceState::never_heard;
  SourceSnapshot source;
  Time time = kNever;                      ///< of the sample
  ImuSample sample;                        ///< the last one, as measured
  Vector3 gyro_bias_radps;                 ///< learned at rest; to be taken off
  double gyro_bias_sigma_radps = kAbsent;  ///< of the z axis; absent: none learned yet
  double roll_rad = kAbsent;
  double pitch_rad = kAbsent;
  // One sigma of each axis, for the covariances of ImuState.
  double orientation_sigma_rad = kAbsent;
  double angular_velocity_sigma_radps = kAbsent;
  double acceleration_sigma_mps2 = kAbsent;
};

/// A receiver, inertial sensor or battery, whatever it is for; `GnssSnapshot`, `ImuSnapshot` and
/// `BatterySnapshot` are of the one that the robot goes by.
struct SensorSnapshot {
  SensorKind kind = SensorKind::receiver;
  Name name;
  Role role = Role::steers;
  bool in_use = false;  ///< the robot goes by it now; of batteries by several
  SourceState health = SourceState::never_heard;
  SourceSnapshot source;  ///< samples: positions, samples of the inertial sensor, answers
  Time time = kNever;     ///< of the last one
  std::variant<std::monostate, GnssPosition, BatterySample> last;
  Reason alarms;  ///< of a battery, in words; empty: none
};

/// A scanner, as its own thread tells of it.
struct ScannerSnapshot {
  Name name;
  SourceState health = SourceState::never_heard;
  SourceSnapshot source;     ///< samples: turns
  Time time = kNever;        ///< end of the last turn
  double turn_Hz = kAbsent;  ///< of that one, as the device tells it
  std::uint32_t points = 0;  ///< of that turn, and those of them in which something was seen
  std::uint32_t returns = 0;
  /// What is nearest of that turn, from the scanner: to check how it is mounted.
  double nearest_m = kAbsent;
  double nearest_deg = kAbsent;  ///< as the robot stands: 0 is ahead, to the left positive
};

struct BatterySnapshot {
  bool configured = false;
  SourceState health = SourceState::never_heard;
  SourceSnapshot source;
  Time time = kNever;
  BatterySample sample;  ///< the last one
  Reason alarms;         ///< the worst of them in words; empty: none
};

/// A stream that a program drives by: of joint commands, or of twists.
struct StreamSnapshot {
  bool active = false;  ///< a stream is heard and owns the drives or waits for them
  std::uint64_t accepted = 0;
  std::uint64_t refused = 0;
  Reason reason;  ///< of the last refusal; empty when the last message was followed
};

/// What the joints of a group outside the base do; of several the first in this order.
enum class GroupState : std::uint8_t {
  following,  ///< commands
  arming,     ///< its drives come into closed loop
  holding,    ///< where it is
  damping,    ///< sinks slowly, if it has a weight
  released,   ///< the drives let go
  idle,       ///< the power stages are off
};

/// Whose commands they follow, highest rank first.
enum class GroupOwner : std::uint8_t {
  estop,   ///< nobody's, as long as it is pressed
  broker,  ///< a program's, over the broker
  ros2,    ///< a program's, over ROS 2
  nobody,
};

/// Joints outside the base that belong together.
struct GroupSnapshot {
  Name name;
  GroupOwner owner = GroupOwner::nobody;
  GroupState state = GroupState::idle;
  std::uint64_t accepted = 0;  ///< messages that were followed
  std::uint64_t refused = 0;
  std::uint64_t limited = 0;  ///< cycles in which a limit was put in place of what was asked for
  Reason reason;              ///< why it does not follow, or what is wrong; empty: nothing
};
inline constexpr std::size_t kMaxGroupsShown = 4;

/// How far the robot may go before it would touch something, by whoever looks around.
struct ClearanceSnapshot {
  bool configured = false;
  Time time = kNever;  ///< of the pose that it is for
  // Absent: not known.
  double ahead_m = kAbsent;    ///< along the curve that it drives, or would drive
  double back_m = kAbsent;     ///< along the same one
  double left_rad = kAbsent;   ///< turning on the spot, counter-clockwise; at most half a turn
  double right_rad = kAbsent;  ///< likewise, clockwise
  double along_m = kAbsent;    ///< on the task's track, at most to its goal; absent without a task
  Reason first;                ///< what is met first, and how far away; empty: nothing near
  Reason unknown;              ///< why nothing is known; empty: it is
  Reason broken;               ///< which constraint does not hold; empty: all do
};

struct NavSnapshot {
  NavStatus status = NavStatus::free;
  LocateState locate = LocateState::uninit;
  bool obstacle = false;
  bool paused = false;
  Owner owner = Owner::nobody;
  Name track;
  std::uint32_t target_id = 0;  ///< as the operator counts, 0 when none
  double cross_track_m = 0;     ///< left of the path positive, while a task runs
  double distance_left_m = 0;   ///< to the target; after an error what was left then
  double asked_speed_mps = 0;
  /// How far it could still drive by dead reckoning before the position is too uncertain; absent
  /// while the receiver gives an RTK fix.
  double metres_left = kAbsent;
  /// How far off the place may be: four sigma (motion is decided by two), or what lies between
  /// sources that contradict each other. What no source shows is not in it. Absent without a place.
  double error_bound_m = kAbsent;
  double owner_timeout_s = kAbsent;  ///< silence of the owner after which the base comes to rest
};

struct CycleStats {
  std::uint64_t cycles = 0;
  std::uint64_t overruns = 0;
  std::uint64_t late_frames = 0;  ///< decided too long ago, or the guard took over: never sent
  Duration longest_step{};
};

inline constexpr std::size_t kMaxShownLinks = 18;

struct LinkSnapshot {
  Name name;
  bool is_bus = false;  ///< a CAN bus; otherwise a serial line, the GPIO chip, ...
  bool up = false;
  Reason reason;  ///< why it is not up, or what is wrong with the bus
  std::uint64_t received = 0;
  std::uint64_t sent = 0;
  std::uint64_t dropped = 0;    ///< receive queue overflow, refused sends, no room to send
  std::uint64_t refused = 0;    ///< frames stopped by the gate
  std::uint64_t clamped = 0;    ///< CAN: kernel stamps that could not be
  std::uint64_t malformed = 0;  ///< CAN: datagrams that are no frame
};

struct Snapshot {
  Time time = kNever;
  Pose pose;
  Odometry odometry;
  /// For people: the worse of what the wheels and the receiver say; ahead positive.
  double worst_vx_mps = 0;
  NavSnapshot nav;
  GnssSnapshot gnss;
  ImuSnapshot imu;
  BatterySnapshot battery;
  FixedVector<SensorSnapshot, kMaxSensors> sensors;  ///< by kind, in the configuration's order
  /// Not the gateway's: told by who shows it, of threads that the control thread does not hear.
  FixedVector<ScannerSnapshot, kMaxOfKind> scanners;
  StreamSnapshot cmd_vel;
  StreamSnapshot joint_command;
  FixedVector<AxisSnapshot, kMaxAxes> axes;  ///< those of the base first
  FixedVector<GroupSnapshot, kMaxGroupsShown> groups;
  BaseSnapshot base;
  ClearanceSnapshot clearance;
  std::array<bool, kLineCount> line_active{};
  std::array<SourceState, kLineCount> line_health{};
  std::array<bool, kLineCount> line_configured{};
  std::array<SourceSnapshot, kLineCount> line_source{};  ///< samples: changes
  std::array<bool, kOutputCount> output_configured{};
  std::array<bool, kOutputCount> output_on{};
  FixedVector<LinkSnapshot, kMaxShownLinks> links;
  bool stop_latched = false;  ///< nothing moves until a person acts
  HoldState hold = HoldState::idle;
  bool guard_alive = false;
  bool guard_has_bus = false;
  bool origin_set = false;
  GeodeticPoint origin;
  /// Why the robot does not move, or may not: the first is the cause. Empty when all is well.
  FixedVector<Reason, 8> why;
  std::uint32_t why_untold = 0;  ///< how many more there are, for which `why` had no room
  CycleStats cycle;
  EstimatorCounters estimator;
  LearnedValues learned;
  std::uint64_t notices_dropped = 0;  ///< events that found the engine's queue full

  /// The next reason of `why`; counted where there is no room.
  void tell_why(const Reason& reason) {
    if (!why.push_back(reason)) ++why_untold;
  }
};

}  // namespace drover
