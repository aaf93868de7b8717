#include "drivers/cubemars_mit/twin.h"

#include <algorithm>
#include <array>
#include <utility>

namespace drover::cubemars_mit {
namespace {

constexpr std::array kErrors{
    std::pair{std::string_view("over_temperature"), MotorError::over_temperature},
    std::pair{std::string_view("over_current"), MotorError::over_current},
    std::pair{std::string_view("over_voltage"), MotorError::over_voltage},
    std::pair{std::string_view("under_voltage"), MotorError::under_voltage},
    std::pair{std::string_view("encoder"), MotorError::encoder},
    std::pair{std::string_view("phase_imbalance"), MotorError::phase_imbalance},
};

}  // namespace

CubemarsTwin::CubemarsTwin(const Settings& settings, const TwinSettings& twin)
    : settings_(settings), twin_(twin), motor_(settings.joint, twin) {}

void CubemarsTwin::set_power(bool on, Time now) {
  if (on == powered_) return;
  powered_ = on;
  booted_ = on_ = false;
  boot_at_ = on ? now + twin_.boot_time : kNever;
  motor_.told.torque_Nm = 0;
}

bool CubemarsTwin::set_fault(std::string_view name, Time) {
  const auto* const error = std::find_if(kErrors.begin(), kErrors.end(),
                                         [&](const auto& each) { return each.first == name; });
  if (error != kErrors.end()) {
    error_ = error->second;
    on_ = false;
  } else if (name.empty()) {
    error_ = MotorError::none;
    motor_.mend();
    silent_ = false;
  } else if (name == "silent") {
    silent_ = true;
  } else if (name == "leaves_closed_loop") {
    on_ = false;
  } else {
    return motor_.set_fault(name);
  }
  return true;
}

void CubemarsTwin::answer(TwinFrames& out) const {
  if (silent_) return;
  Feedback feedback;
  feedback.motion = motor_.told;
  feedback.degC = twin_.ambient_degC + (error_ == MotorError::over_temperature ? 90 : 5);
  feedback.error = static_cast<std::uint8_t>(error_);
  CanFrame frame = encode_feedback(settings_.master_id, settings_.joint.id, feedback, twin_.ranges);
  if (twin_.short_answers) frame.len = 6;
  static_cast<void>(out.push_back(frame));
}

void CubemarsTwin::on_frame(const CanFrame& frame, Time now, TwinFrames& out) {
  if (!booted_ || !frame.is_plain()) return;
  const auto special = mit::decode_special(frame, settings_.joint.id);
  const auto raw = mit::decode_mit_raw(frame, settings_.joint.id);
  if (!special && !raw) return;
  // It tells how it was before.
  if (special || on_ || !twin_.mute_while_off) answer(out);
  last_fed_ = now;
  if (raw) {
    command_ = mit::scale(*raw, twin_.ranges);
  } else if (*special == Special::enable) {
    on_ = error_ == MotorError::none;
  } else if (*special == Special::disable) {
    on_ = false;
  } else if (*special == Special::clear_error) {
    // To this motor no word, but a set point.
    command_ = mit::scale({0xFFFF, 0xFFF, 0xFFF, 0xFFF, 0xFFB}, twin_.ranges);
  }
}

void CubemarsTwin::on_tick(Time now, std::span<Shaft> shafts, TwinFrames&) {
  const double dt_s = last_tick_ == kNever ? 0.0 : to_s(now - last_tick_);
  last_tick_ = now;
  if (powered_ && !booted_ && now >= (boot_at_ == kNever ? now : boot_at_)) {
    booted_ = true;
    command_ = {};
    last_fed_ = now;
  }
  if (twin_.timeout_ms > 0 && to_s(now - last_fed_) * 1000 > twin_.timeout_ms) command_ = {};
  motor_.move(dt_s, booted_ && on_, command_, shafts.front());
}

}  // namespace drover::cubemars_mit
