// A small seeded world for the estimator: a skid-steer base, its wheels, a receiver with late,
// slowly wandering positions, and an inertial sensor.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <random>

#include "drover/angle.h"
#include "engine/estimate/estimator.h"

namespace drover::engine::estimate {

inline constexpr GeodeticPoint kField{
    .latitude_deg = 48.1372, .longitude_deg = 11.5756, .altitude_m = 560.0};

struct World {
  double slip = 1.0;   ///< true yaw slip factor
  double scale = 1.0;  ///< true way over rim way
  double latency_s = 0.08;
  double stamp_error_s = 0.0;  ///< stamp minus truth: 0.08 is a receiver taken as immediate
  bool heading = true;
  bool wheels = true;
  bool position = true;
  bool gst = false;
  FixQuality quality = FixQuality::rtk_fixed;
  std::uint8_t receiver = 0;  ///< whose positions they are
  double noise = 1.0;         ///< 0: a perfect receiver
  double disturbance = 1.0;   ///< 0: a perfect ground
  double fade_s = 0.0;        ///< how slowly the noise follows a better quality
  double correlation_s = 30.0;
  double drift_share = 0.9;  ///< of the variance; the rest is white
  double jump_x_m = 0.0;
  double heading_off_deg = 0.0;
  double drift_mps = 0.0;  ///< of the position, north: a wrong base
  double grip = 1.0;       ///< share of the rolled way that the base makes
  double turn_grip = 1.0;  ///< share of the turn
  double pitch_rad = 0.0;  ///< of the ground under the base
  double roll_rad = 0.0;
  /// Of even ground that rises to the east: pitch and roll follow from the heading then.
  double slope_rad = 0.0;
  // The inertial sensor, 100 a second. Off unless a test turns it on.
  bool imu = false;
  bool imu_frozen = false;
  double gyro_bias_radps = 0.01;
  double gyro_scale = 1.0;  ///< measured over true; -1: mounted upside down and not told
  double gyro_noise_radps = 0.003;
  double gyro_walk_radps = 0.00003;  ///< of the bias, per square root of second
};

inline EngineConfig rig_config() {
  EngineConfig config;
  for (const AxisId axis : {AxisId{0}, AxisId{1}}) (void)config.base.left.push_back(axis);
  for (const AxisId axis : {AxisId{2}, AxisId{3}}) (void)config.base.right.push_back(axis);
  config.estimate.antenna_sigma_m = 0;  // what it may be wrong by has tests of its own
  return config;
}

class Rig {
 public:
  static constexpr double kTick_s = 0.005;

  explicit Rig(std::uint64_t seed = 1, const EngineConfig& config = rig_config())
      : config_(config), estimator(config.estimate, config.base), random_(seed) {
    imu_random_.seed(seed + 4711);
    frame_.set_origin(kField);
    estimator.set_origin(kField);
    for (double& d : drift_) d = normal();
  }

  World world;
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0.3;
  double way_m = 0;  ///< driven, either direction
  Time now{std::chrono::seconds(100)};
  Estimate last;

 private:
  EngineConfig config_;

 public:
  Estimator estimator;

  /// Drives for `seconds` with these rim speeds.
  void drive(double left_mps, double right_mps, double seconds) {
    const auto ticks = std::llround(seconds / kTick_s);
    for (std::int64_t i = 0; i < ticks; ++i) tick(left_mps, right_mps);
  }
  void stand(double seconds) { drive(0, 0, seconds); }
  /// Rim speeds for a circle.
  void circle(double speed_mps, double radius_m, double seconds) {
    const double half_mps = speed_mps / radius_m * config_.base.track_m * world.slip / 2;
    drive(speed_mps - half_mps, speed_mps + half_mps, seconds);
  }

  void tick(double left_mps, double right_mps) {
    move(left_mps, right_mps);
    now += from_s(kTick_s);
    ++ticks_;
    if (world.wheels && ticks_ % 2 == 0) send_wheels(left_mps, right_mps);
    if (world.imu && ticks_ % 2 == 0) send_imu();
    if (ticks_ % 20 == 0) measure();
    while (!queue_.empty() && queue_.front().received <= now) {
      estimator.on_measurement(queue_.front());
      queue_.pop_front();
    }
    last = estimator.step(now);
    note();
  }

  /// Somebody turns the base; the gyro sees it.
  void carry(double turn_rad) { turned_rad_ += turn_rad; }

