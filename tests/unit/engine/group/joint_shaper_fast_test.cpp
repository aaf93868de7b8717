// A joint that turns faster than it may when it is to be held: led by a hand, or by an effort.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/group/joint_shaper.h"
#include "unit/engine/group/arm_joint.h"
#include "unit/engine/group/shaped_joint.h"

namespace drover::engine {
namespace {

struct Swing {
  double fastest_radps = 0;
  double on_rad = 0;      ///< after holding began
  double back_rad = 0;    ///< from there
  double back_radps = 0;  ///< at most
};

/// At `radps`, with little damping and no weight, and then held.
Swing held_at(double radps, JointShaper& shaper, double stiffness = 0, ArmJoint joint = {}) {
  joint.weight_Nm = 0;
  joint.state = AxisState::running;
  joint.velocity_radps = radps;
  const double from_rad = joint.position_rad;
  const auto measured = [&] {
    return JointMeasured{joint.position_rad, joint.velocity_radps, joint.torque_Nm};
  };
  shaper.take_over(measured());
  for (int i = 0; i < 200; ++i) {  // it is led on at that speed
    joint.velocity_radps = radps;
    joint.position_rad = from_rad;
    shaper.follow(at(from_rad, stiffness, 0.1), measured(), kCycle_s);
  }
  Swing swing;
  for (int i = 0; i < 1600; ++i) {
    shaper.hold(measured(), kCycle_s);
    joint.obey({AxisRequest::run, shaper.velocity_radps(), shaper.impedance()});
    for (int k = 0; k < 5; ++k) joint.step(kCycle_s / 5);
    swing.fastest_radps = std::max(swing.fastest_radps, joint.velocity_radps);
    swing.on_rad = std::max(swing.on_rad, joint.position_rad - from_rad);
    swing.back_rad = swing.on_rad - (joint.position_rad - from_rad);
    swing.back_radps = std::max(swing.back_radps, -joint.velocity_radps);
  }
  return swing;
}

/// The spring that came up while it went on threw it back at four times its fastest speed.
TEST(JointShaper, WhatIsHeldAboveItsSpeedIsNotThrownBack) {
  for (const double radps : {2.5, 5.0, 10.0}) {
    JointShaper shaper(rules_of(JointFollows::impedance));
    const Swing swing = held_at(radps, shaper);
    EXPECT_GT(swing.on_rad, 0.05) << "it is braked, not torn to a stop";
    EXPECT_LT(swing.back_rad, 0.1) << radps;
    EXPECT_LT(swing.back_radps, 1) << radps;
  }
}

/// It is held then: a push moves it as its stiffness says.
TEST(JointShaper, WhatWasHeldAboveItsSpeedIsHeldStiffly) {
  JointShaper shaper(rules_of(JointFollows::impedance));
  (void)held_at(5, shaper);
  EXPECT_DOUBLE_EQ(shaper.impedance().stiffness_Nmprad, 40);
  EXPECT_EQ(shaper.velocity_radps(), 0);
}

/// Its set point goes on at first, and would draw it.
TEST(JointShaper, WhatIsHeldAboveItsSpeedIsNotDrivenOn) {
  struct Arm {
    double inertia_kgm2, stiffness, damping, max_radps, slows_radps2, effort_Nm, radps;
  };
  for (const Arm& arm : {Arm{1, 150, 4.9, 3, 5, 20, 3.2}, Arm{0.3, 80, 3, 3, 5, 20, 4},
                         Arm{1, 150, 3, 1, 2, 20, 1.2}, Arm{0.3, 80, 3, 1, 2, 10, 1.2}}) {
    for (const double told : {5.0, 20.0}) {
      JointRules rules = rules_of(JointFollows::impedance);
      rules.max_rad = 10;
      rules.stiffness_Nmprad = arm.stiffness;
      rules.damping_Nmsprad = arm.damping;
      rules.max_velocity_radps = arm.max_radps;
      rules.max_acceleration_radps2 = arm.slows_radps2;
      rules.max_effort_Nm = arm.effort_Nm;
      JointShaper shaper(rules);
      ArmJoint joint;
      joint.inertia_kgm2 = arm.inertia_kgm2;
      const Swing swing = held_at(arm.radps, shaper, told, joint);
      EXPECT_LT(swing.fastest_radps, arm.radps + 0.1) << arm.inertia_kgm2 << " kgm2, " << told;
      EXPECT_LT(swing.back_radps, arm.max_radps) << arm.inertia_kgm2 << " kgm2, " << told;
    }
  }
}

/// Where its set point goes along, or is still on its way, it ends: there a spring brakes.
TEST(JointShaper, WhatIsHeldInAMovementIsNotHeldBeyondItsEnd) {
  for (const double fastest_radps : {1.0, 3.0}) {
    for (const double told : {0.0, 5.0, 20.0}) {
      for (const double radps : {0.9, 2.9, 5.0}) {
        JointRules rules = rules_of(JointFollows::impedance);
        rules.max_velocity_radps = fastest_radps;
        rules.max_effort_Nm = 20;
        JointShaper shaper(rules);
        ArmJoint joint;
        joint.position_rad = 1.45;
        const Swing swing = held_at(radps, shaper, told, joint);
        EXPECT_LT(1.45 + swing.on_rad - swing.back_rad, 1.5 + 0.01)
            << fastest_radps << ", " << told << ", " << radps;
        EXPECT_LE(shaper.position_rad(), 1.5 + 1e-9);
      }
    }
  }
}

/// It sinks by what its braking takes, and its spring brakes it with the rest.
TEST(JointShaper, AWeightThatFallsIsCaughtWhereItFell) {
  JointRules rules = carries(rules_of(JointFollows::impedance));
  rules.min_rad = -3;
  rules.stiffness_Nmprad = 150;
  rules.damping_Nmsprad = 3;
  rules.max_effort_Nm = 20;
  JointShaper shaper(rules);
  ArmJoint joint;
  joint.weight_Nm = 12;
  joint.inertia_kgm2 = 0.3;
  joint.damps_Nmsprad = 3;
  joint.state = AxisState::running;
  joint.velocity_radps = -4;
  joint.torque_Nm = 12;
  shaper.take_over({0, -4});
  double lowest_rad = 0;
  for (int i = 0; i < 1600; ++i) {
    shaper.hold({joint.position_rad, joint.velocity_radps, joint.torque_Nm}, kCycle_s);
    joint.obey({AxisRequest::run, shaper.velocity_radps(), shaper.impedance()});
    for (int k = 0; k < 5; ++k) joint.step(kCycle_s / 5);
    lowest_rad = std::min(lowest_rad, joint.position_rad);
  }
  EXPECT_GT(lowest_rad, -0.45);
  EXPECT_GT(joint.position_rad, -0.3);
}

}  // namespace
}  // namespace drover::engine
