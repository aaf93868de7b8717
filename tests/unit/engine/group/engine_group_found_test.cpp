// An arm that is found running, and one that the guard had: it is held where it is.
#include <algorithm>

#include "unit/engine/group/engine_group_fixture.h"

namespace drover::engine {
namespace {

TEST_F(EngineGroup, WhatIsFoundRunningIsHeldAfterARestart) {
  find_running(0.7);
  settle();
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_NEAR(arm[0].position_rad, 0.7, 0.1);
  const double held = arm[0].position_rad;
  run_s(10);
  EXPECT_NEAR(arm[0].position_rad, held, 0.001);
}

// Just after a start nothing may move yet; nobody was stopped by that who had not begun.
TEST_F(EngineGroup, WhatIsFoundRunningFollowsTheFirstStreamAfterARestart) {
  find_running(0.7);
  rig.guard_has_bus = true;
  run_s(0.1);
  rig.guard_has_bus = false;
  settle();
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_EQ(reason(), "");
  send_s(4, 0.2);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_NEAR(arm[0].position_rad, 0.2, 0.05);
}

// And who had begun does not know of it.
TEST_F(EngineGroup, AStreamThatGoesOnOverARestartWaitsUntilItPaused) {
  for (ArmJoint& joint : arm) {
    joint.state = AxisState::running;
    joint.damps_Nmsprad = 5;
    joint.position_rad = 0.7;
  }
  rig.guard_has_bus = true;
  send_s(0.1, 0.2);
  rig.guard_has_bus = false;
  send_s(4, 0.2);
  EXPECT_EQ(told().state, GroupState::holding);
  run_s(1.1);
  send_s(4, 0.2);
  EXPECT_EQ(told().state, GroupState::following);
}

/// Also where it comes to this program late: by a broker that was away, or by drover-ros2, which
/// looks for droverd once a second.
TEST_F(EngineGroup, AStreamThatGoesOnOverARestartWaitsThoughItsWayComesLate) {
  find_running(0.7);
  rig.guard_has_bus = true;
  run_s(0.1);
  rig.guard_has_bus = false;
  settle();
  ASSERT_EQ(told().state, GroupState::holding);
  for (int i = 0; i < 60; ++i) {
    if (i % 2 == 0) rig.command(JointTargetsRefused{"droverd has only just come"}, source);
    tick();
  }
  const double held = arm[0].position_rad;
  send_s(4, 0.2);
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_NEAR(arm[0].position_rad, held, 0.01);
  EXPECT_NE(reason(), "");
  run_s(1.1);
  send_s(4, 0.2);
  EXPECT_EQ(told().state, GroupState::following) << reason();
}

/// Nor does who sent on while all was without power raise an arm that lies.
TEST_F(EngineGroup, AStreamThatGoesOnOverARestartDoesNotArmWhatIsOff) {
  settle();
  for (int i = 0; i < 60; ++i) {
    if (i % 2 == 0) rig.command(JointTargetsRefused{"in whichever words", true}, source);
    tick();
  }
  send_s(4, 0.2);
  EXPECT_EQ(arm[0].state, AxisState::idle);
  EXPECT_EQ(told().state, GroupState::idle);
  EXPECT_EQ(reason(),
            "pause your commands for a second, then send again: it was stopped by a start "
            "of droverd, or of what brings them");
  run_s(1.1);
  EXPECT_EQ(reason(), "");
  send_s(4, 0.2);
  EXPECT_EQ(told().state, GroupState::following) << reason();
}

/// Who goes on for long without being understood is no old stream of this arm's.
TEST_F(EngineGroup, WhatIsRefusedForAnotherCauseKeepsNobodyFromBeginning) {
  settle();
  // Words are for people.
  constexpr const char* why = "droverd has only just come, and nobody's commands are followed yet";
  for (int i = 0; i < 60; ++i) {
    if (i % 2 == 0) rig.command(JointTargetsRefused{why}, source);
    tick();
  }
  send_s(4, 0.2);
  EXPECT_EQ(told().state, GroupState::following) << reason();
}

TEST_F(EngineGroup, WhatTheGuardLetSinkIsHeldWhereItIsGivenBack) {
  settle();
  send_s(4, 0.4);
  run_s(1);
  rig.guard_has_bus = guards = true;  // it only damps
  run_s(1);
  const double sank = arm[0].position_rad;
  ASSERT_LT(sank, 0.1);
  EXPECT_EQ(told().state, GroupState::damping) << "nobody holds it";
  rig.guard_has_bus = guards = false;
  double highest = sank;
  for (int i = 0; i < 400; ++i) {
    tick();
    highest = std::max(highest, arm[0].position_rad);
  }
  EXPECT_LT(highest, sank + 0.02);
  EXPECT_EQ(told().state, GroupState::holding);
}

}  // namespace
}  // namespace drover::engine
