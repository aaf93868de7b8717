#include "drivers/canopen/emcy.h"

#include "drover/bytes.h"

namespace drover::canopen {
namespace {

constexpr std::uint32_t kEmergencyBase = 0x080;

struct Meaning {
  std::uint16_t mask;
  std::uint16_t code;
  std::string_view text;
};

// The first that fits: codes before their classes.
constexpr Meaning kMeanings[] = {
    {0xFFFF, 0x0000, "no error"},
    {0xFFFF, 0x2310, "over-current at the output"},
    {0xFFFF, 0x2320, "short circuit at the output"},
    {0xFFFF, 0x3210, "supply voltage too high"},
    {0xFFFF, 0x3220, "supply voltage too low"},
    {0xFFFF, 0x4210, "device too hot"},
    {0xFFFF, 0x4310, "drive too hot"},
    {0xFFFF, 0x7300, "sensor"},
    {0xFFFF, 0x7305, "incremental encoder"},
    {0xFFFF, 0x7500, "its own communication"},
    {0xFFFF, 0x8110, "CAN overrun: messages were lost"},
    {0xFFFF, 0x8120, "CAN controller is error passive"},
    {0xFFFF, 0x8130, "it misses the heartbeat it watches"},
    {0xFFFF, 0x8140, "it came back from bus-off"},
    {0xFFFF, 0x8150, "two nodes send the same id"},
    {0xFFFF, 0x8210, "a PDO was too short for its mapping"},
    {0xFFFF, 0x8220, "a PDO was too long for its mapping"},
    {0xFFFF, 0x8250, "it misses a PDO in time"},
    {0xFFFF, 0x8311, "torque too high"},
    {0xFFFF, 0x8611, "following error"},
    {0xFF00, 0x2100, "current at the input"},
    {0xFF00, 0x2200, "current inside the device"},
    {0xFF00, 0x2300, "current at the output"},
    {0xF000, 0x2000, "current"},
    {0xFF00, 0x3100, "mains voltage"},
    {0xFF00, 0x3200, "supply voltage"},
    {0xF000, 0x3000, "voltage"},
    {0xF000, 0x4000, "temperature"},
    {0xF000, 0x5000, "hardware of the device"},
    {0xF000, 0x6000, "software of the device"},
    {0xF000, 0x7000, "an added module"},
    {0xFF00, 0x8100, "communication"},
    {0xFF00, 0x8200, "protocol"},
    {0xF000, 0x8000, "monitoring"},
    {0xF000, 0x9000, "an error from outside"},
    {0xF000, 0x1000, "generic error"},
};

}  // namespace

std::optional<Emergency> decode_emergency(const CanFrame& frame, std::uint8_t node) {
  if (!frame.is_plain() || frame.len != 8) return {};
  // 080 by itself is SYNC.
  if (node == 0 || frame.id != kEmergencyBase + node) return {};
  Emergency emergency;
  emergency.code = load_le<std::uint16_t>(frame.data);
  emergency.error_register = frame.data[2];
  for (std::size_t i = 0; i < emergency.makers.size(); ++i) emergency.makers[i] = frame.data[3 + i];
  return emergency;
}

std::string_view emergency_text(std::uint16_t code) {
  for (const auto& meaning : kMeanings)
    if ((code & meaning.mask) == meaning.code) return meaning.text;
  return "an error of the maker's own";
}

}  // namespace drover::canopen
