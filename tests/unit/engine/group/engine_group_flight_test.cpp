// A joint that was known to go the right way, and flees all at once: following, or held.
#include <gmock/gmock.h>

#include "unit/engine/group/engine_group_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

class EngineGroupFlight : public EngineGroup {
 protected:
  explicit EngineGroupFlight(const EngineConfig& config = arm_config()) : EngineGroup(config) {}
  /// It went its way before, farther than anybody has to be asked.
  void go_to(double position_rad) {
    settle();
    send_s(4, position_rad);
    ASSERT_EQ(told().state, GroupState::following) << reason();
    ASSERT_NEAR(arm[1].position_rad, position_rad, 0.05);
  }
  /// Seconds until it is told; for one second at most.
  double told_after_s(double position_rad, bool sends) {
    for (int i = 0; i < 200; ++i) {
      if (sends && i % 2 == 0) send(position_rad);
      tick();
      fastest_radps = std::max(fastest_radps, std::abs(arm[1].velocity_radps));
      if (is_accused()) return 0.005 * (i + 1);
    }
    return 1;
  }
  void expect_let_go() {
    for (int i = 0; i < 4; ++i) {
      tick();
      fastest_radps = std::max(fastest_radps, std::abs(arm[1].velocity_radps));
    }
    EXPECT_EQ(arm[1].torque_Nm, 0) << "damping drives it on";
    EXPECT_EQ(arm[0].state, AxisState::running) << "its neighbour is held";
    EXPECT_LT(fastest_radps, 10);
    std::printf("  at most %.1f rad/s\n", fastest_radps);
  }
  bool is_accused() { return said("its drive turns the wrong way, or it is pushed") > 0; }

  double fastest_radps = 0;
};

TEST_F(EngineGroupFlight, OfAHeldJointIsFoundBeforeItIsFast) {
  go_to(0.5);
  run_s(2);
  ASSERT_EQ(told().state, GroupState::holding);
  arm[1].wrong_way = true;
  const double after_s = told_after_s(0.5, false);
  std::printf("  after %.3f s, %.1f rad/s\n", after_s, fastest_radps);
  EXPECT_LT(after_s, 0.15);
  EXPECT_LT(fastest_radps, 8);
  EXPECT_THAT(reason(), HasSubstr("elbow: it turns by "));
  expect_let_go();
}

TEST_F(EngineGroupFlight, OfAJointThatFollowsIsFoundBeforeItIsFast) {
  go_to(0.5);
  arm[1].wrong_way = true;
  const double after_s = told_after_s(0.5, true);
  std::printf("  after %.3f s, %.1f rad/s\n", after_s, fastest_radps);
  EXPECT_LT(after_s, 0.15);
  EXPECT_LT(fastest_radps, 8);
  EXPECT_THAT(reason(), HasSubstr("elbow: it turns by "));
  expect_let_go();
  EXPECT_NE(told().state, GroupState::following);
}

TEST_F(EngineGroupFlight, InTheMidstOfAMovementIsFoundBeforeItIsFast) {
  go_to(-1);
  send_s(0.5, 0.5);
  ASSERT_GT(arm[1].velocity_radps, 0.5) << reason();
  arm[1].wrong_way = true;
  EXPECT_LT(told_after_s(0.5, true), 0.15);
  EXPECT_LT(fastest_radps, 8);
  expect_let_go();
}

/// Whatever tips it over: it stands on its head until somebody touches it.
TEST_F(EngineGroupFlight, OfAHeldJointWithoutAWeightIsFoundOnceItIsTouched) {
  for (ArmJoint& joint : arm) joint.weight_Nm = 0;
  go_to(0.5);
  run_s(2);
  arm[1].wrong_way = true;
  arm[1].push_Nm = 0.1;
  EXPECT_LT(told_after_s(0.5, false), 0.25);
  EXPECT_LT(fastest_radps, 8);
  expect_let_go();
}

/// It goes on by itself then, and is braked: nothing makes it faster against its law.
TEST_F(EngineGroupFlight, IsNotAHeldJointThatIsHitAside) {
  go_to(0.5);
  run_s(2);
  for (const double hit_radps : {10.0, -10.0}) {
    arm[1].velocity_radps = 0.4 * hit_radps;  // measured in the midst of it
    tick();
    arm[1].velocity_radps = hit_radps;
    run_s(1);
    EXPECT_FALSE(is_accused()) << reason();
    EXPECT_NEAR(arm[1].position_rad, 0.5, 0.05);
  }
}

/// Also by twice its effort: damping has him soon, and he gets no faster.
TEST_F(EngineGroupFlight, IsNotAHeldJointThatSomebodyPushes) {
  go_to(0.5);
  run_s(2);
  for (const double push_Nm : {5.0, -7.0, 8.0, -10.0, 12.0, -13.0}) {
    arm[1].push_Nm = push_Nm;
    run_s(0.3);
    arm[1].push_Nm = 0;
    run_s(1.5);
    EXPECT_FALSE(is_accused()) << push_Nm << ": " << reason();
  }
}

/// Whose laws are soft: a hand that swings one goes fast against little.
class EngineGroupSoftFlight : public EngineGroupFlight {
 protected:
  EngineGroupSoftFlight() : EngineGroupFlight(soft_config()) {}
  static EngineConfig soft_config() {
    EngineConfig config = arm_config();
    for (JointRules& rules : config.groups[0].joints) {
      rules.stiffness_Nmprad = 3;
      rules.damping_Nmsprad = 0.3;
    }
    return config;
  }
};

TEST_F(EngineGroupSoftFlight, IsNotAHeldJointThatAHandSwings) {
  for (ArmJoint& joint : arm) joint.weight_Nm = 0;
  go_to(0);
  run_s(2);
  for (int swing = 0; swing < 4; ++swing) {
    arm[1].push_Nm = swing % 2 == 0 ? 9 : -9;
    for (int i = 0; i < 30 && std::abs(arm[1].velocity_radps) < 10; ++i) {
      tick();
      fastest_radps = std::max(fastest_radps, std::abs(arm[1].velocity_radps));
    }
    arm[1].push_Nm = 0;
    run_s(1);
  }
  EXPECT_GT(fastest_radps, 8);
  EXPECT_FALSE(is_accused()) << reason();
}

/// What no effort of it carries gets faster as well: it is damped, which is all that is left.
TEST_F(EngineGroupFlight, IsTakenForAWeightBeyondTheEffort) {
  go_to(0.5);
  run_s(2);
  arm[1].inertia_kgm2 = 0.6;
  arm[1].weight_Nm = 20;
  EXPECT_LT(told_after_s(0.5, false), 1);
  tick();
  const Impedance& told_it = rig.out.axes[first + 1].impedance;
  EXPECT_EQ(told_it.stiffness_Nmprad, 0);
  EXPECT_EQ(told_it.effort_Nm, 0);
}

}  // namespace
}  // namespace drover::engine
