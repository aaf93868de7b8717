// Frame ids are node << 5 | command; all values are little endian.
#include "mission/wire.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

namespace drover::mission {
namespace {

constexpr std::uint8_t kHeartbeat = 0x01;
constexpr std::uint8_t kError = 0x03;
constexpr std::uint8_t kAxisState = 0x07;
constexpr std::uint8_t kEstimates = 0x09;
constexpr std::uint8_t kControllerMode = 0x0B;
constexpr std::uint8_t kInputVel = 0x0D;
constexpr std::uint8_t kTemperature = 0x15;
constexpr std::uint8_t kSupply = 0x17;
constexpr std::uint8_t kClearErrors = 0x18;
constexpr std::uint8_t kTorques = 0x1C;

std::uint32_t word(const CanFrame& frame, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i > 0; --i) value = value << 8U | frame.data[at + i - 1];
  return value;
}

bool one_of(std::uint8_t command, std::initializer_list<std::uint8_t> commands) {
  return std::find(commands.begin(), commands.end(), command) != commands.end();
}

std::string judge_command(std::uint8_t command, const CanFrame& frame) {
  switch (command) {
    case kInputVel: {
      const auto wheel = wheel_command(frame);
      if (!wheel) return "a set point of another length";
      if (!std::isfinite(wheel->velocity_turnps)) return "a velocity that is not finite";
      if (wheel->torque_Nm != 0.0F) return "a torque";
      return {};
    }
    case kAxisState:
      if (frame.len != 4) return "an axis state of another length";
      if (word(frame, 0) != 1 && word(frame, 0) != 8) return "neither idle nor closed loop";
      return {};
    case kControllerMode:
      if (frame.len != 8) return "a controller mode of another length";
      if (word(frame, 0) != 2 || word(frame, 4) != 1) return "another mode than velocity";
      return {};
    case kClearErrors:
      return frame.len == 1 && frame.data[0] == 0 ? std::string{} : "an odd clear errors";
    default: return "a command off the list";
  }
}

}  // namespace

std::optional<WheelCommand> wheel_command(const CanFrame& frame) {
  if (frame.extended || frame.remote || frame.error || frame.fd) return std::nullopt;
  if ((frame.id & 0x1FU) != kInputVel || frame.len != 8) return std::nullopt;
  WheelCommand command;
  command.node = static_cast<std::uint8_t>(frame.id >> 5U);
  command.velocity_turnps = std::bit_cast<float>(word(frame, 0));
  command.torque_Nm = std::bit_cast<float>(word(frame, 4));
  return command;
}

std::string forbidden(const CanFrame& frame) {
  if (frame.error) return "an error frame";
  if (frame.extended || frame.fd) return "no plain 11-bit frame";
  const auto node = static_cast<std::uint8_t>(frame.id >> 5U);
  const auto command = static_cast<std::uint8_t>(frame.id & 0x1FU);
  if (node < kFirstNode || node > kLastNode) return "no node of this robot";
  if (frame.remote) {
    if (frame.len != 0) return "a poll with a length";
    return one_of(command, {kError, kTorques, kTemperature, kSupply}) ? std::string{}
                                                                      : "a poll off the list";
  }
  const bool told =
      one_of(command, {kHeartbeat, kEstimates, kError, kTorques, kTemperature, kSupply});
  if (told) return frame.len == 8 ? std::string{} : "a drive's frame of another length";
  return judge_command(command, frame);
}

}  // namespace drover::mission
