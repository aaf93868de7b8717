#include "drivers/robomaster_c620/codec.h"

#include "drover/bytes.h"

namespace drover::robomaster {
namespace {

constexpr std::uint8_t kLength = 8;

bool is(const CanFrame& frame, std::uint32_t id) {
  return frame.is_plain() && frame.id == id && frame.len == kLength;
}

/// The high byte first.
void store(CanFrame& frame, std::size_t at, std::uint16_t word) {
  frame.data[at] = high_byte(word);
  frame.data[at + 1] = low_byte(word);
}

}  // namespace

CanFrame encode_currents(std::uint32_t command_id, const Currents& currents) {
  CanFrame frame = make_frame(command_id);
  frame.len = kLength;
  for (std::size_t i = 0; i < kMotors; ++i)
    store(frame, 2 * i, static_cast<std::uint16_t>(currents[i]));
  return frame;
}

std::optional<Currents> decode_currents(const CanFrame& frame, std::uint32_t command_id) {
  if (!is(frame, command_id)) return {};
  Currents currents{};
  for (std::size_t i = 0; i < kMotors; ++i) currents[i] = load_be<std::int16_t>(frame.data, 2 * i);
  return currents;
}

CanFrame encode_feedback(int motor, const Feedback& feedback) {
  CanFrame frame = make_frame(kFeedback + static_cast<std::uint32_t>(motor));
  frame.len = kLength;
  store(frame, 0, feedback.angle);
  store(frame, 2, static_cast<std::uint16_t>(feedback.rpm));
  store(frame, 4, static_cast<std::uint16_t>(feedback.current));
  frame.data[6] = feedback.degC;
  return frame;
}

std::optional<Feedback> decode_feedback(const CanFrame& frame, int motor) {
  if (!is(frame, kFeedback + static_cast<std::uint32_t>(motor))) return {};
  Feedback feedback;
  feedback.angle = load_be<std::uint16_t>(frame.data, 0);
  feedback.rpm = load_be<std::int16_t>(frame.data, 2);
  feedback.current = load_be<std::int16_t>(frame.data, 4);
  feedback.degC = frame.data[6];
  if (feedback.angle >= kAnglesPerTurn) return {};
  return feedback;
}

}  // namespace drover::robomaster
