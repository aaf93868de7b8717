#include "drivers/cia402/rules.h"

#include <algorithm>

#include "drivers/canopen/nmt.h"
#include "drover/bytes.h"

namespace drover::cia402 {
namespace {

constexpr Effect kHarmless{FrameEffect::harmless, 0};
constexpr Effect kStop{FrameEffect::stop, 0};
constexpr Effect kForbidden{};

Effect effect_of_command(const Command& command) {
  const bool enables = command.controlword == canopen::kEnableOperation;
  if (command.target != 0)
    return enables ? Effect{FrameEffect::motion, channel_bit(0)} : kForbidden;
  switch (command.controlword) {
    case canopen::kEnableOperation:
    case canopen::kDisableVoltage:
    case canopen::kQuickStop: return kStop;
    case canopen::kShutdown:
    case canopen::kSwitchOn:
    case canopen::kFaultReset: return kHarmless;
    default: return kForbidden;
  }
}

Effect effect_of_sdo(const CanFrame& frame, const Settings& settings, const StepList& steps) {
  const canopen::Object object{load_le<std::uint16_t>(frame.data, 1), frame.data[3]};
  const bool abort = frame.data[0] == 0x80;
  if (abort || frame == canopen::encode_sdo_read(settings.node, object)) return kHarmless;
  const bool listed = std::any_of(steps.begin(), steps.end(), [&](const canopen::SdoStep& each) {
    return frame == canopen::encode_sdo_write(settings.node, each.object, each.value);
  });
  if (!listed) return kForbidden;
  return object.index == canopen::kTargetVelocity ? kStop : kHarmless;
}

}  // namespace

RuleList rules_of(const Settings& settings) {
  RuleList rules;
  const auto add = [&](std::uint32_t id, std::uint8_t len, bool shared) {
    FrameRule rule;
    rule.id = id;
    rule.min_len = rule.max_len = len;
    rule.shared = shared;
    static_cast<void>(rules.push_back(rule));
  };
  add(0, 2, true);
  add(id_of(Cob::command, settings.node), 6, false);
  add(id_of(Cob::sdo_request, settings.node), 8, false);
  if (settings.watches()) add(id_of(Cob::heartbeat, settings.gateway_node), 1, true);
  return rules;
}

Effect effect(const CanFrame& frame, const Settings& settings, const StepList& steps) {
  if (frame == canopen::encode_nmt(canopen::NmtCommand::operational, settings.node) ||
      frame == canopen::encode_heartbeat(settings.gateway_node, canopen::NodeState::operational))
    return kHarmless;
  if (const auto command = decode_command(frame, settings.node)) return effect_of_command(*command);
  const bool sdo =
      frame.is_plain() && frame.id == id_of(Cob::sdo_request, settings.node) && frame.len == 8;
  return sdo ? effect_of_sdo(frame, settings, steps) : kForbidden;
}

}  // namespace drover::cia402
