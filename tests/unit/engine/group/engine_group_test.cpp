// The whole engine with an arm beside its base: each under its own owner, and each stops alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "unit/engine/engine_rig.h"
#include "unit/engine/group/arm_joint.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

constexpr std::size_t kFirst = 4;  // after the wheels
constexpr std::array kNames{"shoulder", "elbow"};

EngineConfig arm_config() {
  EngineConfig config = rig_config();
  GroupConfig arm;
  arm.name = "arm";
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    (void)config.joints.push_back(kNames[i]);
    JointRules rules;
    rules.axis = static_cast<AxisId>(kFirst + i);
    rules.min_rad = -1.5;
    rules.max_rad = 1.5;
    rules.max_effort_Nm = 6;
    rules.stiffness_Nmprad = 60;
    rules.damping_Nmsprad = 3;
    (void)arm.joints.push_back(rules);
  }
  (void)config.groups.push_back(arm);
  return config;
}

class EngineGroup : public ::testing::Test {
 protected:
  explicit EngineGroup(const EngineConfig& config = arm_config()) : rig(config) {
    for (ArmJoint& joint : arm) joint.position_rad = -1.45;  // it hangs
  }

  void tick() {
    const Time told = rig.now + kRigTick;
    for (std::size_t i = 0; i < arm.size(); ++i) {
      const auto axis = static_cast<AxisId>(kFirst + i);
      arm[i].obey(guards ? AxisCommand{} : rig.out.axes[axis]);
      for (int k = 0; k < 5; ++k) arm[i].step(to_s(kRigTick) / 5);
      rig.environment.axes[axis].state = silent[i] ? SourceState::stale : SourceState::fresh;
      if (silent[i]) continue;
      measure(told, AxisMotion{axis, arm[i].position_rad, arm[i].velocity_radps, arm[i].torque_Nm});
      measure(told, AxisStatus{axis, arm[i].state, 0,
                               arm[i].state == AxisState::fault ? Reason("too hot") : Reason()});
    }
    rig.tick();
  }
  /// Of each joint with this stiffness, at 100 Hz.
  void send_s(double seconds, double position_rad, double stiffness = 60) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) {
      if (i % 2 == 0) send(position_rad, stiffness);
      tick();
    }
  }
  void send(double position_rad, double stiffness = 60) {
    JointTargets targets;
    for (std::size_t i = 0; i < arm.size(); ++i)
      (void)targets.joints.push_back(
          {static_cast<AxisId>(kFirst + i), 0, position_rad, 0, stiffness, 3});
    rig.command(targets);
  }
  void run_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) tick();
  }
  void settle() {
    tick();
    rig.set_origin();
    run_s(3);
  }
  const GroupSnapshot& told() const { return rig.snapshot().groups[0]; }
  std::string reason() const { return std::string(told().reason.view()); }
  bool may_move(std::size_t i) const { return rig.out.joint_may_move[kFirst + i]; }

  EngineRig rig;
  std::array<ArmJoint, kNames.size()> arm;
  std::array<bool, kNames.size()> silent{};
  bool guards = false;  ///< the guard commands the drives

 private:
  template <class Value>
  void measure(Time time, const Value& value) {
    Measurement m;
    m.time = m.received = time;
    m.value = value;
    rig.engine->on_measurement(m);
  }
};

TEST_F(EngineGroup, IsLeftAsItIsUntilSomebodyCommandsIt) {
  settle();
  EXPECT_EQ(told().name, "arm");
  EXPECT_EQ(told().state, GroupState::idle);
  for (std::size_t i = 0; i < arm.size(); ++i) {
    EXPECT_EQ(rig.out.axes[kFirst + i].request, AxisRequest::rest);
    EXPECT_FALSE(may_move(i));
    EXPECT_EQ(rig.snapshot().axes[kFirst + i].group, 1);
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
  EXPECT_EQ(reason(), "shoulder: too hot");
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
  EXPECT_EQ(reason(), "shoulder: too hot");
  EXPECT_LT(arm[1].position_rad, 0.5);
}

TEST_F(EngineGroup, ASilentJointIsToldToDampAndTheOthersHold) {
  settle();
  send_s(3, 0.4);
  silent[1] = true;
  send_s(1, 1.0);
  EXPECT_EQ(rig.out.axes[kFirst + 1].request, AxisRequest::rest);
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
    (void)targets.joints.push_back({kFirst, 0, 0.3, 0, 60, 3});
    rig.command(targets);
    tick();
  }
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::joint_command);
  EXPECT_NEAR(rig.fastest_command_radps(), 1.0, 0.1);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_EQ(rig.out.axes[kFirst + 1].request, AxisRequest::rest);  // not named: as it was
}

/// A stream for the arm alone is none for the base, whose own does not go on by it.
TEST_F(EngineGroup, AnArmsStreamIsNoneOfTheBase) {
  settle();
  send_s(1, 0.3);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::nobody);
  EXPECT_EQ(rig.snapshot().joint_command.accepted, 0u);
}

TEST_F(EngineGroup, WhatIsFoundRunningIsHeldAfterARestart) {
  for (ArmJoint& joint : arm) {
    joint.state = AxisState::running;  // as the guard left it
    joint.found_on = joint.damps_while_arming = true;
    joint.damps_Nmsprad = 5;
    joint.arms_in = 20;
    joint.position_rad = 0.7;
  }
  settle();
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_NEAR(arm[0].position_rad, 0.7, 0.1);
  const double held = arm[0].position_rad;
  run_s(10);
  EXPECT_NEAR(arm[0].position_rad, held, 0.001);
}

TEST_F(EngineGroup, WhatTheGuardLetSinkIsHeldWhereItIsGivenBack) {
  settle();
  send_s(4, 0.4);
  run_s(1);
  rig.guard_has_bus = guards = true;  // it only damps
  run_s(1);
  const double sank = arm[0].position_rad;
  ASSERT_LT(sank, 0.1);
  rig.guard_has_bus = guards = false;
  double highest = sank;
  for (int i = 0; i < 400; ++i) {
    tick();
    highest = std::max(highest, arm[0].position_rad);
  }
  EXPECT_LT(highest, sank + 0.02);
  EXPECT_EQ(told().state, GroupState::holding);
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

}  // namespace
}  // namespace drover::engine
