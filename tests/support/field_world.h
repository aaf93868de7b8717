// A field for the whole engine in closed loop: a base that slips, slides and is shoved, a receiver
// and an inertial sensor with planted errors, and a judge who knows the truth.
// Pure and seeded: equal plans and seeds give equal drives.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "drover/angle.h"
#include "engine/engine.h"
#include "engine/estimate/estimator.h"

namespace drover::test {

inline constexpr GeodeticPoint kFieldOrigin{48.1, 11.6, 500};

/// When it happens: by the way driven since the start, or by the time since the start.
struct Span {
  double from = INFINITY;
  double to = INFINITY;
  bool holds(double at) const { return at >= from && at < to; }
};

/// What is wrong, all of it nothing at first.
struct FieldPlan {
  double speed_mps = 0.5;
  // Ground.
  Span slip_s;            ///< the wheels roll more than the base moves
  double slip_share = 0;  ///< of the way
  Span slope_m;           ///< ground that falls towards `downhill_rad`
  double slope_deg = 0;
  double downhill_rad = -kPi / 2;
  double crab_per_slope = 0.5;  ///< course beside the heading over the slope
  double shove_at_s = INFINITY;
  double shove_left_m = 0;  ///< within 0.4 s
  double tyres = 1;         ///< true radius over the configured one
  double yaw_slip = 1.2;    ///< true factor
  double ground_noise = 1;
  // Receiver.
  double receiver_Hz = 10;
  double sigma_m = 0.01;
  double sigma_claimed_m = kAbsent;  ///< GST
  FixQuality quality = FixQuality::rtk_fixed;
  Span outage_s;  ///< no positions and headings
  Span float_s;   ///< float solution
  Span drift_m;   ///< the place wanders while this is driven,
  double drift_mps = 0;
  double drift_rad = kPi / 2;
  Span step_s;  ///< it is elsewhere
  double step_m = 0;
  double step_rad = kPi / 2;
  double late_s = 0;           ///< later than the gateway believes
  double heading_epoch_s = 0;  ///< the heading is so much older than the position
  double heading_off_deg = 0;  ///< of the antenna line, not told to the gateway
  Span heading_wrong_s;
  double heading_wrong_deg = 0;
  bool no_heading = false;
  double lever_x_m = 0;  ///< true antenna beside the configured one
  double lever_y_m = 0;
  // Inertial sensor.
  bool imu = true;
  double imu_roll_deg = 0;  ///< mounted so, and not told
  double gyro_bias_radps = 0.005;
  double gyro_scale = 1.002;
};

struct Judgement {
  bool success = false;
  bool ended = false;
  std::string words;  ///< how the task ended, or that it was refused
  double time_s = 0;  ///< from the start to the end
  double way_m = 0;
  double rms_m = 0;  ///< of the truth beside the track, over the way
  double p95_m = 0;
  double max_m = 0;
  double goal_m = 0;  ///< from the target, at the end
  int pauses = 0;
  double paused_s = 0;
  double outside_s = 0;  ///< moved while the true error was beyond the published bound
  double worst_outside_m = 0;
  double beyond_s = 0;          ///< moved beyond the corridor
  double inside_two_sigma = 0;  ///< share of time while moving
  double inside_three_sigma = 0;
  std::vector<std::string> said;  ///< notices, with the time
};

inline engine::EngineConfig field_config() {
  engine::EngineConfig config;
  for (const char* name : {"front_left", "front_right", "rear_left", "rear_right"}) {
    (void)config.joints.push_back(name);
  }
  for (const AxisId id : {AxisId{0}, AxisId{2}}) (void)config.base.left.push_back(id);
  for (const AxisId id : {AxisId{1}, AxisId{3}}) (void)config.base.right.push_back(id);
  config.estimate.antenna_x_m = 0.1;
  config.estimate.antenna_z_m = 0.6;
  config.base.hold = engine::HoldBy::brake;
  config.base.max_tilt_deg = 20;
  config.base.yaw_slip_factor = 1.2;
  return config;
}

/// Rows of `leg_m` with U-turns of 1.5 m between them, a point each half metre.
inline Path field_rows(int rows, double leg_m) {
  Path path;
  path.name = "rows";
  double x = 0, y = 0, yaw = 0, since = 0.5;
  const auto go = [&](double step_m, double turn_rad) {
    x += step_m * std::cos(yaw + turn_rad / 2);
    y += step_m * std::sin(yaw + turn_rad / 2);
    yaw += turn_rad;
    since += step_m;
    if (since < 0.5) return;
    path.points.push_back({x, y});
    since = 0;
  };
  path.points.push_back({0, 0});
  since = 0;
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < static_cast<int>(leg_m * 100); ++i) go(0.01, 0);
    if (row + 1 == rows) break;
    const double side = row % 2 == 0 ? 1 : -1;
    const int steps = static_cast<int>(kPi * 1.5 * 100);
    for (int i = 0; i < steps; ++i) go(kPi * 1.5 / steps, side * kPi / steps);
  }
  if (since > 0) path.points.push_back({x, y});
  return path;
}

