// The set point of a joint outside the base has no steps, whatever it is asked.
#include "engine/group/joint_shaper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/engine/group/arm_joint.h"

namespace drover::engine {
namespace {

constexpr double kCycle_s = 0.005;

JointRules rules_of(JointFollows follows) {
  JointRules rules;
  rules.follows = follows;
  rules.min_rad = -1;
  rules.max_rad = 1.5;
  rules.max_velocity_radps = 1;
  rules.max_acceleration_radps2 = 5;
  rules.max_effort_Nm = 4;
  rules.stiffness_Nmprad = 40;
  rules.damping_Nmsprad = 2;
  rules.rise_s = 0.5;
  return rules;
}

JointRules carries(JointRules rules) {
  rules.carries_weight = true;
  return rules;
}

JointTarget at(double position_rad, double stiffness = 40, double damping = 2) {
  JointTarget target;
  target.position_rad = position_rad;
  target.stiffness_Nmprad = stiffness;
  target.damping_Nmsprad = damping;
  return target;
}

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

/// What the drive makes of it, with the joint where it was measured.
double torque_of(const JointShaper& shaper, const JointMeasured& measured) {
  const Impedance& law = shaper.impedance();
  return law.stiffness_Nmprad * (law.position_rad - measured.position_rad) +
         law.damping_Nmsprad * (shaper.velocity_radps() - measured.velocity_radps) + law.effort_Nm;
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
