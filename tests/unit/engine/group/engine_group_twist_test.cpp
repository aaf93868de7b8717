// An arm beside a base that takes a twist: the device of the base has no joint's number.
#include <gmock/gmock.h>

#include "unit/engine/engine_twist_fixture.h"
#include "unit/engine/group/engine_group_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

class EngineGroupBesideATwist : public EngineGroup {
 protected:
  EngineGroupBesideATwist() : EngineGroup(arm_config(twist_config())) {}
  void drive() {
    settle();
    rig.start(path, 18, 0.5);
    run_s(4);
    ASSERT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
    ASSERT_GT(rig.out.base.twist.vx_mps, 0.4);
  }
  Path path = straight_path(9);
};

TEST_F(EngineGroupBesideATwist, ItsJointsAreAllThatThereAre) {
  settle();
  ASSERT_EQ(rig.snapshot().axes.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(rig.snapshot().axes[i].joint, kArmNames[i]);
    EXPECT_EQ(rig.snapshot().axes[i].group, 1);
    EXPECT_EQ(rig.out.axes[i].request, AxisRequest::rest);
    EXPECT_FALSE(may_move(i));
  }
  EXPECT_TRUE(rig.snapshot().base.configured);
}

TEST_F(EngineGroupBesideATwist, FollowsWhileTheBaseStands) {
  settle();
  send_s(6, 0.5);
  EXPECT_EQ(told().state, GroupState::following) << reason();
  for (const ArmJoint& joint : arm) EXPECT_NEAR(joint.position_rad, 0.5, 0.04);
  EXPECT_FALSE(rig.out.motion_permitted);
  EXPECT_EQ(rig.out.base.request, AxisRequest::rest);
  EXPECT_EQ(rig.snapshot().base.state, AxisState::idle);
  EXPECT_EQ(rig.snapshot().joint_command.refused, 0U);
}

TEST_F(EngineGroupBesideATwist, FollowsWhileTheBaseDrives) {
  drive();
  send_s(6, 0.5);
  EXPECT_EQ(told().state, GroupState::following) << reason();
  EXPECT_GT(rig.out.base.twist.vx_mps, 0.4);
  EXPECT_NEAR(arm[0].position_rad, 0.5, 0.04);
  run_s(16);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
  EXPECT_NEAR(arm[0].position_rad, 0.5, 0.04);
}

/// What turns in the arm is no way of the base: its edges have the same numbers inside.
TEST_F(EngineGroupBesideATwist, AMovingArmMovesNoEstimate) {
  settle();
  const Pose before = rig.snapshot().pose;
  for (int k = 0; k < 3; ++k) {
    send_s(4, k % 2 == 0 ? 1.2 : -1.2);
    const Pose& pose = rig.snapshot().pose;
    EXPECT_EQ(pose.vx_mps, 0);
    EXPECT_NEAR(std::hypot(pose.x_m - before.x_m, pose.y_m - before.y_m), 0, 0.01);
  }
  EXPECT_EQ(rig.snapshot().estimator.absurd, 0U);
  EXPECT_EQ(rig.why(), "");
}

TEST_F(EngineGroupBesideATwist, AFaultOfTheArmLeavesTheBaseAlone) {
  drive();
  send_s(3, 0.4);
  arm[0].state = AxisState::fault;
  send_s(2, 1.0);
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
  EXPECT_GT(rig.out.base.twist.vx_mps, 0.4);
  EXPECT_EQ(rig.why(), "");
}

TEST_F(EngineGroupBesideATwist, AFaultOfTheBaseLeavesTheArmAlone) {
  drive();
  send_s(3, 0.4);
  rig.drives[0].silent = true;
  send_s(3, 0.6);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  EXPECT_THAT(rig.why(), HasSubstr("the base"));
  EXPECT_EQ(told().state, GroupState::following) << reason();
  EXPECT_NEAR(arm[0].position_rad, 0.6, 0.04);
}

TEST_F(EngineGroupBesideATwist, AnEstopStopsBothAndTheArmIsHeld) {
  drive();
  send_s(3, 0.4);
  rig.lines[static_cast<std::size_t>(Line::estop)] = true;
  send_s(1, 1.0);
  EXPECT_EQ(rig.out.base.twist.vx_mps, 0);
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_NEAR(arm[0].position_rad, 0.4, 0.05);
  EXPECT_TRUE(may_move(0));
  EXPECT_FALSE(rig.out.motion_permitted);
}

/// Who presses the button that is nearest does not ask whose it is.
TEST_F(EngineGroupBesideATwist, TheBasesOwnEstopStopsBothAndTheArmIsHeld) {
  drive();
  send_s(3, 0.4);
  rig.drives[0].fault = rig.drives[0].stops_all = true;
  send_s(1, 1.0);
  EXPECT_EQ(rig.out.base.twist.vx_mps, 0);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  EXPECT_THAT(rig.why(), HasSubstr("its emergency stop is pressed"));
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_NEAR(arm[0].position_rad, 0.4, 0.05);
  rig.drives[0].fault = rig.drives[0].stops_all = false;
  send_s(2, 1.0);
  EXPECT_EQ(told().state, GroupState::holding) << "the same stream, which never paused";
  EXPECT_NEAR(arm[0].position_rad, 0.4, 0.05);
  rig.run_s(1.5);
  send_s(3, 0.6);
  EXPECT_EQ(told().state, GroupState::following) << reason();
  EXPECT_NE(rig.snapshot().nav.status, NavStatus::run) << "that needs a new start";
}

TEST_F(EngineGroupBesideATwist, NoStreamForTheArmBeginsUnderTheBasesOwnEstop) {
  settle();
  rig.drives[0].fault = rig.drives[0].stops_all = true;
  rig.run_s(1);
  send_s(3, 0.4);
  EXPECT_NE(told().state, GroupState::following);
  EXPECT_THAT(reason(), HasSubstr("its emergency stop is pressed"));
}

/// A ramp of the base to rest is none of a joint's.
TEST_F(EngineGroupBesideATwist, ABaseThatIsCaughtSlowsNoJoint) {
  drive();
  send_s(3, 0.4);
  rig.drives[0].fault = rig.drives[0].lapsed = true;
  bool slowed = false;
  for (int i = 0; i < 400; ++i) {
    if (i == 20) rig.drives[0].fault = false;
    rig.disobeys = WheelSpeeds{0.3 / 0.165, 0.3 / 0.165};
    tick();
    slowed = slowed || rig.out.base.slowing_permitted;
    for (const bool slowing : rig.out.slowing_permitted) ASSERT_FALSE(slowing);
  }
  EXPECT_TRUE(slowed);
}

TEST_F(EngineGroupBesideATwist, WhatIsAskedOfNoJointIsTold) {
  settle();
  JointTargets targets;
  (void)targets.joints.push_back({7, 1.0});
  rig.command(targets);
  tick();
  EXPECT_THAT(std::string(rig.snapshot().joint_command.reason.view()), HasSubstr("takes a twist"));
}

}  // namespace
}  // namespace drover::engine
