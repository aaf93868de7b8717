#include "drivers/gt01/can/codec.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <span>

#include "drivers/thousandths.h"
#include "drover/bytes.h"

namespace drover::gt01::can {
namespace {

constexpr std::uint8_t kHead = 0x01;
constexpr std::uint8_t kTwist = 0x01;
constexpr std::uint8_t kEstop = 0x0F;
constexpr std::uint8_t kVersion = 0x31;

double thousandth(std::span<const std::uint8_t> bytes, std::size_t at) {
  return load_le<std::int16_t>(bytes, at) / 1000.0;
}
/// In the table's layout a speed whose low byte is the head reads as another command: a millimetre
/// a second less.
std::int16_t unmistakable(std::int16_t speed) {
  const bool mistaken = (static_cast<std::uint16_t>(speed) & 0xFFU) == kHead;
  return static_cast<std::int16_t>(mistaken ? speed - (speed > 0 ? 1 : -1) : speed);
}
double tenth(std::span<const std::uint8_t> bytes, std::size_t at) {
  return load_le<std::int16_t>(bytes, at) / 10.0;
}

CanFrame command(std::initializer_list<std::uint8_t> bytes, std::uint8_t size) {
  CanFrame frame;
  frame.id = kCommandId;
  frame.len = size;
  std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  return frame;
}

}  // namespace

std::optional<Report> decode(const CanFrame& frame) {
  if (!frame.is_plain()) return std::nullopt;
  const std::span<const std::uint8_t> data(frame.data.data(), frame.len);
  // The manual prints only the bytes that mean something; frames may be filled up to eight.
  const auto at_least = [&](std::size_t size) { return data.size() >= size && data.size() <= 8; };
  switch (frame.id) {
    case 0x10:
      if (!at_least(4)) return std::nullopt;
      return Motion{{thousandth(data, 0), thousandth(data, 2)}};
    case 0x11:
      if (!at_least(4)) return std::nullopt;
      return Wheels{thousandth(data, 0), thousandth(data, 2)};
    case 0x12:
      if (!at_least(4)) return std::nullopt;
      return Currents{tenth(data, 0), tenth(data, 2)};
    case 0x20:
      if (!at_least(6)) return std::nullopt;
      return State{data[0], data[1], load_le<std::uint16_t>(data, 2) / 10.0, data[4], data[5]};
    case 0x30:
      if (!at_least(4)) return std::nullopt;
      return MotorFaults{load_le<std::uint16_t>(data, 0), load_le<std::uint16_t>(data, 2)};
    case 0x41:
      if (!at_least(3)) return std::nullopt;
      return Version{data[0], data[1], data[2]};
    default: return std::nullopt;
  }
}

const char* motor_fault(unsigned bit) {
  static constexpr const char* kWords[] = {
      "undervoltage",   "position",      "Hall sensors",  "overcurrent",     "overload",
      "EEPROM",         "IGBT",          "drive too hot", "a phase is lost", "current deviates",
      "speed deviates", "motor too hot", "overvoltage",   "runs away",       "drive too hot"};
  return bit < std::size(kWords) ? kWords[bit] : "";
}

CanFrame motion(const Twist& twist, TwistLayout layout) {
  const bool head = layout == TwistLayout::example;
  CanFrame frame = head ? command({kHead, kTwist}, 8) : command({}, 8);
  const std::size_t at = head ? 2 : 0;
  const std::int16_t speed = thousandths(twist.vx_mps);
  store_le(std::span<std::uint8_t>(frame.data), at, head ? speed : unmistakable(speed));
  store_le(std::span<std::uint8_t>(frame.data), at + 2, thousandths(twist.wz_radps));
  return frame;
}

CanFrame estop(bool on) {
  return command({kHead, kEstop, on ? std::uint8_t{1} : std::uint8_t{0}}, 3);
}

CanFrame ask_version() {
  return command({kHead, kVersion}, 2);
}

std::optional<Twist> asked_twist(const CanFrame& frame, TwistLayout layout) {
  if (!frame.is_plain() || frame.id != kCommandId || frame.len != 8) return std::nullopt;
  const std::span<const std::uint8_t> data(frame.data.data(), frame.len);
  const bool head = layout == TwistLayout::example;
  if (head ? data[0] != kHead || data[1] != kTwist : data[0] == kHead) return std::nullopt;
  const std::size_t at = head ? 2 : 0;
  return Twist{thousandth(data, at), thousandth(data, at + 2)};
}

}  // namespace drover::gt01::can
