#include "mission/wire_damiao.h"

#include <algorithm>

namespace drover::mission::damiao {
namespace {

constexpr std::uint32_t kFirst = 1;
constexpr std::uint32_t kLast = 3;
constexpr std::uint32_t kAnswers = 0x10;  // more than the id
constexpr std::uint32_t kRegisters = 0x7FF;

/// FF seven times, and then a word.
bool is_special(const CanFrame& frame) {
  return std::all_of(frame.data.begin(), frame.data.begin() + 7,
                     [](std::uint8_t byte) { return byte == 0xFF; });
}

bool is_one_of(std::uint8_t value, std::initializer_list<int> all) {
  return std::find(all.begin(), all.end(), value) != all.end();
}

/// Nothing is stored, and of what stands in its memory only the time-out is written.
bool may_be_asked(const CanFrame& frame) {
  const std::uint8_t word = frame.data[2];
  const std::uint8_t number = frame.data[3];
  const bool one_of_ours = frame.data[0] >= kFirst && frame.data[0] <= kLast && frame.data[1] == 0;
  if (word == 0xCC) return one_of_ours;
  if (word == 0x33) return one_of_ours && is_one_of(number, {9, 10, 21, 22, 23});
  return word == 0x55 && one_of_ours && number == 9;
}

}  // namespace

std::string forbidden(const CanFrame& frame) {
  if (frame.extended || frame.remote || frame.fd || frame.len != 8)
    return "no frame of eight bytes with eleven bits of id";
  if (frame.id >= kFirst + kAnswers && frame.id <= kLast + kAnswers) return "";
  if (frame.id == kRegisters)
    return may_be_asked(frame) ? "" : "asks a motor for something that a gateway may not";
  if (frame.id < kFirst || frame.id > kLast) return "an id of nobody on this bus";
  if (!is_special(frame)) return "";  // a set point
  return is_one_of(frame.data[7], {0xFB, 0xFC, 0xFD}) ? "" : "moves a motor's zero";
}

}  // namespace drover::mission::damiao
