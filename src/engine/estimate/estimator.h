// Position, heading and velocity of the base, with covariance, from wheels, GNSS and gyro.
//
// Measurements are applied at their own time: a short history of states is kept, a late measurement
// goes in where it belongs and what came after is applied again. Fixed size, no allocation.
#pragma once

#include <array>
#include <cstdint>

#include "drover/learned.h"
#include "drover/measurement.h"
#include "drover/path.h"
#include "drover/snapshot.h"
#include "engine/base/kinematics.h"
#include "engine/config.h"
#include "engine/estimate/history.h"
#include "engine/estimate/imu_intake.h"
#include "engine/estimate/local_frame.h"

namespace drover::engine {

namespace estimate {
struct Contradictions;
}

struct Estimate {
  bool has_position = false;
  bool has_heading = false;
  Pose pose;  ///< predicted to the asked time
  /// By it motion is decided: two sigma of the larger horizontal axis, or what lies between sources
  /// that contradict each other, if that is more.
  double predicted_error_m = kAbsent;
  /// Likewise with four sigma, for people, and with what wheels may have slipped since the last
  /// fix. Another error that no source shows is in neither.
  double error_bound_m = kAbsent;
  /// The way since the last believed RTK fix, and how far aside of the heading the robot may be
  /// when wheels slipped on it by unseen_slip_share, which is in error_bound_m.
  double unseen_way_m = 0;
  double unseen_slip_m = 0;  ///< what is in error_bound_m of it
  double unseen_aside_m = 0;
  double unseen_ahead_m = 0;  ///< likewise ahead, by the way that led against its heading
  double unseen_behind_m = 0;
  /// Of two places one was believed after a minute: the other one is so far east and north of it,
  /// until another fix is found.
  double unbelieved_x_m = 0;
  double unbelieved_y_m = 0;
  double unbelieved_error_m = 0;   ///< two sigma; 0: there is none
  double yaw_error_rad = kAbsent;  ///< two sigma
  bool way_heals = false;          ///< RTK fixes come and no heading: only way driven tells it
  BodyMotion body;                 ///< as the base tells it, nothing learned applied
  double fastest_mps = 0;          ///< of its wheels on the ground, by that motion
  double yaw_slip_factor = 1.0;    ///< as refined
  Reason reason;                   ///< why it is not good; empty when it is
  bool disagrees = false;          ///< GNSS and odometry contradict each other beyond the gate
  /// They do since the base drove, and which of both is right may still show: predicted_error_m and
  /// yaw_error_rad cover both, and inside of them a task may go on.
  bool disputed = false;
  /// Of predicted_error_m what is not between both.
  double own_error_m = kAbsent;
  /// The last time that it was decided for where the receiver is; kNever: it was not.
  Time renewed = kNever;
  Time found = kNever;  ///< there was an RTK fix again then, believed or not
  /// When it is decided at the latest if all stays as it is; kNever: not by waiting.
  Time decided_at = kNever;
  /// The position drifted or jumped while it drove, and nobody has accepted where it is.
  bool place_doubted = false;
  bool heading_doubted = false;  ///< it contradicts wheels and gyro
  /// What another place, which may be the right one, adds to the bound, m.
  double elsewhere_m = 0;
  bool slipping = false;  ///< the wheels roll another way than the base moves
  /// How much the ways of wheels and receiver differ since they slip: one of both is wrong by it.
  double slipped_m = 0;
  /// So much later than their stamps say are positions and headings, as learned and made up for, s;
  /// absent until it is certain that they are.
  double late_s = kAbsent;
  double heading_late_s = kAbsent;
  /// The antenna is so much farther ahead and to the left of what the base turns about than is
  /// configured, m; absent until that is certain. Not made up for: predicted_error_m has it.
  double arm_ahead_m = kAbsent;
  double arm_left_m = kAbsent;
  /// Nothing tells yet that it is nearer than this to where it is configured, m; absent: turns or a
  /// calibration do, or it is told to be wrong.
  double arm_unknown_m = kAbsent;
  /// True speed over the told one, when that is certainly another; absent: about the same.
  double wheel_scale = kAbsent;
  /// The last shove that is over, as an inertial sensor felt it: to the left; kNever: none.
  Time shoved = kNever;
  double shoved_m = 0;
  /// Why the base has to stand until it is seen whether the position drifts; empty: it may drive.
  Reason looks;
  /// The antenna line is mounted so much beside what is configured, counterclockwise, as learned
  /// and corrected; its sigma, until then that of the configuration. Absent: no receiver tells
  /// headings.
  double mounting_rad = kAbsent;
  double mounting_sigma_rad = kAbsent;
  bool mounting_known = false;
  /// What of all that is known well enough to begin with next time.
  LearnedValues learned;
  /// What was noticed and is made up for, so far: slipping wheels, a gyro that is not believed.
  Reason notice;
  /// How far it could still drive by dead reckoning; absent with an RTK fix, or without a place.
  double metres_left = kAbsent;
  bool gyro_used = false;  ///< the heading is predicted by the inertial sensor
  double roll_rad = kAbsent;
  double pitch_rad = kAbsent;
  Vector3 gyro_bias_radps;                 ///< learned at rest, z refined while driving
  double gyro_bias_sigma_radps = kAbsent;  ///< of z; absent: none learned yet
};

/// How far what a receiver says is from the estimate.
struct Apart {
  bool known = false;
  double m = 0;
  double permitted_m = 0;  ///< by what both are uncertain
};

class Estimator final {
 public:
  Estimator(const EstimateConfig& config, const BaseConfig& base);

