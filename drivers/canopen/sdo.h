// Service data objects: one value of a node's dictionary, read or written with confirmation.
// Source: CiA 301, section 7.2.4. Expedited transfers both ways, segmented ones for reading: no
// drive needs a longer write.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "drover/can_frame.h"
#include "drover/fixed_vector.h"

namespace drover::canopen {

/// A place in a node's object dictionary.
struct Object {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  friend bool operator==(const Object&, const Object&) = default;
};

/// Abort codes that a client sends itself.
inline constexpr std::uint32_t kAbortToggle = 0x05030000;
inline constexpr std::uint32_t kAbortTimeout = 0x05040000;
inline constexpr std::uint32_t kAbortCommand = 0x05040001;
inline constexpr std::uint32_t kAbortMemory = 0x05040005;
inline constexpr std::uint32_t kAbortLength = 0x06070010;

/// In words; of an unknown code a sentence that says so.
std::string_view abort_text(std::uint32_t code);

/// A number of 1, 2 or 4 bytes as objects hold it; the sign is the object's affair.
struct SdoNumber {
  std::uint32_t bits = 0;
  std::uint8_t size = 4;
  friend bool operator==(const SdoNumber&, const SdoNumber&) = default;
};
constexpr SdoNumber u8(std::uint8_t value) {
  return {value, 1};
}
constexpr SdoNumber u16(std::uint16_t value) {
  return {value, 2};
}
constexpr SdoNumber u32(std::uint32_t value) {
  return {value, 4};
}
constexpr SdoNumber i32(std::int32_t value) {
  return {static_cast<std::uint32_t>(value), 4};
}

CanFrame encode_sdo_read(std::uint8_t node, Object object);
CanFrame encode_sdo_write(std::uint8_t node, Object object, SdoNumber value);
CanFrame encode_sdo_segment_request(std::uint8_t node, bool toggle);
CanFrame encode_sdo_abort(std::uint8_t node, Object object, std::uint32_t code);

/// What a server answers. `object` is only in those that name one.
struct SdoAnswer {
  enum class Kind : std::uint8_t {
    written,    ///< the write was taken
    value,      ///< expedited: `data`
    segmented,  ///< the value follows in segments, of `size` bytes where it tells
    segment,    ///< `data`, `toggle`, `last`
    abort,      ///< refused: `code`
  };
  Kind kind = Kind::written;
  Object object;
  FixedVector<std::uint8_t, 7> data;
  std::optional<std::uint32_t> size;
  bool toggle = false;
  bool last = false;
  std::uint32_t code = 0;
};

/// Nothing for frames that are not this node's, or no answer that a client knows. Servers that
/// leave out the bytes they do not need are understood.
std::optional<SdoAnswer> decode_sdo_answer(const CanFrame& frame, std::uint8_t node);

}  // namespace drover::canopen
