// What a joint's drive measures cannot be believed: its torque goes the wrong way, or its encoder
// stands still.
#include <gmock/gmock.h>

#include "unit/engine/group/engine_group_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

class EngineGroupTrust : public EngineGroup {
 protected:
  explicit EngineGroupTrust(const EngineConfig& config = arm_config()) : EngineGroup(config) {
    for (ArmJoint& joint : arm) joint.weight_Nm = 0;
  }
  void watch_s(double seconds, double position_rad, double stiffness = 60) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) {
      if (i % 2 == 0) send(position_rad, stiffness);
      tick();
      for (ArmJoint& joint : arm) {
        fastest_radps = std::max(fastest_radps, std::abs(joint.velocity_radps));
        hardest_Nm = std::max(hardest_Nm, std::abs(joint.torque_Nm));
      }
    }
  }
  void comes_to_rest() {
    arm[1].rests = true;
    arm[1].velocity_radps = 0;
    arm[1].position_rad += 0.1;
  }

  double fastest_radps = 0;
  double hardest_Nm = 0;
};

TEST_F(EngineGroupTrust, FindsADriveThatTurnsItTheWrongWayAndLetsThatOneGo) {
  arm[1].wrong_way = true;
  settle();
  const double began_rad = arm[1].position_rad;
  watch_s(1.5, -1);
  EXPECT_EQ(said("elbow: it turns by "), 1);
  EXPECT_EQ(said("its drive turns the wrong way, or it is pushed"), 1);
  EXPECT_NE(told().state, GroupState::following);
  EXPECT_EQ(arm[1].torque_Nm, 0) << "it is let go";
  EXPECT_EQ(arm[0].state, AxisState::running) << "its neighbour is held";
  EXPECT_LT(fastest_radps, 8);
  std::printf("  went %.2f rad, at most %.1f rad/s\n", arm[1].position_rad - began_rad,
              fastest_radps);
  const double rest_rad = arm[1].position_rad;
  watch_s(2, -1);
  EXPECT_EQ(arm[1].torque_Nm, 0) << "its commands did not pause";
  EXPECT_LT(std::abs(arm[1].position_rad - rest_rad), 4);
}

TEST_F(EngineGroupTrust, FindsAnEncoderThatStandsInMotion) {
  settle();
  watch_s(1.5, -1);
  ASSERT_EQ(told().state, GroupState::following) << reason();
  fastest_radps = hardest_Nm = 0;
  arm[1].stands = true;
  watch_s(1, 0.5);
  EXPECT_THAT(reason(), HasSubstr("elbow: it stands to the bit"));
  EXPECT_EQ(said("its encoder stands still, or it is blocked"), 1);
  EXPECT_EQ(arm[1].torque_Nm, 0) << "no torque is made of what it does not measure";
  EXPECT_LT(hardest_Nm, 6.1);
  std::printf("  at most %.1f Nm, %.1f rad/s\n", hardest_Nm, fastest_radps);
  // Who begins anew is told anew.
  run_s(1.2);
  watch_s(1.5, 0);
  EXPECT_EQ(said("its encoder stands still, or it is blocked"), 2);
}

/// What it was told was made of a place that is not so, and would drive it on.
TEST_F(EngineGroupTrust, DropsAtOnceWhatItWasToldWhenItsEncoderStands) {
  settle();
  watch_s(1.5, -1);
  arm[1].stands = true;
  for (int i = 0; i < 200 && said("its encoder stands still") == 0; ++i) watch_s(0.005, 0.5);
  ASSERT_EQ(said("its encoder stands still"), 1);
  ASSERT_GT(hardest_Nm, 1);
  tick();
  EXPECT_EQ(arm[1].torque_Nm, 0);
  EXPECT_NE(arm[0].torque_Nm, 0) << "its neighbour is held";
}

/// Nothing that turns stands to the bit from one moment to the next: nobody waits there until the
/// torque has grown, which makes it fast.
TEST_F(EngineGroupTrust, FindsAnEncoderThatStandsInMotionBeforeItsJointIsFast) {
  settle();
  watch_s(1.5, -1);
  watch_s(0.7, 0.5);
  ASSERT_GT(arm[1].velocity_radps, 0.5);
  arm[1].stands = true;
  fastest_radps = 0;
  watch_s(1, 0.5);
  EXPECT_EQ(said("stood to the bit at once: its encoder stands still"), 1) << reason();
  std::printf("  at most %.1f rad/s\n", fastest_radps);
  EXPECT_LT(fastest_radps, 2);
}

/// From rest nobody knows before its torque has grown: then at once, for it is fast by then.
TEST_F(EngineGroupTrust, FindsAnEncoderThatStandsFromRestBeforeItsJointIsFast) {
  settle();
  watch_s(2.5, -1);
  ASSERT_EQ(told().state, GroupState::following) << reason();
  ASSERT_LT(std::abs(arm[1].velocity_radps), 1e-3);
  arm[1].stands = true;
  fastest_radps = hardest_Nm = 0;
  watch_s(1, 0.5);
  EXPECT_EQ(said("it stands to the bit while its torque changed"), 1) << reason();
  std::printf("  at most %.1f Nm, %.1f rad/s\n", hardest_Nm, fastest_radps);
  EXPECT_LT(fastest_radps, 1.5);
}

