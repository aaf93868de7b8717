// A driver on a CAN bus under any frames, requests, set points and gaps.
#pragma once

#include <array>

#include "drover/driver.h"
#include "tests/fuzz/input.h"
#include "tests/fuzz/on_list.h"

namespace drover::fuzz {

/// `wanted` reads a set point, given its first byte; `judge` looks at what the driver made of it.
template <class Driver, std::size_t N, class Wanted, class Judge>
void drive_actuator(Driver& driver, const std::array<std::uint32_t, N>& ids, Input& input,
                    const Wanted& wanted, const Judge& judge) {
  Time now{std::chrono::seconds(1)};
  DriverOut out;
  while (input.more()) {
    out.clear();
    now += std::chrono::milliseconds(input.byte());
    const std::uint8_t what = input.byte();
    if (what < 0x80) {
      driver.on_frame(read_frame(input, ids[what % ids.size()]), now, out);
    } else if (what == 0xFF) {
      driver.on_link_up(now);
    } else {
      const Setpoint setpoint = wanted(input, what);
      driver.on_setpoints({&setpoint, 1}, now, out);
      driver.on_tick(now, out);
      judge(driver, setpoint, now, out);
    }
    (void)driver.health(now);
  }
}

}  // namespace drover::fuzz
