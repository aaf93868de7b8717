// What leaves towards something that moves: a CAN frame, or one whole packet of a byte stream.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drover/can_frame.h"
#include "drover/fixed_vector.h"

namespace drover {

/// The longest packet: as many bytes as the longest frame of its link takes on the way to the
/// guard, less one.
inline constexpr std::size_t kMaxPacket = 71;

/// With its head and its checksum: what a device takes or refuses as one.
using Packet = FixedVector<std::uint8_t, kMaxPacket>;

/// A view of one of both, good for the call.
class Message {
 public:
  Message(const CanFrame& frame) : frame_(&frame) {}
  Message(const Packet& packet) : packet_(&packet) {}
  /// nullptr: it is a packet.
  const CanFrame* frame() const { return frame_; }
  /// nullptr: it is a frame.
  const Packet* packet() const { return packet_; }
  std::span<const std::uint8_t> payload() const {
    if (frame_ != nullptr) return frame_->payload();
    return {packet_->data(), packet_->size()};
  }

 private:
  const CanFrame* frame_ = nullptr;
  const Packet* packet_ = nullptr;
};

}  // namespace drover
