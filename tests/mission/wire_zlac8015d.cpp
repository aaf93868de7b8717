#include "mission/wire_zlac8015d.h"

#include "mission/wire_bytes.h"

namespace drover::mission::zlac8015d {
namespace {

constexpr std::uint32_t kManagement = 0x000;
constexpr std::uint32_t kControlword = 0x201;
constexpr std::uint32_t kTargets = 0x301;
constexpr std::uint32_t kAnswer = 0x581;
constexpr std::uint32_t kRequest = 0x601;
constexpr std::uint32_t kHeartbeat = 0x701;
constexpr float kStepsPerTurnps = 10 * 60;  // tenths of a turn a minute

/// Written before anything turns: nothing of the flash, of the node or of the origin.
std::string judge_request(const CanFrame& frame) {
  if (frame.len != 8) return "a request of another length";
  const std::uint32_t index = number(frame, 1, 2);
  if (frame.data[0] == 0x40 || frame.data[0] == 0x80) return {};  // reads, and gives up
  constexpr std::uint32_t kSettings[] = {0x1017, 0x2000, 0x200F, 0x2026,
                                         0x605A, 0x6060, 0x6083, 0x6084};
  const bool maps = (index >= 0x1400 && index <= 0x1403) || (index >= 0x1600 && index <= 0x1603) ||
                    (index >= 0x1800 && index <= 0x1803) || (index >= 0x1A00 && index <= 0x1A03);
  if (maps || has(kSettings, index)) return {};
  if (index != 0x60FF) return "an object off the list";
  return number(frame, 4, 4) == 0 ? std::string{} : "a target that moves, by service";
}

}  // namespace

std::optional<std::array<float, 2>> targets_turnps(const CanFrame& frame) {
  if (frame.extended || frame.remote || frame.error || frame.fd) return std::nullopt;
  if (frame.id != kTargets || frame.len != 8) return std::nullopt;
  const auto left = static_cast<std::int32_t>(number(frame, 0, 4));
  const auto right = static_cast<std::int32_t>(number(frame, 4, 4));
  // No zero with a sign: it would be told as a motion.
  return std::array{static_cast<float>(left) / kStepsPerTurnps,
                    static_cast<float>(0 - right) / kStepsPerTurnps};
}

bool is_zero_by_service(const CanFrame& frame) {
  return frame.id == kRequest && frame.len == 8 && frame.data[0] == 0x23 &&
         number(frame, 1, 2) == 0x60FF && number(frame, 4, 4) == 0;
}

std::string forbidden(const CanFrame& frame) {
  if (frame.error) return "an error frame";
  if (frame.extended || frame.fd || frame.remote) return "no plain 11-bit frame";
  constexpr std::uint32_t kTold[] = {0x181, 0x281, 0x381, kAnswer};
  if (has(kTold, frame.id)) return frame.len == 8 ? std::string{} : "a node's frame of odd length";
  switch (frame.id) {
    case kHeartbeat: return frame.len == 1 ? std::string{} : "a heartbeat of odd length";
    case kManagement:
      return frame.len == 2 && number(frame, 0, 2) == 0x0101 ? std::string{}
                                                             : "more than a start of node 1";
    case kControlword: {
      constexpr std::uint32_t kWords[] = {0x00, 0x02, 0x06, 0x07, 0x0F, 0x80};
      return frame.len == 2 && has(kWords, number(frame, 0, 2)) ? std::string{}
                                                                : "a controlword off the list";
    }
    case kTargets: return frame.len == 8 ? std::string{} : "targets of another length";
    case kRequest: return judge_request(frame);
    default: return "no id of this robot";
  }
}

}  // namespace drover::mission::zlac8015d
