// A Scout's or a Hunter's driver under any frames, requests and gaps. What must hold: at rest
// nothing moves it, and what it sends is on its own list and not forbidden.
#include <cstdlib>

#include "drivers/agilex_v2/driver.h"
#include "tests/fuzz/drive_actuator.h"

namespace drover {
namespace {

constexpr std::array<std::uint32_t, 7> kIds{0x111, 0x151, 0x211, 0x221, 0x421, 0x311, 0x131};

double part_of(std::uint8_t byte) {
  return byte == 0xFF ? kAbsent : (byte - 127) * 0.01;
}

Setpoint read_setpoint(fuzz::Input& input, std::uint8_t what) {
  return {static_cast<AxisRequest>(what % 4), 0, {part_of(input.byte()), part_of(input.byte())}};
}

void judge(const agilex_v2::AgilexV2Driver& driver, const Setpoint& setpoint, Time now,
           const DriverOut& out) {
  const bool rests = setpoint.request == AxisRequest::rest || setpoint.request == AxisRequest::idle;
  if (out.overflows != 0 || out.frames.size() > driver.messages_per_cycle()) std::abort();
  for (const CanFrame& frame : out.frames) {
    const FrameEffect effect = driver.effect(frame, now).kind;
    if (!fuzz::on_list(driver, frame) || effect == FrameEffect::forbidden) std::abort();
    if (rests && effect == FrameEffect::motion) std::abort();
  }
}

}  // namespace
}  // namespace drover

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace drover;
  fuzz::Input input({data, size});
  const bool hunter = input.byte() % 2 != 0;
  agilex_v2::AgilexV2Driver driver(
      0, hunter ? std::optional(agilex_v2::Steering{}) : std::optional<agilex_v2::Steering>());
  fuzz::drive_actuator(driver, kIds, input, read_setpoint, judge);
  return 0;
}
