#include "drivers/canopen/sdo.h"

#include "drover/bytes.h"

namespace drover::canopen {
namespace {

constexpr std::uint32_t kRequestBase = 0x600;
constexpr std::uint32_t kAnswerBase = 0x580;

constexpr std::uint8_t kRead = 0x40;
constexpr std::uint8_t kSegmentRequest = 0x60;
constexpr std::uint8_t kToggle = 0x10;
constexpr std::uint8_t kAbort = 0x80;

struct AbortCode {
  std::uint32_t code;
  std::string_view text;
};

constexpr AbortCode kAbortCodes[] = {
    {kAbortToggle, "toggle bit not alternated"},
    {kAbortTimeout, "no answer in time"},
    {kAbortCommand, "unknown command"},
    {kAbortMemory, "out of memory"},
    {0x06010000, "unsupported access"},
    {0x06010001, "can only be written"},
    {0x06010002, "can only be read"},
    {0x06020000, "no such object"},
    {0x06040041, "cannot be mapped to a PDO"},
    {0x06040042, "more than fits into a PDO"},
    {0x06040043, "parameters do not agree"},
    {0x06040047, "does not agree inside the device"},
    {0x06060000, "hardware error"},
    {kAbortLength, "wrong length"},
    {0x06070012, "too long"},
    {0x06070013, "too short"},
    {0x06090011, "no such subindex"},
    {0x06090030, "invalid value"},
    {0x06090031, "value too high"},
    {0x06090032, "value too low"},
    {0x06090036, "maximum below minimum"},
    {0x060A0023, "resource not available"},
    {0x08000000, "general error"},
    {0x08000020, "cannot be stored"},
    {0x08000021, "under local control"},
    {0x08000022, "not in this state of the device"},
    {0x08000023, "no object dictionary"},
    {0x08000024, "no data"},
};

CanFrame request(std::uint8_t node, std::uint8_t command, Object object, std::uint32_t value = 0) {
  CanFrame frame = make_frame(kRequestBase + node, {command});
  frame.len = 8;
  store_le(frame.data, 1, object.index);
  frame.data[3] = object.sub;
  store_le(frame.data, 4, value);
  return frame;
}

/// Command byte 0 1 0 x n n e s: how many bytes follow at once, or how many will in segments.
std::optional<SdoAnswer> decode_value(const CanFrame& frame, SdoAnswer answer) {
  const std::uint8_t command = frame.data[0];
  const bool expedited = (command & 0x02U) != 0;
  const bool tells_size = (command & 0x01U) != 0;
  if (!expedited) {
    if (tells_size && frame.len < 8) return {};
    answer.kind = SdoAnswer::Kind::segmented;
    if (tells_size) answer.size = load_le<std::uint32_t>(frame.data, 4);
    return answer;
  }
  answer.kind = SdoAnswer::Kind::value;
  const std::size_t there = frame.len - 4U;
  const std::size_t size = tells_size ? 4U - ((command >> 2U) & 0x03U) : there;
  if (size > there || size == 0) return {};
  for (std::size_t i = 0; i < size; ++i)
    static_cast<void>(answer.data.push_back(frame.data[4 + i]));
  return answer;
}

/// Command byte 0 0 0 t n n n c, then seven bytes of which the last n mean nothing.
std::optional<SdoAnswer> decode_segment(const CanFrame& frame) {
  const std::uint8_t command = frame.data[0];
  SdoAnswer answer;
  answer.kind = SdoAnswer::Kind::segment;
  answer.toggle = (command & kToggle) != 0;
  answer.last = (command & 0x01U) != 0;
  const std::size_t size = 7U - ((command >> 1U) & 0x07U);
  if (frame.len < 1 + size) return {};
  for (std::size_t i = 0; i < size; ++i)
    static_cast<void>(answer.data.push_back(frame.data[1 + i]));
  return answer;
}

}  // namespace

std::string_view abort_text(std::uint32_t code) {
  for (const auto& known : kAbortCodes)
    if (known.code == code) return known.text;
  return "refused with a code of the maker's own";
}

CanFrame encode_sdo_read(std::uint8_t node, Object object) {
  return request(node, kRead, object);
}

CanFrame encode_sdo_write(std::uint8_t node, Object object, SdoNumber value) {
  // 0 0 1 0 n n 1 1: expedited, n of the four bytes unused.
  const auto unused = static_cast<std::uint8_t>(4U - value.size);
  return request(node, static_cast<std::uint8_t>(0x23U | unused << 2U), object, value.bits);
}

CanFrame encode_sdo_segment_request(std::uint8_t node, bool toggle) {
  const auto command = static_cast<std::uint8_t>(kSegmentRequest | (toggle ? kToggle : 0U));
  return request(node, command, {});
}

CanFrame encode_sdo_abort(std::uint8_t node, Object object, std::uint32_t code) {
  return request(node, kAbort, object, code);
}

std::optional<SdoAnswer> decode_sdo_answer(const CanFrame& frame, std::uint8_t node) {
  if (!frame.is_plain()) return {};
  if (frame.id != kAnswerBase + node || frame.len == 0 || frame.len > 8) return {};
  const std::uint8_t command = frame.data[0];
  if ((command & 0xE0U) == 0x00U) return decode_segment(frame);
  if (frame.len < 4) return {};
  SdoAnswer answer;
  answer.object = {load_le<std::uint16_t>(frame.data, 1), frame.data[3]};
  if (command == 0x60U) return answer;
  if ((command & 0xE0U) == 0x40U) return decode_value(frame, answer);
  if (command == kAbort && frame.len == 8) {
    answer.kind = SdoAnswer::Kind::abort;
    answer.code = load_le<std::uint32_t>(frame.data, 4);
    return answer;
  }
  return {};
}

}  // namespace drover::canopen
