// Whether a joint's drive drives it beyond its limits, as far as the drive can tell.
#include "engine/group/joint_watch.h"

#include <gmock/gmock.h>

#include "unit/engine/group/shaped_joint.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

/// A drive tells no more than the end of its range, however fast its joint turns.
TEST(JointWatch, WhatTurnsAsFastAsItsDriveCanTellIsTooFast) {
  JointRules rules = rules_of(JointFollows::effort);
  rules.min_rad = -12;
  rules.max_rad = 12;
  rules.max_velocity_radps = 6;
  rules.drive.velocity_radps = 10;
  JointWatch watch(rules);
  Impedance told;
  told.effort_Nm = 3;
  Reason why;
  for (int i = 0; i < 20 && why.empty(); ++i) why = watch.look({0, 10, 3}, told, 0, kCycle_s);
  EXPECT_THAT(why.view(), HasSubstr("it turns by 10.0 rad/s, its limit is 6.0"));
}

TEST(JointWatch, WhatIsToldToTurnSoFastMay) {
  JointRules rules = rules_of(JointFollows::velocity);
  rules.max_velocity_radps = rules.drive.velocity_radps = 10;
  JointWatch watch(rules);
  Impedance told;
  told.damping_Nmsprad = 2;
  told.effort_Nm = 1;
  for (int i = 0; i < 400; ++i)
    ASSERT_EQ(watch.look({0, 10, 1}, told, 9.8, kCycle_s).view(), "") << i;
}

}  // namespace
}  // namespace drover::engine
