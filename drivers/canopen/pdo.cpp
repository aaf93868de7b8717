#include "drivers/canopen/pdo.h"

namespace drover::canopen {
namespace {

constexpr std::uint32_t kInvalid = 0x80000000;
constexpr std::uint32_t kNoRemote = 0x40000000;  // nobody asks for it by a remote frame

}  // namespace

std::uint32_t cob_id(const Pdo& pdo, std::uint8_t node) {
  const std::uint32_t first = pdo.direction == PdoDirection::transmits ? 0x180 : 0x200;
  return first + 0x100U * (pdo.number - 1U) + node;
}

PdoSteps steps_of(const Pdo& pdo, std::uint8_t node) {
  const bool transmits = pdo.direction == PdoDirection::transmits;
  const auto place = static_cast<std::uint16_t>(pdo.number - 1U);
  const auto communication = static_cast<std::uint16_t>((transmits ? 0x1800U : 0x1400U) + place);
  const auto mapping = static_cast<std::uint16_t>((transmits ? 0x1A00U : 0x1600U) + place);
  const std::uint32_t id = cob_id(pdo, node) | (transmits ? kNoRemote : 0U);

  PdoSteps steps;
  const auto add = [&steps](Object object, SdoNumber value) {
    static_cast<void>(steps.push_back({.object = object, .value = value}));
  };
  add({communication, 1}, u32(id | kInvalid));
  add({communication, 2}, u8(pdo.transmission));
  if (pdo.inhibit_100us) add({communication, 3}, u16(*pdo.inhibit_100us));
  if (pdo.event_timer_ms) add({communication, 5}, u16(*pdo.event_timer_ms));
  add({mapping, 0}, u8(0));
  std::uint8_t sub = 0;
  for (const auto& [object, bits] : pdo.objects) {
    add({mapping, ++sub}, u32(static_cast<std::uint32_t>(object.index) << 16U |
                              static_cast<std::uint32_t>(object.sub) << 8U | bits));
  }
  add({mapping, 0}, u8(static_cast<std::uint8_t>(pdo.objects.size())));
  add({communication, 1}, u32(id));
  return steps;
}

}  // namespace drover::canopen
