#include "mission/wire_cia402.h"

#include "mission/wire_bytes.h"

namespace drover::mission::cia402 {
namespace {

constexpr std::uint32_t kManagement = 0x000;
constexpr std::uint32_t kGatewaysHeartbeat = 0x77F;
constexpr float kRpm_per_turnps = 60;
constexpr std::uint8_t kLeft = 1;
constexpr std::uint8_t kRight = 2;

/// The function of an id of one of the two nodes; 0: it is none.
std::uint32_t function_of(std::uint32_t id) {
  const std::uint32_t node = id & 0x7FU;
  return node == kLeft || node == kRight ? id - node : 0;
}

std::string judge_word(const CanFrame& frame) {
  if (frame.len != 6) return "a command of another length";
  constexpr std::uint32_t kWords[] = {0x00, 0x02, 0x06, 0x07, 0x0F, 0x80};
  const std::uint32_t word = number(frame, 0, 2);
  if (!has(kWords, word)) return "a controlword off the list";
  const bool moves = number(frame, 2, 4) != 0;
  return moves && word != 0x0F ? "a target beside a word that does not enable" : "";
}

/// Written before anything turns: nothing of the flash, of the node or of its factors.
std::string judge_service(const CanFrame& frame) {
  if (frame.len != 8) return "a request of another length";
  const std::uint32_t object = number(frame, 1, 2);
  if (frame.data[0] == 0x40 || frame.data[0] == 0x80) return {};  // reads, and gives up
  constexpr std::uint32_t kSettings[] = {0x1016, 0x1017, 0x6007, 0x605A, 0x6060,
                                         0x6083, 0x6084, 0x6085, 0x60C2};
  constexpr std::uint32_t kMappings[] = {0x1400, 0x1600, 0x1800, 0x1A00};
  if (has(kSettings, object) || has(kMappings, object & 0xFFFCU)) return {};
  if (object != 0x60FF) return "an object off the list";
  return number(frame, 4, 4) == 0 ? "" : "a target that moves, by service";
}

}  // namespace

std::optional<WheelCommand> wheel_command(const CanFrame& frame) {
  if (frame.extended || frame.remote || frame.error || frame.fd) return std::nullopt;
  if (function_of(frame.id) != 0x200 || frame.len != 6) return std::nullopt;
  const auto node = static_cast<std::uint8_t>(frame.id & 0x7FU);
  const auto rpm = static_cast<std::int32_t>(number(frame, 2, 4));
  // No zero with a sign: it would be told as a motion.
  const auto ahead = static_cast<float>(node == kRight ? 0 - rpm : rpm);
  return WheelCommand{node, ahead / kRpm_per_turnps, 0};
}

bool is_zero_by_service(const CanFrame& frame) {
  return function_of(frame.id) == 0x600 && frame.len == 8 && frame.data[0] == 0x23 &&
         number(frame, 1, 2) == 0x60FF && number(frame, 4, 4) == 0;
}

std::string forbidden(const CanFrame& frame) {
  if (frame.error) return "an error frame";
  if (frame.extended || frame.fd || frame.remote) return "no plain 11-bit frame";
  if (frame.id == kManagement) {
    const bool ours = frame.data[1] == kLeft || frame.data[1] == kRight;
    return frame.len == 2 && frame.data[0] == 1 && ours ? "" : "more than a start of one node";
  }
  if (frame.id == kGatewaysHeartbeat)
    return frame.len == 1 && frame.data[0] == 5 ? "" : "no heartbeat of a gateway that runs";
  switch (function_of(frame.id)) {
    case 0x080:
    case 0x580: return frame.len == 8 ? "" : "a node's frame of odd length";
    case 0x180: return frame.len == 6 ? "" : "a status of odd length";
    case 0x280: return frame.len == 4 ? "" : "a position of odd length";
    case 0x700: return frame.len == 1 ? "" : "a heartbeat of odd length";
    case 0x200: return judge_word(frame);
    case 0x600: return judge_service(frame);
    default: return "no id of this robot";
  }
}

}  // namespace drover::mission::cia402
