// The whole engine with an arm beside its base: each under its own owner, and each stops alone.
#include <gmock/gmock.h>

#include <cmath>

#include "unit/engine/group/engine_group_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

TEST_F(EngineGroup, IsLeftAsItIsUntilSomebodyCommandsIt) {
  settle();
  EXPECT_EQ(told().name, "arm");
  EXPECT_EQ(told().state, GroupState::idle);
  for (std::size_t i = 0; i < arm.size(); ++i) {
    EXPECT_EQ(rig.out.axes[first + i].request, AxisRequest::rest);
    EXPECT_FALSE(may_move(i));
    EXPECT_EQ(rig.snapshot().axes[first + i].group, 1);
  }
  EXPECT_EQ(rig.snapshot().axes[0].group, 0);
}

TEST_F(EngineGroup, FollowsAStreamFromWhereItIs) {
  settle();
  const double began = arm[0].position_rad;
  send_s(0.29, 0.5);
  EXPECT_EQ(told().state, GroupState::idle);  // nothing is armed by what may be a burst
  send_s(0.1, 0.5);
  EXPECT_NEAR(arm[0].position_rad, began, 0.05);
  send_s(5, 0.5);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_EQ(reason(), "");
  for (const ArmJoint& joint : arm)
    EXPECT_NEAR(joint.position_rad, 0.5 - 1.5 * std::cos(0.5) / 60, 0.01);
  EXPECT_GT(told().accepted, 400u);
  EXPECT_FALSE(rig.out.motion_permitted);  // a moving arm does not open the base's wires
}

TEST_F(EngineGroup, HoldsWhenTheCommandsCease) {
  settle();
  send_s(4, 0.4);
  const double was = arm[1].position_rad;
  run_s(20);
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_NEAR(arm[1].position_rad, was, 0.01);
  EXPECT_TRUE(may_move(0));  // holding is a wish, too
}

TEST_F(EngineGroup, ABurstAfterAGapMovesNothing) {
  settle();
  send_s(4, 0.4);
  run_s(1);
  const double was = arm[0].position_rad;
  for (int i = 0; i < 100; ++i) send(-1);
  run_s(2);
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_NEAR(arm[0].position_rad, was, 0.02);
}

TEST_F(EngineGroup, WhatWasStoppedWaitsUntilItsCommandsPaused) {
  settle();
  send_s(4, 0.4);
  rig.lines[static_cast<std::size_t>(Line::estop)] = true;
  send_s(0.5, 1.0);
  const double was = arm[0].position_rad;
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_THAT(reason(), HasSubstr("e-stop"));
  rig.lines[static_cast<std::size_t>(Line::estop)] = false;
  send_s(3, 1.0);  // it goes on sending, and does not know
  EXPECT_NEAR(arm[0].position_rad, was, 0.02);
  EXPECT_THAT(reason(), HasSubstr("e-stop"));
  run_s(1.2);
  send_s(3, 1.0);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_GT(arm[0].position_rad, 0.8);
}

TEST_F(EngineGroup, StopsByAPersonsWordToo) {
  settle();
  send_s(4, 0.4);
  rig.command(CancelTask{});
  send_s(0.2, 0.8);
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_THAT(reason(), HasSubstr("cancelled"));
  run_s(1.2);
  send_s(3, 0.4);
  EXPECT_EQ(told().state, GroupState::following);
  rig.command(EngageStop{});
  run_s(1.2);
  send_s(2, 0.8);
  EXPECT_EQ(told().state, GroupState::holding);  // latched
  rig.command(ResetStop{});
  run_s(1.2);
  send_s(1, 0.4);
  EXPECT_EQ(told().state, GroupState::following);
}

TEST_F(EngineGroup, AFaultOfOneJointStopsItsGroupAndNotTheBase) {
  const Path path = straight_path(9);
  settle();
  rig.start(path, 18, 0.5);
  run_s(3);
  ASSERT_EQ(rig.snapshot().nav.status, NavStatus::run);
  send_s(4, 0.4);
  ASSERT_EQ(told().state, GroupState::following);
  const double elbow = arm[1].position_rad;
  arm[0].state = AxisState::fault;
  send_s(2, 1.0);
  EXPECT_THAT(reason(), HasSubstr("stopped by shoulder: too hot"));
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_NEAR(arm[1].position_rad, elbow, 0.05);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
  EXPECT_GT(rig.fastest_command_radps(), 1.0);
  EXPECT_EQ(rig.why(), "");
}