  double position_error_m() const { return std::hypot(last.pose.x_m - x_m, last.pose.y_m - y_m); }
  double yaw_error_rad() const { return std::abs(wrap_rad(last.pose.yaw_rad - yaw_rad)); }

  /// Since forget().
  double rms_m() const { return std::sqrt(sum2_ / n_); }
  double rms_yaw_rad() const { return std::sqrt(sum2_yaw_ / n_); }
  double max_m() const { return max_; }
  double share_inside() const { return inside_ / n_; }
  /// Inside what is said never to be exceeded.
  double share_bound() const { return bound_inside_ / n_; }
  double share_yaw_inside() const { return yaw_inside_ / n_; }
  void forget() { n_ = sum2_ = sum2_yaw_ = max_ = inside_ = yaw_inside_ = bound_inside_ = 0; }

  double normal() { return normal_(random_); }
  Measurement position_at(double x, double y, FixQuality quality, Time time) const {
    GnssPosition p;
    const GeodeticPoint g = frame_.geodetic({.x_m = x, .y_m = y}, kField.altitude_m);
    p.latitude_deg = g.latitude_deg;
    p.longitude_deg = g.longitude_deg;
    p.altitude_msl_m = kField.altitude_m - 45;
    p.undulation_m = 45;
    p.quality = quality;
    p.correction_age_s = 1.0;
    return {.time = time, .received = time, .value = p};
  }
  static Measurement heading_at(double yaw, Time time) {
    return {.time = time,
            .received = time,
            .value = GnssHeading{.heading_deg = compass_deg_from_yaw_rad(yaw)}};
  }
  Measurement wheel_at(AxisId axis, double rim_mps, Time time) const {
    AxisMotion motion;
    motion.axis = axis;
    motion.velocity_radps = rim_mps / config_.base.wheel_radius_m;
    return {.time = time, .received = time, .value = motion};
  }

