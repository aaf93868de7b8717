#include "drivers/damiao/rules.h"

#include <algorithm>

namespace drover::damiao {
namespace {

constexpr std::uint8_t kRead[] = {reg::kPMax, reg::kVMax, reg::kTMax, reg::kMode, reg::kTimeout};

/// Exactly the requests that this driver has: all else there stores to flash, or changes what the
/// motor is.
FrameEffect effect_of_request(const CanFrame& frame, const Settings& settings) {
  const bool reads = std::any_of(std::begin(kRead), std::end(kRead), [&](std::uint8_t rid) {
    return frame == encode_read(settings.joint.id, rid);
  });
  const bool known =
      reads || frame == encode_request(settings.joint.id) ||
      frame == encode_write(settings.joint.id, reg::kTimeout, settings.timeout_raw());
  return known ? FrameEffect::harmless : FrameEffect::forbidden;
}

}  // namespace

std::span<const std::uint8_t> read_registers() {
  return kRead;
}

std::array<FrameRule, 2> rules_of(const Settings& settings) {
  return {FrameRule{.id = settings.joint.id, .min_len = 8, .max_len = 8},
          FrameRule{.id = kRequestId, .min_len = 8, .max_len = 8, .shared = true}};
}

FrameEffect effect(const CanFrame& frame, const Settings& settings) {
  if (frame.is_plain() && frame.id == kRequestId) return effect_of_request(frame, settings);
  return mit::effect(frame, settings.joint.id);
}

}  // namespace drover::damiao