class FieldWorld final {
 public:
  FieldWorld(const engine::EngineConfig& config, const FieldPlan& plan, std::uint64_t seed)
      : config_(config),
        plan_(plan),
        random_(seed),
        engine_(std::make_unique<engine::Engine>(config)),
        geo_(config.estimate, config.base) {
    geo_.set_origin(kFieldOrigin);
    for (double& d : drift_) d = normal();
  }

  const Snapshot& snapshot() const { return engine_->snapshot(); }
  Time now() const { return now_; }

  /// Stands for a while, starts, and drives until the task ends or `limit_s` is over.
  Judgement drive(const Path& path, double limit_s) {
    path_ = &path;
    tick();
    command(SetOrigin{kFieldOrigin});
    for (int i = 0; i < 200 * 6; ++i) tick();
    started_at_ = now_;
    moved_m_ = 0;
    command(StartTask{&path, static_cast<std::uint32_t>(path.points.size() - 1), plan_.speed_mps});
    while (!judged_.ended && to_s(now_ - started_at_) < limit_s) {
      tick();
      judge();
    }
    return conclude();
  }

 private:
  using BodyOf = decltype(Command::body);
  static constexpr double kTick_s = 0.005;

  void command(const BodyOf& body) {
    engine_->on_command({{RequestId::Source::mqtt, ++asked_}, now_, body}, now_);
  }
  double since_s() const { return started_at_ == kNever ? -1 : to_s(now_ - started_at_); }

  void tick() {
    now_ += from_s(kTick_s);
    ++ticks_;
    move();
    tell_wheels();
    if (plan_.imu && ticks_ % 2 == 0) tell_imu();
    const auto every = static_cast<std::int64_t>(std::lround(1 / (plan_.receiver_Hz * kTick_s)));
    if (ticks_ % every == 0) measure_place();
    deliver();
    environment_.guard_alive = true;
    environment_.imu_configured = plan_.imu;
    environment_.gnss[0].state =
        now_ - heard_ < std::chrono::milliseconds(500) ? SourceState::fresh : SourceState::stale;
    environment_.gnss[0].last_good = heard_;
    if (plan_.imu) {
      environment_.imu[0].state = SourceState::fresh;
      environment_.imu[0].last_good = now_;
    }
    engine_->step(now_, environment_, out_);
    for (const Event& event : out_.events) hear(event);
  }

  void hear(const Event& event) {
    if (const auto* refused = std::get_if<CommandRefused>(&event.body)) {
      end(false, "refused: " + std::string(refused->reason.view()));
    } else if (const auto* not_started = std::get_if<NavigationNotStarted>(&event.body)) {
      end(false, "not started: " + std::string(not_started->reason.view()));
    } else if (const auto* ended = std::get_if<TaskEnded>(&event.body)) {
      end(ended->how == TaskEnded::How::success, std::string(ended->reason.view()));
    } else if (const auto* notice = std::get_if<Notice>(&event.body)) {
      judged_.said.push_back(std::to_string(since_s()) + " " + std::string(notice->text.view()));
    }
  }
  void end(bool success, const std::string& words) {
    judged_.ended = true;
    judged_.success = success;
    judged_.words = words;
    judged_.time_s = since_s();
  }