TEST_F(EngineGroup, AFaultIsClearedByWhoBeginsAnew) {
  settle();
  send_s(4, 0.4);
  arm[0].state = AxisState::fault;
  send_s(1, 0.6);
  EXPECT_EQ(told().state, GroupState::holding);
  send_s(1, 0.6);  // it goes on, and is refused
  EXPECT_EQ(arm[0].state, AxisState::fault);
  run_s(1.2);
  arm[0].clears = true;
  arm[0].arms_in = 60;
  send_s(0.35, 0.6);
  EXPECT_EQ(told().state, GroupState::arming);  // the elbow waits for the shoulder
  send_s(4, 0.6);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_NEAR(arm[0].position_rad, 0.6, 0.05);
  EXPECT_NEAR(arm[1].position_rad, 0.6, 0.05);
}

TEST_F(EngineGroup, AFaultThatStaysIsToldWhenItsTimeIsUp) {
  settle();
  send_s(4, 0.4);
  arm[0].state = AxisState::fault;
  run_s(1.5);
  send_s(4, 0.6);
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_THAT(reason(), HasSubstr("stopped by shoulder: too hot"));
  EXPECT_LT(arm[1].position_rad, 0.5);
}

TEST_F(EngineGroup, ASilentJointIsToldToDampAndTheOthersHold) {
  settle();
  send_s(3, 0.4);
  silent[1] = true;
  send_s(1, 1.0);
  EXPECT_EQ(rig.out.axes[first + 1].request, AxisRequest::rest);
  EXPECT_FALSE(may_move(1));
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_THAT(reason(), HasSubstr("elbow"));
}

TEST_F(EngineGroup, AFaultOfTheBaseLeavesTheArmAlone) {
  settle();
  send_s(3, 0.4);
  rig.drives[0].fault = true;
  send_s(1, 0.6);
  EXPECT_EQ(told().state, GroupState::following);
  rig.drives[1].silent = true;
  send_s(3, 0.6);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_NEAR(arm[0].position_rad, 0.6, 0.04);
}

TEST_F(EngineGroup, ABaseWithoutArmDrives) {
  const Path path = straight_path(3);
  settle();
  silent = {true, true};
  rig.start(path, 6, 0.5);
  run_s(14);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success);
}

TEST_F(EngineGroup, AMessageNamesTheJointsOfBoth) {
  settle();
  for (int i = 0; i < 400; ++i) {
    JointTargets targets;
    for (AxisId wheel = 0; wheel < 4; ++wheel)
      (void)targets.joints.push_back({wheel, i < 100 ? 0.0 : 1.0});
    (void)targets.joints.push_back({static_cast<AxisId>(first), 0, 0.3, 0, 60, 3});
    rig.command(targets);
    tick();
  }
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::joint_command);
  EXPECT_NEAR(rig.fastest_command_radps(), 1.0, 0.1);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_EQ(rig.out.axes[first + 1].request, AxisRequest::rest);  // not named: as it was
}

/// Sound as a whole, each part of it is for its own: wheels that may not begin stop no arm, and
/// an arm that is held stops no wheels.
TEST_F(EngineGroup, AMessageForBothIsRefusedByOneAlone) {
  settle();
  const auto send_both_s = [&](double seconds, double wheels_radps) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) {
      JointTargets targets;
      for (AxisId wheel = 0; wheel < 4; ++wheel)
        (void)targets.joints.push_back({wheel, wheels_radps});
      for (std::size_t joint = 0; joint < arm.size(); ++joint)
        (void)targets.joints.push_back({static_cast<AxisId>(first + joint), 0, 0.3, 0, 60, 3});
      rig.command(targets);
      tick();
    }
  };
  send_both_s(1, 1);
  EXPECT_EQ(rig.snapshot().joint_command.accepted, 0u) << "it does not begin with velocity 0";
  EXPECT_GT(rig.snapshot().joint_command.refused, 100u);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_EQ(told().refused, 0u);
  arm[0].state = AxisState::fault;
  send_both_s(0.5, 0);
  send_both_s(0.5, 1);
  EXPECT_EQ(told().state, GroupState::holding) << reason();
  EXPECT_GT(told().refused, 0u);
  EXPECT_NEAR(rig.fastest_command_radps(), 1.0, 0.1);
}

