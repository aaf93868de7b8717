// All constraints at once: satisfied only if all are.
#include "scene/constraint/evaluate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/scene/constraint/judged.h"

namespace drover::scene {
namespace {

using testing::ElementsAre;
using yard::box;
using yard::inside;
using yard::joint;
using yard::Judged;

TEST(Constraints, AreSatisfiedOnlyIfAllAre) {
  Judged robot;
  EXPECT_TRUE(robot.holds());
  Constraints set;
  set.name = "row";
  set.joint_constraints = {joint("base/x", 0, 5, 5)};
  set.position_constraints = {inside(box(4, 4, 4))};
  robot.keep(set);
  robot.keep(joint("base/y", 0, 1, 1));
  EXPECT_EQ(robot.verdicts().size(), 3U);
  EXPECT_TRUE(robot.holds());
  EXPECT_FALSE(robot.holds_at({3, 0, 0}));  // the position only
  EXPECT_FALSE(robot.holds_at({0, 1.5, 0}));
}

TEST(Constraints, AnUnweightedFenceCounts) {
  Judged robot;
  PositionConstraint fence = inside(box(4, 4, 4));
  for (const double weight : {0.0, 1e-30, -1.0, kAbsent, 0.1, 7.0}) {
    fence.weight = weight;
    robot.keep(fence);
    EXPECT_FALSE(robot.holds_at({3, 0, 0})) << weight;
    EXPECT_EQ(robot.verdicts()[0].weight, weight >= 0.1 ? weight : 1.0);
    EXPECT_TRUE(robot.holds_at({1, 0, 0})) << weight;
  }
}

TEST(Constraints, TheWorstByWeightTimesErrorIsFirst) {
  Judged robot;
  Constraints set;
  set.name = "row";
  set.joint_constraints = {joint("base/x", 0, 1, 1), joint("base/y", 0, 1, 1),
                           joint("base/theta", 0, 9, 9), joint("mast", 0, 1, 1)};
  set.joint_constraints[0].weight = 0.5;
  robot.keep(set);
  robot.state.base = {4, 3, 0};
  std::vector<std::string> which;
  for (const Verdict& verdict : robot.verdicts()) which.push_back(verdict.which);
  EXPECT_THAT(which,
              ElementsAre("row.joint_constraints[3] (mast)",  // unknown
                          "row.joint_constraints[1] (base/y)", "row.joint_constraints[0] (base/x)",
                          "row.joint_constraints[2] (base/theta)"));
  EXPECT_EQ(robot.why(), "the robot has no joint \"mast\"");
}

TEST(Constraints, WithNumbersThatAreNoneAreStillPutInOrder) {
  Judged robot;
  Constraints set;
  for (int i = 0; i < 40; ++i) {
    JointConstraint bad = joint("base/x", i % 3 == 0 ? kAbsent : 0.01 * i, 0.1, 0.1);
    bad.weight = i % 4 == 0 ? kAbsent : i;
    set.joint_constraints.push_back(bad);
  }
  robot.keep(set);
  const auto verdicts = robot.verdicts();
  EXPECT_EQ(verdicts.size(), 40U);
  for (std::size_t i = 1; i < verdicts.size(); ++i)
    EXPECT_GE(verdicts[i - 1].weight * verdicts[i - 1].error,
              verdicts[i].weight * verdicts[i].error);
}

}  // namespace
}  // namespace drover::scene
