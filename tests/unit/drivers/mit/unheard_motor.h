// A motor in MIT mode of which nothing is heard, and a driver that never heard it.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "unit/drivers/conformance/harness.h"

namespace drover::mit::test {

using drover::test::CanBench;

/// The motor of `before` on a new link, beside the driver of `bench`.
inline void take_motor(CanBench& bench, CanBench& before) {
  bench.twin = std::move(before.twin);
  bench.now = before.now;
  bench.device->on_link_up(bench.now);
}

/// It runs in `before`, and holds a weight from now on.
inline void begin_anew(CanBench& bench, CanBench& before) {
  before.twin->set_fault("silent", before.now);
  take_motor(bench, before);
  bench.load_Nm = 1;
}

/// With 1 Nm on a damping of 1 Nms/rad; a free fall is 20 rad/s after a second.
inline void expect_damped(const CanBench& bench) {
  EXPECT_TRUE(bench.shaft.energized);
  EXPECT_LT(std::abs(bench.shaft.velocity_radps), 1.1);
}

}  // namespace drover::mit::test
