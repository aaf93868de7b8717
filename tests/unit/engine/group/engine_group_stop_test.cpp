// A stop holds what followed, whatever its rules say of the end of its commands.
#include <gmock/gmock.h>

#include "unit/engine/group/engine_group_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

/// The shoulder is let go when its commands cease, the elbow damps.
class EngineGroupStop : public EngineGroup {
 protected:
  EngineGroupStop() : EngineGroup(ruled()) {}
  static EngineConfig ruled() {
    EngineConfig config = arm_config();
    config.groups[0].joints[0].on_silence = OnSilence::release;
    config.groups[0].joints[1].on_silence = OnSilence::damp;
    return config;
  }

  void expect_held(double at_rad, const char* when) {
    EXPECT_EQ(told().state, GroupState::holding) << when;
    for (const ArmJoint& joint : arm) {
      EXPECT_EQ(joint.state, AxisState::running) << when;
      EXPECT_NEAR(joint.position_rad, at_rad, 0.05) << when;
    }
  }
};

TEST_F(EngineGroupStop, HoldsWhileItsCauseIsThereAndAfterIt) {
  settle();
  send_s(4, 0.8);
  rig.lines[static_cast<std::size_t>(Line::estop)] = true;
  send_s(1, 0.8);
  expect_held(0.8, "pressed, and still commanded");
  run_s(5);
  expect_held(0.8, "pressed, and its commands have ceased");
  rig.lines[static_cast<std::size_t>(Line::estop)] = false;
  run_s(5);
  expect_held(0.8, "released");
  send_s(4, 0.4);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_NEAR(arm[0].position_rad, 0.4, 0.05);
}

TEST_F(EngineGroupStop, HoldsByAPersonsWordToo) {
  settle();
  send_s(4, 0.8);
  rig.command(CancelTask{});
  run_s(3);
  expect_held(0.8, "cancelled");
  send_s(4, 0.6);
  ASSERT_EQ(told().state, GroupState::following);
  rig.command(EngageStop{});
  run_s(3);
  expect_held(0.6, "stopped");
  rig.command(ResetStop{});
  run_s(3);
  expect_held(0.6, "reset");
}

TEST_F(EngineGroupStop, AFaultOfOneHoldsItsNeighbour) {
  settle();
  send_s(4, 0.8);
  arm[1].state = AxisState::fault;
  run_s(3);
  EXPECT_EQ(arm[0].state, AxisState::running);
  EXPECT_NEAR(arm[0].position_rad, 0.8, 0.05);
}

/// After the next stream its rules count again.
TEST_F(EngineGroupStop, OnlyTheEndOfAStreamLetsGo) {
  settle();
  send_s(4, 0.8);
  rig.command(CancelTask{});
  run_s(2);
  send_s(3, 0.8);
  ASSERT_EQ(told().state, GroupState::following);
  run_s(0.5);
  EXPECT_EQ(arm[0].state, AxisState::idle);
  EXPECT_EQ(told().state, GroupState::damping);
}

TEST_F(EngineGroupStop, StopsWhatSinksSlowlyAndArmsNothingThatWasLetGo) {
  settle();
  arm[0].says_on = true;
  send_s(4, 0.8);
  run_s(1);
  const double sinks = arm[1].position_rad;
  ASSERT_LT(sinks, 0.75);
  ASSERT_EQ(rig.out.axes[first].request, AxisRequest::idle);
  rig.lines[static_cast<std::size_t>(Line::estop)] = true;
  run_s(2);
  EXPECT_EQ(rig.out.axes[first].request, AxisRequest::idle);
  EXPECT_NEAR(arm[1].position_rad, sinks, 0.05);
  EXPECT_EQ(rig.out.axes[first + 1].request, AxisRequest::run);
  rig.lines[static_cast<std::size_t>(Line::estop)] = false;
  run_s(2);
  EXPECT_EQ(rig.out.axes[first].request, AxisRequest::idle);
  EXPECT_NEAR(arm[1].position_rad, sinks, 0.05);
}

TEST_F(EngineGroupStop, LeavesAsItIsWhatWasNeverArmed) {
  settle();
  rig.lines[static_cast<std::size_t>(Line::estop)] = true;
  send_s(1, 0.8);
  EXPECT_EQ(told().state, GroupState::idle);
  for (std::size_t i = 0; i < arm.size(); ++i)
    EXPECT_EQ(rig.out.axes[first + i].request, AxisRequest::rest);
}

/// The guard had it, or droverd began anew: that was a stop, too.
TEST_F(EngineGroupStop, WhatIsFoundRunningIsHeld) {
  find_running(0.7);
  settle();
  run_s(5);
  expect_held(arm[0].position_rad, "found");
  EXPECT_NEAR(arm[0].position_rad, 0.7, 0.1);
}

}  // namespace
}  // namespace drover::engine
