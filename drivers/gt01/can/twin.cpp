#include "drivers/gt01/can/twin.h"

#include "drivers/thousandths.h"
#include "drover/bytes.h"

namespace drover::gt01::can {
namespace {

using std::chrono::milliseconds;

constexpr std::uint8_t kBatteryPercent = 57;
constexpr std::uint16_t kVoltage_dV = 510;
constexpr std::int16_t kCurrent_dA = 10;
constexpr std::uint16_t kOverCurrent = 1U << 3U;
constexpr std::uint8_t kCommandHead = 0x01;
constexpr std::uint8_t kSoftEstopCommand = 0x0F;

}  // namespace

/// Only twists and the emergency stop; whatever else it takes is never sent.
void Gt01CanTwin::on_frame(const CanFrame& frame, Time now, TwinFrames&) {
  if (!chassis_.is_up()) return;
  if (const auto twist = asked_twist(frame, layout_)) return chassis_.on_twist(*twist, now);
  const bool command =
      frame.is_plain() && frame.id == kCommandId && frame.len >= 3 && frame.data[0] == kCommandHead;
  if (command && frame.data[1] == kSoftEstopCommand) chassis_.on_soft_estop(frame.data[2] == 1);
}

void Gt01CanTwin::tell(std::uint32_t id, std::int16_t first, std::int16_t second,
                       TwinFrames& out) const {
  CanFrame frame;
  frame.id = id;
  frame.len = 8;
  store_le(frame.data, 0, first);
  store_le(frame.data, 2, second);
  static_cast<void>(out.push_back(frame));
}

CanFrame Gt01CanTwin::state() const {
  const ChassisFaults& faults = chassis_.faults();
  CanFrame frame;
  frame.id = 0x20;
  frame.len = 8;
  Mode mode = chassis_.obeys_host() ? Mode::host : Mode::idle;
  if (faults.docking) mode = Mode::docking;
  if (faults.remote) mode = Mode::remote;
  frame.data[0] = static_cast<std::uint8_t>(mode);
  frame.data[1] = kBatteryPercent;
  store_le(frame.data, 2, kVoltage_dV);
  unsigned bits = faults.remote ? 0U : status::kRemoteOffline;
  if (faults.hard_estop) bits |= status::kHardEstop;
  if (faults.soft_estop) bits |= status::kSoftEstop;
  if (faults.bumper) bits |= status::kFrontBumper;
  frame.data[4] = static_cast<std::uint8_t>(bits);
  frame.data[5] = faults.over_current ? error::kDriveError : std::uint8_t{0};
  return frame;
}

void Gt01CanTwin::on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) {
  chassis_.on_tick(now, shafts);
  const bool speeds = is_due(next_speeds_, milliseconds(20), now);
  const bool states = is_due(next_state_, milliseconds(10), now);
  if (!chassis_.tells()) return;
  if (speeds) {
    const Twist twist = chassis_.twist();
    tell(0x10, thousandths(twist.vx_mps), thousandths(twist.wz_radps), out);
    tell(0x11, thousandths(chassis_.left_mps()), thousandths(chassis_.right_mps()), out);
  }
  if (!states) return;
  tell(0x12, kCurrent_dA, kCurrent_dA, out);
  static_cast<void>(out.push_back(state()));
  tell(0x30, static_cast<std::int16_t>(chassis_.faults().over_current ? kOverCurrent : 0), 0, out);
}

}  // namespace drover::gt01::can