/// A stream for the arm alone is none for the base, whose own does not go on by it.
TEST_F(EngineGroup, AnArmsStreamIsNoneOfTheBase) {
  settle();
  send_s(1, 0.3);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::nobody);
  EXPECT_EQ(rig.snapshot().joint_command.accepted, 0u);
}

TEST_F(EngineGroup, ALimitIsToldOnceASecond) {
  settle();
  send_s(3.5, 9);
  int told_times = 0;
  for (const Notice& notice : rig.said<Notice>())
    if (std::string(notice.text.view()).find("limits") != std::string::npos) ++told_times;
  EXPECT_GE(told_times, 3);
  EXPECT_LE(told_times, 4);
  EXPECT_GT(told().limited, 400u);
  EXPECT_LT(arm[0].position_rad, 1.5);
}

/// Each joint with each value.
TEST_F(EngineGroup, ALimitIsToldWithWhatWasAskedOfWhom) {
  settle();
  for (int i = 0; i < 300; ++i) {
    JointTargets targets;
    (void)targets.joints.push_back({static_cast<AxisId>(first), 0, 9, 50, 60, 3});
    (void)targets.joints.push_back({static_cast<AxisId>(first + 1), -7, -1.4, 0, 60, 3});
    rig.command(targets);
    tick();
  }
  const auto all = rig.said<Notice>();
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all.back().text,
            "arm: more was asked than the limits allow: shoulder (position, effort), elbow "
            "(velocity)");
}

TEST_F(EngineGroup, TooSlowAStreamIsToldSo) {
  settle();
  for (int i = 0; i < 10; ++i) {
    send(0.3);
    run_s(0.15);
  }
  EXPECT_EQ(told().state, GroupState::idle);
  send(0.3);
  tick();
  EXPECT_THAT(reason(), HasSubstr("150 ms apart, 100 ms are allowed"));
}

/// The silence before its first command was the one before it, who was fast enough.
TEST_F(EngineGroup, ANewProgramIsNotToldHowLongTheLastOneWasSilent) {
  settle();
  send_s(2, 0.4);
  ASSERT_EQ(told().state, GroupState::following);
  run_s(0.4);
  send_s(0.2, 0.4);
  EXPECT_EQ(reason(), "");
  send_s(0.4, 0.4);
  EXPECT_EQ(told().state, GroupState::following);
}

class ANewProgramOfAnotherWay : public EngineGroup {
 protected:
  void comes_after_one_who_was_too_slow() {
    settle();
    for (int i = 0; i < 10; ++i) {
      send(0.3);
      run_s(0.15);
    }
    ASSERT_THAT(reason(), HasSubstr("150 ms apart"));
    source = RequestId::Source::ros2;
  }
};

/// Nor that of one who was too slow, and came by another way.
TEST_F(ANewProgramOfAnotherWay, IsNotToldHowSlowTheLastOneWas) {
  ASSERT_NO_FATAL_FAILURE(comes_after_one_who_was_too_slow());
  send_s(0.1, 0.4);
  EXPECT_EQ(reason(), "");
}

/// It is of all its joints that somebody else sends now, though he names them in turn.
TEST_F(ANewProgramOfAnotherWay, IsNotToldThatOfAJointThatItNamesSecond) {
  ASSERT_NO_FATAL_FAILURE(comes_after_one_who_was_too_slow());
  JointTargets other;
  (void)other.joints.push_back({static_cast<AxisId>(first + 1), 0, 0.3, 0, 60, 3});
  rig.command(other, source);
  tick();
  send_s(0.1, 0.4);
  EXPECT_EQ(reason(), "");
}

