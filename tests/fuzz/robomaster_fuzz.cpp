// Four RoboMaster motors' driver under any frames, requests, set points and gaps. What must hold:
// what it sends is on its own list and not forbidden, one frame a cycle, and at rest none that
// moves.
#include <array>
#include <cstdlib>

#include "drivers/robomaster_c620/driver.h"
#include "tests/fuzz/input.h"
#include "tests/fuzz/on_list.h"

namespace drover {
namespace {

constexpr std::array<std::uint32_t, 8> kIds{0x201, 0x202, 0x203, 0x204, 0x200, 0x1FF, 0x205, 0x201};
using Wanted = std::array<Setpoint, robomaster::kMotors>;

Wanted read_setpoints(fuzz::Input& input, std::uint8_t what) {
  Wanted wanted;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const std::uint8_t byte = input.byte();
    // Mostly all are asked for the same.
    wanted[i].request = static_cast<AxisRequest>((what + (byte % 8 == 7 ? 1 : 0)) % 4);
    wanted[i].velocity_radps = byte == 0xFF ? kAbsent : (byte - 127) * 0.5;
  }
  return wanted;
}

void judge(const robomaster::RobomasterDriver& driver, const Wanted& wanted, Time now,
           const DriverOut& out) {
  if (out.overflows != 0 || out.frames.size() > driver.messages_per_cycle()) std::abort();
  for (const CanFrame& frame : out.frames) {
    const Effect effect = driver.effect(frame, now);
    if (!fuzz::on_list(driver, frame) || effect.kind == FrameEffect::forbidden) std::abort();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const bool moves = (effect.moves & channel_bit(i)) != 0;
      const bool may = wanted[i].request == AxisRequest::run && wanted[i].velocity_radps != 0;
      if (moves && !may) std::abort();
    }
  }
}

}  // namespace
}  // namespace drover

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace drover;
  fuzz::Input input({data, size});
  Options options(robomaster::option_table());
  options.set("velocity_gain_Nms_per_rad", 0.3);
  robomaster::RobomasterDriver driver(robomaster::read_settings(options), {0, 1, 2, 3});
  Time now{std::chrono::seconds(1)};
  DriverOut out;
  while (input.more()) {
    out.clear();
    const std::uint8_t what = input.byte();
    if (what < 0x80) {
      driver.on_frame(fuzz::read_frame(input, kIds[what % kIds.size()]), now, out);
    } else if (what == 0xFF) {
      driver.on_link_up(now);
    } else if (what >= 0xF0) {
      now += std::chrono::milliseconds(input.byte());
    } else {
      now += std::chrono::milliseconds(5);
      const Wanted wanted = read_setpoints(input, what);
      driver.on_setpoints(wanted, now, out);
      driver.on_tick(now, out);
      judge(driver, wanted, now, out);
    }
    (void)driver.health(now);
  }
  return 0;
}
