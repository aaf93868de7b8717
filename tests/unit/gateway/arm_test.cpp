// A base and a joint beside it, each behind its own twin: what one may do opens nothing for the
// other, and what the guard has after a stop from outside is the base alone.
#include <gtest/gtest.h>

#include "unit/gateway/arm_bench.h"

namespace drover::gateway {
namespace {

constexpr auto kArm = R"({
  "links": {"can0": {"can": "can0"}, "can1": {"can": "can1"}, "panel": {"gpio": "chip0"}},
  "devices": {
    "elbow": {"driver": "damiao", "link": "can1", "options": {"id": 1, "model": "DM4310"}},
    "wheels": {"driver": "zlac8015d", "link": "can0",
      "joints": {"left": {"channel": "left"}, "right": {"channel": "right"}}},
    "estop": {"driver": "gpio_line", "link": "panel", "line": "a", "is": "estop"}},
  "groups": {"base": {"kind": "differential", "wheel_radius_m": 0.085, "track_m": 0.42,
                      "left": ["left"], "right": ["right"], "hold": "brake"},
             "arm": {"joints": {"elbow": {"min_rad": -1, "max_rad": 1, "max_velocity_radps": 1,
                                          "max_effort_Nm": 5, "stiffness_Nmprad": 40}}}},
  "guard": {"required": false},
  "mqtt": {"host": "127.0.0.1", "port": 1883}
})";

constexpr AxisId kElbow = 2;  // behind the wheels, though it is written before them

TEST(AnArmAtTheGateway, FollowsWithoutItsBaseAndWithoutAnAllocation) {
  ArmBench bench(kArm, kElbow);
  ASSERT_EQ(bench.gateway.snapshot().axes.size(), 3U);
  EXPECT_EQ(bench.gateway.snapshot().axes[kElbow].joint, "elbow");
  bench.cycles(400);
  EXPECT_EQ(bench.arm().state, GroupState::idle);
  bench.follow(600, 0.5);
  EXPECT_EQ(bench.arm().state, GroupState::following) << bench.arm().reason.view();
  EXPECT_NEAR(bench.shafts[0].position_rad, 0.5, 0.02);
  EXPECT_EQ(bench.gateway.refused(1), 0U);
  EXPECT_EQ(bench.allocations, 0U);
  for (const CanFrame& frame : bench.gateway.output().frames[0])
    EXPECT_NE(frame.id, 0x201U) << "a target for wheels that nobody moves";
}

TEST(AnArmAtTheGateway, IsHeldByItAfterAStopFromOutsideAndNotWhenTheGuardHasAll) {
  ArmBench bench(kArm, kElbow);
  bench.cycles(400);
  bench.follow(600, 0.5);
  bench.guard_has_bus = bench.guard_latched = true;
  bench.cycles(100);
  EXPECT_EQ(bench.arm().state, GroupState::holding);
  EXPECT_FALSE(bench.to_arm().empty());
  EXPECT_EQ(bench.gateway.refused(1), 0U);
  EXPECT_NEAR(bench.shafts[0].position_rad, 0.5, 0.02);
  bench.guard_has_all = true;  // its heartbeat was late
  const auto before = bench.gateway.refused(1);
  bench.cycles(100);
  EXPECT_GT(bench.gateway.refused(1), before);
}

/// That set is another program's, whose axes the guard plays all: two would write.
TEST(AnArmAtTheGateway, IsLeftToALatchedGuardThatKeepsAnotherStopSet) {
  ArmBench bench(kArm, kElbow);
  bench.cycles(400);
  bench.follow(600, 0.5);
  bench.guard_has_bus = bench.guard_latched = bench.guard_refuses_set = true;
  const auto before = bench.gateway.refused(1);
  bench.cycles(100);
  EXPECT_GT(bench.gateway.refused(1), before);
  EXPECT_TRUE(bench.to_arm().empty());
}

TEST(AnArmAtTheGateway, TellsTheGuardWhatItCannotHold) {
  const ArmBench bench(kArm, kElbow);
  const auto duties = bench.gateway.duties();
  ASSERT_EQ(duties[0].stops.size(), 1U);
  EXPECT_FALSE(duties[0].stops[0].held_by_daemon);
  ASSERT_EQ(duties[1].stops.size(), 1U);
  EXPECT_TRUE(duties[1].stops[0].held_by_daemon);
  EXPECT_EQ(duties[1].stops[0].recipe.ends, StopEnds::damps);
}

}  // namespace
}  // namespace drover::gateway
