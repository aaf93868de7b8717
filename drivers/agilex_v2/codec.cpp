#include "drivers/agilex_v2/codec.h"

#include <cmath>

#include "drivers/thousandths.h"
#include "drover/bytes.h"

namespace drover::agilex_v2 {
namespace {

constexpr std::uint8_t kWholeFrame = 8;
constexpr std::uint8_t kHunterRemote = 2;

double from_thousandths(const CanFrame& frame, std::size_t at) {
  return load_be<std::int16_t>(frame.payload(), at) * 0.001;
}

CanFrame twist_frame(std::uint32_t id, const Twist& twist) {
  const auto ahead = static_cast<std::uint16_t>(thousandths(twist.vx_mps));
  const auto left = static_cast<std::uint16_t>(thousandths(twist.wz_radps));
  return make_frame(
      id, {high_byte(ahead), low_byte(ahead), high_byte(left), low_byte(left), 0, 0, 0, 0});
}

}  // namespace

std::optional<SystemState> read_system_state(const CanFrame& frame, Model model) {
  if (frame.len != kWholeFrame || frame.data[0] > 2 || frame.data[1] > 3) return {};
  SystemState state{static_cast<Vehicle>(frame.data[0]), static_cast<Mode>(frame.data[1]),
                    load_be<std::uint16_t>(frame.payload(), 2) * 0.1,
                    load_be<std::uint16_t>(frame.payload(), 4)};
  if (model == Model::hunter) {
    // 2 is its remote control; 3 stands in one example, and is not this bus either.
    if (frame.data[1] > 1) state.mode = Mode::remote;
    state.brake_locked = frame.data[6] != 0;
  }
  return state;
}

CanFrame system_state_frame(const SystemState& state, std::uint8_t count, Model model) {
  const auto tenths_V = static_cast<std::uint16_t>(std::lround(state.battery_V * 10));
  auto mode = static_cast<std::uint8_t>(state.mode);
  if (model == Model::hunter && state.mode == Mode::remote) mode = kHunterRemote;
  const std::uint8_t brake = model == Model::hunter && state.brake_locked ? 1 : 0;
  return make_frame(kSystemStateId, {static_cast<std::uint8_t>(state.vehicle), mode,
                                     high_byte(tenths_V), low_byte(tenths_V),
                                     high_byte(state.error), low_byte(state.error), brake, count});
}

std::optional<Twist> read_motion(const CanFrame& frame) {
  if (frame.len != kWholeFrame) return {};
  return Twist{from_thousandths(frame, 0), from_thousandths(frame, 2)};
}

CanFrame motion_frame(const Twist& twist) {
  return twist_frame(kMotionId, twist);
}

CanFrame motion_command(const Twist& twist) {
  return twist_frame(kMotionCommandId, twist);
}

std::optional<Twist> read_motion_command(const CanFrame& frame) {
  if (frame.id != kMotionCommandId || frame.len != kWholeFrame) return {};
  if (load_be<std::uint32_t>(frame.payload(), 4) != 0) return {};
  return Twist{from_thousandths(frame, 0), from_thousandths(frame, 2)};
}

namespace {

CanFrame steered_frame(std::uint32_t id, const Steered& steered) {
  const auto ahead = static_cast<std::uint16_t>(thousandths(steered.speed_mps));
  const auto angle = static_cast<std::uint16_t>(thousandths(steered.inner_rad));
  return make_frame(
      id, {high_byte(ahead), low_byte(ahead), 0, 0, 0, 0, high_byte(angle), low_byte(angle)});
}

}  // namespace

CanFrame steered_command(const Steered& wanted) {
  return steered_frame(kMotionCommandId, wanted);
}

std::optional<Steered> read_steered_command(const CanFrame& frame) {
  if (frame.id != kMotionCommandId || frame.len != kWholeFrame) return {};
  if (load_be<std::uint32_t>(frame.payload(), 2) != 0) return {};
  return Steered{from_thousandths(frame, 0), from_thousandths(frame, 6)};
}

std::optional<Steered> read_steered_motion(const CanFrame& frame) {
  if (frame.len != kWholeFrame) return {};
  return Steered{from_thousandths(frame, 0), from_thousandths(frame, 6)};
}

CanFrame steered_motion_frame(const Steered& steered) {
  return steered_frame(kMotionId, steered);
}

CanFrame brake_command(bool lock) {
  return make_frame(kBrakeCommandId, {static_cast<std::uint8_t>(lock ? 1 : 0)});
}

std::optional<bool> read_brake_command(const CanFrame& frame) {
  if (frame.id != kBrakeCommandId || frame.len != 1 || frame.data[0] > 1) return {};
  return frame.data[0] == 1;
}

CanFrame mode_command(Mode mode) {
  return make_frame(kModeCommandId, {static_cast<std::uint8_t>(mode)});
}

std::optional<Mode> read_mode_command(const CanFrame& frame) {
  if (frame.id != kModeCommandId || frame.len != 1 || frame.data[0] > 1) return {};
  return static_cast<Mode>(frame.data[0]);
}

std::string_view error_text(std::uint16_t error, Model model) {
  if (model == Model::hunter) {
    // In which its two documents agree; what they tell otherwise is shown as a number.
    if ((error & 0x0001U) != 0) return "battery voltage low";
    if ((error & 0x0038U) != 0) return "one of its motors is not heard";
    return {};
  }
  // The worst first. Bits that the Scout's manual does not name mean other things on other chassis.
  if ((error & 0x0100U) != 0) return "battery voltage too low";
  if ((error & 0x0200U) != 0) return "battery voltage low";
  if ((error & 0x0400U) != 0) return "its remote control is lost";
  return {};
}

}  // namespace drover::agilex_v2
