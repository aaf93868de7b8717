// What is told keeps within the limits, and the joint does not.
#include <gmock/gmock.h>

#include "unit/engine/group/engine_group_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

class EngineGroupWatch : public EngineGroup {
 protected:
  explicit EngineGroupWatch(const EngineConfig& config = arm_config()) : EngineGroup(config) {}
  /// The shoulder alone.
  void ask_s(double seconds, const JointTarget& target) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) {
      JointTargets targets;
      (void)targets.joints.push_back(target);
      targets.joints.back().axis = static_cast<AxisId>(first);
      if (i % 2 == 0) rig.command(targets);
      tick();
      fastest_radps = std::max(fastest_radps, std::abs(arm[0].velocity_radps));
      farthest_rad = std::max(farthest_rad, arm[0].position_rad);
    }
  }
  static JointTarget target(double position_rad, double velocity_radps, double effort_Nm,
                            double stiffness, double damping) {
    JointTarget wanted;
    wanted.position_rad = position_rad;
    wanted.velocity_radps = velocity_radps;
    wanted.effort_Nm = effort_Nm;
    wanted.stiffness_Nmprad = stiffness;
    wanted.damping_Nmsprad = damping;
    return wanted;
  }
  /// Held, with its neighbour, until its stream begins anew.
  void expect_stopped(const JointTarget& by, const char* says) {
    EXPECT_EQ(told().state, GroupState::holding);
    EXPECT_THAT(reason(), HasSubstr(says));
    int times = 0;
    for (const Notice& notice : rig.said<Notice>())
      if (notice.text.view().find(says) != std::string_view::npos) ++times;
    EXPECT_EQ(times, 1);
    ask_s(1, by);
    EXPECT_EQ(told().state, GroupState::holding) << "it goes on";
    EXPECT_LT(std::abs(arm[0].velocity_radps), 0.05);
    run_s(1.2);
    ask_s(1, target(arm[0].position_rad, 0, 0, 60, 3));
    EXPECT_EQ(told().state, GroupState::following) << reason();
  }

  double fastest_radps = 0;
  double farthest_rad = -10;
};

TEST_F(EngineGroupWatch, AnEffortAloneThatTurnsItTooFast) {
  settle();
  const JointTarget effort = target(0, 0, 3, 0, 0.1);
  ask_s(1, effort);
  EXPECT_LT(fastest_radps, 5);
  expect_stopped(effort, "shoulder: it turns by ");
  EXPECT_LT(farthest_rad, 1.5);
}

TEST_F(EngineGroupWatch, ASpeedWithoutStiffnessBeyondItsEnd) {
  arm[0].weight_Nm = 0;
  settle();
  const JointTarget speed = target(0, 1, 0, 0, 3);
  ask_s(5, speed);
  expect_stopped(speed, "shoulder: it is driven on at 1.");
  EXPECT_LT(farthest_rad, 1.75);
}

TEST_F(EngineGroupWatch, AnEffortAgainstLittleStiffnessBeyondItsEnd) {
  arm[0].weight_Nm = 0;
  settle();
  const JointTarget effort = target(1, 0, 4, 2, 5);
  ask_s(5, effort);
  expect_stopped(effort, "its limit is 1.50");
  EXPECT_LT(farthest_rad, 1.8);
}

TEST_F(EngineGroupWatch, IsNotForWhoPushes) {
  arm[0].weight_Nm = 0;
  settle();
  ask_s(3, target(0, 0, 0, 2, 0.3));
  for (const double push_Nm : {4.0, -4.0}) {
    fastest_radps = 0;
    arm[0].push_Nm = push_Nm;
    ask_s(0.4, target(0, 0, 0, 2, 0.3));
    EXPECT_GT(fastest_radps, 3);
    arm[0].push_Nm = 0;
    ask_s(2, target(0, 0, 0, 2, 0.3));
    EXPECT_EQ(told().state, GroupState::following) << reason();
  }
}

/// Nor for what sinks, or for who lifts it away from where it is held.
TEST_F(EngineGroupWatch, IsNotForAWeight) {
  settle();
  ask_s(4, target(1, 0, 1, 60, 3));
  ASSERT_GT(arm[0].position_rad, 0.8);
  ask_s(4, target(1, 0, 0, 0, 0));
  EXPECT_GT(fastest_radps, 3);  // it fell
  EXPECT_EQ(told().state, GroupState::following) << reason();
  ask_s(4, target(0, 0, 1.5, 20, 1));
  ASSERT_EQ(told().state, GroupState::following) << reason();
  arm[0].push_Nm = 5;
  ask_s(0.3, target(0, 0, 1.5, 20, 1));
  arm[0].push_Nm = 0;
  ask_s(1, target(0, 0, 1.5, 20, 1));
  EXPECT_EQ(told().state, GroupState::following) << reason();
}

/// Its weight rests beyond its end: it is carried in.
TEST_F(EngineGroupWatch, IsNotForWhatComesBackFromBeyondItsEnd) {
  arm[0].position_rad = 1.7;
  arm[0].weight_Nm = -1;  // it draws up there
  settle();
  arm[0].position_rad = 1.7;
  arm[0].velocity_radps = 0;
  ask_s(4, target(1, 0, -0.5, 60, 3));
  EXPECT_EQ(told().state, GroupState::following) << reason();
  EXPECT_NEAR(arm[0].position_rad, 1, 0.05);
}

/// As an arm hangs, or was led by hand while nobody held it.
EngineConfig effort_config() {
  EngineConfig config = arm_config();
  for (JointRules& rules : config.groups[0].joints) {
    rules.follows = JointFollows::effort;
    rules.min_rad = -0.5;
    rules.max_effort_Nm = 20;
    rules.stiffness_Nmprad = 150;
  }
  return config;
}

class EngineGroupEffort : public EngineGroupWatch {
 protected:
  EngineGroupEffort() : EngineGroupWatch(effort_config()) {}
};

TEST_F(EngineGroupEffort, BringsItBackFromBeyondItsEndNoFasterThanItMayTurn) {
  settle();
  ASSERT_LT(arm[0].position_rad, -1.3);
  ask_s(3, target(0, 0, 0, 0, 1));
  EXPECT_EQ(told().state, GroupState::following) << reason();
  EXPECT_NEAR(arm[0].position_rad, -0.5, 0.03);
  EXPECT_LT(fastest_radps, 1.25);
}

}  // namespace
}  // namespace drover::engine
