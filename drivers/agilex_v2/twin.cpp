#include "drivers/agilex_v2/twin.h"

#include "drivers/agilex_v2/chassis.h"

namespace drover::agilex_v2 {
namespace {

constexpr LowBattery kNearlyEmpty{22.4, 0x0200};

constexpr std::array kOptions{
    OptionSpec{.name = "zero_holds",
               .default_value = false,
               .text =
                   "a chassis that is told zero, or nothing, holds on a slope. Users say so, the "
                   "maker does not: try it. false: it brakes, and creeps"},
};

constexpr std::array kTwinOptions{
    OptionSpec{.name = "wheel_radius_m",
               .default_value = 0.165,
               .min = 0.02,
               .max = 1,
               .text = "Radius of the simulated wheels"},
    OptionSpec{.name = "track_m",
               .default_value = 0.583,
               .min = 0.1,
               .max = 3,
               .text = "How far the simulated left and right wheels are apart, as the chassis "
                       "reckons its turning"},
    OptionSpec{.name = "max_torque_Nm",
               .default_value = 60.0,
               .min = 1,
               .max = 1000,
               .text = "Most torque of the simulated motors of one side"},
};

}  // namespace

std::span<const OptionSpec> option_table() {
  return kOptions;
}

std::span<const OptionSpec> twin_option_table() {
  return kTwinOptions;
}

AgilexV2Twin::AgilexV2Twin(const Options& options)
    : AgilexV2Twin(CheckedOptions(options, kTwinOptions), CheckedOptions(options, kOptions)) {}

AgilexV2Twin::AgilexV2Twin(const CheckedOptions& own, const CheckedOptions& of_driver)
    : wheel_radius_m_(own.number("wheel_radius_m")),
      track_m_(own.number("track_m")),
      max_torque_Nm_(own.number("max_torque_Nm")),
      zero_holds_(of_driver.flag("zero_holds")) {
  state_.battery_V = kFull_V;
}

void AgilexV2Twin::set_power(bool on, Time now) {
  if (on == powered_) return;
  powered_ = on;
  booted_ = now + kBoot;
  state_.mode = Mode::standby;
  last_asked_ = kNever;
}

bool AgilexV2Twin::set_fault(std::string_view name, Time) {
  if (name == "serial") {
    state_.mode = Mode::serial;
    return true;
  }
  return set_chassis_fault(name, kNearlyEmpty, state_, silent_);
}

bool AgilexV2Twin::awake(Time now) const {
  return powered_ && now >= booted_;
}

void AgilexV2Twin::on_frame(const CanFrame& frame, Time now, TwinFrames&) {
  if (!awake(now) || !frame.is_plain()) return;
  if (const auto mode = read_mode_command(frame); mode && !is_taken(state_.mode)) {
    if (*mode != state_.mode) last_asked_ = kNever;
    state_.mode = *mode;
  }
  const auto twist = read_motion_command(frame);
  if (!twist || state_.mode != Mode::can) return;
  asked_ = *twist;
  last_asked_ = now;
}

void AgilexV2Twin::on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) {
  const double dt_s = last_tick_ == kNever ? 0 : to_s(now - last_tick_);
  last_tick_ = now;
  // What standby, an emergency stop and an exception do with the motors nobody wrote down: here
  // they let go, the worse of both.
  const bool drives = awake(now) && state_.mode != Mode::standby && state_.vehicle == Vehicle::well;
  if (drives) {
    turn(shafts, obeyed(now), dt_s);
  } else {
    let_go(servos_, {}, shafts);
  }
  if (awake(now) && !silent_) tell(shafts, now, out);
}

Twist AgilexV2Twin::obeyed(Time now) const {
  const bool fed = now - last_asked_ <= kProtection;
  if (state_.mode != Mode::can || !fed) return {};
  return asked_;
}

void AgilexV2Twin::turn(std::span<Shaft> shafts, const Twist& twist, double dt_s) {
  for (std::size_t i = 0; i < servos_.size() && i < shafts.size(); ++i) {
    const double side = i == 0 ? -1 : 1;
    const double asked_radps =
        (twist.vx_mps + side * twist.wz_radps * track_m_ / 2) / wheel_radius_m_;
    // It remembers nothing at zero: then it gives way to a load.
    if (asked_radps == 0 && !zero_holds_) servos_[i].effort_Nm = 0;
    shafts[i].torque_Nm =
        servos_[i].torque_Nm(asked_radps - shafts[i].velocity_radps, dt_s, max_torque_Nm_);
    shafts[i].energized = true;
  }
}

void AgilexV2Twin::tell(std::span<const Shaft> shafts, Time now, TwinFrames& out) {
  if (shafts.size() < 2) return;
  if (now >= next_motion_) {
    next_motion_ = now + kMotionPeriod;
    const double left_mps = shafts[0].velocity_radps * wheel_radius_m_;
    const double right_mps = shafts[1].velocity_radps * wheel_radius_m_;
    (void)out.push_back(
        motion_frame({(left_mps + right_mps) / 2, (right_mps - left_mps) / track_m_}));
  }
  if (now >= next_state_) {
    next_state_ = now + kStatePeriod;
    (void)out.push_back(system_state_frame(state_, count_++));
  }
}

}  // namespace drover::agilex_v2
