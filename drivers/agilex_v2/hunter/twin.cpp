#include "drivers/agilex_v2/hunter/twin.h"

#include <algorithm>
#include <cmath>

#include "drivers/agilex_v2/chassis.h"

namespace drover::agilex_v2 {
namespace {

constexpr LowBattery kEmptied{22.0, 0x0001};
constexpr std::uint16_t kNobodySpeaks = 0x0200;

constexpr double kSteer_Nm_per_rad = 400;
constexpr double kSteerDamping_Nms_per_rad = 20;
constexpr double kMostSteering_Nm = 60;
constexpr double kSteerDrag_Nms_per_rad = 20;  // a worm gear, nearly

constexpr std::array kHunterTwinOptions{
    OptionSpec{.name = "wheel_radius_m",
               .default_value = 0.165,
               .min = 0.02,
               .max = 1,
               .text = "Radius of the simulated wheels"},
    OptionSpec{.name = "max_torque_Nm",
               .default_value = 60.0,
               .min = 1,
               .max = 1000,
               .text = "Most torque of each simulated rear motor"},
    OptionSpec{.name = "steering_rate_radps",
               .default_value = 0.6,
               .min = 0.05,
               .max = 5,
               .text = "How fast the simulated inner wheel is steered"},
};

}  // namespace

std::span<const OptionSpec> hunter_twin_option_table() {
  return kHunterTwinOptions;
}

HunterTwin::HunterTwin(const Options& options, const Steering& steering)
    : HunterTwin(CheckedOptions(options, kHunterTwinOptions), steering) {}

HunterTwin::HunterTwin(const CheckedOptions& own, const Steering& steering)
    : steering_(steering),
      wheel_radius_m_(own.number("wheel_radius_m")),
      max_torque_Nm_(own.number("max_torque_Nm")),
      rate_radps_(own.number("steering_rate_radps")) {
  state_.battery_V = kFull_V;
  state_.brake_locked = true;  // as it was left
}

void HunterTwin::set_power(bool on, Time now) {
  if (on == powered_) return;
  powered_ = on;
  booted_ = now + kBoot;
  state_.mode = Mode::standby;
  state_.brake_locked = true;
  last_asked_ = kNever;
  fell_silent_ = false;
}

bool HunterTwin::set_fault(std::string_view name, Time) {
  if (name == "steering_stuck") {
    steering_stuck_ = true;
    return true;
  }
  if (name == "brake_stuck") {
    brake_stuck_ = true;
    return true;
  }
  if (name == "remote") fell_silent_ = false;
  if (name.empty()) steering_stuck_ = brake_stuck_ = false;
  return set_chassis_fault(name, kEmptied, state_, silent_);
}

void HunterTwin::on_frame(const CanFrame& frame, Time now, TwinFrames&) {
  if (!awake(now) || !frame.is_plain()) return;
  if (const auto mode = read_mode_command(frame); mode && state_.mode != Mode::remote) {
    if (*mode != state_.mode) last_asked_ = kNever;
    state_.mode = *mode;
    fell_silent_ = false;
  }
  if (const auto lock = read_brake_command(frame); lock && state_.mode == Mode::can)
    state_.brake_locked = *lock;
  const auto steered = read_steered_command(frame);
  if (!steered) return;
  if (fell_silent_) {
    // As a Hunter SE does: the first command after a silence is obeyed.
    state_.mode = Mode::can;
    state_.error = static_cast<std::uint16_t>(state_.error & ~kNobodySpeaks);
    fell_silent_ = false;
  }
  if (state_.mode != Mode::can) return;
  asked_ = *steered;
  last_asked_ = now;
}

void HunterTwin::watch_silence(Time now) {
  if (state_.mode != Mode::can || last_asked_ == kNever || now - last_asked_ <= kProtection) return;
  state_.mode = Mode::standby;
  state_.error |= kNobodySpeaks;
  fell_silent_ = true;
}

void HunterTwin::on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) {
  const double dt_s = last_tick_ == kNever ? 0 : to_s(now - last_tick_);
  last_tick_ = now;
  if (shafts.size() < kHunterShafts) return;
  const bool on = awake(now);
  if (on) watch_silence(now);
  if (on && (state_.mode != Mode::standby || fell_silent_ || locked())) {
    const bool obeys = state_.mode == Mode::can && state_.vehicle == Vehicle::well && !locked();
    const bool fed = now - last_asked_ <= kProtection;
    drive(shafts, obeys && fed ? asked_.speed_mps : 0, dt_s);
  } else {
    let_go(servos_, kServo, shafts.first(2));
  }
  if (on) {
    steer(shafts, dt_s);
  } else {
    for (Shaft& shaft : shafts.subspan(2))
      shaft.torque_Nm = -kSteerDrag_Nms_per_rad * shaft.velocity_radps;
  }
  if (on && !silent_) tell(shafts, now, out);
}

