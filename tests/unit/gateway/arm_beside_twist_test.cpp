// A Scout and a joint beside it, each behind its twin: the chassis has no joint's number, and the
// joint none of the chassis.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/gateway/arm_bench.h"

namespace drover::gateway {
namespace {

constexpr auto kScoutArm = R"({
  "links": {"can0": {"can": "can0"}, "can1": {"can": "can1"}, "panel": {"gpio": "chip0"}},
  "devices": {
    "elbow": {"driver": "damiao", "link": "can1", "options": {"id": 1, "model": "DM4310"}},
    "chassis": {"driver": "agilex_v2", "link": "can0"},
    "estop": {"driver": "gpio_line", "link": "panel", "line": "a", "is": "estop"}},
  "groups": {"base": {"kind": "twist", "device": "chassis", "track_m": 0.44, "hold": "brake"},
             "arm": {"joints": {"elbow": {"min_rad": -1, "max_rad": 1, "max_velocity_radps": 1,
                                          "max_effort_Nm": 5, "stiffness_Nmprad": 40}}}},
  "navigate": {"first_way_m": 0},
  "guard": {"required": false},
  "mqtt": {"host": "127.0.0.1", "port": 1883}
})";

constexpr AxisId kElbow = 0;

class AnArmBesideAScout : public ::testing::Test {
 protected:
  /// By somebody's key.
  void drive(int cycles, double vx_mps) {
    for (int i = 0; i < cycles; ++i) {
      if (i % 10 == 0) bench.command(DriveByHand{1, {vx_mps, 0}});
      bench.cycle();
    }
  }
  bool moves_base() const {
    return std::any_of(bench.to_base().begin(), bench.to_base().end(), [](const CanFrame& frame) {
      return frame.id == 0x111 && (frame.data[0] | frame.data[1] | frame.data[2] | frame.data[3]);
    });
  }
  const Snapshot& seen() const { return bench.gateway.snapshot(); }

  ArmBench bench{kScoutArm, kElbow, "agilex_v2"};
};

TEST_F(AnArmBesideAScout, IsTheOnlyJointThatThereIs) {
  ASSERT_EQ(seen().axes.size(), 1U);
  EXPECT_EQ(seen().axes[kElbow].joint, "elbow");
  EXPECT_EQ(seen().axes[kElbow].group, 1);
  EXPECT_TRUE(seen().base.configured);
}

TEST_F(AnArmBesideAScout, EachDeviceTellsItsOwnHealth) {
  bench.cycles(100);
  EXPECT_EQ(seen().base.health, SourceState::fresh);
  EXPECT_EQ(seen().axes[kElbow].health, SourceState::fresh);
  ASSERT_TRUE(bench.base->set_fault("silent", bench.now));
  bench.cycles(100);
  EXPECT_NE(seen().base.health, SourceState::fresh);
  EXPECT_EQ(seen().axes[kElbow].health, SourceState::fresh);
}

TEST_F(AnArmBesideAScout, FollowsAndTheBaseStandsWithoutAnAllocation) {
  bench.cycles(400);
  for (int i = 0; i < 600; ++i) {
    bench.follow(1, 0.5);
    ASSERT_FALSE(moves_base());
  }
  EXPECT_EQ(bench.arm().state, GroupState::following) << bench.arm().reason.view();
  EXPECT_NEAR(bench.shafts[0].position_rad, 0.5, 0.02);
  EXPECT_EQ(seen().axes[kElbow].state, AxisState::running);
  EXPECT_EQ(bench.base_shafts[0].position_rad, 0);
  EXPECT_EQ(bench.gateway.refused(0), 0U);
  EXPECT_EQ(bench.gateway.refused(1), 0U);
  EXPECT_EQ(bench.allocations, 0U);
}

TEST_F(AnArmBesideAScout, IsLeftAsItIsByABaseThatDrives) {
  bench.cycles(400);
  drive(600, 0.2);
  EXPECT_TRUE(moves_base());
  EXPECT_GT(bench.base_shafts[0].position_rad, 1);
  EXPECT_TRUE(bench.gateway.output().engine.motion_permitted);
  EXPECT_FALSE(bench.gateway.output().engine.joint_may_move[kElbow]);
  EXPECT_EQ(bench.arm().state, GroupState::idle);
  EXPECT_EQ(bench.shafts[0].position_rad, 0);
  EXPECT_EQ(bench.gateway.refused(1), 0U);
  EXPECT_EQ(bench.allocations, 0U);
}

TEST_F(AnArmBesideAScout, IsHeldByAnEstop) {
  bench.cycles(400);
  bench.follow(600, 0.5);
  bench.estop = true;
  bench.follow(200, -0.5);
  EXPECT_EQ(bench.arm().state, GroupState::holding);
  EXPECT_NEAR(bench.shafts[0].position_rad, 0.5, 0.02);
  EXPECT_EQ(bench.gateway.refused(1), 0U);
}

TEST_F(AnArmBesideAScout, IsHeldByItAfterAStopFromOutsideAndTheBaseIsTheGuards) {
  bench.cycles(400);
  bench.follow(600, 0.5);
  bench.guard_has_bus = bench.guard_latched = true;
  bench.cycles(100);
  EXPECT_EQ(bench.arm().state, GroupState::holding);
  EXPECT_FALSE(bench.to_arm().empty());
  EXPECT_TRUE(bench.to_base().empty());
  EXPECT_EQ(bench.gateway.refused(1), 0U);
  EXPECT_NEAR(bench.shafts[0].position_rad, 0.5, 0.02);
}

TEST_F(AnArmBesideAScout, TellsTheGuardOfEachDevice) {
  const auto duties = bench.gateway.duties();
  ASSERT_EQ(duties[0].stops.size(), 1U);
  EXPECT_FALSE(duties[0].stops[0].held_by_daemon);
  ASSERT_EQ(duties[1].stops.size(), 1U);
  EXPECT_TRUE(duties[1].stops[0].held_by_daemon);
  EXPECT_EQ(duties[1].stops[0].recipe.ends, StopEnds::damps);
}

}  // namespace
}  // namespace drover::gateway
