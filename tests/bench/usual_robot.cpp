#include "bench/usual_robot.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::bench {
namespace {

// One sigma of what is measured directly.
constexpr double kWheelAlong_mps = 0.02;
constexpr double kNotAside_mps = 0.02;
constexpr double kLean_rad = 0.01;
constexpr double kHeight_m = 0.05;

constexpr double kLeanFilter_s = 2;

}  // namespace

UsualRobot::UsualRobot(const engine::EngineConfig& config, const GeodeticPoint& origin,
                       const UsualTuning& tuning, bool replays)
    : config_(config.estimate), base_(config.base), tuning_(tuning), filter_(tuning, replays) {
  frame_.set_origin(origin);
}

void UsualRobot::on_measurement(const Measurement& measurement) {
  if (const auto* motion = std::get_if<AxisMotion>(&measurement.value)) {
    on_wheel(*motion, measurement.time);
  } else if (const auto* imu = std::get_if<ImuSample>(&measurement.value)) {
    on_imu(*imu, measurement.time);
  } else if (const auto* position = std::get_if<GnssPosition>(&measurement.value)) {
    on_position(*position, std::min(measurement.time, measurement.received));
  } else if (const auto* heading = std::get_if<GnssHeading>(&measurement.value)) {
    on_heading(*heading, std::min(measurement.time, measurement.received));
  }
}

Pose UsualRobot::pose(Time now) const {
  const UsualBelief& belief = filter_.belief();
  const UsualVector mean = predicted(belief.mean, to_s(now - belief.time), nullptr);
  const auto& p = belief.covariance.at;
  const double half = (p[kPlaceX][kPlaceX] + p[kPlaceY][kPlaceY]) / 2;
  const double apart = (p[kPlaceX][kPlaceX] - p[kPlaceY][kPlaceY]) / 2;
  Pose pose;
  pose.x_m = mean[kPlaceX];
  pose.y_m = mean[kPlaceY];
  pose.yaw_rad = mean[kHeading];
  pose.vx_mps = mean[kSpeedX];
  pose.position_sigma_m = std::sqrt(half + std::hypot(apart, p[kPlaceX][kPlaceY]));
  pose.yaw_sigma_rad = std::sqrt(p[kHeading][kHeading]);
  return pose;
}

void UsualRobot::on_wheel(const AxisMotion& motion, Time time) {
  const double rim_mps = motion.velocity_radps * base_.wheel_radius_m;
  const bool left =
      std::find(base_.left.begin(), base_.left.end(), motion.axis) != base_.left.end();
  (left ? left_mps_ : right_mps_) = rim_mps;
  (left ? left_sum_mps_ : right_sum_mps_) += rim_mps;
  const int all = static_cast<int>(base_.left.size() + base_.right.size());
  constexpr int kTicks = 2;
  if (++wheels_ < kTicks * all) return;
  const double left_mps = left_sum_mps_ / (kTicks * static_cast<double>(base_.left.size()));
  const double right_mps = right_sum_mps_ / (kTicks * static_cast<double>(base_.right.size()));
  wheels_ = 0;
  left_sum_mps_ = right_sum_mps_ = 0;
  has_moved_ = has_moved_ || !stands();
  if (!known()) return;
  UsualSeen seen;
  seen.time = time;
  seen.add(kSpeedX, (left_mps + right_mps) / 2, kWheelAlong_mps);
  seen.add(kSpeedY, 0, kNotAside_mps);
  seen.add(kSpeedZ, 0, kNotAside_mps);
  seen.add(kYawRate, (right_mps - left_mps) / base_.track_m / base_.yaw_slip_factor,
           tuning_.wheel_yaw_radps);
  filter_.see(seen);
}

