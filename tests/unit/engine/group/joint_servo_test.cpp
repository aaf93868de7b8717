// One joint outside the base from cycle to cycle: what it keeps of what was, and what not.
#include "engine/group/joint_servo.h"

#include <gmock/gmock.h>

#include "unit/engine/group/shaped_joint.h"

namespace drover::engine {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

struct ServoBench {
  JointServo servo;
  AxisSnapshot axis;
  JointTarget target = at(0.3);
  bool sends = false;
  bool heard = true;
  double tremble_rad = 0;  ///< of its encoder, from one cycle to the next
  double at_rad = 0.3;
  Time now = Time{} + 100s;
  Duration tick = 5ms;
  int measures_each = 1;  ///< so many cycles
  bool goes = false;      ///< where it is told, at once
  int cycle = 0;
  const Reason none{};

  explicit ServoBench(const JointRules& rules = rules_of(JointFollows::impedance)) : servo(rules) {
    axis.state = AxisState::running;
    axis.motion.velocity_radps = 0;
  }
  void step() {
    now += tick;
    ++cycle;
    if (sends && cycle % 2 == 0) servo.take(target, now);
    if (goes) go();
    if (cycle % measures_each == 1 % measures_each) {
      axis.motion.position_rad = at_rad + tremble_rad * (cycle % 2);
      axis.last_motion = now;
    }
    servo.step({now, tick, axis, heard, none, 2s, false, true});
  }
  void go() {
    at_rad = servo.command().impedance.position_rad;
    axis.motion.velocity_radps = servo.command().velocity_radps;
  }
  void run_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / to_s(tick) + 0.5); ++i) step();
  }
  /// Whether it ended by itself meanwhile.
  bool fails_within_s(double seconds) {
    bool failed = false;
    for (int i = 0; i < static_cast<int>(seconds / to_s(tick) + 0.5); ++i) {
      step();
      failed = failed || servo.failed();
    }
    return failed;
  }
};

/// Its blocker is gone, and a joint in good bearings rests to the bit.
TEST(JointServo, WhatStoodToTheBitBeginsAnewWhereNothingIsAskedOfIt) {
  ServoBench joint;
  joint.run_s(1);
  joint.sends = true;
  joint.run_s(1.5);
  joint.target.effort_Nm = 2;
  ASSERT_TRUE(joint.fails_within_s(0.5));
  ASSERT_THAT(joint.servo.reason().view(), HasSubstr("it stands to the bit"));
  joint.sends = false;
  joint.run_s(2);
  joint.target.effort_Nm = 0;
  joint.sends = true;
  EXPECT_FALSE(joint.fails_within_s(2)) << joint.servo.reason().view();
  EXPECT_TRUE(joint.servo.following());
}

/// What it pressed with once is no matter of the effort that is found on it when it is heard again.
TEST(JointServo, WhatPressedBeforeItsDriveWasSilentKeepsTheWeightThatIsFoundOnIt) {
  ServoBench joint(carries(rules_of(JointFollows::impedance)));
  joint.tremble_rad = 0.0004;
  joint.axis.motion.effort_Nm = 1.5;
  joint.run_s(1);
  joint.sends = true;
  joint.run_s(1);
  joint.target.position_rad = 1;
  joint.axis.motion.effort_Nm = 4;
  ASSERT_TRUE(joint.fails_within_s(4));
  joint.sends = false;
  joint.run_s(3);
  joint.heard = false;
  joint.axis.motion.effort_Nm = 1.5;
  joint.run_s(1);
  joint.heard = true;
  joint.at_rad = 0.1;
  joint.run_s(0.5);  // before it is asked what of it the weight needs
  EXPECT_NEAR(joint.servo.command().impedance.effort_Nm, 1.5, 1e-6);
}

/// A gap that ends in the cycle in which it would be seen begins the row anew, and the time that
/// its drive has.
TEST(JointServo, ItsDriveHasTheWholeTimeForEachRowOfCommands) {
  ServoBench joint;
  joint.axis.state = AxisState::arming;
  for (int row = 0; row < 8; ++row) {
    joint.sends = true;
    ASSERT_FALSE(joint.fails_within_s(0.45)) << row << ": " << joint.servo.reason().view();
    EXPECT_EQ(joint.servo.state(), GroupState::arming);
    joint.sends = false;
    ASSERT_FALSE(joint.fails_within_s(0.1)) << row << ": " << joint.servo.reason().view();
    joint.servo.take(joint.target, joint.now + 5ms);
    joint.step();
  }
}

/// As of a drive that measures each 4 ms, asked each 2.
ServoBench often_asked() {
  ServoBench joint;
  joint.tick = 2ms;
  joint.measures_each = 2;
  return joint;
}

/// Time is that of the measurements, however often it is asked between them.
TEST(JointServo, AnEncoderThatStandsIsFoundAsSoonWhereItsCyclesAreShort) {
  for (ServoBench joint : {ServoBench(), often_asked()}) {
    joint.run_s(1);
    joint.sends = true;
    joint.run_s(1.5);
    joint.target.effort_Nm = 2;
    ASSERT_FALSE(joint.fails_within_s(0.1)) << "a fifth of its effort takes so long";
    EXPECT_TRUE(joint.fails_within_s(0.03)) << to_s(joint.tick);
  }
}

/// What is measured seldom is asked no fewer times: what it does is told late.
TEST(JointServo, OneThatMeasuresSeldomHasTheSameNumberOfMeasurementsToGiveWay) {
  ServoBench joint;
  joint.measures_each = 4;
  joint.run_s(1);
  joint.sends = true;
  joint.run_s(1.5);
  joint.target.effort_Nm = 2;
  EXPECT_FALSE(joint.fails_within_s(0.14)) << joint.servo.reason().view();
  EXPECT_TRUE(joint.fails_within_s(0.1));
}

/// It went its way for 0.15 rad: somebody pushes.
TEST(JointServo, OneThatWentWithItsSetPointIsKnownAsSoonWhereItsCyclesAreShort) {
  for (ServoBench joint : {ServoBench(), often_asked()}) {
    joint.run_s(1);
    joint.sends = joint.goes = true;
    joint.run_s(1);
    joint.target.position_rad = joint.at_rad + 0.15;
    joint.run_s(1);
    ASSERT_TRUE(joint.servo.following()) << joint.servo.reason().view();
    joint.goes = false;
    for (double pushed_s = 0; pushed_s < 0.2; pushed_s += to_s(joint.tick)) {
      joint.axis.motion.velocity_radps = -0.3 - 4 * pushed_s;
      joint.at_rad += joint.axis.motion.velocity_radps * to_s(joint.tick);
      joint.step();
    }
    EXPECT_TRUE(joint.servo.following()) << joint.servo.reason().view();
  }
}

}  // namespace
}  // namespace drover::engine
