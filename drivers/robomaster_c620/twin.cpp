#include "drivers/robomaster_c620/twin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "drivers/twin_states.h"

namespace drover::robomaster {
namespace {

constexpr double kHot_degC = 95;
// Behind the gear of an M3508: what turns with a shaft that nothing hangs on, and what rubs there.
constexpr double kRotor_kgm2 = 0.006;
constexpr double kRubs_Nm = 0.045;

/// The speed of a shaft that nothing hangs on, after this.
double turned_freely_radps(double radps, double torque_Nm, double dt_s) {
  const double pushed_radps = radps + torque_Nm / kRotor_kgm2 * dt_s;
  const double rubs_radps = kRubs_Nm / kRotor_kgm2 * dt_s;
  return std::copysign(std::max(std::abs(pushed_radps) - rubs_radps, 0.0), pushed_radps);
}

}  // namespace

RobomasterTwin::RobomasterTwin(const Settings& settings, const TwinSettings& twin)
    : settings_(settings), twin_(twin) {
  for (Unit& unit : units_) unit.degC = twin.ambient_degC;
}

void RobomasterTwin::boot(Time now) {
  booted_ = true;
  last_fed_ = next_ = now;
  for (Unit& unit : units_) unit.current = 0;
}

void RobomasterTwin::set_power(bool on, Time now) {
  if (on == powered_) return;
  powered_ = on;
  booted_ = false;
  boot_at_ = on ? now + twin_.boot_time : kNever;
}

bool RobomasterTwin::set_fault(std::string_view name, Time) {
  constexpr std::pair<std::string_view, bool Unit::*> kFaults[] = {{"silent", &Unit::silent},
                                                                   {"no_torque", &Unit::torn},
                                                                   {"stuck_encoder", &Unit::stuck},
                                                                   {"over_temperature", &Unit::hot},
                                                                   {"loose", &Unit::loose}};
  if (name.empty())
    for (Unit& unit : units_) unit.silent = unit.torn = unit.stuck = unit.hot = unit.loose = false;
  bool known = name.empty();
  for (const auto& [fault, flag] : kFaults) {
    if (name == fault)
      for (Unit& unit : units_) unit.*flag = true;
    const auto number = number_after(name, fault);
    const double channel = number.value_or(0) - settings_.first_motor;
    const bool one = number && channel >= 0 && channel < kMotors;
    if (one) units_[static_cast<std::size_t>(channel)].*flag = true;
    known = known || one || name == fault;
  }
  return known;
}

/// It takes what stands there, without any arming.
void RobomasterTwin::on_frame(const CanFrame& frame, Time now, TwinFrames&) {
  const auto currents = decode_currents(frame, settings_.command_id());
  if (!booted_ || !currents) return;
  last_fed_ = now;
  const auto most = static_cast<std::int16_t>(settings_.most_counts);
  for (std::size_t i = 0; i < kMotors; ++i)
    units_[i].current = std::clamp((*currents)[i], static_cast<std::int16_t>(-most), most);
}

void RobomasterTwin::on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) {
  const double dt_s = last_tick_ == kNever ? 0.0 : to_s(now - last_tick_);
  last_tick_ = now;
  if (powered_ && !booted_ && now >= (boot_at_ == kNever ? now : boot_at_)) boot(now);
  if (twin_.silence > Duration{} && now - last_fed_ > twin_.silence)
    for (Unit& unit : units_) unit.current = 0;
  for (std::size_t i = 0; i < kMotors && i < shafts.size(); ++i) move(i, dt_s, shafts[i]);
  if (!booted_ || now < next_) return;
  // No more than one of each in a tick, however long that is.
  next_ = std::max(next_ + twin_.period, now);
  for (std::size_t i = 0; i < kMotors; ++i) tell(i, out);
}

void RobomasterTwin::move(std::size_t channel, double dt_s, Shaft& shaft) {
  Unit& unit = units_[channel];
  const double sign = settings_.sign[channel];
  const double to_rotor = sign * settings_.gear_ratio;
  if (!unit.loose) unit.free_radps = shaft.velocity_radps;
  if (unit.stuck) {
    unit.rotor_radps = 0;
  } else {
    unit.rotor_radps = unit.free_radps * to_rotor;
    unit.angle_rad =
        unit.loose ? unit.angle_rad + unit.rotor_radps * dt_s : shaft.position_rad * to_rotor;
  }
  unit.told_current = booted_ && !unit.torn ? unit.current : std::int16_t{0};
  const double current_A = unit.told_current / settings_.counts_per_A;
  shaft.torque_Nm = current_A * settings_.Nm_per_A * sign;
  shaft.energized = booted_;
  if (unit.loose) {
    unit.free_radps = turned_freely_radps(unit.free_radps, shaft.torque_Nm, dt_s);
    shaft.torque_Nm = 0;
  }
  const double heats_W = current_A * current_A * twin_.winding_ohm;
  const double cools_W = (unit.degC - twin_.ambient_degC) / twin_.thermal_resistance_KpW;
  unit.degC += (heats_W - cools_W) / twin_.thermal_capacity_JpK * dt_s;
}

/// Evenly spread, and the same in each run.
std::int16_t RobomasterTwin::noisy(std::int16_t current) {
  noise_ = noise_ * 1664525U + 1013904223U;
  const double share = 2.0 * noise_ / std::numeric_limits<std::uint32_t>::max() - 1;
  const double most = settings_.most_counts;
  const double told = current + share * twin_.current_noise_A * settings_.counts_per_A;
  return static_cast<std::int16_t>(std::clamp(told, -most, most));
}

void RobomasterTwin::tell(std::size_t channel, TwinFrames& out) {
  const Unit& unit = units_[channel];
  if (unit.silent) return;
  Feedback feedback;
  const double turns = unit.angle_rad / kTurn_rad;
  const auto angle = static_cast<int>((turns - std::floor(turns)) * kAnglesPerTurn);
  feedback.angle = static_cast<std::uint16_t>(std::min(angle, kAnglesPerTurn - 1));
  constexpr double kMost_rpm = 32767;
  feedback.rpm =
      static_cast<std::int16_t>(std::clamp(unit.rotor_radps / kRadpsPerRpm, -kMost_rpm, kMost_rpm));
  feedback.current = noisy(unit.told_current);
  const double degC = unit.hot ? std::max(unit.degC, kHot_degC) : unit.degC;
  if (twin_.tells_temperature)
    feedback.degC = static_cast<std::uint8_t>(std::clamp(degC, 0.0, 255.0));
  static_cast<void>(out.push_back(encode_feedback(settings_.motor(channel), feedback)));
}

}  // namespace drover::robomaster
