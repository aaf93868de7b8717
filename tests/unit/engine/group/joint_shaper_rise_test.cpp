// How stiffness, damping and speed of a joint's set point come and go: each within its time, none
// by a step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/group/joint_shaper.h"
#include "unit/engine/group/arm_joint.h"
#include "unit/engine/group/shaped_joint.h"

namespace drover::engine {
namespace {

/// A joint that goes where its set point goes.
struct Led {
  JointShaper shaper;
  JointMeasured measured{0.3, 0};

  explicit Led(const JointRules& rules) : shaper(rules) { shaper.take_over(measured); }
  void goes_along() {
    measured.velocity_radps = shaper.velocity_radps();
    measured.position_rad += measured.velocity_radps * kCycle_s;
  }
  void follow_s(double seconds, JointTarget target, bool at_its_place) {
    for (int i = 0; i < static_cast<int>(seconds / kCycle_s + 0.5); ++i) {
      if (at_its_place) target.position_rad = measured.position_rad;
      shaper.follow(target, measured, kCycle_s);
      goes_along();
    }
  }
  double torque_Nm() const { return torque_of(shaper, measured); }
};

/// The place of a target without stiffness is none, and most leave it at 0.
TEST(JointShaper, ASpeedWithoutStiffnessIsNotDrawnToAPlace) {
  for (const double configured : {0.0, 10.0, 40.0}) {
    JointRules rules = rules_of(JointFollows::impedance);
    rules.stiffness_Nmprad = configured;
    Led joint(rules);
    joint.follow_s(2, at(0.3, 80), true);
    JointTarget speed = at(0, 0, 4);
    speed.velocity_radps = 0.3;
    for (int i = 0; i < 400; ++i) {
      joint.shaper.follow(speed, joint.measured, kCycle_s);
      joint.goes_along();
      ASSERT_GE(joint.shaper.velocity_radps(), 0) << i << ", configured " << configured;
    }
    EXPECT_NEAR(joint.shaper.velocity_radps(), 0.3, 1e-9);
  }
}

TEST(JointShaper, WhatIsMoreThanConfiguredGoesDownWithinItsTimeToo) {
  for (const double configured : {0.0, 10.0, 40.0}) {
    JointRules rules = rules_of(JointFollows::impedance);
    rules.stiffness_Nmprad = configured;
    rules.damping_Nmsprad = 0.5;
    Led joint(rules);
    joint.follow_s(1, at(0.3, 80, 4), true);
    ASSERT_EQ(joint.shaper.impedance().stiffness_Nmprad, 80);
    double before = 80;
    for (int i = 0; i < 100; ++i) {
      // A sender's number is not the same to the bit each time.
      const double noise = 1e-9 * (i % 2);
      joint.shaper.follow(at(0.3, noise, 0.5 + noise), joint.measured, kCycle_s);
      const Impedance& told = joint.shaper.impedance();
      EXPECT_LE(before - told.stiffness_Nmprad, 80 * 0.01 + 1e-9) << "in one cycle";
      before = told.stiffness_Nmprad;
    }
    EXPECT_NEAR(joint.shaper.impedance().stiffness_Nmprad, 0, 1e-6) << configured;
    EXPECT_NEAR(joint.shaper.impedance().damping_Nmsprad, 0.5, 1e-6);
  }
}

/// Led by damping alone, or beside a stiffness: the stop, or the silence, brakes it by its limit.
TEST(JointShaper, NeitherHoldNorDampIsAStepOfTorqueInAMovement) {
  for (const double stiffness : {0.0, 20.0})
    for (const bool holds : {true, false})
      for (const bool tells_effort : {true, false}) {
        Led joint(rules_of(JointFollows::impedance));
        JointTarget target = at(0, stiffness, 4);
        target.velocity_radps = 0.9;
        joint.follow_s(1, target, true);
        ASSERT_NEAR(joint.measured.velocity_radps, 0.9, 0.05);
        double before_Nm = joint.torque_Nm();
        for (int i = 0; i < 200; ++i) {
          if (tells_effort) joint.measured.effort_Nm = joint.torque_Nm();
          holds ? joint.shaper.hold(joint.measured, kCycle_s)
                : joint.shaper.damp(joint.measured, kCycle_s);
          ASSERT_LT(std::abs(joint.torque_Nm() - before_Nm), 0.3)
              << i << ", stiffness " << stiffness << (holds ? ", holds" : ", damps");
          joint.goes_along();
          before_Nm = joint.torque_Nm();
        }
        EXPECT_NEAR(joint.measured.velocity_radps, 0, 1e-6);
      }
}

/// Friction holds it until the stiffness has come up.
TEST(JointShaper, AVelocityThatWasHeldBackBeginsNoFasterThanItMay) {
  for (const double friction_Nm : {0.5, 1.5, 3.0}) {
    JointRules rules = rules_of(JointFollows::velocity);
    rules.max_rad = 4;
    rules.damping_Nmsprad = 1;
    JointShaper shaper(rules);
    JointMeasured measured;
    shaper.take_over(measured);
    JointTarget target;
    target.velocity_radps = 1;
    double fastest_radps = 0;
    for (int i = 0; i < 400; ++i) {
      shaper.follow(target, measured, kCycle_s);
      for (int k = 0; k < 10; ++k) {
        const double drives_Nm = torque_of(shaper, measured);
        double& speed = measured.velocity_radps;
        const bool sticks = std::abs(speed) < 1e-4 && std::abs(drives_Nm) < friction_Nm;
        const double rubs_Nm = std::copysign(friction_Nm, speed != 0 ? speed : drives_Nm);
        const double next = sticks ? 0 : speed + (drives_Nm - rubs_Nm) / 0.02 * kCycle_s / 10;
        speed = speed * next < 0 ? 0 : next;
        measured.position_rad += speed * kCycle_s / 10;
        fastest_radps = std::max(fastest_radps, std::abs(speed));
      }
    }
    EXPECT_LT(fastest_radps, 1.1) << "with a friction of " << friction_Nm << " Nm";
    EXPECT_GT(fastest_radps, 0.9);
  }
}

}  // namespace
}  // namespace drover::engine