  /// Takes an origin. A known pose is told in its frame at once. One that was not known, or that
  /// the receiver contradicts, is forgotten and found again from the next measurements; then only
  /// the yaw gain, the wheel scale, the gyro's errors and the mounting of the antenna line, which
  /// no origin changes, are kept.
  void set_origin(const GeodeticPoint& origin);
  /// The place is that of the next position, and the heading, where a receiver tells one, of the
  /// next heading. What was found by comparing positions with wheels and gyro is forgotten, but not
  /// the mounting of the antenna line: that is of the robot, not of the place.
  void accept_position();
  /// What the program before this one had learned, before anything is measured. Values that cannot
  /// be are left out; what is taken is a little less certain than it was.
  void recall(const LearnedValues& learned);
  /// The program before this one knew of another place so far away, m, which may be the right one.
  void recall_elsewhere(double away_m);
  /// Begins as a robot that has never driven; where it is told headings, place and heading are
  /// those of the next measurements. It rests.
  void forget_learned();
  bool has_origin() const;
  const GeodeticPoint& origin() const;
  /// Position of the antenna for a pose of base_link, degrees (for rtk.latitude/longitude). The
  /// altitude is the last received one. NaN without an origin.
  GeodeticPoint antenna_geodetic(const Pose& pose) const;
  /// Position in the map frame of a geodetic point (for tracks). NaN without an origin.
  PathPoint local(const GeodeticPoint& point) const;

  void on_measurement(const Measurement& measurement);  ///< what it does not use is ignored
  /// From here on the turn is this sensor's; the others only learn their zeros. Receivers need no
  /// such word: a position that comes is used.
  void use_imu(std::size_t source) { imu_in_use_ = source; }
  const estimate::ImuIntake& imu(std::size_t source) const { return imus_[source]; }
  /// Of a receiver that is not in use.
  Apart apart(const GnssPosition& position, std::uint8_t receiver, Time time) const;
  /// Advances to `now` (monotonic) and returns the state there.
  const Estimate& step(Time now);

  EstimatorCounters counters() const;

 private:
  /// Rim speeds and rates that become known within one slot share an entry of the history, so its
  /// length does not depend on the number of wheels. At 0.4 m/s2 the speed changes by 2 mm/s in
  /// one.
  static constexpr Duration kSlot = std::chrono::milliseconds(4);

  // What is measured, in estimator_intake.cpp:
  void on_joint(const AxisMotion& motion, Time time);
  void on_body(const BodyMotion& body, Time time);
  void on_imu(const ImuSample& sample, std::uint8_t source, Time time);
  void on_position(const GnssPosition& position, std::uint8_t receiver, Time time);
  void on_heading(const GnssHeading& heading, std::uint8_t receiver, Time time);
  template <class Edit>
  void edit_slot(Time slot, const Edit& edit);
  void insert(Time time, const estimate::Input& input);
  bool too_old(Time time);
  // What follows from it:
  void clamp_future(Time now);
  void replay();
  void advance(estimate::State& state, Time to) const;
  void reckon(estimate::State& state, const BodyMotion& body, const estimate::GyroMotion& gyro,
              double dt_s) const;
  void take(estimate::State& state, const estimate::Input& input) const;
  double in_time(estimate::State& state, double told_rad) const;
  void count_unseen_tilt(estimate::State& state, const BodyMotion& body, double dt_s) const;
  void take_rates(estimate::State& state, const estimate::MotionInput& input) const;
  void hand_over_gyro(estimate::State& state, const estimate::TurnRate& turn) const;
  estimate::State blank() const;
  estimate::State carried_over(const estimate::State& old, const GeodeticPoint& origin) const;
  // What a state means, in report.cpp; the motion first, and then in any order:
  // each tells what no other does.
  void report(const estimate::State& state, Time now);
  void report_motion(const estimate::State& state, Time now);
  void report_unseen(const estimate::State& state);
  void report_imu(const estimate::State& state, Time now);
  void report_learned(const estimate::State& state, Time now);
  void report_kept(const estimate::State& state);  // in learned.cpp
  // in report_errors.cpp:
  void report_errors(const estimate::State& state, const estimate::Contradictions& between,
                     Time now);
  void report_yaw_error(const estimate::State& state);
  // in report_trouble.cpp:
  void report_trouble(const estimate::State& state, const estimate::Contradictions& between,
                      Time now);
  const char* missing(const estimate::State& state, Time now) const;
  bool arm_wrong(const estimate::State& state, Time now) const;
  double reach_m(const estimate::State& state, Time now) const;

  EstimateConfig config_;
  Kinematics base_;
  JointSet joints_;
  std::size_t joint_count_;  ///< the last one's number, and one
  double first_gain_;        ///< of the turn, before anything was learned
  Duration wheel_stale_;
  Duration imu_stale_;
  Duration max_delay_;
  estimate::LocalFrame frame_;
  estimate::History history_;
  std::array<estimate::ImuIntake, kMaxOfKind> imus_;
  std::size_t imu_in_use_ = 0;
  double altitude_m_ = kAbsent;  ///< of the antenna, above the ellipsoid
  Time reach_at_ = kNever;       ///< when metres_left was computed last
  Time now_ = kNever;            ///< of the last step
  EstimatorCounters counters_;
  Estimate estimate_;
};

}  // namespace drover::engine
