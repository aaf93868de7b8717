#include "drivers/mit/frame.h"

#include <algorithm>
#include <cmath>

namespace drover::mit {
namespace {

constexpr std::uint16_t kEnd16 = 0xFFFF;
constexpr std::uint16_t kEnd12 = 0xFFF;
constexpr std::uint16_t kMiddle12 = 0x7FF;
/// One step below the end.
constexpr std::uint16_t kGainEnd = 0xFFE;

/// Truncated, as the maker's library has it.
std::uint16_t to_raw(double value, double min, double max, std::uint16_t end) {
  if (!std::isfinite(value)) value = 0;
  const double share = (std::clamp(value, min, max) - min) / (max - min);
  return static_cast<std::uint16_t>(share * end);
}

double from_raw(std::uint16_t raw, double min, double max, std::uint16_t end) {
  return static_cast<double>(raw) * (max - min) / end + min;
}

/// Of a symmetric range: the two steps beside its middle are zero.
bool is_zero12(std::uint16_t raw) {
  return raw == kMiddle12 || raw == kMiddle12 + 1;
}

double symmetric12(std::uint16_t raw, double max) {
  return is_zero12(raw) ? 0 : from_raw(raw, -max, max, kEnd12);
}

std::uint8_t low(unsigned value) {
  return static_cast<std::uint8_t>(value & 0xFFU);
}

bool is_whole(const CanFrame& frame, std::uint32_t id) {
  return frame.is_plain() && frame.id == id && frame.len == 8;
}

}  // namespace

CanFrame encode_mit(std::uint8_t id, const MitCommand& command, const Ranges& ranges) {
  const unsigned p = to_raw(command.position_rad, -ranges.p_max_rad, ranges.p_max_rad, kEnd16);
  const unsigned v =
      to_raw(command.velocity_radps, -ranges.v_max_radps, ranges.v_max_radps, kEnd12);
  const unsigned kp =
      std::min(to_raw(command.stiffness_Nmprad, 0, kStiffnessMax_Nmprad, kEnd12), kGainEnd);
  const unsigned kd =
      std::min(to_raw(command.damping_Nmsprad, 0, kDampingMax_Nmsprad, kEnd12), kGainEnd);
  const unsigned t = to_raw(command.torque_Nm, -ranges.t_max_Nm, ranges.t_max_Nm, kEnd12);
  return make_frame(id, {low(p >> 8U), low(p), low(v >> 4U), low((v & 0xFU) << 4U | kp >> 8U),
                         low(kp), low(kd >> 4U), low((kd & 0xFU) << 4U | t >> 8U), low(t)});
}

CanFrame encode_special(std::uint8_t id, Special special) {
  return make_frame(id,
                    {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, static_cast<std::uint8_t>(special)});
}

std::optional<Special> decode_special(const CanFrame& frame, std::uint8_t id) {
  if (!is_whole(frame, id)) return std::nullopt;
  const auto head = frame.payload().first(7);
  if (std::any_of(head.begin(), head.end(), [](auto byte) { return byte != 0xFF; }))
    return std::nullopt;
  const std::uint8_t last = frame.data[7];
  if (last < static_cast<std::uint8_t>(Special::clear_error) ||
      last > static_cast<std::uint8_t>(Special::set_zero))
    return std::nullopt;
  return static_cast<Special>(last);
}

std::optional<MitRaw> decode_mit_raw(const CanFrame& frame, std::uint8_t id) {
  if (!is_whole(frame, id) || decode_special(frame, id)) return std::nullopt;
  const auto word = [&](std::size_t at) { return static_cast<unsigned>(frame.data[at]); };
  MitRaw raw;
  raw.position = static_cast<std::uint16_t>(word(0) << 8U | word(1));
  raw.velocity = static_cast<std::uint16_t>(word(2) << 4U | word(3) >> 4U);
  raw.stiffness = static_cast<std::uint16_t>((word(3) & 0xFU) << 8U | word(4));
  raw.damping = static_cast<std::uint16_t>(word(5) << 4U | word(6) >> 4U);
  raw.torque = static_cast<std::uint16_t>((word(6) & 0xFU) << 8U | word(7));
  return raw;
}

MitCommand scale(const MitRaw& raw, const Ranges& ranges) {
  MitCommand command;
  command.position_rad = from_raw(raw.position, -ranges.p_max_rad, ranges.p_max_rad, kEnd16);
  command.velocity_radps = symmetric12(raw.velocity, ranges.v_max_radps);
  command.stiffness_Nmprad = from_raw(raw.stiffness, 0, kStiffnessMax_Nmprad, kEnd12);
  command.damping_Nmsprad = from_raw(raw.damping, 0, kDampingMax_Nmsprad, kEnd12);
  command.torque_Nm = symmetric12(raw.torque, ranges.t_max_Nm);
  return command;
}

bool only_damps(const MitRaw& raw) {
  return raw.stiffness == 0 && is_zero12(raw.torque) && is_zero12(raw.velocity);
}

Motion decode_motion(std::span<const std::uint8_t, kMotionBytes> bytes, const Ranges& ranges) {
  const auto word = [&](std::size_t at) { return static_cast<unsigned>(bytes[at]); };
  Motion motion;
  motion.position_rad = from_raw(static_cast<std::uint16_t>(word(0) << 8U | word(1)),
                                 -ranges.p_max_rad, ranges.p_max_rad, kEnd16);
  motion.velocity_radps =
      symmetric12(static_cast<std::uint16_t>(word(2) << 4U | word(3) >> 4U), ranges.v_max_radps);
  motion.torque_Nm =
      symmetric12(static_cast<std::uint16_t>((word(3) & 0xFU) << 8U | word(4)), ranges.t_max_Nm);
  return motion;
}

void encode_motion(const Motion& motion, const Ranges& ranges,
                   std::span<std::uint8_t, kMotionBytes> bytes) {
  const unsigned p = to_raw(motion.position_rad, -ranges.p_max_rad, ranges.p_max_rad, kEnd16);
  const unsigned v = to_raw(motion.velocity_radps, -ranges.v_max_radps, ranges.v_max_radps, kEnd12);
  const unsigned t = to_raw(motion.torque_Nm, -ranges.t_max_Nm, ranges.t_max_Nm, kEnd12);
  bytes[0] = low(p >> 8U);
  bytes[1] = low(p);
  bytes[2] = low(v >> 4U);
  bytes[3] = low((v & 0xFU) << 4U | t >> 8U);
  bytes[4] = low(t);
}

}  // namespace drover::mit
