// The set point of a joint outside the base has no steps, whatever it is asked.
#include "engine/group/joint_shaper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/engine/group/arm_joint.h"
#include "unit/engine/group/shaped_joint.h"

namespace drover::engine {
namespace {

TEST(JointShaper, BeginsWithoutStiffnessWhereTheJointIs) {
  JointShaper shaper(rules_of(JointFollows::impedance));
  shaper.take_over({0.3, 0.1});
  EXPECT_EQ(shaper.impedance().stiffness_Nmprad, 0);
  EXPECT_EQ(shaper.impedance().effort_Nm, 0);
  EXPECT_EQ(shaper.impedance().position_rad, 0.3);
  EXPECT_EQ(shaper.velocity_radps(), 0);
}

TEST(JointShaper, AStepOfPositionIsMadeByItsLimits) {
  JointShaper shaper(rules_of(JointFollows::impedance));
  double measured = 0;
  shaper.take_over({measured, 0});
  double before_rad = 0;
  double before_radps = 0;
  double farthest = 0;
  int arrived = 0;
  for (int i = 0; i < 600; ++i) {
    shaper.follow(at(1), {measured, 0}, kCycle_s);
    const double now_rad = shaper.impedance().position_rad;
    const double now_radps = (now_rad - before_rad) / kCycle_s;
    EXPECT_LE(std::abs(now_radps), 1 + 1e-9);
    EXPECT_LE(std::abs(now_radps - before_radps), 2 * 5 * kCycle_s + 1e-9) << i;
    farthest = std::max(farthest, now_rad);
    if (arrived == 0 && now_rad > 1 - 1e-6) arrived = i;
    before_rad = measured = now_rad;  // an ideal drive
    before_radps = now_radps;
  }
  EXPECT_LE(farthest, 1 + 1e-3);
  EXPECT_GT(arrived * kCycle_s, 1.0);  // at 1 rad/s and with two ramps
  EXPECT_LT(arrived * kCycle_s, 1.6);
}

TEST(JointShaper, AStreamWithinTheLimitsIsFollowedWithoutALag) {
  JointShaper shaper(rules_of(JointFollows::impedance));
  shaper.take_over({0, 0});
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    const double t = i * kCycle_s;
    // 100 Hz: each message stands for two cycles.
    const double told_s = i / 2 * 2 * kCycle_s;
    JointTarget target = at(0.5 * (1 - std::cos(told_s)));
    target.velocity_radps = 0.5 * std::sin(told_s);
    shaper.follow(target, {0.5 * (1 - std::cos(t)), 0}, kCycle_s);
    if (i > 100)
      worst = std::max(worst, std::abs(shaper.impedance().position_rad - 0.5 * (1 - std::cos(t))));
  }
  EXPECT_LT(worst, 0.006);
}

TEST(JointShaper, StiffnessComesUpWithinItsTimeAndFallsSo) {
  JointShaper shaper(rules_of(JointFollows::impedance));
  shaper.take_over({0, 0});
  double before = 0;
  for (int i = 0; i < 100; ++i) {
    shaper.follow(at(0), {0, 0}, kCycle_s);
    EXPECT_LE(shaper.impedance().stiffness_Nmprad - before, 40 * 0.01 + 1e-9);
    before = shaper.impedance().stiffness_Nmprad;
  }
  EXPECT_NEAR(before, 40, 1e-9);  // after half a second
  shaper.follow(at(0, 0), {0, 0}, kCycle_s);
  EXPECT_NEAR(shaper.impedance().stiffness_Nmprad, 40 * 0.99, 1e-9);
}

TEST(JointShaper, WhatStiffnessMakesOfADistanceStaysBelowTheLimitOfEffort) {
  JointShaper shaper(rules_of(JointFollows::impedance));
  shaper.take_over({0, 0});
  for (int i = 0; i < 600; ++i) {
    shaper.follow(at(1), {0, 0}, kCycle_s);  // something holds it
    const Impedance& told = shaper.impedance();
    EXPECT_LE(told.stiffness_Nmprad * told.position_rad, 4 + 1e-9);
  }
  EXPECT_EQ(shaper.limited(), bit(JointValue::effort));
}

TEST(JointShaper, StiffnessSpeedAndEffortTogetherStayBelowTheLimitOfEffort) {
  for (const double sign : {-1.0, 1.0}) {
    JointShaper shaper(rules_of(JointFollows::impedance));
    const JointMeasured blocked{0, 0};
    shaper.take_over(blocked);
    JointTarget target = at(sign);
    target.effort_Nm = 3 * sign;
    target.velocity_radps = 0.8 * sign;
    for (int i = 0; i < 600; ++i) {
      shaper.follow(target, blocked, kCycle_s);
      ASSERT_LE(torque_of(shaper, blocked) * sign, 4 + 1e-9) << i;
    }
    EXPECT_NEAR(torque_of(shaper, blocked) * sign, 4, 0.01);
    EXPECT_EQ(shaper.limited(), bit(JointValue::effort));
  }
}

/// What is braked is braked by all that its damping gives, beside all that its stiffness may.
TEST(JointShaper, ALimitOfEffortTakesNothingFromWhatBrakes) {
  JointShaper shaper(rules_of(JointFollows::impedance));
  shaper.take_over({0, 0});
  for (int i = 0; i < 600; ++i) shaper.follow(at(1), {0, 0}, kCycle_s);
  const JointMeasured pushed{0, -1.5};
  shaper.follow(at(1), pushed, kCycle_s);
  EXPECT_NEAR(torque_of(shaper, pushed), 4 + 2 * 1.5, 0.01);
}

TEST(JointShaper, WhatItsDriveCannotBeToldIsClampedAndTold) {
  JointRules rules = rules_of(JointFollows::impedance);
  rules.drive.stiffness_Nmprad = 500;
  rules.drive.damping_Nmsprad = 5;
  JointShaper shaper(rules);
  shaper.take_over({0, 0});
  for (int i = 0; i < 200; ++i) shaper.follow(at(0, 900, 8), {0, 0}, kCycle_s);
  EXPECT_EQ(shaper.limited(), bit(JointValue::stiffness) | bit(JointValue::damping));
  EXPECT_NEAR(shaper.impedance().stiffness_Nmprad, 500, 1e-9);
  EXPECT_NEAR(shaper.impedance().damping_Nmsprad, 5, 1e-9);
  shaper.follow(at(0, 500, 5), {0, 0}, kCycle_s);
  EXPECT_EQ(shaper.limited(), 0);
}

/// An arm that sank while its stiffness was next to nothing, and gets it back.
TEST(JointShaper, WhatSankUnderLittleStiffnessComesBackAsFastAsItMay) {
  JointRules rules = rules_of(JointFollows::impedance);
  rules.max_effort_Nm = 10;
  JointShaper shaper(rules);
  ArmJoint joint;
  joint.state = AxisState::running;
  double torque = 0;
  double worst_Nm = 0;
  double fastest_radps = 0;
  const auto cycles = [&](int count, double stiffness) {
    worst_Nm = fastest_radps = 0;
    for (int i = 0; i < count; ++i) {
      const JointMeasured measured{joint.position_rad, joint.velocity_radps, joint.torque_Nm};
      shaper.follow(at(0.5, stiffness, 2), measured, kCycle_s);
      if (i > 0) worst_Nm = std::max(worst_Nm, std::abs(torque_of(shaper, measured) - torque));
      joint.obey({AxisRequest::run, shaper.velocity_radps(), shaper.impedance()});
      torque = joint.torque_Nm;
      for (int k = 0; k < 5; ++k) joint.step(kCycle_s / 5);
      torque = torque_of(shaper, {joint.position_rad, joint.velocity_radps});
      fastest_radps = std::max(fastest_radps, joint.velocity_radps);
    }
  };
  shaper.take_over({});
  cycles(1000, 60);
  EXPECT_NEAR(joint.position_rad, 0.48, 0.01);
  cycles(1200, 0.2);
  ASSERT_LT(joint.position_rad, -1);  // it hangs
  cycles(1000, 60);
  EXPECT_LT(fastest_radps, 1.2);
  EXPECT_LT(worst_Nm, 0.5);
  EXPECT_NEAR(joint.position_rad, 0.48, 0.01);
}

TEST(JointShaper, WhereStiffnessGrowsTheTorqueOfItsDistanceStays) {
  JointShaper shaper(rules_of(JointFollows::impedance));
  shaper.take_over({0, 0});
  const JointMeasured pushed{0.1, 0};  // off 0, where it is told to be
  for (int i = 0; i < 400; ++i) shaper.follow(at(0, 20), {0, 0}, kCycle_s);
  shaper.follow(at(0, 20), pushed, kCycle_s);
  EXPECT_NEAR(torque_of(shaper, pushed), -2, 1e-6);
  double before_Nm = -2;
  for (int i = 0; i < 100; ++i) {
    shaper.follow(at(0, 30), pushed, kCycle_s);
    EXPECT_LT(std::abs(torque_of(shaper, pushed) - before_Nm), 0.2) << i;
    before_Nm = torque_of(shaper, pushed);
  }
  EXPECT_NEAR(before_Nm, -3, 0.01);
}

TEST(JointShaper, AStiffnessBeyondItsDriveTakesItsTimeToo) {
  JointRules rules = rules_of(JointFollows::impedance);
  rules.drive.stiffness_Nmprad = 500;
  JointShaper shaper(rules);
  shaper.take_over({0, 0});
  for (int i = 0; i < 200; ++i) shaper.follow(at(0, 0.2), {0, 0}, kCycle_s);
  double before = shaper.impedance().stiffness_Nmprad;
  for (int i = 0; i < 200; ++i) {
    shaper.follow(at(0, 99999), {0, 0}, kCycle_s);
    const double now = shaper.impedance().stiffness_Nmprad;
    EXPECT_LE(now - before, 500 * 0.01 + 1e-9) << i;
    before = now;
  }
  EXPECT_EQ(before, 500);
  EXPECT_EQ(shaper.limited(), bit(JointValue::stiffness));
  // At rest lower than it is told, all its effort draws it: not what is left of a huge stiffness.
  for (int i = 0; i < 600; ++i) shaper.follow(at(0, 99999), {-0.5, 0}, kCycle_s);
  EXPECT_NEAR(torque_of(shaper, {-0.5, 0}), 4, 1e-6);
}

TEST(JointShaper, AnEffortIsDampedByWhatItsDriveCanBeTold) {
  JointRules rules = rules_of(JointFollows::effort);
  rules.drive.damping_Nmsprad = 5;
  JointShaper shaper(rules);
  shaper.take_over({0, 0});
  for (int i = 0; i < 200; ++i) shaper.follow(at(0, 0, 8), {0, 0}, kCycle_s);
  EXPECT_EQ(shaper.limited(), bit(JointValue::damping));
  EXPECT_NEAR(shaper.impedance().damping_Nmsprad, 5, 1e-9);
}

TEST(JointShaper, WhatBlocksAVelocityIsTold) {
  JointShaper shaper(rules_of(JointFollows::velocity));
  JointTarget turns;
  turns.velocity_radps = 0.5;
  shaper.take_over({0, 0});
  for (int i = 0; i < 400; ++i) shaper.follow(turns, {0, 0}, kCycle_s);
  EXPECT_EQ(shaper.limited(), bit(JointValue::effort));
}

TEST(JointShaper, BeyondItsLimitsIsClampedAndTold) {
  JointShaper shaper(rules_of(JointFollows::impedance));
  shaper.take_over({0, 0});
  for (int i = 0; i < 800; ++i) shaper.follow(at(7), {1.4, 0}, kCycle_s);
  EXPECT_EQ(shaper.limited(), bit(JointValue::position));
  EXPECT_NEAR(shaper.impedance().position_rad, 1.5, 1e-6);
  JointTarget hard = at(0);
  hard.effort_Nm = -50;
  for (int i = 0; i < 400; ++i) shaper.follow(hard, {0, 0}, kCycle_s);
  EXPECT_NEAR(shaper.impedance().effort_Nm, -4, 1e-9);
  EXPECT_EQ(shaper.limited(), bit(JointValue::effort));
  shaper.follow(at(0), {0, 0}, kCycle_s);
  EXPECT_FALSE(shaper.limited());
}

TEST(JointShaper, AVelocityEndsAtTheEndOfTheJointsWay) {
  JointShaper shaper(rules_of(JointFollows::velocity));
  double measured = 1.2;
  shaper.take_over({measured, 0});
  JointTarget target;
  target.velocity_radps = 1;
  for (int i = 0; i < 600; ++i) {
    shaper.follow(target, {measured, 0}, kCycle_s);
    measured = shaper.impedance().position_rad;
    EXPECT_LE(measured, 1.5 + 0.01);
  }
  EXPECT_GT(measured, 1.45);
  EXPECT_NEAR(shaper.velocity_radps(), 0, 0.05);
}

TEST(JointShaper, AVelocityThatIsBlockedDoesNotPushHarderForEver) {
  JointShaper shaper(rules_of(JointFollows::velocity));
  shaper.take_over({0, 0});
  JointTarget target;
  target.velocity_radps = 0.5;
  for (int i = 0; i < 2000; ++i) shaper.follow(target, {0, 0}, kCycle_s);
  EXPECT_LE(shaper.impedance().position_rad, 4.0 / 40 + 1e-9);
}

TEST(JointShaper, AnEffortAloneMovesNoFasterThanIsAllowedAndNotBeyondTheEnd) {
  JointShaper shaper(rules_of(JointFollows::effort));
  ArmJoint joint;
  joint.weight_Nm = 0;
  joint.state = AxisState::running;
  shaper.take_over({0, 0});
  JointTarget target;
  target.effort_Nm = 3;
  double fastest = 0;
  double farthest = 0;
  for (int i = 0; i < 2000; ++i) {
    shaper.follow(target, {joint.position_rad, joint.velocity_radps}, kCycle_s);
    joint.obey({AxisRequest::run, shaper.velocity_radps(), shaper.impedance()});
    for (int k = 0; k < 5; ++k) joint.step(kCycle_s / 5);
    fastest = std::max(fastest, joint.velocity_radps);
    farthest = std::max(farthest, joint.position_rad);
  }
  EXPECT_GT(fastest, 0.8);
  EXPECT_LT(fastest, 1.5);
  EXPECT_GT(farthest, 1.4);
  EXPECT_LT(farthest, 1.75);
}

}  // namespace
}  // namespace drover::engine