  /// Drives follow at once what the last cycle asked; the base behind a lag.
  void move() {
    std::array<double, 2> rim{};
    for (std::size_t i = 0; i < 4; ++i) {
      const AxisRequest request = out_.axes[i].request;
      running_ = request == AxisRequest::run || request == AxisRequest::hold ||
                 (request == AxisRequest::rest && running_);
      rim[i % 2] += 0.5 * out_.axes[i].velocity_radps * config_.base.wheel_radius_m;
    }
    const double blend = 1 - std::exp(-kTick_s / 0.12);
    left_mps_ += blend * (rim[0] - left_mps_);
    right_mps_ += blend * (rim[1] - right_mps_);
    const double rolled_mps = 0.5 * (left_mps_ + right_mps_) * plan_.tyres;
    const bool slips = plan_.slip_s.holds(since_s());
    const double vx = rolled_mps * (slips ? 1 - plan_.slip_share : 1);
    const double way_m = std::abs(vx) * kTick_s;
    const double turn =
        (right_mps_ - left_mps_) * plan_.tyres / config_.base.track_m / plan_.yaw_slip * kTick_s;
    lie_on_slope();
    const double root = std::sqrt(way_m) * plan_.ground_noise;
    const double turned =
        turn + (0.007 * root + 0.02 * plan_.ground_noise * std::sqrt(std::abs(turn))) * normal();
    const double along = vx * std::cos(pitch_rad_) * kTick_s + 0.01 * root * normal();
    const double shoved = shove();
    const double across = 0.005 * root * normal() + shoved;
    const double slide = std::abs(vx) * plan_.crab_per_slope * std::tan(slope_rad_) * kTick_s;
    const double middle = yaw_rad_ + turned / 2;
    const double before_vx = vx_mps_;
    x_m_ +=
        along * std::cos(middle) - across * std::sin(middle) + slide * std::cos(plan_.downhill_rad);
    y_m_ +=
        along * std::sin(middle) + across * std::cos(middle) + slide * std::sin(plan_.downhill_rad);
    yaw_rad_ = wrap_rad(yaw_rad_ + turned);
    turned_rad_ += turned;
    vx_mps_ = vx;
    wz_radps_ = turned / kTick_s;
    felt_x_mps2_ = (vx - before_vx) / kTick_s;
    felt_y_mps2_ = vx * turn / kTick_s + (shoved - last_shove_m_) / (kTick_s * kTick_s);
    last_shove_m_ = shoved;
    moved_m_ += way_m;
  }
  /// Left, in this tick: half a cosine in 0.4 s.
  double shove() const {
    constexpr double kFor_s = 0.4;
    const double t = (since_s() - plan_.shove_at_s) / kFor_s;
    if (!(t >= 0 && t < 1)) return 0;
    return plan_.shove_left_m * kPi / 2 * std::sin(kPi * t) / kFor_s * kTick_s;
  }
  void lie_on_slope() {
    const double wanted = plan_.slope_m.holds(moved_m_) ? to_rad(plan_.slope_deg) : 0;
    slope_rad_ += std::clamp(wanted - slope_rad_, -0.0005, 0.0005);  // no edge is sharp
    const double up = yaw_rad_ - plan_.downhill_rad - kPi;
    pitch_rad_ = -std::atan(std::tan(slope_rad_) * std::cos(up));
    roll_rad_ = -std::asin(std::sin(slope_rad_) * std::sin(up));
  }

  void tell_wheels() {
    for (std::size_t i = 0; i < 4; ++i) {
      AxisMotion motion;
      motion.axis = static_cast<AxisId>(i);
      const double rim = i % 2 == 0 ? left_mps_ : right_mps_;
      motion.velocity_radps =
          rim / config_.base.wheel_radius_m * (rim == 0 ? 1 : 1 + 0.002 * normal());
      position_rad_[i] += motion.velocity_radps * kTick_s;
      motion.position_rad = position_rad_[i];
      environment_.axes[i].state = SourceState::fresh;
      measure(now_, motion);
      measure(now_,
              AxisStatus{static_cast<AxisId>(i), running_ ? AxisState::running : AxisState::idle, 0,
                         Reason(), false});
    }
  }

  void tell_imu() {
    const double rate = turned_rad_ / (2 * kTick_s);
    turned_rad_ = 0;
    const double roll = roll_rad_ + to_rad(plan_.imu_roll_deg);
    ImuSample sample;
    sample.angular_velocity_radps = {
        0.003 * normal(), 0.003 * normal(),
        plan_.gyro_bias_radps + plan_.gyro_scale * rate + 0.003 * normal()};
    const double g = 9.81;
    sample.acceleration_mps2 = {
        -g * std::sin(pitch_rad_) + felt_x_mps2_ + 0.05 * normal(),
        g * std::cos(pitch_rad_) * std::sin(roll) + felt_y_mps2_ + 0.05 * normal(),
        g * std::cos(pitch_rad_) * std::cos(roll) + 0.05 * normal()};
    measure(now_, sample);
  }

