#include "drivers/gt01/chassis_twin.h"

#include <algorithm>
#include <cmath>

#include "drivers/checked_options.h"

namespace drover::gt01 {
namespace {

/// What keeps the wheels of a track together.
constexpr double kTrackStiffness_Nms_per_rad = 5;
constexpr double kStands_mps = 0.02;

const OptionSpec kTwinOptions[] = {
    {.name = "wheel_radius_m",
     .default_value = 0.085,
     .min = 0.01,
     .max = 1,
     .text = "of what turns its tracks; the maker's example of 0x89 has 170 mm across"},
    {.name = "track_m",
     .default_value = 0.725,
     .min = 0.1,
     .max = 5,
     .text = "between its tracks, as it reckons with; the maker's example of 0x89"},
    {.name = "torque_limit_Nm",
     .default_value = 60.0,
     .min = 0.01,
     .max = 10000,
     .text = "of a side"},
    {.name = "velocity_gain_Nms_per_rad",
     .default_value = 20.0,
     .min = 0,
     .max = 10000,
     .text = "of a side's speed controller"},
    {.name = "integrator_gain_Nm_per_rad",
     .default_value = 80.0,
     .min = 0,
     .max = 100000,
     .text = "of a side's speed controller; nothing is integrated at zero unless zero_holds"},
    {.name = "acceleration_mps2",
     .default_value = 2.0,
     .min = 0.1,
     .max = 100,
     .text = "of its own ramps"},
    {.name = "boot_s",
     .default_value = 1.0,
     .min = 0,
     .max = 60,
     .text = "silence after the supply comes back"},
};

}  // namespace

std::span<const OptionSpec> chassis_option_table() {
  return kTwinOptions;
}

ChassisSettings read_chassis_settings(const Options& options) {
  const CheckedOptions checked(options, kTwinOptions);
  ChassisSettings chassis;
  chassis.wheel_radius_m = checked.number("wheel_radius_m");
  chassis.track_m = checked.number("track_m");
  chassis.torque_limit_Nm = checked.number("torque_limit_Nm");
  chassis.velocity_gain_Nms_per_rad = checked.number("velocity_gain_Nms_per_rad");
  chassis.integrator_gain_Nm_per_rad = checked.number("integrator_gain_Nm_per_rad");
  chassis.acceleration_mps2 = checked.number("acceleration_mps2");
  chassis.boot_time = checked.seconds("boot_s");
  return chassis;
}

bool is_due(Time& next, Duration period, Time now) {
  if (now < next) return false;
  next = now - next >= 2 * period ? now + period : next + period;
  return true;
}

void ChassisModel::on_twist(const Twist& told, Time now) {
  if (!up_ || faults_.deaf) return;
  twist_ = told;
  last_twist_ = now;
  hosted_ = true;
}

void ChassisModel::set_power(bool on, Time now) {
  if (on == powered_) return;
  powered_ = on;
  up_ = hosted_ = false;
  twist_ = {};
  faults_.soft_estop = faults_.bumper = faults_.over_current = false;
  up_at_ = on ? now + chassis_.boot_time : kNever;
}

bool ChassisModel::set_fault(std::string_view name) {
  struct Named {
    std::string_view name;
    bool ChassisFaults::*fault;
  };
  static constexpr Named kNamed[] = {
      {"silent", &ChassisFaults::silent},
      {"deaf", &ChassisFaults::deaf},
      {"bad_sums", &ChassisFaults::bad_sums},
      {"stuck_encoder", &ChassisFaults::stuck_encoder},
      {"estop", &ChassisFaults::hard_estop},
      {"soft_estop", &ChassisFaults::soft_estop},
      {"bumper", &ChassisFaults::bumper},
      {"remote", &ChassisFaults::remote},
      {"over_current", &ChassisFaults::over_current},
      {"docking", &ChassisFaults::docking},
  };
  if (name.empty()) {
    faults_ = {};
    return true;
  }
  for (const Named& each : kNamed) {
    if (each.name != name) continue;
    faults_.*each.fault = true;
    return true;
  }
  return false;
}

Twist ChassisModel::twist() const {
  return {(told_mps_[0] + told_mps_[1]) / 2 / settings_.speed_scale,
          (told_mps_[1] - told_mps_[0]) / chassis_.track_m / settings_.turn_scale};
}

bool ChassisModel::stopped() const {
  return faults_.hard_estop || faults_.soft_estop || faults_.bumper || faults_.over_current;
}

Twist ChassisModel::target(Time now) const {
  const bool late = settings_.silence > Duration{} && now - last_twist_ > settings_.silence;
  const bool others = faults_.remote || faults_.docking;
  if (!hosted_ || late || stopped() || rests_first_ || others) return {};
  return {twist_.vx_mps * settings_.speed_scale, twist_.wz_radps * settings_.turn_scale};
}

/// Both wheels of a track turn alike; nobody integrates at zero unless it holds there.
void ChassisModel::drive(std::span<Shaft> shafts, std::size_t side, double target_mps,
                         double dt_s) {
  const double radius_m = chassis_.wheel_radius_m;
  const double step_mps = chassis_.acceleration_mps2 * dt_s;
  double& ramped_mps = ramped_mps_[side];
  ramped_mps += std::clamp(target_mps - ramped_mps, -step_mps, step_mps);
  const double mean_radps = measured_mps_[side] / radius_m;
  const double error_radps = ramped_mps / radius_m - mean_radps;
  const double limit_Nm = chassis_.torque_limit_Nm;
  double& integral_Nm = integral_Nm_[side];
  integral_Nm += error_radps * chassis_.integrator_gain_Nm_per_rad * dt_s;
  integral_Nm = std::clamp(integral_Nm, -limit_Nm, limit_Nm);
  if (ramped_mps == 0 && target_mps == 0 && !settings_.zero_holds) integral_Nm = 0;
  const double torque_Nm = std::clamp(
      chassis_.velocity_gain_Nms_per_rad * error_radps + integral_Nm, -limit_Nm, limit_Nm);
  for (Shaft& shaft : shafts)
    shaft.torque_Nm = torque_Nm / static_cast<double>(shafts.size()) +
                      kTrackStiffness_Nms_per_rad * (mean_radps - shaft.velocity_radps);
}

void ChassisModel::on_tick(Time now, std::span<Shaft> shafts) {
  const double dt_s = last_tick_ == kNever ? 0.0 : to_s(now - last_tick_);
  last_tick_ = now;
  if (powered_ && !up_ && (up_at_ == kNever || now >= up_at_)) up_ = true;
  if (settings_.silence > Duration{} && now - last_twist_ > settings_.silence) hosted_ = false;
  const std::size_t half = shafts.size() / 2;
  const std::array sides{shafts.first(half), shafts.subspan(half)};
  for (std::size_t side = 0; side < sides.size(); ++side) {
    double sum_radps = 0;
    for (const Shaft& shaft : sides[side]) sum_radps += shaft.velocity_radps;
    measured_mps_[side] = sum_radps /
                          static_cast<double>(std::max<std::size_t>(1, sides[side].size())) *
                          chassis_.wheel_radius_m;
  }
  if (!faults_.stuck_encoder) told_mps_ = measured_mps_;
  const bool stands =
      std::abs(measured_mps_[0]) < kStands_mps && std::abs(measured_mps_[1]) < kStands_mps;
  rests_first_ = stopped() || (rests_first_ && !stands);
  const bool energized = up_ && !faults_.hard_estop && !faults_.over_current;
  const Twist twist = target(now);
  const double turn_mps = twist.wz_radps * chassis_.track_m / 2;
  const std::array target_mps{twist.vx_mps - turn_mps, twist.vx_mps + turn_mps};
  for (std::size_t side = 0; side < sides.size(); ++side) {
    if (energized) {
      drive(sides[side], side, target_mps[side], dt_s);
    } else {
      ramped_mps_[side] = measured_mps_[side];
      integral_Nm_[side] = 0;
      for (Shaft& shaft : sides[side]) shaft.torque_Nm = 0;
    }
    for (Shaft& shaft : sides[side]) shaft.energized = energized;
  }
}

}  // namespace drover::gt01