/// What a joint is held by: what was asked for, and its configuration's when nobody asks.
TEST_F(EngineGroup, TellsWhichStiffnessAndDampingAreInForce) {
  settle();
  const AxisSnapshot& shoulder = rig.snapshot().axes[first];
  EXPECT_TRUE(std::isnan(shoulder.stiffness_Nmprad)) << "it is told nothing yet";
  EXPECT_TRUE(std::isnan(rig.snapshot().axes[0].stiffness_Nmprad)) << "a wheel";
  send_s(3, 0.4, 25);
  EXPECT_EQ(shoulder.stiffness_Nmprad, 25);
  EXPECT_EQ(shoulder.damping_Nmsprad, 3);
  run_s(2);
  EXPECT_EQ(shoulder.stiffness_Nmprad, 60) << "it is held as it is configured";
}

TEST_F(EngineGroup, TellsWhoseCommandsItFollows) {
  settle();
  EXPECT_EQ(told().owner, GroupOwner::nobody);
  send_s(0.2, 0.4);
  EXPECT_EQ(told().owner, GroupOwner::nobody);  // it may be a burst
  send_s(0.2, 0.4);
  EXPECT_EQ(told().owner, GroupOwner::broker);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::nobody);
  run_s(1);
  EXPECT_EQ(told().owner, GroupOwner::nobody);
  source = RequestId::Source::ros2;
  send_s(1, 0.4);
  EXPECT_EQ(told().owner, GroupOwner::ros2);
  rig.command(CancelTask{});
  send_s(0.1, 0.4);
  EXPECT_EQ(told().owner, GroupOwner::nobody);
  rig.lines[static_cast<std::size_t>(Line::estop)] = true;
  send_s(0.5, 0.4);
  EXPECT_EQ(told().owner, GroupOwner::estop);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::estop);
}

class EngineGroupReleases : public EngineGroup {
 protected:
  EngineGroupReleases() : EngineGroup(released()) {}
  static EngineConfig released() {
    EngineConfig config = arm_config();
    config.groups[0].joints[0].on_silence = OnSilence::release;
    config.groups[0].joints[1].on_silence = OnSilence::damp;
    return config;
  }
};

TEST_F(EngineGroupReleases, EachJointDoesAsItsRulesSay) {
  settle();
  send_s(4, 0.8);
  run_s(0.5);
  EXPECT_EQ(arm[0].state, AxisState::idle);
  EXPECT_EQ(arm[1].state, AxisState::running);
  EXPECT_EQ(told().state, GroupState::damping);
  run_s(3);
  EXPECT_LT(arm[1].position_rad, 0.2);  // it sank
}

TEST_F(EngineGroupReleases, WhatWasLetGoBeginsWhereItIsThoughItsDriveSaysThatItRuns) {
  settle();
  arm[0].says_on = true;
  send_s(4, 0.8);
  run_s(2);
  ASSERT_LT(arm[0].position_rad, -0.5);  // it fell
  const AxisCommand& told = rig.out.axes[first];
  for (int i = 0; told.request != AxisRequest::run; ++i) {
    ASSERT_LT(i, 200);
    send(0.8);
    tick();
  }
  EXPECT_NEAR(told.impedance.position_rad, arm[0].position_rad, 0.05);
  EXPECT_LT(told.impedance.stiffness_Nmprad, 6);
}

TEST_F(EngineGroup, TakesNoNumberThatCannotBeWhoeverSaysIt) {
  settle();
  send_s(3, 0.5);
  const double before_rad = arm[0].position_rad;
  for (int field = 0; field < 7; ++field) {
    JointTarget bad{static_cast<AxisId>(first), 0, 0.5, 0, 60, 3};
    std::array values{&bad.velocity_radps, &bad.position_rad, &bad.effort_Nm, &bad.stiffness_Nmprad,
                      &bad.damping_Nmsprad};
    if (field < 5)
      *values[field] = std::nan("");
    else
      (field == 5 ? bad.stiffness_Nmprad : bad.damping_Nmsprad) = -1;
    JointTargets targets;
    (void)targets.joints.push_back(bad);
    rig.command(targets);
    send(0.5);
    tick();
  }
  send_s(1, 0.5);
  EXPECT_NEAR(arm[0].position_rad, before_rad, 0.01);
  EXPECT_TRUE(std::isfinite(rig.out.axes[first].impedance.position_rad));
  EXPECT_EQ(told().refused, 7U);
}

}  // namespace
}  // namespace drover::engine
