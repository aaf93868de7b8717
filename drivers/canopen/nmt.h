// Network management and heartbeats of CANopen nodes.
// Source: CiA 301, sections 7.2.8.2 and 7.2.8.3.
#pragma once

#include <cstdint>
#include <optional>

#include "drover/can_frame.h"

namespace drover::canopen {

/// Nodes have 1 to 127; 0 means every node at once.
inline constexpr std::uint8_t kLastNode = 127;

enum class NmtCommand : std::uint8_t {
  operational = 0x01,
  stop = 0x02,  ///< of communication: it does not promise that a motor stops
  pre_operational = 0x80,
  reset_node = 0x81,
  reset_communication = 0x82,
};

enum class NodeState : std::uint8_t {
  boot_up = 0x00,  ///< it has just started: what was set before is gone
  stopped = 0x04,
  operational = 0x05,
  pre_operational = 0x7F,
};

struct Heartbeat {
  std::uint8_t node = 0;
  NodeState state = NodeState::boot_up;
};

/// For one node, 1 to 127. Id 000 with node 0 would command every device of the bus, so nothing
/// here makes such a frame: an impossible node gives none.
std::optional<CanFrame> encode_nmt(NmtCommand command, std::uint8_t node);

/// What a gateway sends so that nodes can watch it.
CanFrame encode_heartbeat(std::uint8_t node, NodeState state);

/// Of any node. Nothing for other frames, and for states that CiA 301 does not know.
std::optional<Heartbeat> decode_heartbeat(const CanFrame& frame);

}  // namespace drover::canopen
