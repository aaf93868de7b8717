// What the engine makes of motion that it did not ask for, and of stops that do not work.
#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "engine/base/words.h"
#include "engine/engine_impl.h"
#include "engine/still.h"

namespace drover::engine {
namespace {

// Less is what wheels resist; the same from which a person has to answer for a release.
constexpr double kRollsFrom_deg = 2.0;
constexpr double kCreepsFrom_deg = 1.0;  // of that along its way

}  // namespace

/// Whoever speaks of the robot's motion: what he says is not compared with what another one said.
void Engine::Impl::choose_sensors(Time now, const Environment& environment) {
  const bool stands = !motion_asked && !arming.driven() && estimate.fastest_mps <= kStands_mps;
  const HandOver change = sensors.update(now, environment, estimator, stands);
  if (change.imu) {
    estimator.use_imu(sensors.imu());
    snapshot.imu.time = kNever;
  }
  if (!change.receiver) return;
  rest.witness().forget_receiver();
  mechanics.forget_receiver(antenna_of(config.estimate, sensors.receiver()));
  aside.forget_receiver(antenna_of(config.estimate, sensors.receiver()));
  fix = sensors.position();
  snapshot.gnss.position = fix;
  snapshot.gnss.position_time = sensors.position_at();
  snapshot.gnss.velocity = {};
  snapshot.gnss.velocity_time = kNever;
  snapshot.gnss.receiver_heading_deg = snapshot.gnss.heading_deg = kAbsent;
  snapshot.gnss.heading_time = kNever;
}

void Engine::Impl::watch_imu(const ImuSample& sample, Time at) {
  tilt.on_sample(sample, at);
  hit.on_sample(sample, at);
  const bool zero_known = std::isfinite(estimate.gyro_bias_sigma_radps);
  const double turn_radps =
      sample.angular_velocity_radps.z - (zero_known ? estimate.gyro_bias_radps.z : 0.0);
  rest.witness().on_turn(turn_radps, at);
  mechanics.on_turn(turn_radps, at);
}

/// Why nothing goes aside so now; empty: it does.
std::string_view Engine::Impl::no_sideways(const Twist& twist) const {
  if (!limits(base).sideways) return "this base cannot go sideways";
  if (config.clearance_required && !config.clearance_aside)
    return "nobody looks where it would go sideways";
  if (config.clearance_required && (drives(twist) || std::abs(twist.wz_radps) > kTurns_radps))
    return "nobody looks where it would go aslant: it goes sideways alone";
  if (!mechanics.proved())
    return "this base goes sideways once wheels, gyro and receiver agreed on a first way ahead";
  return {};
}

/// Whether the base rests when it should; what moves it without a command, in words.
Reason Engine::Impl::judge_motion(Time now, Duration dt, const LineTable& lines,
                                  const Environment& environment) {
  const auto estop = static_cast<std::size_t>(Line::estop);
  RestInput input{.now = now, .dt = dt, .axes = axes};
  input.power_is_off = config.line_configured[estop] && lines.active[estop];
  const double falls_deg = tilt_deg();
  if (std::isfinite(falls_deg)) {
    slopes = falls_deg > kRollsFrom_deg;
    const double ahead_deg = to_deg(estimate.pitch_rad);  // nose down is positive
    input.falls_ahead = std::abs(ahead_deg) > kCreepsFrom_deg ? std::sin(estimate.pitch_rad) : 0;
  }
  input.rolls_unpowered =
      !steep.empty() || (config.base.hold == HoldBy::level_ground_only && slopes);
  input.released = arming.released();
  input.drives_on_in_silence = environment.drives_on_in_silence;
  input.stop_creeps = environment.stop_creeps;
  input.found_powered = environment.relay_found_closed;
  input.caught = arming.state() == HoldState::catching;
  if (estimate.has_heading) input.yaw_rad = estimate.pose.yaw_rad;
  const RestState state = rest.update(input);
  if (state == RestState::not_stopping && !latch.power_cut()) {
    latch.set(Latched::did_not_stop, rest.reason());
    events.notice(now, Notice::Level::error, rest.reason());
    navigator.stop(now, events);
  }
  tilt.update(now, imu_trusted() ? estimate.roll_rad : kAbsent,
              imu_trusted() ? estimate.pitch_rad : kAbsent);
  mechanics.step({.now = now,
                  .dt = dt,
                  .body = estimate.body.twist,
                  .fastest_mps = estimate.fastest_mps,
                  .commanded = motion_asked,
                  .asked_radps = motion_asked ? commanded.wz_radps : 0,
                  .yaw_slip_factor = estimate.yaw_slip_factor,
                  .yaw_rad = estimate.has_heading ? estimate.pose.yaw_rad : kAbsent,
                  .gyro_zero_known = std::isfinite(estimate.gyro_bias_sigma_radps)});
  aside.step({.now = now,
              .dt = dt,
              .body = estimate.body.twist,
              .still = !motion_asked && estimate.fastest_mps < kStands_mps,
              .yaw_rad = estimate.has_heading ? estimate.pose.yaw_rad : kAbsent});
  // What did not stop is latched, in words of its own, and "rests again" only when it does.
  if (state != RestState::not_stopping) return rest.reason();
  return rest.moves(now) ? Reason("the robot still moves") : Reason();
}

void Engine::Impl::watch_wheels(Time now, Duration dt) {
  wheel_fault = wheels.update(now, dt, axes);
  wheel_reason = wheels.reason();
  if (wheel_fault == WheelFault::runaway) {
    latch.set(Latched::ran_away, wheel_reason);
    rest.expect_stop(now);
  }
  steering.update(now, dt, motion_asked ? sent : Twist{}, steering_rad);
  // Wheels that work against each other stand before gyro or receiver can tell.
  if (wheel_fault == WheelFault::not_following && !mechanics.proved()) {
    const std::string_view what = wheels.reason();
    wheel_reason.format("%.*s on the first way: %s", static_cast<int>(what.size()), what.data(),
                        words_of(base).on_first_way);
  }
  if (wheel_fault == WheelFault::none && !steering.reason().empty()) {
    wheel_fault = WheelFault::not_following;
    wheel_reason = steering.reason();
  }
  if (wheel_fault == WheelFault::none && !mechanics.fault().empty()) {
    wheel_fault = WheelFault::disagrees;
    wheel_reason = mechanics.fault();
  }
  if (wheel_fault == WheelFault::none && !aside.fault().empty()) {
    wheel_fault = WheelFault::disagrees;
    wheel_reason = aside.fault();
  }
}

void Engine::Impl::fill_speed(Time now) {
  snapshot.worst_vx_mps =
      worst_speed.update({.now = now,
                          .wheels_mps = estimate.body.known ? estimate.pose.vx_mps : kAbsent,
                          .fastest_rim_mps = estimate.fastest_mps,
                          .receiver_mps = rest.witness().speed_mps(now),
                          .receiver_at = rest.witness().speed_at(),
                          .direction = rest.direction()});
}

}  // namespace drover::engine