/// What it is told reaches its drive some cycles late, and what that does is told late, too.
TEST_F(EngineGroupTrust, BelievesADriveThatAnswersThreeCyclesLate) {
  settle();
  watch_s(2.5, -1);
  late_cycles = 3;
  for (const double to_rad : {0.5, -1.0, 0.3, -0.9}) watch_s(2.5, to_rad);
  EXPECT_EQ(said("its encoder stands still"), 0);
  EXPECT_EQ(told().state, GroupState::following) << reason();
  EXPECT_NEAR(arm[1].position_rad, -0.9, 0.05);
}

/// Nobody looked meanwhile: it had its time to come to rest.
TEST_F(EngineGroupTrust, BelievesAJointThatTheGuardBroughtToRest) {
  settle();
  watch_s(1.5, -1);
  watch_s(0.7, 0.5);
  ASSERT_GT(arm[1].velocity_radps, 0.5) << reason();
  rig.guard_has_bus = guards = true;
  tick();
  comes_to_rest();
  run_s(0.5);
  rig.guard_has_bus = guards = false;
  run_s(0.5);
  EXPECT_EQ(said("its encoder stands still"), 0) << reason();
}

TEST_F(EngineGroupTrust, BelievesAJointThatCameToRestWhileNoCycleWasRun) {
  settle();
  watch_s(1.5, -1);
  watch_s(0.7, 0.5);
  ASSERT_GT(arm[1].velocity_radps, 0.5) << reason();
  comes_to_rest();
  rig.now += std::chrono::seconds(1);
  run_s(0.5);
  EXPECT_EQ(said("its encoder stands still"), 0) << reason();
}

/// Of which no effort is kept.
class EngineGroupOfLightJoints : public EngineGroupTrust {
 protected:
  EngineGroupOfLightJoints() : EngineGroupTrust(light_config()) {}
  static EngineConfig light_config() {
    EngineConfig config = arm_config();
    for (JointRules& rules : config.groups[0].joints) rules.carries_weight = false;
    return config;
  }
};

/// What it was told meanwhile it did not hear: that was not the torque it stands against.
TEST_F(EngineGroupOfLightJoints, BelievesAJointThatCameToRestWhileItsLineWasHeldUp) {
  settle();
  watch_s(1, -1.45);
  watch_s(0.5, 0.5);
  ASSERT_EQ(told().state, GroupState::following) << reason();
  ASSERT_GT(arm[1].velocity_radps, 0.5);
  deaf = mute = true;
  watch_s(0.09, 0.5);
  arm[1].rests = true;
  arm[1].velocity_radps = 0;
  mute = false;
  rig.command(CancelTask{});
  tick();
  deaf = false;
  run_s(1);
  EXPECT_EQ(said("stands to the bit"), 0);
  EXPECT_EQ(said("stood to the bit"), 0);
  EXPECT_EQ(told().state, GroupState::holding) << reason();
}

/// Its drive tells positions within a range alone, and at its end those beyond it, too.
class EngineGroupOfSmallRanges : public EngineGroupTrust {
 protected:
  EngineGroupOfSmallRanges() : EngineGroupTrust(small_config()) {}
  static EngineConfig small_config() {
    EngineConfig config = arm_config();
    for (JointRules& rules : config.groups[0].joints) {
      rules.min_rad = -1.6;
      rules.max_rad = 1.5;
      rules.drive.min_rad = -1.7;
      rules.drive.max_rad = 1.7;
    }
    return config;
  }
};

TEST_F(EngineGroupOfSmallRanges, DoNotHoldOrMoveAJointWhereNobodyKnowsWhereItIs) {
  arm[1].least_rad = -1.7;
  arm[1].position_rad = -2.5;  // somebody turned it there
  settle();
  watch_s(2, -1);
  EXPECT_LT(fastest_radps, 0.1);
  EXPECT_LT(hardest_Nm, 1) << "its neighbour begins, and is held";
  EXPECT_NE(told().state, GroupState::following);
  EXPECT_THAT(reason(), HasSubstr("elbow: its drive tells the end of its range, -1.70 rad"));
  run_s(1.2);
  arm[1].position_rad = -1.5;
  watch_s(2, -1);
  EXPECT_EQ(told().state, GroupState::following) << reason();
  EXPECT_NEAR(arm[1].position_rad, -1, 0.05);
}

TEST_F(EngineGroupTrust, BelievesAJointThatRunsIntoItsStop) {
  settle();
  watch_s(1.5, -1);
  arm[1].stop_rad = -0.5;
  watch_s(0.2, 0);
  watch_s(0.3, 0);
  EXPECT_GT(arm[1].position_rad, -0.6);
  for (int i = 0; i < 10; ++i) {
    watch_s(1, -0.9);
    watch_s(0.05 * i, -0.4);
    watch_s(0.6, -0.45);
    EXPECT_EQ(told().state, GroupState::following) << i << ": " << reason();
  }
}

