// The allow-list of an ODrive axis.
#include "drivers/odrive/rules.h"

#include <algorithm>

namespace drover::odrive {
namespace {

// Errors first: `error_commands` is the head of each list.
constexpr std::uint8_t kPolled_0_6[] = {cmd::kError, cmd::kTorques, cmd::kTemperature, cmd::kBus};
constexpr std::uint8_t kPolled_0_5[] = {cmd::kError, cmd::kEncoderError, cmd::kControllerError,
                                        cmd::kIq, cmd::kBus};

FrameEffect effect_of_sdo(const CanFrame& frame, const Settings& settings) {
  if (!settings.sets_watchdog()) return FrameEffect::forbidden;
  const auto timeout_s = static_cast<float>(settings.watchdog_timeout_s);
  const CanFrame allowed[] = {
      encode_sdo_read(settings.node, settings.watchdog_enable_endpoint),
      encode_sdo_read(settings.node, settings.watchdog_timeout_endpoint),
      encode_sdo_write_bool(settings.node, settings.watchdog_enable_endpoint, true),
      encode_sdo_write_float(settings.node, settings.watchdog_timeout_endpoint, timeout_s),
  };
  const bool known = std::find(std::begin(allowed), std::end(allowed), frame) != std::end(allowed);
  return known ? FrameEffect::harmless : FrameEffect::forbidden;
}

}  // namespace

std::span<const std::uint8_t> polled_commands(Firmware firmware) {
  if (firmware == Firmware::v0_6) return kPolled_0_6;
  return kPolled_0_5;
}

std::span<const std::uint8_t> error_commands(Firmware firmware) {
  return polled_commands(firmware).first(firmware == Firmware::v0_6 ? 1 : 3);
}

RuleList rules_of(const Settings& settings) {
  RuleList rules;
  const auto add = [&](std::uint8_t command, std::uint8_t min_len, std::uint8_t max_len,
                       bool remote) {
    FrameRule rule;
    rule.id = frame_id(settings.node, command);
    rule.remote = remote;
    rule.min_len = min_len;
    rule.max_len = max_len;
    static_cast<void>(rules.push_back(rule));
  };
  add(cmd::kSetAxisState, 4, 4, false);
  add(cmd::kSetControllerMode, 8, 8, false);
  add(cmd::kSetInputVel, 8, 8, false);
  add(cmd::kClearErrors, 1, 1, false);
  if (settings.sets_watchdog()) add(cmd::kRxSdo, 4, 8, false);
  for (const std::uint8_t command : polled_commands(settings.firmware)) add(command, 0, 0, true);
  return rules;
}

FrameEffect effect(const CanFrame& frame, const Settings& settings) {
  if (!belongs_to(frame, settings.node)) return FrameEffect::forbidden;
  const std::uint8_t command = command_of(frame.id);
  if (frame.remote) {
    const auto polled = polled_commands(settings.firmware);
    const bool known = std::find(polled.begin(), polled.end(), command) != polled.end();
    return known && frame.len == 0 ? FrameEffect::harmless : FrameEffect::forbidden;
  }
  switch (command) {
    case cmd::kSetInputVel:
      if (frame.len != 8) return FrameEffect::forbidden;
      // NaN compares unequal to zero and so counts as motion.
      return read_float(frame, 0) == 0.0F && read_float(frame, 4) == 0.0F ? FrameEffect::stop
                                                                          : FrameEffect::motion;
    case cmd::kSetAxisState:
      if (frame.len != 4) return FrameEffect::forbidden;
      if (read_u32(frame, 0) == kStateIdle) return FrameEffect::stop;
      if (read_u32(frame, 0) == kStateClosedLoop) return FrameEffect::harmless;
      return FrameEffect::forbidden;
    case cmd::kSetControllerMode:
      return frame == encode_set_controller_mode(settings.node, kControlVelocity, kInputPassthrough)
                 ? FrameEffect::harmless
                 : FrameEffect::forbidden;
    case cmd::kClearErrors:
      return frame == encode_clear_errors(settings.node) ? FrameEffect::harmless
                                                         : FrameEffect::forbidden;
    case cmd::kRxSdo: return effect_of_sdo(frame, settings);
    default: return FrameEffect::forbidden;
  }
}

}  // namespace drover::odrive