void UsualRobot::on_imu(const ImuSample& sample, Time time) {
  const Vector3& rate = sample.angular_velocity_radps;
  const Vector3& force = sample.acceleration_mps2;
  if (stands() && !has_moved_) {
    const double share = 1.0 / ++rested_;
    zero_radps_.x += share * (rate.x - zero_radps_.x);
    zero_radps_.y += share * (rate.y - zero_radps_.y);
    zero_radps_.z += share * (rate.z - zero_radps_.z);
  }
  const Vector3 turn{rate.x - zero_radps_.x, rate.y - zero_radps_.y, rate.z - zero_radps_.z};
  const double roll_rad = std::atan2(force.y, force.z);
  const double pitch_rad = std::atan2(-force.x, std::hypot(force.y, force.z));
  if (sampled_ == kNever) {
    roll_rad_ = roll_rad;
    pitch_rad_ = pitch_rad;
  } else {
    const double dt_s = to_s(time - sampled_);
    const double fresh = dt_s / (kLeanFilter_s + dt_s);
    roll_rad_ += turn.x * dt_s;
    pitch_rad_ += turn.y * dt_s;
    roll_rad_ += fresh * (roll_rad - roll_rad_);
    pitch_rad_ += fresh * (pitch_rad - pitch_rad_);
  }
  sampled_ = time;
  if (!known()) return;
  UsualSeen seen;
  seen.time = time;
  seen.add(kRoll, roll_rad_, kLean_rad);
  seen.add(kPitch, pitch_rad_, kLean_rad);
  seen.add(kRollRate, turn.x, config_.imu_rate_sigma_radps);
  seen.add(kPitchRate, turn.y, config_.imu_rate_sigma_radps);
  seen.add(kYawRate, turn.z, config_.imu_rate_sigma_radps);
  filter_.see(seen);
}

void UsualRobot::on_position(const GnssPosition& position, Time time) {
  GeodeticPoint point;
  point.latitude_deg = position.latitude_deg;
  point.longitude_deg = position.longitude_deg;
  point.altitude_m = position.altitude_msl_m + position.undulation_m;
  const PathPoint at = frame_.local(point);
  placed_ = time;
  place_ = at;
  if (!known()) return;
  UsualSeen seen;
  seen.time = time;
  seen.add(kPlaceX, at.x_m, sigma_of(position));
  seen.add(kPlaceY, at.y_m, sigma_of(position));
  seen.add(kPlaceZ, point.altitude_m - frame_.origin().altitude_m + config_.antenna_z_m, kHeight_m);
  seen.lever_m = {config_.antenna_x_m, config_.antenna_y_m, config_.antenna_z_m};
  filter_.see(seen);
}

void UsualRobot::on_heading(const GnssHeading& heading, Time time) {
  heading_rad_ = wrap_rad(yaw_rad_from_compass_deg(heading.heading_deg) +
                          to_rad(config_.heading_baseline_offset_deg));
  if (known()) {
    UsualSeen seen;
    seen.time = time;
    seen.add(kHeading, heading_rad_, to_rad(config_.heading_sigma_deg));
    filter_.see(seen);
  } else if (placed_ == time) {
    UsualBelief first;
    first.time = time;
    const double c = std::cos(heading_rad_);
    const double s = std::sin(heading_rad_);
    first.mean[kPlaceX] = place_.x_m - c * config_.antenna_x_m + s * config_.antenna_y_m;
    first.mean[kPlaceY] = place_.y_m - s * config_.antenna_x_m - c * config_.antenna_y_m;
    first.mean[kHeading] = heading_rad_;
    first.covariance = UsualMatrix::one();
    for (std::size_t i = 0; i < kUsualStates; ++i) first.covariance.at[i][i] = 0.01;
    filter_.begin(first);
  }
}

double UsualRobot::sigma_of(const GnssPosition& position) const {
  double least_m = config_.sigma_single_m;
  if (position.quality == FixQuality::rtk_fixed) least_m = config_.sigma_fixed_m;
  if (position.quality == FixQuality::rtk_float) least_m = config_.sigma_float_m;
  const double told_m = std::max(position.sigma_east_m, position.sigma_north_m);
  return tuning_.gnss_scale * (told_m > least_m ? told_m : least_m);
}

}  // namespace drover::bench