/// Damping drives that on, too: it is told so no longer than it takes to see.
TEST_F(EngineGroupTrust, DropsAtOnceWhatItWasToldWhenItTurnsTheWrongWay) {
  arm[1].wrong_way = true;
  settle();
  for (int i = 0; i < 400 && said("its drive turns the wrong way") == 0; ++i) watch_s(0.005, -1);
  ASSERT_EQ(said("its drive turns the wrong way"), 1);
  tick();
  const Impedance& told = rig.out.axes[first + 1].impedance;
  EXPECT_EQ(told.stiffness_Nmprad, 0);
  EXPECT_EQ(told.effort_Nm, 0);
}

TEST_F(EngineGroupTrust, BelievesAWeightThatIsHeldWhereNothingMoves) {
  arm[0].weight_Nm = 3;
  settle();
  watch_s(4, 0);
  ASSERT_EQ(told().state, GroupState::following) << reason();
  arm[0].rests = true;  // by a brake: nothing of it moves
  watch_s(10, 0);
  EXPECT_EQ(told().state, GroupState::following) << reason();
}

TEST_F(EngineGroupTrust, BelievesAJointThatIsPressedOnItsStop) {
  settle();
  watch_s(3, -1);
  arm[1].stop_rad = -0.9;  // it gives way, by little
  watch_s(4, -0.85);
  EXPECT_EQ(told().state, GroupState::following) << reason();
  EXPECT_GT(arm[1].position_rad, -0.91);
  watch_s(2, -1.2);
  EXPECT_EQ(told().state, GroupState::following) << reason();
}

/// Against what a joint that went its way before is told: somebody pushes.
TEST_F(EngineGroupTrust, BelievesAJointThatSomebodyPushes) {
  settle();
  watch_s(2, -1);
  watch_s(2, -0.5, 10);
  for (const double push_Nm : {5.0, -5.0, 8.0}) {
    arm[0].push_Nm = push_Nm;
    watch_s(0.4, -0.5, 10);
    arm[0].push_Nm = 0;
    watch_s(1.5, -0.5, 10);
    EXPECT_EQ(told().state, GroupState::following) << reason();
  }
}

/// Also from its first moment on: with little stiffness, and with a weight that it cannot lift.
TEST_F(EngineGroupTrust, BelievesAWeightThatSinks) {
  arm[0].weight_Nm = 4;
  arm[0].position_rad = 1.2;
  settle();
  arm[0].position_rad = 1.2;
  arm[0].velocity_radps = 0;
  watch_s(2, 1.2, 4);
  EXPECT_EQ(said("the wrong way"), 0);
  EXPECT_EQ(told().state, GroupState::following) << reason();
}

/// A frame that lies, as a line's noise makes one in some days: no step of torque, no fault.
TEST_F(EngineGroupTrust, PassesOverOnePlaceThatCannotBe) {
  settle();
  watch_s(1.5, 0.3);
  for (const double lie_rad : {1.0, -12.0, 0.2}) {
    hardest_Nm = fastest_radps = 0;
    arm[0].lies_rad = lie_rad;
    watch_s(0.005, 0.3);
    arm[0].lies_rad = 0;
    watch_s(0.5, 0.3);
    EXPECT_LT(hardest_Nm, 0.5) << lie_rad;
    EXPECT_EQ(told().state, GroupState::following) << reason();
  }
  EXPECT_EQ(said("its place leapt"), 0);
}

TEST_F(EngineGroupTrust, PassesOverOneSpeedThatCannotBe) {
  settle();
  watch_s(1.5, 0.3);
  arm[0].lies_radps = 10;
  watch_s(0.005, 0.3);
  arm[0].lies_radps = 0;
  watch_s(0.5, 0.3);
  EXPECT_EQ(told().state, GroupState::following) << reason();
}

/// What it is told goes by a place that is not known any more: it is damped.
TEST_F(EngineGroupTrust, DoesNotBelieveAPlaceThatLeaptAndStays) {
  settle();
  watch_s(3, 0.3);
  hardest_Nm = fastest_radps = 0;
  arm[0].lies_rad = 1;
  watch_s(1, 0.3);
  EXPECT_EQ(said("shoulder: its place leapt by 1.00 rad at once"), 1) << reason();
  EXPECT_LT(hardest_Nm, 0.5);
  EXPECT_NEAR(arm[0].torque_Nm, 0, 1e-9);
  EXPECT_EQ(arm[1].state, AxisState::running);
}

TEST_F(EngineGroupTrust, DoesNotBelievePlacesThatLeapToAndFro) {
  settle();
  watch_s(1.5, 0.3);
  for (int i = 0; i < 40; ++i) {
    arm[0].lies_rad = i % 2 == 0 ? 1 : 0;
    watch_s(0.005, 0.3);
  }
  EXPECT_EQ(said("shoulder: its place leapt by"), 1);
  EXPECT_LT(hardest_Nm, 6.1);
}

}  // namespace
}  // namespace drover::engine
