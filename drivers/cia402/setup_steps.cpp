// What is written into a drive of CiA 402, and read back.
#include "drivers/canopen/cia402.h"
#include "drivers/canopen/pdo.h"
#include "drivers/cia402/settings.h"

namespace drover::cia402 {
namespace {

using canopen::Object;
using canopen::PdoDirection;

constexpr std::uint16_t kTenMilliseconds = 10;
constexpr std::uint16_t kAbortQuickStop = 3;  ///< of 6007
constexpr std::uint8_t kFiveMilliseconds = 5;

}  // namespace

StepList steps_of(const Settings& settings) {
  StepList steps;
  const auto add = [&steps](Object object, canopen::SdoNumber value, bool may_be_refused = false) {
    static_cast<void>(
        steps.push_back({.object = object, .value = value, .may_be_refused = may_be_refused}));
  };
  const auto add_if_asked = [&](std::uint16_t index, std::uint32_t value) {
    if (value != 0) add({index, 0}, canopen::u32(value));
  };
  const auto add_pdo = [&](PdoDirection direction, std::uint8_t number,
                           std::initializer_list<canopen::MappedObject> objects) {
    canopen::Pdo pdo;
    pdo.direction = direction;
    pdo.number = number;
    if (direction == PdoDirection::transmits) pdo.event_timer_ms = kTenMilliseconds;
    for (const auto& object : objects) static_cast<void>(pdo.objects.push_back(object));
    for (const auto& step : canopen::steps_of(pdo, settings.node))
      static_cast<void>(steps.push_back(step));
  };

  add({canopen::kTargetVelocity, 0}, canopen::i32(0));
  add({0x1017, 0}, canopen::u16(settings.heartbeat_ms));
  if (settings.has_consumer) {
    const std::uint32_t watched =
        settings.silence_ms == 0 ? 0U : settings.gateway_node * 0x10000U + settings.silence_ms;
    add({0x1016, 1}, canopen::u32(watched));
  }
  if (settings.has_abort_option) add({0x6007, 0}, canopen::u16(kAbortQuickStop));
  add({canopen::kQuickStopOption, 0}, canopen::u16(settings.quick_stop_option));
  add_if_asked(0x6083, settings.acceleration);
  add_if_asked(0x6084, settings.deceleration);
  add_if_asked(0x6085, settings.quick_deceleration);
  add({canopen::kMode, 0}, canopen::u8(settings.mode));
  if (settings.mode == 9) {
    // How often a target comes. Who has no such object interpolates nothing.
    add({0x60C2, 1}, canopen::u8(kFiveMilliseconds), true);
    add({0x60C2, 2}, canopen::u8(static_cast<std::uint8_t>(-3)), true);
  }
  add_pdo(PdoDirection::receives, 1,
          {{{canopen::kControlword, 0}, 16}, {{canopen::kTargetVelocity, 0}, 32}});
  add_pdo(PdoDirection::transmits, 1,
          {{{canopen::kStatusword, 0}, 16}, {{canopen::kVelocityActual, 0}, 32}});
  if (settings.torque()) {
    add_pdo(PdoDirection::transmits, 2,
            {{{canopen::kPositionActual, 0}, 32}, {{canopen::kTorqueActual, 0}, 16}});
  } else {
    add_pdo(PdoDirection::transmits, 2, {{{canopen::kPositionActual, 0}, 32}});
  }
  return steps;
}

}  // namespace drover::cia402
