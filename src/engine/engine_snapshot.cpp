// The engine's part of the snapshot, at the end of each cycle.
#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "engine/engine_impl.h"

namespace drover::engine {

void Engine::Impl::fill_imu(const Estimate& located) {
  ImuSnapshot& imu = snapshot.imu;
  imu.gyro_bias_radps = located.gyro_bias_radps;
  imu.gyro_bias_sigma_radps = located.gyro_bias_sigma_radps;
  imu.roll_rad = located.roll_rad;
  imu.pitch_rad = located.pitch_rad;
  imu.orientation_sigma_rad = to_rad(config.estimate.imu_orientation_sigma_deg);
  imu.angular_velocity_sigma_radps = config.estimate.imu_rate_sigma_radps;
  imu.acceleration_sigma_mps2 = config.estimate.imu_acceleration_sigma_mps2;
}

void Engine::Impl::fill_sources(const Environment& environment) {
  const auto tell = [](SourceSnapshot& source, const SourceHealth& driver) {
    source.reason = driver.reason;
    source.bad = driver.bad;
    source.overflows = driver.overflows;
  };
  const std::size_t battery = sensors.battery_shown();
  tell(snapshot.gnss.source, environment.gnss[sensors.receiver()]);
  tell(snapshot.imu.source, environment.imu[sensors.imu()]);
  tell(snapshot.battery.source, environment.battery[battery]);
  snapshot.gnss.source.samples = sensors.samples(SensorKind::receiver, sensors.receiver());
  snapshot.imu.source.samples = sensors.samples(SensorKind::imu, sensors.imu());
  snapshot.battery.source.samples = sensors.samples(SensorKind::battery, battery);
  snapshot.battery.sample = sensors.batteries()[battery].sample;
  snapshot.battery.alarms = sensors.batteries()[battery].alarms;
  snapshot.battery.time = sensors.batteries()[battery].time;
  sensors.fill(snapshot, environment);
  for (std::size_t i = 0; i < snapshot.axes.size(); ++i)
    tell(snapshot.axes[i].source, environment.axes[i]);
  for (std::size_t i = 0; i < kLineCount; ++i) tell(snapshot.line_source[i], environment.lines[i]);
}

void Engine::Impl::fill_lines(const LineTable& lines) {
  for (std::size_t i = 0; i < kLineCount; ++i) {
    const bool known = config.line_configured[i] && !health.unknown(static_cast<Line>(i));
    snapshot.line_active[i] = known && lines.active[i];
  }
}

void Engine::Impl::fill_clearance() {
  ClearanceSnapshot& s = snapshot.clearance;
  const Clearance& found = clearance.found();
  s.configured = true;
  s.time = found.t;
  s.first = found.first;
  s.unknown = clearance.unknown();
  s.broken = clearance.broken();
  const bool known = s.unknown.empty();
  s.ahead_m = known ? found.ahead_m : kAbsent;
  s.back_m = known ? found.back_m : kAbsent;
  s.left_rad = known ? std::min(found.left_rad, kPi) : kAbsent;
  s.right_rad = known ? std::min(found.right_rad, kPi) : kAbsent;
  const bool on_track = known && navigator.active() && found.path == navigator.path_number();
  s.along_m = on_track ? std::min(found.along_m, snapshot.nav.distance_left_m) : kAbsent;
}

/// Who goes on sending after the end of his stream asks for no motion any more: what
/// stopped him would be told nowhere else.
void Engine::Impl::tell_sender(Time now, Owner owner, const Stream& stream, Owner his) {
  const bool to_him = owner == Owner::nobody || owner == his;
  if (!to_him || !stream.refuses(now)) return;
  const auto tell = [this](const Reason& what) {
    const auto& why = snapshot.why;
    const bool stands_there = std::find(why.begin(), why.end(), what) != why.end();
    if (!stands_there && !health.report().gives(what)) snapshot.tell_why(what);
  };
  // What is in the way still is told with its newest distance.
  if (!stream.obstacle().empty()) {
    if (!snapshot.nav.obstacle) tell(stream.obstacle());
    snapshot.nav.obstacle = true;
    if (stream.reason() == stream.obstacle()) return;
  }
  tell(stream.reason());
}

/// The first way: nothing is wrong, and the robot is slower than was asked for.
void Engine::Impl::tell_first_way(Owner owner) {
  if (owner == Owner::nobody || owner == Owner::estop) return;
  const bool by_stream_of_joints = owner == Owner::joint_command;
  const bool by_hand = owner == Owner::manual && owners.hand_drives();
  const bool by_twist = owner == Owner::cmd_vel;
  Reason why = mechanics.slowly(by_stream_of_joints || by_twist ? FirstWay::joints
                                : by_hand                       ? FirstWay::hand
                                                                : FirstWay::task);
  const Learned learned{estimate.yaw_slip_factor};
  if (why.empty() && by_twist) why = aside.slowly(owners.by_twist());
  if (why.empty() && by_stream_of_joints)
    why = aside.slowly(twist_of(base, owners.stream_radps(), learned));
  if (why.empty()) return;
  snapshot.tell_why(why);
  if (by_twist && snapshot.cmd_vel.reason.empty()) snapshot.cmd_vel.reason = why;
  if (by_stream_of_joints && snapshot.joint_command.reason.empty())
    snapshot.joint_command.reason = why;
}

/// Where the antennas' cables are swapped the base lies as far behind its antenna as it is taken to
/// lie ahead of it, or the other way round: until the first way has shown which way it goes.
double Engine::Impl::reversal_m(const Estimate& located) const {
  const bool told_by_receiver = std::isfinite(located.mounting_rad);
  if (mechanics.proved() || !told_by_receiver) return 0;
  const AntennaConfig antenna = antenna_of(config.estimate, sensors.receiver());
  return 2 * std::hypot(antenna.x_m, antenna.y_m);
}

void Engine::Impl::fill_snapshot(Time now, const Environment& environment, const LineTable& lines,
                                 const Estimate& located, Owner owner) {
  const HealthReport& report = health.report();
  snapshot.time = now;
  fill_sources(environment);
  fill_lines(lines);
  snapshot.pose = located.pose;
  fill_speed(now);
  snapshot.nav = navigator.snapshot(report);
  snapshot.nav.owner = owner;
  snapshot.nav.owner_timeout_s = owners.timeout_s(owner);
  if (config.clearance_required) fill_clearance();
  snapshot.cmd_vel = owners.cmd_vel().snapshot();
  snapshot.joint_command = owners.stream().snapshot();
  snapshot.gnss.configured = environment.gnss_configured;
  fill_imu(located);
  const SourceState receiver = environment.gnss[sensors.receiver()].state;
  snapshot.gnss.health = report.gnss_ok ? receiver : SourceState::stale;
  if (receiver == SourceState::never_heard) {
    snapshot.gnss.health = SourceState::never_heard;
  }
  const bool fixed = snapshot.gnss.health == SourceState::fresh &&
                     snapshot.gnss.position.quality == FixQuality::rtk_fixed;
  // Nobody reckons beside a fix, though the estimator believes a new one only after a while.
  snapshot.nav.metres_left = fixed ? kAbsent : located.metres_left;
  snapshot.nav.error_bound_m = located.error_bound_m + reversal_m(located);
  snapshot.imu.configured = environment.imu_configured;
  snapshot.imu.health = environment.imu[sensors.imu()].state;
  snapshot.gnss.pose_heading_deg =
      located.has_heading ? compass_deg_from_yaw_rad(located.pose.yaw_rad) : kAbsent;
  if (located.has_position) {
    const GeodeticPoint antenna = estimator.antenna_geodetic(located.pose);
    snapshot.gnss.pose_latitude_deg = antenna.latitude_deg;
    snapshot.gnss.pose_longitude_deg = antenna.longitude_deg;
  } else if (std::isfinite(fix.latitude_deg) && std::isfinite(fix.longitude_deg)) {
    snapshot.gnss.pose_latitude_deg = fix.latitude_deg;
    snapshot.gnss.pose_longitude_deg = fix.longitude_deg;
  }
  snapshot.battery.configured = config.battery_configured;
  snapshot.battery.health = environment.battery[sensors.battery_shown()].state;
  if (snapshot.battery.time != kNever &&
      now - snapshot.battery.time > from_s(config.health.battery_stale_s)) {
    snapshot.battery.health = SourceState::stale;
  }
  snapshot.estimator = estimator.counters();
  snapshot.learned = located.learned;
  snapshot.notices_dropped = events.dropped();
  snapshot.stop_latched = !latch.why().empty();
  snapshot.hold = arming.state();
  snapshot.guard_alive = environment.guard_alive;
  snapshot.guard_has_bus = environment.guard_has_bus;
  snapshot.why.clear();
  snapshot.why_untold = 0;
  // Latched in this very cycle by what is no lasting cause: health will tell from the next on.
  if (snapshot.stop_latched && !report.holds(Cause::latched) && report.stop.empty()) {
    snapshot.tell_why(latch.why());
  }
  // Before "no heading yet", which asks for another search.
  if (owner == Owner::nobody && !owners.no_heading().empty())
    snapshot.tell_why(owners.no_heading());
  for (const Reason& reason : report.why) snapshot.tell_why(reason);
  // Of a battery that is empty, but not for long enough to end anything: a sag, were it driven.
  const bool is_told = std::any_of(report.why.begin(), report.why.end(), [&](const Reason& each) {
    return each.view() == report.no_start.view();
  });
  if (owner == Owner::nobody && !report.no_start.empty() && !is_told)
    snapshot.tell_why(report.no_start);
  snapshot.why_untold += report.why_untold;
  if (const Reason waits = navigator.waits_for(report); !waits.empty()) snapshot.tell_why(waits);
  if (latch.power_cut()) snapshot.tell_why("the drives have no power: drover reset");
  if (arming.state() == HoldState::lost) {
    snapshot.tell_why("the drives let go and are not held: drover hold");
  } else if (const Reason why = arming.hindrance(); !why.empty()) {
    snapshot.tell_why(why);
  }
  tell_sender(now, owner, owners.cmd_vel(), Owner::cmd_vel);
  tell_sender(now, owner, owners.stream(), Owner::joint_command);
  tell_first_way(owner);
}

}  // namespace drover::engine
