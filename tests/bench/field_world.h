// A field for the whole engine in closed loop: a base that slips, slides and is shoved, a receiver
// and an inertial sensor with planted errors.
// Pure and seeded: equal plans and seeds give equal drives.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <utility>

#include "bench/field_judge.h"
#include "bench/field_plan.h"
#include "drover/angle.h"
#include "engine/engine.h"
#include "engine/estimate/estimator.h"

namespace drover::bench {

inline constexpr GeodeticPoint kFieldOrigin{48.1, 11.6, 500};

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

  /// Each tick: what is published, the truth, s since the start (below 0 before it).
  using Watch = std::function<void(const Snapshot&, const Pose&, double)>;

  /// Each measurement, before the engine hears it.
  void listen(std::function<void(const Measurement&)> heard) { listen_ = std::move(heard); }

  /// Stands for a while, starts, and drives until the task ends or `limit_s` is over.
  Judgement drive(const Path& path, double limit_s, const Watch& watch = {}) {
    judge_.emplace(path, config_.navigate.corridor_m);
    watch_ = watch;
    tick();
    command(SetOrigin{kFieldOrigin});
    for (int i = 0; i < 200 * 6; ++i) tick();
    started_at_ = now_;
    moved_m_ = 0;
    command(StartTask{&path, static_cast<std::uint32_t>(path.points.size() - 1), plan_.speed_mps});
    while (!judge_->ended() && since_s() < limit_s) {
      tick();
      judge_->look(engine_->snapshot(), truth(), kTick_s);
    }
    return judge_->conclude(engine_->snapshot(), truth(), since_s());
  }

  /// Somebody holds a key, for so long at most: what he asks for after a tick, if anything. Each
  /// answer goes to `answered`.
  struct Hand {
    std::function<std::optional<Twist>(const Snapshot&, Time)> ask;
    std::function<void(bool, std::string_view)> answered;
    std::function<bool()> done;
  };
  void drive_by_hand(double limit_s, const Hand& hand) {
    tick();
    command(SetOrigin{kFieldOrigin});
    started_at_ = now_;
    while (!hand.done() && since_s() < limit_s) {
      if (const auto twist = hand.ask(engine_->snapshot(), now_)) {
        command(DriveByHand{1, *twist});
        const std::uint64_t asked = asked_;
        tick();
        for (const Event& event : out_.events) {
          const auto* yes = std::get_if<CommandAccepted>(&event.body);
          const auto* no = std::get_if<CommandRefused>(&event.body);
          if (yes != nullptr && yes->id.number == asked) hand.answered(true, yes->note);
          if (no != nullptr && no->id.number == asked) hand.answered(false, no->reason);
        }
      } else {
        tick();
      }
    }
  }
  Pose true_pose() const { return truth(); }

