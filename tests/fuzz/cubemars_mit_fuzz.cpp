// A CubeMars motor's driver under any frames, requests, set points and gaps. What must hold: at
// rest nothing moves it, what it sends is on its own list and not forbidden, and it is enabled only
// while it is asked to run.
#include <array>
#include <cstdlib>

#include "drivers/cubemars_mit/driver.h"
#include "tests/fuzz/input.h"
#include "tests/fuzz/on_list.h"

namespace drover {
namespace {

constexpr std::array<std::uint32_t, 4> kIds{0x001, 0x001, 0x002, 0x000};

double value_of(std::uint8_t byte) {
  return byte == 0xFF ? kAbsent : (byte - 127) * 0.5;
}

Setpoint read_setpoint(fuzz::Input& input, std::uint8_t what) {
  Setpoint setpoint;
  setpoint.request = static_cast<AxisRequest>(what % 4);
  setpoint.velocity_radps = value_of(input.byte());
  setpoint.impedance = {value_of(input.byte()), value_of(input.byte()), value_of(input.byte()),
                        value_of(input.byte())};
  return setpoint;
}

void judge(const cubemars_mit::CubemarsDriver& driver, const Setpoint& setpoint, Time now,
           const DriverOut& out) {
  if (out.overflows != 0 || out.frames.size() > driver.messages_per_cycle()) std::abort();
  for (const CanFrame& frame : out.frames) {
    const FrameEffect effect = driver.effect(frame, now).kind;
    if (!fuzz::on_list(driver, frame) || effect == FrameEffect::forbidden) std::abort();
    const bool runs = setpoint.request == AxisRequest::run || setpoint.request == AxisRequest::hold;
    const bool enables = mit::decode_special(frame, 1) == mit::Special::enable;
    if (!runs && (effect == FrameEffect::motion || enables)) std::abort();
  }
}

}  // namespace
}  // namespace drover

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace drover;
  fuzz::Input input({data, size});
  Options options(cubemars_mit::option_table());
  options.set("id", 1.0).set("model", std::string("AK80-9")).set("settle_s", 0.0);
  if (input.byte() % 2 != 0) options.set("master_id", 0.0);
  cubemars_mit::CubemarsDriver driver(cubemars_mit::read_settings(options), 0);
  Time now{std::chrono::seconds(1)};
  DriverOut out;
  while (input.more()) {
    out.clear();
    now += std::chrono::milliseconds(input.byte());
    const std::uint8_t what = input.byte();
    if (what < 0x80) {
      driver.on_frame(fuzz::read_frame(input, kIds[what % kIds.size()]), now, out);
    } else if (what == 0xFF) {
      driver.on_link_up(now);
    } else {
      const Setpoint setpoint = read_setpoint(input, what);
      driver.on_setpoints({&setpoint, 1}, now, out);
      driver.on_tick(now, out);
      judge(driver, setpoint, now, out);
    }
    (void)driver.health(now);
  }
  return 0;
}
