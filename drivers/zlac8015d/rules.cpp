#include "drivers/zlac8015d/rules.h"

#include <algorithm>

#include "drivers/canopen/nmt.h"
#include "drover/bytes.h"

namespace drover::zlac8015d {
namespace {

constexpr std::uint8_t kSdoAbort = 0x80;
constexpr Effect kHarmless{FrameEffect::harmless, 0};
constexpr Effect kStop{FrameEffect::stop, 0};
constexpr Effect kForbidden{};

Effect effect_of_speeds(const Pair& target) {
  const auto moves = static_cast<ChannelMask>((target[kLeft] != 0 ? channel_bit(kLeft) : 0) |
                                              (target[kRight] != 0 ? channel_bit(kRight) : 0));
  return moves == 0 ? kStop : Effect{FrameEffect::motion, moves};
}

Effect effect_of_controlword(std::uint16_t controlword, const Pair& target) {
  switch (controlword) {
    case canopen::kDisableVoltage:
    case canopen::kQuickStop: return kStop;
    case canopen::kShutdown:
    case canopen::kSwitchOn:
    case canopen::kFaultReset: return kHarmless;
    case canopen::kEnableOperation: {
      const Effect speeds = effect_of_speeds(target);
      return speeds.kind == FrameEffect::motion ? speeds : kHarmless;
    }
    default: return kForbidden;
  }
}

Effect effect_of_sdo(const CanFrame& frame, const Settings& settings, const StepList& steps) {
  if (frame.data[0] == kSdoAbort) return kHarmless;
  const canopen::Object object{load_le<std::uint16_t>(frame.data, 1), frame.data[3]};
  if (frame.data[0] == kSdoRead)
    return frame == canopen::encode_sdo_read(settings.node, object) ? kHarmless : kForbidden;
  const auto* const step =
      std::find_if(steps.begin(), steps.end(), [&](const canopen::SdoStep& each) {
        return frame == canopen::encode_sdo_write(settings.node, each.object, each.value);
      });
  if (step == steps.end()) return kForbidden;
  return object.index == canopen::kTargetVelocity ? kStop : kHarmless;
}

}  // namespace

RuleList rules_of(const Settings& settings) {
  RuleList rules;
  const auto add = [&](Cob cob, std::uint8_t len) {
    FrameRule rule;
    rule.id = id_of(cob, settings.node);
    rule.min_len = rule.max_len = len;
    rule.shared = cob == Cob::nmt;
    static_cast<void>(rules.push_back(rule));
  };
  add(Cob::nmt, 2);
  add(Cob::controlword, 2);
  add(Cob::targets, 8);
  add(Cob::sdo_request, 8);
  return rules;
}

Effect effect(const CanFrame& frame, const Settings& settings, const StepList& steps,
              const Pair& target) {
  if (frame == canopen::encode_nmt(canopen::NmtCommand::operational, settings.node))
    return kHarmless;
  if (const auto controlword = decode_controlword(frame, settings.node))
    return effect_of_controlword(*controlword, target);
  if (const auto speeds = decode_pair(frame, Cob::targets, settings.node))
    return effect_of_speeds(*speeds);
  const bool sdo =
      frame.id == id_of(Cob::sdo_request, settings.node) && frame.len == 8 && frame.is_plain();
  return sdo ? effect_of_sdo(frame, settings, steps) : kForbidden;
}

}  // namespace drover::zlac8015d
