#include "drivers/canopen/nmt.h"

namespace drover::canopen {
namespace {

constexpr std::uint32_t kNmtId = 0x000;
constexpr std::uint32_t kHeartbeatBase = 0x700;

}  // namespace

std::optional<CanFrame> encode_nmt(NmtCommand command, std::uint8_t node) {
  if (node == 0 || node > kLastNode) return {};
  return make_frame(kNmtId, {static_cast<std::uint8_t>(command), node});
}

CanFrame encode_heartbeat(std::uint8_t node, NodeState state) {
  return make_frame(kHeartbeatBase + node, {static_cast<std::uint8_t>(state)});
}

std::optional<Heartbeat> decode_heartbeat(const CanFrame& frame) {
  if (!frame.is_plain() || frame.len != 1) return {};
  if (frame.id <= kHeartbeatBase || frame.id > kHeartbeatBase + kLastNode) return {};
  const auto node = static_cast<std::uint8_t>(frame.id - kHeartbeatBase);
  // Bit 7 toggles in the answers of the older node guarding; in a heartbeat it is 0.
  switch (const auto state = static_cast<NodeState>(frame.data[0] & 0x7FU)) {
    case NodeState::boot_up:
    case NodeState::stopped:
    case NodeState::operational:
    case NodeState::pre_operational: return Heartbeat{node, state};
  }
  return {};
}

}  // namespace drover::canopen
