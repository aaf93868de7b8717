#include "mission/wire_damiao.h"

#include <algorithm>
#include <array>

namespace drover::mission::damiao {
namespace {

constexpr std::uint32_t kFirst = 1;
constexpr std::uint32_t kLast = 3;
constexpr std::uint32_t kAnswers = 0x10;  // more than the id
constexpr std::uint32_t kRegisters = 0x7FF;

/// At either end of a number: two DM4340 and a DM4310, whose positions all end at 12.5 rad.
struct Ends {
  double velocity_radps;
  double torque_Nm;
};
constexpr std::array<Ends, kMotors> kEnds{{{10, 28}, {10, 28}, {30, 10}}};
constexpr double kPosition_rad = 12.5;

/// A number of so many bits between -end and end. There is none for zero: what is half a step below
/// it is sent for it.
double between(unsigned raw, unsigned bits, double end) {
  const unsigned most = (1U << bits) - 1;
  return raw == most / 2 ? 0 : raw * 2 * end / most - end;
}

unsigned high_12(const CanFrame& frame, std::size_t at) {
  return frame.data[at] * 16U + frame.data[at + 1] / 16U;
}
unsigned low_12(const CanFrame& frame, std::size_t at) {
  return frame.data[at] % 16U * 256U + frame.data[at + 1];
}

bool is_plain(const CanFrame& frame) {
  return !frame.extended && !frame.remote && !frame.error && !frame.fd && frame.len == 8;
}

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

/// What it tells of a register, and no feedback.
bool is_of_register(const CanFrame& frame) {
  return frame.data[0] == frame.id - kAnswers && frame.data[1] == 0 &&
         is_one_of(frame.data[2], {0x33, 0x55});
}

}  // namespace

std::optional<SetPoint> set_point(const CanFrame& frame) {
  if (!is_plain(frame) || frame.id < kFirst || frame.id > kLast || is_special(frame))
    return std::nullopt;
  const std::size_t joint = frame.id - kFirst;
  const Ends& ends = kEnds.at(joint);
  return SetPoint{joint,
                  between(frame.data[0] * 256U + frame.data[1], 16, kPosition_rad),
                  between(high_12(frame, 2), 12, ends.velocity_radps),
                  low_12(frame, 3) * 500.0 / 4095,
                  high_12(frame, 5) * 5.0 / 4095,
                  between(low_12(frame, 6), 12, ends.torque_Nm)};
}

std::optional<Answer> answer(const CanFrame& frame) {
  if (!is_plain(frame) || frame.id < kFirst + kAnswers || frame.id > kLast + kAnswers ||
      is_of_register(frame))
    return std::nullopt;
  const std::size_t joint = frame.id - kAnswers - kFirst;
  const Ends& ends = kEnds.at(joint);
  return Answer{joint, frame.data[0] / 16,
                between(frame.data[1] * 256U + frame.data[2], 16, kPosition_rad),
                between(high_12(frame, 3), 12, ends.velocity_radps),
                between(low_12(frame, 4), 12, ends.torque_Nm)};
}

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