/// Each rear wheel on its own curve.
void HunterTwin::drive(std::span<Shaft> shafts, double speed_mps, double dt_s) {
  const double radpm = steered_radpm(shafts);
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    const double side = i == 0 ? -1 : 1;
    const double rim_mps = speed_mps * (1 + side * radpm * steering_.track_m / 2);
    shafts[i].torque_Nm = servos_[i].torque_Nm(rim_mps / wheel_radius_m_ - shafts[i].velocity_radps,
                                               dt_s, max_torque_Nm_);
    shafts[i].energized = true;
  }
}

/// The inner wheel towards its angle, at the rate of what turns it; the outer one goes with it.
void HunterTwin::steer(std::span<Shaft> shafts, double dt_s) {
  if (state_.mode == Mode::can && last_asked_ != kNever && !steering_stuck_) {
    const double wanted_rad = std::clamp(asked_.inner_rad, -steering_.most_rad, steering_.most_rad);
    const double most_rad = rate_radps_ * dt_s;
    inner_rad_ += std::clamp(wanted_rad - inner_rad_, -most_rad, most_rad);
  }
  const double radpm = steering_.radpm(inner_rad_);
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = i == 0 ? -1 : 1;
    const double wide = 1 + side * radpm * steering_.track_m / 2;
    const double wanted_rad = std::atan(steering_.wheelbase_m * radpm / wide);
    Shaft& shaft = shafts[2 + i];
    shaft.torque_Nm = std::clamp(kSteer_Nm_per_rad * (wanted_rad - shaft.position_rad) -
                                     kSteerDamping_Nms_per_rad * shaft.velocity_radps,
                                 -kMostSteering_Nm, kMostSteering_Nm);
    shaft.energized = true;
  }
}

/// The curve that both front wheels make together.
double HunterTwin::steered_radpm(std::span<const Shaft> shafts) const {
  double sum_radpm = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = i == 0 ? -1 : 1;
    const double slope = std::tan(std::clamp(shafts[2 + i].position_rad, -1.0, 1.0));
    // tan = L k / (1 + side k w / 2)
    sum_radpm += slope / (steering_.wheelbase_m - side * slope * steering_.track_m / 2);
  }
  return sum_radpm / 2;
}

void HunterTwin::tell(std::span<const Shaft> shafts, Time now, TwinFrames& out) {
  if (now >= next_motion_) {
    next_motion_ = now + kMotionPeriod;
    const double speed_mps =
        (shafts[0].velocity_radps + shafts[1].velocity_radps) / 2 * wheel_radius_m_;
    (void)out.push_back(
        steered_motion_frame({speed_mps, steering_.inner_rad(steered_radpm(shafts))}));
  }
  if (now >= next_state_) {
    next_state_ = now + kStatePeriod;
    SystemState told = state_;
    told.brake_locked = locked();
    (void)out.push_back(system_state_frame(told, count_++, Model::hunter));
  }
}

}  // namespace drover::agilex_v2
