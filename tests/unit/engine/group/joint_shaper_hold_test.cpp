// What holds a joint outside the base, and what it keeps of the effort that was there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/group/joint_shaper.h"
#include "unit/engine/group/arm_joint.h"
#include "unit/engine/group/shaped_joint.h"

namespace drover::engine {
namespace {

/// A bar that its own effort carries, level; then the commands cease.
TEST(JointShaper, HoldKeepsThePlaceWithAllThatCarriedIt) {
  JointShaper shaper(carries(rules_of(JointFollows::impedance)));
  ArmJoint joint;
  joint.state = AxisState::running;
  const auto cycle = [&] {
    joint.obey({AxisRequest::run, shaper.velocity_radps(), shaper.impedance()});
    for (int k = 0; k < 5; ++k) joint.step(kCycle_s / 5);
  };
  const auto measured = [&] { return JointMeasured{joint.position_rad, joint.velocity_radps}; };
  shaper.take_over(measured());
  for (int i = 0; i < 1000; ++i) {
    shaper.follow(at(0, 20), measured(), kCycle_s);
    cycle();
  }
  const double rested = joint.position_rad;
  EXPECT_NEAR(rested, -1.5 / 20, 0.01);  // it sags by weight over stiffness
  double torque = joint.torque_Nm;
  for (int i = 0; i < 2000; ++i) {
    shaper.hold(measured(), kCycle_s);
    cycle();
    EXPECT_NEAR(joint.torque_Nm, torque, 0.1) << i;
    torque = joint.torque_Nm;
  }
  EXPECT_NEAR(joint.position_rad, rested, 0.002);
}

/// Which a push cannot be told from: it stays in the effort. README.md says so.
TEST(JointShaper, HoldTakesAPushForAWeightAndMovesByItsShareWhenItIsLetGo) {
  JointShaper shaper(carries(rules_of(JointFollows::impedance)));
  ArmJoint joint;
  joint.state = AxisState::running;
  joint.weight_Nm = 0;
  const auto cycles = [&](int count, bool follows) {
    for (int i = 0; i < count; ++i) {
      const JointMeasured measured{joint.position_rad, joint.velocity_radps, joint.torque_Nm};
      follows ? shaper.follow(at(0), measured, kCycle_s) : shaper.hold(measured, kCycle_s);
      joint.obey({AxisRequest::run, shaper.velocity_radps(), shaper.impedance()});
      for (int k = 0; k < 5; ++k) joint.step(kCycle_s / 5);
    }
  };
  shaper.take_over({});
  joint.push_Nm = 1.6;
  cycles(800, true);
  const double pushed = joint.position_rad;
  EXPECT_NEAR(pushed, 1.6 / 40, 0.002);
  cycles(2000, false);
  EXPECT_NEAR(joint.position_rad, pushed, 0.001);
  joint.push_Nm = 0;
  cycles(1000, false);
  EXPECT_NEAR(joint.position_rad, pushed - 1.6 / 40, 0.002);
  const double rests = joint.position_rad;
  cycles(2000, false);
  EXPECT_NEAR(joint.position_rad, rests, 0.001);
}

TEST(JointShaper, HoldCarriesNoMoreThanTheLimitOfEffort) {
  JointShaper shaper(carries(rules_of(JointFollows::impedance)));
  shaper.take_over({0.3, 0});
  for (int i = 0; i < 200; ++i) {
    shaper.hold({0.3, 0, -9}, kCycle_s);
    EXPECT_EQ(shaper.impedance().effort_Nm, -4);
  }
}

/// It was told, or somebody pushed: no weight needs it.
TEST(JointShaper, HoldKeepsNoEffortWhereNoWeightIsCarried) {
  JointShaper shaper(rules_of(JointFollows::effort));
  JointTarget presses = at(0, 0, 1);
  presses.effort_Nm = 3;
  shaper.take_over({});
  const JointMeasured blocked{0.3, 0, 3};  // by something in its way
  for (int i = 0; i < 200; ++i) shaper.follow(presses, blocked, kCycle_s);
  EXPECT_NEAR(shaper.impedance().effort_Nm, 3, 1e-9);
  double before_Nm = 3;
  for (int i = 0; i < 100; ++i) {
    shaper.hold(blocked, kCycle_s);
    EXPECT_LT(std::abs(torque_of(shaper, blocked) - before_Nm), 0.1) << i;
    before_Nm = torque_of(shaper, blocked);
  }
  EXPECT_EQ(before_Nm, 0);
  EXPECT_EQ(shaper.impedance().position_rad, 0.3);
}

/// An arm that lies on its stop is not pressed against it, and one that is drawn off it is kept.
TEST(JointShaper, HoldPressesNothingFartherOutOfItsLimits) {
  for (const double effort : {-3.0, 3.0}) {
    JointShaper below(carries(rules_of(JointFollows::impedance)));
    below.take_over({-1.02, 0});
    for (int i = 0; i < 200; ++i) below.hold({-1.02, 0, effort}, kCycle_s);
    EXPECT_EQ(below.impedance().effort_Nm, std::max(effort, 0.0));
    JointShaper above(carries(rules_of(JointFollows::impedance)));
    above.take_over({1.5, 0});
    for (int i = 0; i < 200; ++i) above.hold({1.5, 0, effort}, kCycle_s);
    EXPECT_EQ(above.impedance().effort_Nm, std::min(effort, 0.0));
  }
}

/// Its drive damps until the very cycle, and gives by that what the weight needs.
TEST(JointShaper, WhatFellIsCaughtWithoutAStepOfTorque) {
  JointShaper shaper(carries(rules_of(JointFollows::impedance)));
  JointMeasured measured{0.2, -0.8, 1.6};
  shaper.take_over(measured);
  double before_Nm = 1.6;
  int cycles = 0;
  for (int i = 0; i < 40; ++i) {
    shaper.hold(measured, kCycle_s);
    EXPECT_LT(torque_of(shaper, measured) - before_Nm, 0.25) << i;
    before_Nm = torque_of(shaper, measured);
    if (cycles == 0 && shaper.impedance().effort_Nm > 1.6 - 1e-9) cycles = i + 1;
  }
  EXPECT_GT(cycles, 4);
  EXPECT_LE(cycles, 10);
}

TEST(JointShaper, HoldBrakesAMovementByItsLimit) {
  JointShaper shaper(rules_of(JointFollows::velocity));
  shaper.take_over({0, 0});
  JointTarget target;
  target.velocity_radps = 1;
  double measured = 0;
  for (int i = 0; i < 200; ++i) {
    shaper.follow(target, {measured, shaper.velocity_radps()}, kCycle_s);
    measured = shaper.impedance().position_rad;
  }
  double before = shaper.velocity_radps();
  for (int i = 0; i < 100; ++i) {
    shaper.hold({measured, before}, kCycle_s);
    EXPECT_LE(std::abs(shaper.velocity_radps() - before), 5 * kCycle_s + 1e-9);
    before = shaper.velocity_radps();
    measured = shaper.impedance().position_rad;
  }
  EXPECT_EQ(before, 0);
}

TEST(JointShaper, WhatSinksIsCaughtWhereItIs) {
  JointShaper shaper(carries(rules_of(JointFollows::impedance)));
  ArmJoint joint;
  joint.state = AxisState::running;
  joint.damps_Nmsprad = 2;
  for (int i = 0; i < 100; ++i) {
    joint.obey({});
    for (int k = 0; k < 5; ++k) joint.step(kCycle_s / 5);
  }
  const double caught = joint.position_rad;
  ASSERT_LT(joint.velocity_radps, -0.5);
  shaper.take_over({joint.position_rad, joint.velocity_radps});
  double lowest = caught;
  for (int i = 0; i < 600; ++i) {
    shaper.hold({joint.position_rad, joint.velocity_radps}, kCycle_s);
    joint.obey({AxisRequest::run, shaper.velocity_radps(), shaper.impedance()});
    for (int k = 0; k < 5; ++k) joint.step(kCycle_s / 5);
    lowest = std::min(lowest, joint.position_rad);
  }
  EXPECT_GT(lowest, caught - 0.15);
  EXPECT_LT(joint.position_rad, caught + 0.005);
  EXPECT_GT(joint.position_rad, caught - 0.03);
}

TEST(JointShaper, DampLetsItSinkSlowly) {
  JointShaper shaper(rules_of(JointFollows::impedance));
  ArmJoint joint;
  joint.state = AxisState::running;
  shaper.take_over({0, 0});
  for (int i = 0; i < 400; ++i) {
    shaper.damp({joint.position_rad, joint.velocity_radps}, kCycle_s);
    joint.obey({AxisRequest::run, shaper.velocity_radps(), shaper.impedance()});
    for (int k = 0; k < 5; ++k) joint.step(kCycle_s / 5);
  }
  EXPECT_LT(joint.position_rad, -0.3);
  EXPECT_NEAR(joint.velocity_radps, -1.5 * std::cos(joint.position_rad) / 2.05, 0.1);
}

}  // namespace
}  // namespace drover::engine