  void measure_place() {
    const double dt_s = 1 / plan_.receiver_Hz;
    const double keep = std::exp(-dt_s / 30.0);
    for (double& d : drift_) d = keep * d + std::sqrt(1 - keep * keep) * normal();
    const bool floats = plan_.float_s.holds(since_s());
    const double sigma = floats ? 0.3 : plan_.sigma_m;
    if (plan_.drift_m.holds(moved_m_)) wandered_m_ += plan_.drift_mps * dt_s;
    const double step = plan_.step_s.holds(since_s()) ? plan_.step_m : 0;
    const auto& e = config_.estimate;
    const engine::AntennaConfig arm{e.antenna_x_m + plan_.lever_x_m,
                                    e.antenna_y_m + plan_.lever_y_m, e.antenna_z_m, 0};
    const double over = arm.y_m * std::sin(roll_rad_) + arm.z_m * std::cos(roll_rad_);
    const double ahead = arm.x_m * std::cos(pitch_rad_) + over * std::sin(pitch_rad_);
    const double left = arm.y_m * std::cos(roll_rad_) - arm.z_m * std::sin(roll_rad_);
    const double c = std::cos(yaw_rad_);
    const double s = std::sin(yaw_rad_);
    std::array<double, 2> at{x_m_ + ahead * c - left * s, y_m_ + ahead * s + left * c};
    at[0] += wandered_m_ * std::cos(plan_.drift_rad) + step * std::cos(plan_.step_rad);
    at[1] += wandered_m_ * std::sin(plan_.drift_rad) + step * std::sin(plan_.step_rad);
    for (std::size_t i = 0; i < 2; ++i) {
      at[i] += sigma * (std::sqrt(0.9) * drift_[i] + std::sqrt(0.1) * normal());
    }
    const GeodeticPoint place = place_of(at[0], at[1]);
    Fix fix;
    fix.stamp = now_ + from_s(plan_.late_s);
    fix.received = now_ + from_s(0.08 + plan_.late_s);
    fix.position.latitude_deg = place.latitude_deg;
    fix.position.longitude_deg = place.longitude_deg;
    fix.position.altitude_msl_m = 455;
    fix.position.undulation_m = 45;
    fix.position.quality = floats ? FixQuality::rtk_float : plan_.quality;
    fix.position.satellites = 20;
    fix.position.hdop = 0.7;
    fix.position.correction_age_s = 1;
    fix.position.sigma_east_m = fix.position.sigma_north_m = plan_.sigma_claimed_m;
    headings_.push_back(yaw_rad_);
    const auto old =
        static_cast<std::size_t>(std::clamp(std::lround(plan_.heading_epoch_s * plan_.receiver_Hz),
                                            0L, static_cast<long>(headings_.size()) - 1));
    const double yaw = headings_[headings_.size() - 1 - old];
    if (headings_.size() > 16) headings_.pop_front();
    const double off_deg = plan_.heading_off_deg +
                           (plan_.heading_wrong_s.holds(since_s()) ? plan_.heading_wrong_deg : 0);
    fix.heading.heading_deg =
        wrap_deg(compass_deg_from_yaw_rad(yaw + to_rad(0.3) * normal()) + off_deg);
    if (!plan_.outage_s.holds(since_s())) fixes_.push_back(fix);
  }
  /// Where a point of the map is on the earth: the antenna of a pose without a lever arm.
  GeodeticPoint place_of(double x_m, double y_m) const {
    Pose pose;
    const auto& e = config_.estimate;
    const double lean_m = e.antenna_x_m;  // the estimator's own arm at yaw 0 is taken off again
    pose.x_m = x_m - lean_m;
    pose.y_m = y_m - e.antenna_y_m;
    return geo_.antenna_geodetic(pose);
  }
  void deliver() {
    while (!fixes_.empty() && fixes_.front().received <= now_) {
      const Fix& fix = fixes_.front();
      measure(fix.stamp, fix.position);
      if (!plan_.no_heading) measure(fix.stamp, fix.heading);
      heard_ = now_;
      fixes_.pop_front();
    }
  }
  template <class Value>
  void measure(Time time, const Value& value) {
    Measurement m;
    m.time = time;
    m.received = now_;
    m.value = value;
    engine_->on_measurement(m);
  }

