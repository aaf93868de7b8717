// Between CanFrame and the kernel's struct can_frame / canfd_frame.
#pragma once

#include <linux/can.h>

#include <cstring>

#include "drover/can_frame.h"

namespace drover::link {

/// Bytes that go to the descriptor for this frame: CAN_MTU or CANFD_MTU.
inline std::size_t to_wire(const CanFrame& frame, canfd_frame& wire) {
  std::memset(&wire, 0, sizeof wire);
  wire.can_id =
      frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U);
  wire.len = frame.len;
  if (!frame.remote) std::memcpy(wire.data, frame.data.data(), frame.len);
  return frame.fd ? CANFD_MTU : CAN_MTU;
}

/// False when `size` bytes at `wire` are no frame.
inline bool from_wire(const canfd_frame& wire, std::size_t size, CanFrame& frame) {
  if (size != CAN_MTU && size != CANFD_MTU) return false;
  frame.fd = size == CANFD_MTU;
  if (wire.len > (frame.fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN)) return false;
  frame.error = (wire.can_id & CAN_ERR_FLAG) != 0;
  frame.extended = !frame.error && (wire.can_id & CAN_EFF_FLAG) != 0;
  frame.remote = !frame.error && (wire.can_id & CAN_RTR_FLAG) != 0;
  frame.id = wire.can_id & (frame.error      ? CAN_ERR_MASK
                            : frame.extended ? CAN_EFF_MASK
                                             : CAN_SFF_MASK);
  frame.len = wire.len;
  if (frame.remote) return true;
  if (frame.len == CAN_MAX_DLEN) {  // most are: without a call
    std::memcpy(frame.data.data(), wire.data, CAN_MAX_DLEN);
  } else {
    std::memcpy(frame.data.data(), wire.data, frame.len);
  }
  return true;
}

}  // namespace drover::link
