#include "scene/constraint/edge.h"

#include <gtest/gtest.h>

#include <random>

#include "unit/scene/constraint/judged.h"

namespace drover::scene {
namespace {

using yard::box;
using yard::inside;
using yard::joint;
using yard::Judged;

/// What a robot that does not know where it looks may rely on.
TEST(AnEdgeAround, HasNothingBeforeIt) {
  std::mt19937 random(11);
  std::uniform_real_distribution<> any(-1, 1);
  int found = 0;
  for (int round = 0; round < 200; ++round) {
    Judged robot;
    Constraints set;
    set.name = "set";
    PositionConstraint position = inside(box(8, 5, 4), yard::at(any(random), any(random), 0));
    if (round % 2 == 0) position.target_point_offset = {any(random), any(random), 0};
    position.constraint_region.primitives.push_back(box(3, 9, 4));
    position.constraint_region.primitive_poses.push_back(yard::at(2, any(random), 0));
    set.position_constraints = {position};
    if (round % 3 == 0) set.joint_constraints = {joint("base/x", 0, 3, 3)};
    robot.keep(set);
    const Pose2 here{4 * any(random), 3 * any(random), kAbsent};
    Terms terms;
    terms.extent = {{}, 0.05, kAbsent};
    const Edges edges(robot.world, robot.robot, terms, here);
    if (edges.empty()) continue;
    const double most_m = 3;
    const auto edge = edges.around(here, most_m);
    if (edge) ++found;
    robot.terms = terms;
    const bool all = robot.holds_at(here);  // else one of them is told as broken already
    robot.terms.extent.turn_rad = 0;
    for (int i = 0; all && i < 200; ++i) {
      const double off_m = (edge ? edge->driven_m : most_m) * std::abs(any(random));
      const Point2 to = off_m * direction(kPi * any(random));
      ASSERT_TRUE(robot.holds_at({here.x_m + to.x_m, here.y_m + to.y_m, kPi * any(random)}))
          << round;
    }
  }
  EXPECT_GT(found, 50);
}

TEST(AnEdgeAround, IsNoneWhereAllHoldsAsFarAsAsked) {
  Judged robot;
  robot.keep(inside(box(40, 40, 4)));
  const Edges edges(robot.world, robot.robot, robot.terms, {0, 0, kAbsent});
  EXPECT_FALSE(edges.around({0, 0, kAbsent}, 3).has_value());
  const auto edge = edges.around({0, 0, kAbsent}, 30);
  ASSERT_TRUE(edge.has_value());
  EXPECT_LE(edge->driven_m, 20);
  EXPECT_GT(edge->driven_m, 20 * 0.98 - 0.002) << "a circle is taken 2 % too wide";
  EXPECT_EQ(edge->which, "set.position_constraints[0] (base_link)");
}

/// A region that goes along is left nowhere.
TEST(AnEdgeAround, IsNoneOfARegionOfTheRobotsOwn) {
  Judged robot;
  PositionConstraint position = inside(box(2, 2, 4));
  position.header.frame_id = "base_link";
  robot.keep(position);
  const Edges edges(robot.world, robot.robot, robot.terms, {0, 0, kAbsent});
  ASSERT_FALSE(edges.empty());
  EXPECT_FALSE(edges.around({0, 0, kAbsent}, 100).has_value());
}

}  // namespace
}  // namespace drover::scene
