// What the engine is made of; the files engine*.cpp share it and nobody else includes it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/kinematics.h"
#include "engine/clearance/clearance_watch.h"
#include "engine/engine.h"
#include "engine/estimate/estimator.h"
#include "engine/estimate/place_count.h"
#include "engine/event_queue.h"
#include "engine/group/joint_group.h"
#include "engine/health/announcer.h"
#include "engine/health/aside_check.h"
#include "engine/health/health.h"
#include "engine/health/hit_watch.h"
#include "engine/health/latch.h"
#include "engine/health/learned_notices.h"
#include "engine/health/mechanics_check.h"
#include "engine/health/place_watch.h"
#include "engine/health/rest_watch.h"
#include "engine/health/steering_watch.h"
#include "engine/health/tilt_watch.h"
#include "engine/health/wheels.h"
#include "engine/health/worst_speed.h"
#include "engine/navigate/navigator.h"
#include "engine/odometry.h"
#include "engine/own/arming.h"
#include "engine/own/owners.h"
#include "engine/own/power.h"
#include "engine/sensors/sensors.h"
#include "engine/signals/signals.h"

namespace drover::engine {

struct Engine::Impl {
  explicit Impl(const EngineConfig& c);

  void take(const Measurement& m);
  void take_words(const Measurement& m, std::string_view words);
  std::span<AxisSnapshot> axes_of(const AxisStatus& status, AxisSnapshot& axis) const;
  void count(const Measurement& m);
  /// Of the base or of a group; nullptr: there is none of that number. kBaseAxis: the first edge.
  AxisSnapshot* axis_of(AxisId id);
  /// What holds of it in this cycle, as its driver judges.
  static void look_at(AxisSnapshot& axis, const SourceHealth& driver, Time now);
  void make_groups();
  /// Those of the groups come after them.
  std::size_t joints_of_base() const { return snapshot.axes.size() - joints_of_groups(config); }
  void fill_sources(const Environment& environment);
  void propose_origin(const RequestId& id, Time now);
  void set_origin(const RequestId& id, const GeodeticPoint& origin, Time now);
  void accept_position(const RequestId& id, Time now);
  void forget_learned(const RequestId& id, Time now);
  Reason poor_fix(Time now) const;
  void engage_stop(const RequestId& id, Time now);
  void reset_stop(const RequestId& id, Time now);
  void start_task(const Command& command, const StartTask& task, Time now);
  void command_axes(const Motion& motion, EngineOutput& out);
  void take_body(const BodyMotion& body, Time time);
  void command_base(EngineOutput& out);
  void take_joints(const JointTargets& targets, RequestId::Source source, Time now);
  void end_groups(const Reason& why);
  void step_groups(Time now, Duration dt, const Environment& environment, EngineOutput& out);
  /// Of the curve that the wheels of a base that steers make; not a number: it tells nothing of it.
  double steered_radpm() const;
  void fill_base(const Environment& environment, const BaseCommand& command);
  void release_hold(const RequestId& id, const ReleaseHold& release, Time now);
  void arm_hold(const RequestId& id, Time now);
  double tilt_deg() const;
  /// As the base turns: its track is wider than it is.
  double half_track_m() const { return track_of_turn_m(base) / 2 * estimate.yaw_slip_factor; }
  std::string_view no_sideways(const Twist& twist) const;
  void watch_tilt(Time now, bool has_imu);
  void watch_imu(const ImuSample& sample, Time at);
  void choose_sensors(Time now, const Environment& environment);
  bool imu_trusted() const { return sensors.imu_trusted(sensors.imu()); }
  Reason judge_motion(Time now, Duration dt, const LineTable& lines,
                      const Environment& environment);
  void watch_wheels(Time now, Duration dt);
  void fill_clearance();
  void fill_speed(Time now);
  void fill_viewpoint();
  void tell_sender(Time now, Owner owner, const Stream& stream, Owner his);
  void tell_first_way(Owner owner);
  void fill_imu(const Estimate& located);
  double reversal_m(const Estimate& located) const;
  void fill_lines(const LineTable& lines);
  void fill_snapshot(Time now, const Environment& environment, const LineTable& lines,
                     const Estimate& estimate, Owner owner);

  EngineConfig config;
  Kinematics base;
  Estimator estimator;
  OdometryTrack odometry;
  Sensors sensors;
  HealthMonitor health;
  WheelMonitor wheels;
  SteeringWatch steering;
  WheelFault wheel_fault = WheelFault::none;  ///< of the last step
  Reason wheel_reason;                        ///< of that fault
  RestWatch rest;
  WorstSpeed worst_speed;
  PlaceWatch place;
  PlaceCount place_count;
  TiltWatch tilt;
  HitWatch hit;
  MechanicsCheck mechanics;
  AsideCheck aside;
  ClearanceWatch clearance;
  Twist commanded;            ///< in the last cycle; of single joints what they make of it
  bool by_joints = false;     ///< and of those it is
  Twist asked;                ///< likewise, by its owner, before anything bounded it
  bool motion_asked = false;  ///< in the last cycle
  Twist sent;                 ///< in the last cycle, to a base that takes a twist
  Announcer announcer;
  Latch latch;
  Navigator navigator;
  Owners owners;
  Arming arming;
  PowerSwitch power;
  Signals signals;
  EventQueue events;
  std::array<bool, kLineCount> level{};  ///< last reported; active until then
  std::array<bool, kLineCount> pulse{};  ///< was active at some instant since the last step
  Estimate estimate;                     ///< of the last step
  GnssPosition fix;                      ///< the last one
  Reason steep;                          ///< why this ground is too steep to stop on
  Time steep_since = kNever;
  Time tilt_known_at = kNever;
  LearnedNotices learned_notices;
  bool slopes = false;       ///< the ground fell when that was known last
  Time stopped_at = kNever;  ///< last: nothing could move then
  Time last_step = kNever;
  Snapshot snapshot;
  Viewpoint view;
  /// Edges of a base that takes a twist.
  std::array<AxisSnapshot, 2> edges;
  Twist told{kAbsent, kAbsent};   ///< by that base, last
  double steering_rad = kAbsent;  ///< likewise, of one that steers
  /// All of the base that is watched and commanded: its joints, or those edges.
  std::span<AxisSnapshot> axes;
  std::vector<JointGroup> groups;  ///< beside the base; made once
};

}  // namespace drover::engine
