// A joint that presses for long and does not come to its set point.
#include <gmock/gmock.h>

#include "unit/engine/group/engine_group_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

constexpr const char* kPresses = "and comes no nearer: blocked, pushed, or mirrored";

class EngineGroupBlocked : public EngineGroup {
 protected:
  explicit EngineGroupBlocked(const EngineConfig& config = arm_config()) : EngineGroup(config) {
    for (ArmJoint& joint : arm) joint.weight_Nm = 0;
  }
  /// The shoulder alone.
  void ask_s(double seconds, double position_rad, double effort_Nm, double stiffness,
             double velocity_radps = 0) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) {
      JointTargets targets;
      (void)targets.joints.push_back(
          {static_cast<AxisId>(first), velocity_radps, position_rad, effort_Nm, stiffness, 3});
      if (i % 2 == 0) rig.command(targets);
      tick();
    }
  }
  void expect_ended() {
    EXPECT_EQ(told().state, GroupState::holding);
    EXPECT_THAT(reason(), HasSubstr("shoulder: it presses with "));
    EXPECT_THAT(reason(), HasSubstr(kPresses));
    EXPECT_EQ(said(kPresses), 1);
    EXPECT_LT(std::abs(arm[0].torque_Nm), 0.5) << "and its motor burns";
  }
};

/// One whose stop comes before its limit, or that is mirrored in the configuration: it goes where
/// it is told, in a mirrored world, to the wrong stop.
TEST_F(EngineGroupBlocked, IsToldByNameAndEndsWhatItFollows) {
  arm[0].stop_rad = -1;
  settle();
  send_s(1.5, 0.5);
  EXPECT_EQ(told().state, GroupState::following) << "it pushes for a moment";
  send_s(3, 0.5);
  expect_ended();
  EXPECT_EQ(arm[1].state, AxisState::running);
  EXPECT_LT(std::abs(arm[1].velocity_radps), 0.01) << "its neighbour is held";
}

/// What holding keeps of the effort is a weight's. Here it is what pressed.
TEST_F(EngineGroupBlocked, DoesNotGoOnPressingWhereItCarriesAWeight) {
  arm[0].stop_rad = -0.5;
  arm[0].weight_Nm = 1.5;
  settle();
  send_s(5, 0.8);
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_NEAR(arm[0].position_rad, -0.52, 0.05) << "it hangs on its stiffness";
  EXPECT_LT(arm[0].torque_Nm, 1.5) << "its weight alone";
}

/// Not hard enough to be ended, and for ever once it is held.
TEST_F(EngineGroupBlocked, LetsGoOfWhatItPressesWithWhenItsCommandsCease) {
  arm[0].stop_rad = -0.5;
  arm[0].weight_Nm = 1.5;
  settle();
  send_s(4, -0.43);
  ASSERT_EQ(told().state, GroupState::following) << reason();
  ASSERT_LT(arm[0].stop_Nm(), -2.5);
  run_s(8);
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_EQ(reason(), "");
  EXPECT_GT(arm[0].stop_Nm(), -0.1);
  EXPECT_NEAR(arm[0].torque_Nm, 1.5 * std::cos(arm[0].position_rad), 0.1);
  EXPECT_NEAR(arm[0].position_rad, -0.5, 0.005);
}

TEST_F(EngineGroupBlocked, LetsGoOfItAfterAnEstopToo) {
  arm[0].stop_rad = -0.5;
  arm[0].weight_Nm = 1.5;
  settle();
  send_s(4, -0.43);
  rig.lines[static_cast<std::size_t>(Line::estop)] = true;
  run_s(8);
  EXPECT_GT(arm[0].stop_Nm(), -0.1);
  EXPECT_NEAR(arm[0].torque_Nm, 1.5 * std::cos(arm[0].position_rad), 0.1);
}

/// As by a brake. Letting go of its effort is no reason to take its encoder for one that stands.
TEST_F(EngineGroupBlocked, IsHeldAsBeforeWhereNothingOfItMoves) {
  arm[0].weight_Nm = 3;
  settle();
  send_s(4, -0.5);
  run_s(0.2);
  arm[0].rests = true;
  const double carried = arm[0].torque_Nm;
  run_s(20);
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_EQ(reason(), "");
  EXPECT_NEAR(arm[0].torque_Nm, carried, 0.2);
}

