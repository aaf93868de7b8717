// The simulated node on its bus: service channel, process data, heartbeat.
#include <algorithm>

#include "drivers/zlac8015d/twin.h"
#include "drover/bytes.h"

namespace drover::zlac8015d {
namespace {

using canopen::NodeState;
using canopen::Object;

// CiA 301: abort codes of the service channel; the id in objects 1400 and 1800.
constexpr std::uint32_t kNoObject = 0x06020000;
constexpr std::uint32_t kReadOnly = 0x06010002;
constexpr std::uint32_t kIdBits = 0x7FF;
// The maker's example of an event timer.
constexpr Duration kPdoUnit = std::chrono::microseconds(500);

constexpr std::uint16_t kMeasured[] = {canopen::kStatusword, canopen::kErrorCode,
                                       canopen::kVelocityActual, canopen::kPositionActual};

bool is_measured(std::uint16_t index) {
  return std::find(std::begin(kMeasured), std::end(kMeasured), index) != std::end(kMeasured);
}

CanFrame answer(std::uint8_t node, std::uint8_t command, Object object, std::uint32_t value) {
  CanFrame frame = canopen::encode_sdo_write(node, object, canopen::u32(value));
  frame.id = id_of(Cob::sdo_answer, node);
  frame.data[0] = command;
  return frame;
}

}  // namespace

void Zlac8015dTwin::on_frame(const CanFrame& frame, Time now, TwinFrames& out) {
  if (!booted_ || !frame.is_plain()) return;
  if (frame.id == 0) {
    const bool meant = frame.len == 2 && (frame.data[1] == settings_.node || frame.data[1] == 0);
    if (meant) on_nmt(frame.data[0]);
    return;
  }
  if (frame.id == id_of(Cob::sdo_request, settings_.node) && state_ != NodeState::stopped)
    return on_sdo(frame, now, out);
  for (std::uint16_t pdo = 0; pdo < 4; ++pdo) {
    const std::uint32_t id = stored(static_cast<std::uint16_t>(0x1400U + pdo), 1);
    if ((id & kInvalidPdo) == 0 && (id & kIdBits) == frame.id) on_pdo(pdo, frame, now);
  }
}

void Zlac8015dTwin::on_sdo(const CanFrame& frame, Time now, TwinFrames& out) {
  if (frame.len != 8) return;
  const Object object{load_le<std::uint16_t>(frame.data, 1), frame.data[3]};
  const Entry* const entry = find(object);
  const std::uint8_t command = frame.data[0];
  const auto say = [&](std::uint8_t how, std::uint32_t value) {
    send(answer(settings_.node, how, object, value), out);
  };
  if (command == 0x80) return;
  if (entry == nullptr && !is_measured(object.index)) return say(0x80, kNoObject);
  const auto size = entry == nullptr ? 4U : static_cast<unsigned>(entry->value.size);
  if (command == 0x40)
    return say(static_cast<std::uint8_t>(0x43U | (4U - size) << 2U), read(object));
  if (entry == nullptr) return say(0x80, kReadOnly);
  if (command != (0x23U | (4U - size) << 2U)) return say(0x80, canopen::kAbortLength);
  write(object, load_le<std::uint32_t>(frame.data, 4), now);
  say(0x60, 0);
}

void Zlac8015dTwin::on_pdo(std::uint16_t number, const CanFrame& frame, Time now) {
  if (state_ != NodeState::operational) return;
  const auto mapping = static_cast<std::uint16_t>(0x1600U + number);
  std::size_t at = 0;
  for (std::uint8_t sub = 1; sub <= mapped_count(mapping); ++sub) {
    const std::uint32_t mapped = stored(mapping, sub);
    const std::size_t size = (mapped & 0xFFU) / 8;
    if (at + size > frame.len) return;
    const Object object{static_cast<std::uint16_t>(mapped >> 16U),
                        static_cast<std::uint8_t>(mapped >> 8U & 0xFFU)};
    write(
        object,
        size == 2 ? load_le<std::uint16_t>(frame.data, at) : load_le<std::uint32_t>(frame.data, at),
        now);
    at += size;
  }
}

void Zlac8015dTwin::send_pdo(std::uint16_t number, TwinFrames& out) const {
  const auto mapping = static_cast<std::uint16_t>(0x1A00U + number);
  CanFrame frame = make_frame(stored(static_cast<std::uint16_t>(0x1800U + number), 1) & kIdBits);
  for (std::uint8_t sub = 1; sub <= mapped_count(mapping); ++sub) {
    const std::uint32_t mapped = stored(mapping, sub);
    store_le(frame.data, frame.len,
             read({static_cast<std::uint16_t>(mapped >> 16U),
                   static_cast<std::uint8_t>(mapped >> 8U & 0xFFU)}));
    frame.len = static_cast<std::uint8_t>(frame.len + 4);
  }
  send(frame, out);
}

void Zlac8015dTwin::send_cyclic(Time now, TwinFrames& out) {
  const auto due = [now](Time& next, Duration period) {
    if (period <= Duration{} || now < next) return false;
    // A plant that was held up catches up without a burst.
    next = now - next >= 2 * period ? now + period : next + period;
    return true;
  };
  if (due(next_heartbeat_, std::chrono::milliseconds(stored(kHeartbeatTime, 0))))
    send(canopen::encode_heartbeat(settings_.node, state_), out);
  if (state_ != NodeState::operational) return;
  for (std::uint16_t pdo = 0; pdo < 4; ++pdo) {
    const auto communication = static_cast<std::uint16_t>(0x1800U + pdo);
    if ((stored(communication, 1) & kInvalidPdo) == 0 &&
        due(next_pdo_[pdo], kPdoUnit * stored(communication, 5)))
      send_pdo(pdo, out);
  }
}

}  // namespace drover::zlac8015d
