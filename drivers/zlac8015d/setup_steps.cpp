#include "drivers/zlac8015d/setup_steps.h"

#include <algorithm>

#include "drivers/canopen/pdo.h"

namespace drover::zlac8015d {
namespace {

using canopen::Object;
using canopen::PdoDirection;

constexpr std::uint8_t kByTimer = 254;
/// This maker counts an event timer in half milliseconds.
constexpr std::uint16_t kTenMilliseconds = 20;

canopen::Pdo pdo(PdoDirection direction, std::uint8_t number,
                 std::initializer_list<canopen::MappedObject> objects) {
  canopen::Pdo made;
  made.direction = direction;
  made.number = number;
  if (direction == PdoDirection::transmits) {
    made.transmission = kByTimer;
    made.event_timer_ms = kTenMilliseconds;
  }
  for (const auto& object : objects) static_cast<void>(made.objects.push_back(object));
  return made;
}

/// After how many steps the time-out is fed: each is written and read back, a cycle of 5 ms for
/// either.
std::size_t steps_between_feeds(const Settings& settings) {
  constexpr int kStep_ms = 10;
  constexpr int kMost = 6;
  const int half_ms = settings.silence_ms / 2;
  return static_cast<std::size_t>(std::clamp(half_ms / kStep_ms, 1, kMost));
}

}  // namespace

StepList steps_of(const Settings& settings) {
  StepList steps;
  const auto add = [&steps](Object object, canopen::SdoNumber value) {
    static_cast<void>(steps.push_back({.object = object, .value = value}));
  };
  add({canopen::kTargetVelocity, 1}, canopen::i32(0));
  add({canopen::kTargetVelocity, 2}, canopen::i32(0));
  add({kSilenceTime, 0}, canopen::u16(settings.silence_ms));
  add({kHeartbeatTime, 0}, canopen::u16(settings.heartbeat_ms));
  add({kSynchronous, 0}, canopen::u16(0));
  add({kDriverParameters, 5}, canopen::u16(static_cast<std::uint16_t>(settings.steps_per_rpm)));
  add({canopen::kMode, 0}, canopen::u8(kVelocityMode));
  for (const std::uint8_t wheel : kSubs) {
    add({kAccelerationTime, wheel}, canopen::u32(settings.acceleration_ms));
    add({kDecelerationTime, wheel}, canopen::u32(settings.deceleration_ms));
  }
  add({canopen::kQuickStopOption, 0}, canopen::u16(kStopsAndHolds));
  const canopen::Pdo pdos[] = {
      pdo(PdoDirection::receives, 1, {{{canopen::kControlword, 0}, 16}}),
      pdo(PdoDirection::receives, 2,
          {{{canopen::kTargetVelocity, 1}, 32}, {{canopen::kTargetVelocity, 2}, 32}}),
      pdo(PdoDirection::transmits, 1,
          {{{canopen::kStatusword, 0}, 32}, {{canopen::kErrorCode, 0}, 32}}),
      pdo(PdoDirection::transmits, 2,
          {{{canopen::kVelocityActual, 1}, 32}, {{canopen::kVelocityActual, 2}, 32}}),
      pdo(PdoDirection::transmits, 3,
          {{{canopen::kPositionActual, 1}, 32}, {{canopen::kPositionActual, 2}, 32}}),
  };
  for (const auto& each : pdos)
    for (const auto& step : canopen::steps_of(each, settings.node))
      static_cast<void>(steps.push_back(step));
  return steps;
}

StepList fed_steps_of(const Settings& settings) {
  const StepList objects = steps_of(settings);
  const std::size_t each = steps_between_feeds(settings);
  StepList steps;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    static_cast<void>(steps.push_back(objects[i]));
    if ((i + 1) % each != 0 && i + 1 != objects.size()) continue;
    static_cast<void>(steps.push_back({.object = {canopen::kTargetVelocity, kSubs[i / each % 2]},
                                       .value = canopen::i32(0),
                                       .read_back = false}));
  }
  return steps;
}

}  // namespace drover::zlac8015d