TEST_F(EngineGroupBlocked, FollowsAnewWhenItIsFree) {
  arm[0].stop_rad = -1;
  settle();
  send_s(4.5, 0.5);
  ASSERT_EQ(told().state, GroupState::holding);
  arm[0].stop_rad = 10;
  run_s(1.2);
  send_s(4, 0.5);
  EXPECT_EQ(told().state, GroupState::following) << reason();
  EXPECT_EQ(reason(), "");
  EXPECT_NEAR(arm[0].position_rad, 0.5, 0.03);
}

EngineConfig follows(JointFollows what) {
  EngineConfig config = arm_config();
  for (JointRules& rules : config.groups[0].joints) rules.follows = what;
  return config;
}

class EngineGroupBlockedSpeed : public EngineGroupBlocked {
 protected:
  EngineGroupBlockedSpeed() : EngineGroupBlocked(follows(JointFollows::velocity)) {}
};

TEST_F(EngineGroupBlockedSpeed, IsToldOfASpeedToo) {
  arm[0].stop_rad = -1;
  settle();
  ask_s(5, 0, 0, 0, 0.5);
  expect_ended();
}

class EngineGroupBlockedEffort : public EngineGroupBlocked {
 protected:
  EngineGroupBlockedEffort() : EngineGroupBlocked(follows(JointFollows::effort)) {}
};

/// A gripper.
TEST_F(EngineGroupBlockedEffort, MayPressForEverOnPurpose) {
  arm[0].stop_rad = -1;
  settle();
  ask_s(8, 0, 6, 0);
  EXPECT_EQ(told().state, GroupState::following) << reason();
  EXPECT_EQ(reason(), "");
  EXPECT_NEAR(arm[0].torque_Nm, 6, 0.3);
}

TEST_F(EngineGroupBlocked, IsNotForAnEffortBesideAPlace) {
  arm[0].stop_rad = -1;
  settle();
  ask_s(8, -1, 6, 20);
  EXPECT_EQ(told().state, GroupState::following) << reason();
  EXPECT_EQ(reason(), "");
}

/// Three quarters of what its motor may give, on little stiffness: it sags by 0.45 rad.
TEST_F(EngineGroupBlocked, IsNotForAWeightThatSags) {
  arm[0].weight_Nm = 4.5;
  settle();
  ask_s(12, 0.2, 0, 10);
  EXPECT_EQ(told().state, GroupState::following) << reason();
  EXPECT_EQ(reason(), "");
  EXPECT_LT(arm[0].position_rad, -0.1);
}

TEST_F(EngineGroupBlocked, IsNotForWhoPushesWithinItsStiffness) {
  settle();
  send_s(3, 0);
  arm[0].push_Nm = -4;
  send_s(6, 0);
  EXPECT_LT(arm[0].position_rad, -0.05);
  EXPECT_EQ(told().state, GroupState::following) << reason();
  arm[0].push_Nm = 0;
  send_s(1, 0);
  EXPECT_EQ(reason(), "");
}

/// A heavy one that comes slowly.
TEST_F(EngineGroupBlocked, IsNotForWhatComesNearer) {
  arm[0].friction_Nms = 80;
  settle();
  ask_s(10, 1, 0, 60);
  EXPECT_EQ(told().state, GroupState::following) << reason();
  EXPECT_GT(arm[0].position_rad, -1);
}

/// With a law so soft that it never presses hard nothing burns: it is told.
TEST_F(EngineGroupBlocked, TellsOfASoftOneThatStays) {
  arm[0].stop_rad = -1.4;
  settle();
  send_s(6, -0.9, 5);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_THAT(reason(), HasSubstr("shoulder: its set point went by 0."));
  EXPECT_EQ(said("shoulder: its set point went by 0."), 1);
  send_s(3, -1.45, 5);
  EXPECT_EQ(reason(), "") << "it is back";
}

/// Who leans on a held joint for long; nothing is there to end.
TEST_F(EngineGroupBlocked, TellsOfAHeldOneThatIsPressed) {
  settle();
  send_s(3, 0);
  run_s(2);
  ASSERT_EQ(told().state, GroupState::holding);
  arm[0].push_Nm = -5.5;
  run_s(4);
  EXPECT_THAT(reason(), HasSubstr("shoulder: it presses with "));
  EXPECT_EQ(said(kPresses), 1);
  arm[0].push_Nm = 0;
  run_s(2);
  EXPECT_EQ(reason(), "");
}

}  // namespace
}  // namespace drover::engine
