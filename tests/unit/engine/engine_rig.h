// The whole engine with a simulated base, drives, receiver, lines and guard about it.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "drover/angle.h"
#include "engine/base/kinematics.h"
#include "engine/engine.h"
#include "engine/estimate/estimator.h"
#include "support/plant_2d.h"

namespace drover::engine {

inline constexpr Duration kRigTick = std::chrono::milliseconds(5);
inline constexpr GeodeticPoint kRigOrigin{48.1, 11.6, 500};

inline EngineConfig rig_config() {
  EngineConfig config;
  for (const char* name : {"front_left", "front_right", "rear_left", "rear_right"}) {
    (void)config.joints.push_back(name);
  }
  for (const AxisId id : {AxisId{0}, AxisId{2}}) (void)config.base.left.push_back(id);
  for (const AxisId id : {AxisId{1}, AxisId{3}}) (void)config.base.right.push_back(id);
  config.line_configured = {true, true, true, true};
  config.estimate.antenna_x_m = 0.2;
  config.base.hold = HoldBy::brake;  // it may stop on any slope
  // Its mechanics were proved already; tests of that switch it on.
  config.navigate.first_way_m = 0;
  return config;
}

/// One call of `tick` is one control cycle. Faults are fields that a test sets.
class EngineRig {
 public:
  explicit EngineRig(const EngineConfig& c = rig_config(), double x_m = 0, double y_m = 0,
                     double yaw_rad = 0)
      : config(c),
        engine(std::make_unique<Engine>(c)),
        plant(c.base, {}, x_m, y_m, yaw_rad),
        geo_(c.estimate, c.base) {
    geo_.set_origin(kRigOrigin);
  }

  struct Drive {
    bool silent = false;
    bool refuses = false;  ///< does not arm
    bool stuck = false;    ///< feedback stands still
    bool fault = false;
    bool lapsed = false;         ///< that fault is only a want of set points
    bool stops_all = false;      ///< that fault is a person's stop
    double by_itself_radps = 0;  ///< the wheel turns so much faster than it is told to
    AxisState state = AxisState::idle;
    AxisRequest asked = AxisRequest::rest;  ///< in the cycle before
    int arming = 0;
    double position_rad = 0;
  };

  void command(const decltype(Command::body)& body,
               RequestId::Source source = RequestId::Source::mqtt) {
    engine->on_command({{source, ++asked}, now, body}, now);
  }
  void start(const Path& path, std::uint32_t target, double speed_mps) {
    command(StartTask{&path, target, speed_mps});
  }
  void set_origin() { command(SetOrigin{kRigOrigin}); }

