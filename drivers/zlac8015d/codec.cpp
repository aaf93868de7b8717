#include "drivers/zlac8015d/codec.h"

#include <algorithm>

#include "drover/bytes.h"

namespace drover::zlac8015d {
namespace {

using canopen::DriveState;

constexpr std::uint16_t kSwitchBits = 0x0F;
constexpr std::uint16_t kExternalEstop = 0x8000;

struct ErrorBit {
  std::uint16_t bit;
  std::string_view text;
};
/// What a person must look at first comes first.
constexpr ErrorBit kErrors[] = {
    {0x0004, "over-current"},
    {0x0008, "overload"},
    {0x0001, "supply voltage too high"},
    {0x0002, "supply voltage too low"},
    {0x0400, "motor too hot"},
    {0x0800, "encoder"},
    {0x0200, "hall sensors"},
    {0x0020, "encoder out of tolerance"},
    {0x0080, "reference voltage"},
    {0x0100, "EEPROM"},
    {0x2000, "set speed above the rated one"},
};

bool is(const CanFrame& frame, Cob cob, std::uint8_t node, std::uint8_t len) {
  return frame.is_plain() && frame.id == id_of(cob, node) && frame.len == len;
}

}  // namespace

CanFrame encode_controlword(std::uint8_t node, std::uint16_t controlword) {
  return make_frame(id_of(Cob::controlword, node), {low_byte(controlword), high_byte(controlword)});
}

CanFrame encode_targets(std::uint8_t node, const Pair& targets) {
  CanFrame frame = make_frame(id_of(Cob::targets, node));
  frame.len = 8;
  store_le(frame.data, 0, targets[kLeft]);
  store_le(frame.data, 4, targets[kRight]);
  return frame;
}

std::optional<Status> decode_status(const CanFrame& frame, std::uint8_t node) {
  if (!is(frame, Cob::status, node, 8)) return {};
  Status status;
  for (std::size_t half = 0; half < kWheels; ++half) {
    status.statuswords[half] = load_le<std::uint16_t>(frame.data, 2 * half);
    status.errors[half] = load_le<std::uint16_t>(frame.data, 4 + 2 * half);
  }
  return status;
}

std::optional<Pair> decode_pair(const CanFrame& frame, Cob cob, std::uint8_t node) {
  if (!is(frame, cob, node, 8)) return {};
  return Pair{load_le<std::int32_t>(frame.data, 0), load_le<std::int32_t>(frame.data, 4)};
}

std::optional<std::uint16_t> decode_controlword(const CanFrame& frame, std::uint8_t node) {
  if (!is(frame, Cob::controlword, node, 2)) return {};
  return load_le<std::uint16_t>(frame.data);
}

DriveState wheel_state(std::uint16_t statusword) {
  if ((statusword & kSwitchBits) == 0) return DriveState::switch_on_disabled;
  return canopen::drive_state(statusword);
}

DriveState drive_state(const Status& status) {
  const DriveState a = wheel_state(status.statuswords[0]);
  const DriveState b = wheel_state(status.statuswords[1]);
  if (a == b) return a;
  for (const DriveState worse : {DriveState::fault_reaction, DriveState::fault, DriveState::unknown,
                                 DriveState::quick_stop_active})
    if (a == worse || b == worse) return worse;
  return std::min(a, b);  // the order of the steps
}

bool is_powered(const Status& status) {
  return std::any_of(status.statuswords.begin(), status.statuswords.end(),
                     [](std::uint16_t word) { return canopen::is_powered(wheel_state(word)); });
}

bool external_estop(const Status& status) {
  return ((status.statuswords[0] | status.statuswords[1]) & kExternalEstop) != 0;
}

Reason error_text(const Status& status) {
  const auto errors = static_cast<std::uint16_t>(status.errors[0] | status.errors[1]);
  if (errors == 0) return {};
  const auto* const known =
      std::find_if(std::begin(kErrors), std::end(kErrors),
                   [&](const auto& each) { return (errors & each.bit) != 0; });
  Reason text;
  if (known == std::end(kErrors))
    text.format("error 0x%04X", static_cast<unsigned>(errors));
  else
    text = Reason(known->text);
  // Nobody knows which half is whose: a person looks at both.
  if ((status.errors[0] == 0) == (status.errors[1] == 0)) return text;
  Reason one;
  one.format("%.*s, of the left or the right motor", static_cast<int>(text.view().size()),
             text.view().data());
  return one;
}

}  // namespace drover::zlac8015d