 private:
  using BodyOf = decltype(Command::body);
  static constexpr double kTick_s = 0.005;
  static constexpr double kYawSlip = 1.2;  // true factor
  static constexpr double kDownhill_rad = -kPi / 2;
  static constexpr double kGyroBias_radps = 0.005;
  static constexpr double kGyroScale = 1.002;

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
    if (judge_)
      for (const Event& event : out_.events) judge_->hear(event, since_s());
    if (watch_) watch_(engine_->snapshot(), truth(), since_s());
  }

  Pose truth() const {
    Pose pose;
    pose.x_m = x_m_;
    pose.y_m = y_m_;
    pose.yaw_rad = yaw_rad_;
    pose.vx_mps = vx_mps_;
    return pose;
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
    const double vx = rolled_mps * (1 - plan_.slip_at(since_s()));
    const double way_m = std::abs(vx) * kTick_s;
    const double turn =
        (right_mps_ - left_mps_) * plan_.tyres / config_.base.track_m / kYawSlip * kTick_s;
    lie_on_slope();
    const double root = std::sqrt(way_m);
    const double turned = turn + (0.007 * root + 0.02 * std::sqrt(std::abs(turn))) * normal();
    const double along = vx * std::cos(pitch_rad_) * kTick_s + 0.01 * root * normal();
    const double shoved = shove();
    const double across = 0.005 * root * normal() + shoved;
    const double slide = std::abs(vx) * plan_.crab_per_slope * std::tan(slope_rad_) * kTick_s;
    const double middle = yaw_rad_ + turned / 2;
    const double before_vx = vx_mps_;
    x_m_ += along * std::cos(middle) - across * std::sin(middle) + slide * std::cos(kDownhill_rad);
    y_m_ += along * std::sin(middle) + across * std::cos(middle) + slide * std::sin(kDownhill_rad);
    yaw_rad_ = wrap_rad(yaw_rad_ + turned);
    turned_rad_ += turned;
    vx_mps_ = vx;
    felt_x_mps2_ = (vx - before_vx) / kTick_s;
    felt_y_mps2_ = vx * turn / kTick_s + (shoved - last_shove_m_) / (kTick_s * kTick_s);
    last_shove_m_ = shoved;
    moved_m_ += way_m;
  }
  /// Left, in this tick.
  double shove() const {
    double left_m = shove(plan_.shove_at_s, plan_.shove_left_m);
    for (const Trouble& t : plan_.more)
      if (t.kind == Trouble::Kind::shove) left_m += shove(t.span.from, t.size);
    return left_m;
  }
  /// Half a cosine in 0.4 s.
  double shove(double at_s, double left_m) const {
    constexpr double kFor_s = 0.4;
    const double t = (since_s() - at_s) / kFor_s;
    if (!(t >= 0 && t < 1)) return 0;
    return left_m * kPi / 2 * std::sin(kPi * t) / kFor_s * kTick_s;
  }
  void lie_on_slope() {
    const double wanted = to_rad(plan_.slope_deg_at(moved_m_));
    slope_rad_ += std::clamp(wanted - slope_rad_, -0.0005, 0.0005);  // no edge is sharp
    const double up = yaw_rad_ - kDownhill_rad - kPi;
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
              AxisStatus{static_cast<AxisId>(i), running_ ? AxisState::running : AxisState::idle});
    }
  }

  void tell_imu() {
    const double rate = turned_rad_ / (2 * kTick_s);
    turned_rad_ = 0;
    const double roll = roll_rad_ + to_rad(plan_.imu_roll_deg);
    ImuSample sample;
    sample.angular_velocity_radps = {0.003 * normal(), 0.003 * normal(),
                                     kGyroBias_radps + kGyroScale * rate + 0.003 * normal()};
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
    const bool floats = plan_.floats(since_s());
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
    at[0] += step * std::cos(plan_.step_rad);
    at[1] += wandered_m_ + step * std::sin(plan_.step_rad);
    for (const Trouble& t : plan_.more) {
      if (!t.holds(Trouble::Kind::step, since_s())) continue;
      at[0] += t.size * std::cos(t.towards_rad);
      at[1] += t.size * std::sin(t.towards_rad);
    }
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
    fix.position.quality = floats ? FixQuality::rtk_float : FixQuality::rtk_fixed;
    fix.position.satellites = 20;
    fix.position.hdop = 0.7;
    fix.position.correction_age_s = 1;
    if (plan_.gst) fix.position.sigma_east_m = fix.position.sigma_north_m = sigma;
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
    fix.has_heading = !plan_.no_heading_s.holds(since_s());
    if (!plan_.is_out(since_s())) fixes_.push_back(fix);
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
      if (fix.has_heading) measure(fix.stamp, fix.heading);
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
    if (listen_) listen_(m);
    engine_->on_measurement(m);
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
    bool has_heading = true;
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
  // The truth.
  double x_m_ = 0, y_m_ = 0, yaw_rad_ = 0, vx_mps_ = 0;
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
  Watch watch_;
  std::function<void(const Measurement&)> listen_;
  std::optional<FieldJudge> judge_;
};

}  // namespace drover::bench