  void tick() {
    now += kRigTick;
    move();
    sense();
    if (cycle_skipped) return;
    hand_over();
    environment.guard_alive = guard_alive;
    environment.guard_has_bus = guard_has_bus;
    environment.guard_refuses_set = guard_refuses_set;
    engine->step(now, environment, out);
    log.insert(log.end(), out.events.begin(), out.events.end());
  }
  void run_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) tick();
  }
  /// Origin set, drives heard, fix there: as a robot is before its first task.
  void settle() {
    tick();
    set_origin();
    run_s(3);
  }

  /// Of those who drive; a ramp to rest of what has let go is another matter.
  double fastest_command_radps() const {
    double fastest = 0;
    for (std::size_t i = 0; i < out.axes.size(); ++i) {
      if (!out.slowing_permitted[i])
        fastest = std::max(fastest, std::abs(out.axes[i].velocity_radps));
    }
    return fastest;
  }
  template <class Body>
  std::vector<Body> said() const {
    std::vector<Body> all;
    for (const Event& event : log) {
      if (const auto* body = std::get_if<Body>(&event.body)) all.push_back(*body);
    }
    return all;
  }
  const Snapshot& snapshot() const { return engine->snapshot(); }
  std::string why() const {
    return snapshot().why.empty() ? "" : std::string(snapshot().why[0].view());
  }

  EngineConfig config;
  std::unique_ptr<Engine> engine;
  test::Plant2d plant;
  Environment environment;
  EngineOutput out;
  std::vector<Event> log;
  std::array<Drive, 4> drives;
  std::array<bool, kLineCount> lines{};
  std::array<bool, kLineCount> line_lost{};
  std::array<bool, kLineCount> line_unknown{};  ///< nothing was ever heard of it
  bool guard_alive = true;
  bool guard_has_bus = false;
  bool guard_refuses_set = false;
  bool receiver_silent = false;
  bool receiver_late = false;  ///< what it says comes in one burst, when this ends
  int receiver_ticks = 20;     ///< between two of its positions
  bool no_heading = false;
  bool blocked = false;
  FixQuality quality = FixQuality::rtk_fixed;
  bool tells_speed = false;    ///< the receiver
  double speed_noise_mps = 0;  ///< it tells so much at least, now and then
  bool imu = false;            ///< there is one
  Vector3 gravity_mps2{0, 0, 9.81};
  double pitch_radps = 0;  ///< nose down positive
  /// The base moves so, whatever the drives are asked, while they have power.
  std::optional<WheelSpeeds> disobeys;
  /// A base that takes a twist tells this speed, whatever it does.
  std::optional<double> tells_mps;
  double tells_share = 1;         ///< or so many times its speed
  double tells_turn_share = 1;    ///< and its turn
  double steering_rad = kAbsent;  ///< of a base that steers
  bool steering_stuck = false;
  /// The base is moved so, with power or without.
  std::optional<WheelSpeeds> carried;
  /// What is built otherwise than configured.
  struct Mechanics {
    double gear = 1;        ///< the wheels turn so many times faster than the drives tell
    bool swapped = false;   ///< left and right
    bool crossed = false;   ///< left and right of the rear axle alone: its wheels slip
    bool reversed = false;  ///< the left front wheel
    double differs = 1;     ///< the sides follow so much of the difference that they are asked for
    double gyro = 1;        ///< it tells so many times the turn
    double aside = 1;       ///< on rollers it goes so much of what its wheels say of a way aside
  } mechanics;
  bool cycle_skipped = false;    ///< what is measured waits for the next cycle
  bool burst_backwards = false;  ///< it comes newest first
  Duration wheels_late{};        ///< what the wheels tell comes so much late
  double jump_m = 0;             ///< of the reported position, east
  double aside_m = 0;            ///< likewise, north
  double heading_off_deg = 0;    ///< of the reported heading
  Time now{std::chrono::seconds(10)};
  double driven_m = 0;  ///< true way of the base

  /// The relay is closed and a drive is in closed loop.
  bool has_power() const {
    const bool twist = takes_twist(config.base.kind);
    return out.outputs[static_cast<std::size_t>(Output::enable_relay)] &&
           (twist ? out.base.request : out.axes[0].request) != AxisRequest::idle;
  }
  std::uint64_t asked = 0;

 private:
  struct Fix {
    Time time;
    GnssPosition position;
    GnssHeading heading;
    GnssVelocity velocity;
  };

  static bool arms(AxisRequest request) {
    return request == AxisRequest::run || request == AxisRequest::hold;
  }

  static void ask(Drive& drive, AxisRequest request) {
    if (request == AxisRequest::idle && !drive.fault) drive.state = AxisState::idle;
    if (drive.fault) {
      drive.state = AxisState::fault;
    } else if (drive.state == AxisState::fault) {
      drive.state = AxisState::idle;
    } else if (arms(request) && drive.asked != request && !drive.refuses) {
      // Each new request is armed anew, also by a drive that still holds from the last one.
      drive.state = AxisState::arming;
      drive.arming = 40;
    } else if (drive.state == AxisState::arming && --drive.arming <= 0) {
      drive.state = AxisState::running;
    }
    if (request == AxisRequest::idle) drive.state = AxisState::idle;
    drive.asked = request;
  }

  /// Its front wheels are turned as fast as they can, and stay as they are at rest.
  Twist steered(const Twist& asked_twist) {
    const double wheelbase_m = config.base.wheelbase_m;
    const double v_mps = asked_twist.vx_mps;
    if (!std::isfinite(steering_rad)) steering_rad = 0;
    if (std::abs(v_mps) > 1e-3 && !steering_stuck) {
      const double wanted_rad = std::atan(wheelbase_m * asked_twist.wz_radps / v_mps);
      const double step_rad = 1.5 * config.base.steering_rate_radps * to_s(kRigTick);
      steering_rad += std::clamp(wanted_rad - steering_rad, -step_rad, step_rad);
    }
    return {v_mps, v_mps * std::tan(steering_rad) / wheelbase_m};
  }

  static AxisStatus status_of(AxisId axis, const Drive& drive) {
    AxisStatus status;
    status.axis = axis;
    status.state = drive.state;
    status.lapsed = drive.lapsed;
    status.stops_all = drive.stops_all;
    status.error_code = drive.fault ? 1 : 0;
    return status;
  }

  /// The device of a base that takes a twist does what the last cycle asked, and tells its motion.
  void move_base() {
    Drive& device = drives[0];
    ask(device, out.base.request);
    const bool obeys = device.state == AxisState::running && !blocked;
    const TwoSides sides = sides_of(config.base);
    Twist asked_twist = obeys ? out.base.twist : Twist{};
    if (config.base.kind == BaseKind::ackermann) asked_twist = steered(asked_twist);
    WheelSpeeds speeds = wheels_from_twist(sides, 1, asked_twist, 10);
    if (disobeys && has_power()) speeds = *disobeys;
    plant.step(speeds, to_s(kRigTick));
    environment.base.state = device.silent ? SourceState::stale : SourceState::fresh;
    if (device.silent) return;
    const Pose seen = plant.estimate();
    Twist told = device.stuck ? Twist{} : Twist{seen.vx_mps, seen.wz_radps};
    told.vx_mps *= tells_share;
    told.wz_radps *= tells_turn_share;
    if (tells_mps) told.vx_mps = *tells_mps;
    measure(now, BodyMotion{.twist = told, .known = true, .steering_rad = steering_rad});
    measure(now, status_of(kBaseAxis, device));
  }

  /// The drives do what the last cycle asked, the plant turns it into motion.
  void move() {
    if (takes_twist(config.base.kind)) return move_base();
    std::array<double, 4> speed{};
    for (std::size_t i = 0; i < 4; ++i) {
      ask(drives[i], out.axes[i].request);
      if (drives[i].state == AxisState::running) speed[i] = out.axes[i].velocity_radps;
    }
    if (blocked) speed = {};
    const double mean_radps = 0.25 * (speed[0] + speed[1] + speed[2] + speed[3]);
    for (double& radps : speed) radps = mean_radps + mechanics.differs * (radps - mean_radps);
    const double dt_s = to_s(kRigTick);
    std::array<double, 4> true_speed = speed;
    for (double& radps : true_speed) radps *= mechanics.gear;
    if (mechanics.reversed) true_speed[0] = -true_speed[0];
    if (mechanics.crossed) std::swap(true_speed[2], true_speed[3]);
    WheelSpeeds sides{0.5 * (true_speed[0] + true_speed[2]), 0.5 * (true_speed[1] + true_speed[3])};
    if (mechanics.swapped) std::swap(sides.left_radps, sides.right_radps);
    if (disobeys && has_power()) sides = *disobeys;
    if (carried) sides = *carried;
    const double before_x_m = plant.truth().x_m;
    const double before_y_m = plant.truth().y_m;
    const bool rollers = config.base.kind == BaseKind::mecanum;
    const double aside_radps = (true_speed[1] + true_speed[2] - true_speed[0] - true_speed[3]) / 4;
    const double aside_mps = mechanics.aside * aside_radps * config.base.wheel_radius_m;
    plant.step(sides, dt_s, rollers ? aside_mps : 0);
    driven_m += std::hypot(plant.truth().x_m - before_x_m, plant.truth().y_m - before_y_m);
    const Pose seen = plant.estimate();
    const double turn_mps = (mechanics.swapped ? -0.5 : 0.5) * plant.turn_track_m() * seen.wz_radps;
    for (std::size_t i = 0; i < 4; ++i) {
      const double told_mps = mechanics.aside == 0 ? 0 : seen.vy_mps / mechanics.aside;
      const double roller_mps = i == 1 || i == 2 ? told_mps : -told_mps;
      const double rim_mps = seen.vx_mps + roller_mps + (i % 2 == 0 ? -turn_mps : turn_mps);
      Drive& drive = drives[i];
      double radps = rim_mps / config.base.wheel_radius_m / mechanics.gear + drive.by_itself_radps;
      if (mechanics.reversed || mechanics.crossed)
        radps = speed[i];  // each wheel tells what it was asked
      if (!drive.stuck) drive.position_rad += radps * dt_s;
      environment.axes[i].state = drive.silent ? SourceState::stale : SourceState::fresh;
      if (drive.silent) continue;
      AxisMotion motion;
      motion.axis = static_cast<AxisId>(i);
      motion.position_rad = drive.position_rad;
      motion.velocity_radps = drive.stuck ? 0 : radps;
      measure(now, motion);
      measure(now, status_of(static_cast<AxisId>(i), drive));
    }
  }

  void sense() {
    for (std::size_t i = 0; i < kLineCount; ++i) {
      SourceHealth& source = environment.lines[i];
      source.state = line_lost[i] ? SourceState::stale : SourceState::fresh;
      if (line_unknown[i]) source.state = SourceState::never_heard;
      if (line_lost[i] || line_unknown[i]) continue;
      source.last_good = now;
      measure(now, LineState{static_cast<Line>(i), lines[i]});
    }
    if (imu) read_imu();
    environment.gnss[0].state = receiver_silent ? SourceState::stale : SourceState::fresh;
    if (!receiver_silent) environment.gnss[0].last_good = now;
    if (++ticks_ % static_cast<std::uint64_t>(receiver_ticks) == 0) read_receiver();
    while (!receiver_late && !fixes_.empty() &&
           now - fixes_.front().time >= std::chrono::milliseconds(80)) {
      const Fix& fix = fixes_.front();
      if (!receiver_silent) {
        measure(fix.time, fix.position);
        if (!no_heading) measure(fix.time, fix.heading);
        if (tells_speed) measure(fix.time, fix.velocity);
      }
      fixes_.pop_front();
    }
  }

  void read_imu() {
    environment.imu_configured = true;
    environment.imu[0].state = SourceState::fresh;
    environment.imu[0].last_good = now;
    ImuSample sample;
    sample.acceleration_mps2 = gravity_mps2;
    sample.angular_velocity_radps.y = pitch_radps;
    sample.angular_velocity_radps.z = mechanics.gyro * plant.truth().wz_radps;
    measure(now, sample);
  }

  void read_receiver() {
    Pose pose = plant.estimate();
    pose.x_m += jump_m;
    pose.y_m += aside_m;
    const GeodeticPoint antenna = geo_.antenna_geodetic(pose);
    Fix fix;
    fix.time = now;
    fix.position.latitude_deg = antenna.latitude_deg;
    fix.position.longitude_deg = antenna.longitude_deg;
    fix.position.altitude_msl_m = 455;
    fix.position.undulation_m = 45;
    fix.position.quality = quality;
    fix.position.satellites = 20;
    fix.position.hdop = 0.7;
    fix.position.correction_age_s = 1;
    fix.heading.heading_deg = wrap_deg(compass_deg_from_yaw_rad(pose.yaw_rad) + heading_off_deg);
    fix.velocity.speed_mps = std::abs(plant.truth().vx_mps);
    if (ticks_ % 60 == 0) fix.velocity.speed_mps += speed_noise_mps;
    fixes_.push_back(fix);
  }

  /// As the drive's device would say it.
  static const char* words_of(const Measurement& m) {
    const auto* const status = std::get_if<AxisStatus>(&m.value);
    if (status == nullptr || status->error_code == 0) return "";
    return status->stops_all ? "its emergency stop is pressed" : "over temperature";
  }
  template <class Value>
  void measure(Time time, const Value& value) {
    Measurement m;
    m.time = time;
    m.received = now;
    m.value = value;
    if (cycle_skipped || !held_back_.empty()) return held_back_.push_back(m);
    engine->on_measurement(m);
    engine->on_words(m, words_of(m));
  }
  /// What was held back comes in a burst; of the wheels only what is older than `wheels_late`.
  void hand_over() {
    std::deque<Measurement> later;
    if (burst_backwards) std::reverse(held_back_.begin(), held_back_.end());
    for (const Measurement& m : held_back_) {
      const bool of_wheels = std::holds_alternative<AxisMotion>(m.value);
      if (of_wheels && now - m.time < wheels_late) {
        later.push_back(m);
      } else {
        engine->on_measurement(m);
        engine->on_words(m, words_of(m));
      }
    }
    held_back_ = later;
  }

  Estimator geo_;  ///< only its geodesy
  std::deque<Fix> fixes_;
  std::deque<Measurement> held_back_;
  std::uint64_t ticks_ = 0;
};

/// Points each half metre from (0, 0) along x.
inline Path straight_path(double length_m) {
  Path path;
  path.name = "straight";
  for (int i = 0; i <= static_cast<int>(length_m * 2 + 0.5); ++i) {
    path.points.push_back({0.5 * i, 0});
  }
  return path;
}

}  // namespace drover::engine
