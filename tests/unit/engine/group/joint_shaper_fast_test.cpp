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
  double on_rad = 0;      ///< after holding began
  double back_rad = 0;    ///< from there
  double back_radps = 0;  ///< at most
};

/// At `radps`, with little damping and no weight, and then held.
Swing held_at(double radps, JointShaper& shaper) {
  ArmJoint joint;
  joint.weight_Nm = 0;
  joint.state = AxisState::running;
  joint.velocity_radps = radps;
  const auto measured = [&] {
    return JointMeasured{joint.position_rad, joint.velocity_radps, joint.torque_Nm};
  };
  shaper.take_over(measured());
  for (int i = 0; i < 200; ++i) {  // it is led on at that speed
    joint.velocity_radps = radps;
    joint.position_rad = 0;
    shaper.follow(at(0, 0, 0.1), measured(), kCycle_s);
  }
  Swing swing;
  for (int i = 0; i < 800; ++i) {
    shaper.hold(measured(), kCycle_s);
    joint.obey({AxisRequest::run, shaper.velocity_radps(), shaper.impedance()});
    for (int k = 0; k < 5; ++k) joint.step(kCycle_s / 5);
    swing.on_rad = std::max(swing.on_rad, joint.position_rad);
    swing.back_rad = swing.on_rad - joint.position_rad;
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

}  // namespace
}  // namespace drover::engine
