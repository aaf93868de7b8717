#include "drivers/agilex_v2/codec.h"

#include <cmath>
#include <span>

#include "drivers/thousandths.h"
#include "drover/bytes.h"

namespace drover::agilex_v2 {
namespace {

constexpr std::uint8_t kWholeFrame = 8;
constexpr std::uint8_t kHunterRemote = 2;

struct ErrorBits {
  unsigned bits;
  std::string_view text;
  unsigned hides = 0;  ///< what is less of the same
};
// The worst first. Bits that the Scout's manual does not name mean other things on other chassis.
constexpr ErrorBits kScoutErrors[] = {
    {0x0100, "battery voltage too low", 0x0200},
    {0x0200, "battery voltage low"},
    {0x0400, "its remote control is lost"},
};
// Of two documents, one of which names bits that the other does not. What they tell otherwise is
// told as both have it.
constexpr ErrorBits kHunterErrors[] = {
    {0x0001, "battery voltage low"},
    {0x0038, "one of its motors is not heard"},
    {0x4100, "a fault of its motor drives"},
    {0x0404, "its remote control is lost"},
    {0x0040, "too hot"},
    {0x0080, "over-current, or its steering's encoder"},
    {0x1000, "it lost its commands"},
    {0x0200, "it lost its commands, or its steering's encoder"},
};

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

ErrorWords error_words(std::uint16_t error, Model model) {
  const std::span<const ErrorBits> known = model == Model::hunter
                                               ? std::span<const ErrorBits>(kHunterErrors)
                                               : std::span<const ErrorBits>(kScoutErrors);
  ErrorWords words{{}, error};
  for (const ErrorBits& each : known) {
    if ((words.unnamed & each.bits) == 0) continue;
    words.unnamed &= ~(each.bits | each.hides);
    if (!words.text.empty()) words.text.append(", ");
    words.text.append(each.text);
  }
  return words;
}

}  // namespace drover::agilex_v2
