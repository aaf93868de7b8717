// Emergency messages of CANopen nodes.
// Source: CiA 301, section 7.2.7.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "drover/can_frame.h"

namespace drover::canopen {

/// It is sent once, when something changes: who missed it learns of the error from the statusword.
struct Emergency {
  std::uint16_t code = 0;           ///< 0: the errors are gone
  std::uint8_t error_register = 0;  ///< object 1001
  std::array<std::uint8_t, 5> makers{};
  bool is_reset() const { return code == 0; }
};

/// Nothing for frames that are not this node's emergency message.
std::optional<Emergency> decode_emergency(const CanFrame& frame, std::uint8_t node);

/// In words: the code's own meaning where CiA 301 or 402 gives one, else its class.
std::string_view emergency_text(std::uint16_t code);

}  // namespace drover::canopen