  void judge() {
    const Snapshot& s = engine_->snapshot();
    if (s.nav.paused && !was_paused_) ++judged_.pauses;
    was_paused_ = s.nav.paused;
    if (s.nav.paused) judged_.paused_s += kTick_s;
    const bool moves = std::abs(vx_mps_) > 0.02;
    if (!moves) return;
    const double error_m = std::hypot(s.pose.x_m - x_m_, s.pose.y_m - y_m_);
    moving_s_ += kTick_s;
    if (error_m <= 2 * s.pose.position_sigma_m) judged_.inside_two_sigma += kTick_s;
    if (error_m <= 3 * s.pose.position_sigma_m) judged_.inside_three_sigma += kTick_s;
    if (!(error_m <= s.nav.error_bound_m)) {
      judged_.outside_s += kTick_s;
      judged_.worst_outside_m = std::max(judged_.worst_outside_m, error_m);
    }
    if (ticks_ % 4 != 0) return;
    const double off_m = beside_m();
    if (off_m > config_.navigate.corridor_m) judged_.beyond_s += 4 * kTick_s;
    const double weight_m = std::abs(vx_mps_) * 4 * kTick_s;
    off_.push_back({off_m, weight_m});
  }
  double beside_m() const {
    double best_m = INFINITY;
    for (std::size_t i = 0; i + 1 < path_->points.size(); ++i) {
      const PathPoint& a = path_->points[i];
      const double bx = path_->points[i + 1].x_m - a.x_m;
      const double by = path_->points[i + 1].y_m - a.y_m;
      const double px = x_m_ - a.x_m;
      const double py = y_m_ - a.y_m;
      if (px * px + py * py > best_m * best_m + 4 * best_m + 4) continue;
      const double t = std::clamp((px * bx + py * by) / (bx * bx + by * by), 0.0, 1.0);
      best_m = std::min(best_m, std::hypot(px - t * bx, py - t * by));
    }
    return best_m;
  }
  Judgement conclude() {
    if (!judged_.ended) {
      judged_.words = "did not end";
      if (!snapshot().why.empty()) judged_.words += ": " + std::string(snapshot().why[0].view());
      judged_.time_s = since_s();
    }
    judged_.way_m = moved_m_;
    const PathPoint& goal = path_->points.back();
    judged_.goal_m = std::hypot(x_m_ - goal.x_m, y_m_ - goal.y_m);
    if (moving_s_ > 0) {
      judged_.inside_two_sigma /= moving_s_;
      judged_.inside_three_sigma /= moving_s_;
    }
    std::sort(off_.begin(), off_.end());
    double whole_m = 0, square = 0;
    for (const auto& [off_m, weight_m] : off_) {
      whole_m += weight_m;
      square += weight_m * off_m * off_m;
    }
    if (whole_m > 0) judged_.rms_m = std::sqrt(square / whole_m);
    double passed_m = 0;
    for (const auto& [off_m, weight_m] : off_) {
      passed_m += weight_m;
      judged_.max_m = off_m;
      if (passed_m <= 0.95 * whole_m) judged_.p95_m = off_m;
    }
    return judged_;
  }

  /// Box-Muller, so that every standard library gives the same numbers.
  double normal() {
    const double u = (static_cast<double>(random_() >> 11) + 0.5) / 9007199254740992.0;
    const double v = static_cast<double>(random_() >> 11) / 9007199254740992.0;
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * kPi * v);
  }

  struct Fix {
    Time stamp = kNever;
    Time received = kNever;
    GnssPosition position;
    GnssHeading heading;
  };

  engine::EngineConfig config_;
  FieldPlan plan_;
  std::mt19937_64 random_;
  std::unique_ptr<engine::Engine> engine_;
  engine::Estimator geo_;  ///< only its geodesy
  engine::Environment environment_;
  engine::EngineOutput out_;
  Time now_{std::chrono::seconds(10)};
  Time started_at_ = kNever;
  Time heard_ = kNever;
  std::int64_t ticks_ = 0;
  std::uint64_t asked_ = 0;
  const Path* path_ = nullptr;
  // The truth.
  double x_m_ = 0, y_m_ = 0, yaw_rad_ = 0, vx_mps_ = 0, wz_radps_ = 0;
  double left_mps_ = 0, right_mps_ = 0;
  double slope_rad_ = 0, pitch_rad_ = 0, roll_rad_ = 0;
  double felt_x_mps2_ = 0, felt_y_mps2_ = 0, last_shove_m_ = 0;
  double turned_rad_ = 0;
  double moved_m_ = 0;
  bool running_ = false;
  std::array<double, 4> position_rad_{};
  std::array<double, 2> drift_{};
  double wandered_m_ = 0;
  std::deque<Fix> fixes_;
  std::deque<double> headings_;
  // The judge.
  Judgement judged_;
  bool was_paused_ = false;
  double moving_s_ = 0;
  std::vector<std::pair<double, double>> off_;
};

}  // namespace drover::test
