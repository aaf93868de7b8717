// A speed beside a position: it goes ahead of one that moves, and leads nowhere else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/group/joint_shaper.h"
#include "unit/engine/group/shaped_joint.h"

namespace drover::engine {
namespace {

JointTarget with(double position_rad, double velocity_radps) {
  JointTarget target = at(position_rad);
  target.velocity_radps = velocity_radps;
  return target;
}

/// An ideal drive: the joint is where it is told.
class AnIdealJoint {
 public:
  explicit AnIdealJoint(const JointRules& rules, double from_rad = 0) : shaper(rules) {
    shaper.take_over({from_rad, 0});
    place_rad = farthest_rad = from_rad;
  }
  void follow(const JointTarget& target, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kCycle_s); ++i) {
      shaper.follow(target, {place_rad, shaper.velocity_radps()}, kCycle_s);
      limited = limited || (shaper.limited() & bit(JointValue::position)) != 0;
      const double now_rad = shaper.impedance().position_rad;
      const double now_radps = (now_rad - place_rad) / kCycle_s;
      hardest_radps2 = std::max(hardest_radps2, std::abs(now_radps - speed_radps) / kCycle_s);
      place_rad = now_rad;
      speed_radps = now_radps;
      farthest_rad = std::max(farthest_rad, place_rad);
    }
  }
  JointShaper shaper;
  double place_rad = 0;
  double speed_radps = 0;
  double farthest_rad = 0;
  double hardest_radps2 = 0;
  bool limited = false;
};

/// Beside a position at the joint's end a speed led it 0.125 rad beyond, at a slow acceleration by
/// more than half a radian.
TEST(JointShaper, ASpeedLeadsNoSetPointBeyondItsLimits) {
  for (const double acceleration : {5.0, 1.0}) {
    JointRules rules = rules_of(JointFollows::impedance);
    rules.max_acceleration_radps2 = acceleration;
    for (const double position : {1.45, 1.5}) {
      AnIdealJoint joint(rules, 0.5);
      joint.follow(with(position, 1), 4);
      EXPECT_LE(joint.farthest_rad, 1.5 + 1e-9) << position << " at " << acceleration;
      EXPECT_FALSE(joint.limited) << "nothing was cut off";
      EXPECT_LE(joint.hardest_radps2, 2 * acceleration + 1e-6) << "not torn to a stop there";
    }
  }
}

/// One that moves a little all the time, with a speed as if by much.
TEST(JointShaper, ASpeedThatLeadsOutIsCutOffAndTold) {
  AnIdealJoint joint(rules_of(JointFollows::impedance), 0.5);
  for (int i = 0; i < 400; ++i) joint.follow(with(i % 2 == 0 ? 1.45 : 1.451, 1), 2 * kCycle_s);
  EXPECT_LE(joint.farthest_rad, 1.5 + 1e-9);
  EXPECT_TRUE(joint.limited);
  EXPECT_LE(joint.hardest_radps2, 2 * 5 + 1e-6);
}

/// Which is within its limits to its very end.
TEST(JointShaper, AStreamToItsEndIsNotCutOff) {
  AnIdealJoint joint(rules_of(JointFollows::impedance), 0.5);
  for (int i = 0; i < 400; ++i) {
    const double t = 2 * kCycle_s * i;
    joint.follow(with(1 - 0.5 * std::cos(t), 0.5 * std::sin(t)), 2 * kCycle_s);
  }
  EXPECT_FALSE(joint.limited);
}

TEST(JointShaper, ASpeedBesideAPositionThatStandsComesToNothing) {
  for (const double radps : {0.5, 1.0, -1.0}) {
    AnIdealJoint joint(rules_of(JointFollows::impedance));
    joint.follow(with(0.6, radps), 4);
    EXPECT_NEAR(joint.place_rad, 0.6, 1e-6) << radps;
    EXPECT_EQ(joint.shaper.velocity_radps(), 0) << radps;
  }
}

/// From below its set point had the speed when it came there, and kept it for ever.
TEST(JointShaper, ASpeedThatItComesToItsPositionWithIsLetGo) {
  AnIdealJoint joint(rules_of(JointFollows::impedance), -0.9);
  joint.follow(with(0.5, 1), 6);
  EXPECT_NEAR(joint.place_rad, 0.5, 1e-6);
  EXPECT_EQ(joint.shaper.velocity_radps(), 0);
}

/// Without stiffness the position has no weight, and the speed is all that is asked.
TEST(JointShaper, ASpeedWithoutStiffnessIsFollowedOn) {
  AnIdealJoint joint(rules_of(JointFollows::impedance));
  JointTarget target = with(0, 0.5);
  target.stiffness_Nmprad = 0;
  joint.follow(target, 2);
  EXPECT_EQ(joint.shaper.velocity_radps(), 0.5);
}

}  // namespace
}  // namespace drover::engine
