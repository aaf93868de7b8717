// Everything on CAN that moves, as subjects, and what is asked of all of it.
#pragma once

#include "unit/drivers/conformance/harness.h"

namespace drover::test {

inline std::vector<Subject> movers() {
  return subjects_with_twin<MakeCanTwin>(&Made::actuator);
}

inline void expect_decent(const CanBench& bench) {
  EXPECT_EQ(bench.off_list, 0) << "sent outside its own allow-list";
  EXPECT_EQ(bench.forbidden, 0) << "sent what it calls forbidden itself";
  EXPECT_EQ(bench.motion_at_rest, 0) << "sent motion while asked to rest";
  EXPECT_EQ(bench.allocations, 0U) << "allocated memory in on_frame, on_setpoints or on_tick";
  EXPECT_EQ(bench.overflows, 0U);
}

}  // namespace drover::test
