// A robot's measurements for the filter of the usual shape, as its users bring them there.
#pragma once

#include "bench/usual_filter.h"
#include "drover/measurement.h"
#include "drover/snapshot.h"
#include "engine/config.h"
#include "engine/estimate/local_frame.h"

namespace drover::bench {

/// The wheels of a tracked or skid-steered base become a twist each 10 ms (vx, vy and vz 0, yaw
/// rate). An inertial sensor's rates, their zeros from the rest before the first motion, and the
/// roll and pitch of a complementary filter, as its driver would tell them. Positions are moved to
/// the base by the attitude of the moment, headings are the yaw.
class UsualRobot final {
 public:
  UsualRobot(const engine::EngineConfig& config, const GeodeticPoint& origin,
             const UsualTuning& tuning, bool replays);

  void on_measurement(const Measurement& measurement);
  bool known() const { return filter_.begun(); }
  /// At an instant that is not before the last measurement.
  Pose pose(Time now) const;

 private:
  void on_wheel(const AxisMotion& motion, Time time);
  void on_imu(const ImuSample& sample, Time time);
  void on_position(const GnssPosition& position, Time time);
  void on_heading(const GnssHeading& heading, Time time);
  bool stands() const { return left_mps_ == 0 && right_mps_ == 0; }
  double sigma_of(const GnssPosition& position) const;

  engine::EstimateConfig config_;
  engine::BaseConfig base_;
  engine::estimate::LocalFrame frame_;
  UsualTuning tuning_;
  UsualFilter filter_;
  double left_mps_ = 0, right_mps_ = 0;
  // Since the last twist.
  int wheels_ = 0;
  double left_sum_mps_ = 0, right_sum_mps_ = 0;
  // The inertial sensor's own.
  bool has_moved_ = false;
  int rested_ = 0;
  Vector3 zero_radps_;
  double roll_rad_ = kAbsent, pitch_rad_ = kAbsent;
  Time sampled_ = kNever;
  // Until both are there.
  Time placed_ = kNever;
  PathPoint place_;
  double heading_rad_ = kAbsent;
};

}  // namespace drover::bench