 private:
  void lie_on_slope() {
    if (world.slope_rad == 0) return;
    world.pitch_rad = -std::atan(std::tan(world.slope_rad) * std::cos(yaw_rad));
    world.roll_rad = -std::asin(std::sin(world.slope_rad) * std::sin(yaw_rad));
  }
  /// Turn about the vertical for a turn about the base's z, on even ground.
  double upright() const {
    if (world.slope_rad == 0) return 1.0;
    return std::cos(world.roll_rad) / std::cos(world.pitch_rad);
  }
  void move(double left_mps, double right_mps) {
    lie_on_slope();
    const double level = world.grip * std::cos(world.pitch_rad);
    const double way = level * world.scale * (left_mps + right_mps) / 2 * kTick_s;
    const double turn = world.turn_grip * (right_mps - left_mps) / config_.base.track_m /
                        world.slip * upright() * kTick_s;
    const double d = world.disturbance;
    const double root_way = std::sqrt(std::abs(way));
    const double along = way + d * 0.01 * root_way * normal();
    const double across = d * 0.005 * root_way * normal();
    const double scrub = 0.007 * root_way + 0.02 * std::sqrt(std::abs(turn));
    const double turned = turn + d * scrub * normal();
    const double middle = yaw_rad + turned / 2;
    x_m += along * std::cos(middle) - across * std::sin(middle);
    y_m += along * std::sin(middle) + across * std::cos(middle);
    yaw_rad = wrap_rad(yaw_rad + turned);
    turned_rad_ += turned;
    way_m += std::abs(along);
  }
  void send_imu() {
    const double rate_radps = turned_rad_ / (2 * kTick_s);
    turned_rad_ = 0;
    gyro_walked_radps_ += world.gyro_walk_radps * std::sqrt(2 * kTick_s) * imu_normal();
    const double noise = world.gyro_noise_radps;
    if (!world.imu_frozen) {
      const double bias = world.gyro_bias_radps + gyro_walked_radps_;
      const double sp = std::sin(world.pitch_rad);
      const double cp = std::cos(world.pitch_rad);
      const double sr = std::sin(world.roll_rad);
      const double cr = std::cos(world.roll_rad);
      // Even ground turns the base about its own z, ground like a cone about the vertical.
      const bool even = world.slope_rad != 0;
      const Vector3 axis = even ? Vector3{0, 0, 1 / upright()} : Vector3{-sp, sr * cp, cr * cp};
      imu_.angular_velocity_radps = {
          .x = -0.004 + axis.x * rate_radps + noise * imu_normal(),
          .y = 0.006 + axis.y * rate_radps + noise * imu_normal(),
          .z = bias + world.gyro_scale * axis.z * rate_radps + noise * imu_normal()};
      imu_.acceleration_mps2 = {.x = -9.81 * sp + 0.05 * imu_normal(),
                                .y = 9.81 * cp * sr + 0.05 * imu_normal(),
                                .z = 9.81 * cp * cr + 0.05 * imu_normal()};
    }
    estimator.on_measurement({.time = now, .received = now, .value = imu_});
  }
  double imu_normal() { return imu_normal_(imu_random_); }
  void send_wheels(double left_mps, double right_mps) {
    for (AxisId axis = 0; axis < 4; ++axis) {
      const double rim = axis < 2 ? left_mps : right_mps;
      estimator.on_measurement(wheel_at(axis, rim + (rim == 0 ? 0 : 0.002 * normal()), now));
    }
  }
  static double sigma(FixQuality quality) {
    return quality == FixQuality::rtk_fixed   ? 0.01
           : quality == FixQuality::rtk_float ? 0.30
           : quality == FixQuality::dgps      ? 0.60
                                              : 2.0;
  }
  void measure() {
    const double keep = std::exp(-0.1 / world.correlation_s);
    for (double& d : drift_) d = keep * d + std::sqrt(1 - keep * keep) * normal();
    const double wanted = sigma(world.quality);
    const bool better = wanted < sigma_now_ && world.fade_s > 0;
    sigma_now_ = better ? wanted + (sigma_now_ - wanted) * std::exp(-0.1 / world.fade_s) : wanted;
    const auto& e = config_.estimate;
    const double c = std::cos(yaw_rad);
    const double s = std::sin(yaw_rad);
    const double over =
        e.antenna_y_m * std::sin(world.roll_rad) + e.antenna_z_m * std::cos(world.roll_rad);
    const double ahead =
        e.antenna_x_m * std::cos(world.pitch_rad) + over * std::sin(world.pitch_rad);
    const double aside =
        e.antenna_y_m * std::cos(world.roll_rad) - e.antenna_z_m * std::sin(world.roll_rad);
    drifted_m_ = world.drift_mps == 0 ? 0 : drifted_m_ + world.drift_mps * 20 * kTick_s;
    std::array<double, 2> at{x_m + ahead * c - aside * s, y_m + ahead * s + aside * c + drifted_m_};
    for (std::size_t i = 0; i < 2; ++i) {
      at[i] +=
          world.noise * sigma_now_ *
          (std::sqrt(world.drift_share) * drift_[i] + std::sqrt(1 - world.drift_share) * normal());
    }
    at[0] += world.jump_x_m;
    const Time stamp = now + from_s(world.stamp_error_s);
    const Time received = now + from_s(world.latency_s);
    if (world.position) {
      Measurement m = position_at(at[0], at[1], world.quality, stamp);
      m.received = received;
      m.source = world.receiver;
      if (world.gst) {
        auto& p = std::get<GnssPosition>(m.value);
        p.sigma_east_m = p.sigma_north_m = sigma_now_;
      }
      queue_.push_back(m);
    }
    if (world.heading) {
      const double noise_rad = world.noise * to_rad(0.3) * normal();
      Measurement m = heading_at(yaw_rad + noise_rad - to_rad(world.heading_off_deg), stamp);
      m.received = received;
      queue_.push_back(m);
    }
  }
  void note() {
    const double error = position_error_m();
    n_ += 1;
    sum2_ += error * error;
    sum2_yaw_ += yaw_error_rad() * yaw_error_rad();
    max_ = std::max(max_, error);
    inside_ += error <= last.predicted_error_m ? 1 : 0;
    bound_inside_ += error <= last.error_bound_m ? 1 : 0;
    yaw_inside_ += yaw_error_rad() <= last.yaw_error_rad ? 1 : 0;
  }

  LocalFrame frame_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::array<double, 2> drift_{};
  std::deque<Measurement> queue_;
  std::mt19937_64 imu_random_{4711};  ///< its own, so that it does not disturb the world
  std::normal_distribution<double> imu_normal_;
  ImuSample imu_;
  double turned_rad_ = 0;
  double gyro_walked_radps_ = 0;
  double drifted_m_ = 0;
  double sigma_now_ = 0;
  std::int64_t ticks_ = 0;
  double n_ = 0, sum2_ = 0, sum2_yaw_ = 0, max_ = 0, inside_ = 0, yaw_inside_ = 0;
  double bound_inside_ = 0;
};

}  // namespace drover::engine::estimate
