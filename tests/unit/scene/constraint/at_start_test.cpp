// What can be said of a track before it is driven.
#include "scene/constraint/at_start.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/scene/constraint/judged.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;
using yard::add_box;
using yard::at;
using yard::box;
using yard::inside;
using yard::joint;
using yard::Judged;

/// Ten metres along x, a pose every half metre.
std::vector<Pose2> straight() {
  std::vector<Pose2> track;
  for (int i = 0; i <= 20; ++i) track.push_back({0.5 * i, 0, 0});
  return track;
}

std::optional<Offence> first(const Judged& robot, const std::vector<Pose2>& track) {
  return first_offence(robot.world, robot.robot, track, robot.terms);
}

TEST(AtStart, TheFirstPoseThatBreaksAConstraintIsNamed) {
  Judged robot;
  robot.keep(inside(box(6, 4, 4), at(2, 0)));
  const auto offence = first(robot, straight());
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->index, 11U);  // x = 5.5
  EXPECT_EQ(offence->verdict.which, "set.position_constraints[0] (base_link)");
  EXPECT_EQ(offence->verdict.why, "0.500 m outside of its region");
  EXPECT_FALSE(offence->verdict.holds);
}

TEST(AtStart, ATrackThatHoldsEverythingHasNoOffence) {
  Judged robot;
  robot.keep(inside(box(30, 4, 4)));
  EXPECT_FALSE(first(robot, straight()));
  EXPECT_FALSE(first(robot, {}));
}

TEST(AtStart, ThePlaceOfTheBaseIsKnownAheadItsOtherJointsAreNot) {
  Judged robot;
  Constraints set;
  set.joint_constraints = {joint("arm", 0, 1, 1), joint("base/x", 0, 7.2, 7.2)};
  robot.keep(set);
  const auto offence = first(robot, straight());
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->index, 15U);
  EXPECT_EQ(offence->verdict.which, "set.joint_constraints[1] (base/x)");
  EXPECT_EQ(known_ahead(set.joint_constraints[0]), Ahead::nothing);
  EXPECT_EQ(known_ahead(set.joint_constraints[1]), Ahead::all);
}

TEST(AtStart, OfAnOrientationOnlyTheYawIsKnownAhead) {
  Judged robot;
  OrientationConstraint orientation;
  orientation.header.frame_id = "map";
  orientation.link_name = "base_link";
  orientation.absolute_x_axis_tolerance = 0;
  orientation.absolute_y_axis_tolerance = 0;
  orientation.absolute_z_axis_tolerance = 0.5;
  robot.keep(orientation);
  EXPECT_EQ(known_ahead(orientation), Ahead::yaw_only);
  std::vector<Pose2> track = straight();
  EXPECT_FALSE(first(robot, track));
  track[7].yaw_rad = 0.6;
  const auto offence = first(robot, track);
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->index, 7U);
  EXPECT_THAT(offence->verdict.why, HasSubstr("deg about z"));
}

TEST(AtStart, AViewIsJudgedAlongTheTrack) {
  Judged robot;
  VisibilityConstraint visibility;
  visibility.target_radius = 0.1;
  visibility.target_pose.header.frame_id = "map";
  visibility.target_pose.pose = {{30, 0, 0.6}, {}};
  visibility.sensor_pose.header.frame_id = "base_link";
  visibility.sensor_pose.pose = {{0, 0, 0.8}, {}};
  visibility.sensor_view_direction = VisibilityConstraint::SENSOR_X;
  robot.keep(visibility);
  robot.apply(add_box("crate", at(6, 0, 0.5)));
  const auto offence = first(robot, straight());
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->index, 0U);
  EXPECT_THAT(offence->verdict.why, HasSubstr("\"crate\" is in the view"));
  EXPECT_EQ(known_ahead(visibility), Ahead::all);
  robot.apply(add_box("crate", at(6, 2, 0.5)));
  EXPECT_FALSE(first(robot, straight()));
}

TEST(AtStart, OfSeveralThatBreakAtOnePoseTheOneThatWeighsMostIsTold) {
  Judged robot;
  Constraints set;
  set.joint_constraints = {joint("base/x", 0, 5, 5), joint("base/x", 0, 4, 4)};
  set.joint_constraints[0].weight = 0.1;
  set.joint_constraints[1].weight = 0.2;
  robot.keep(set);
  const std::vector<Pose2> track{{0, 0, 0}, {6, 0, 0}};
  const auto offence = first(robot, track);
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->verdict.which, "set.joint_constraints[1] (base/x)");
}

TEST(AtStart, WhatIsUnknownBreaksAtTheFirstPose) {
  Judged robot;
  PositionConstraint position = inside(box(30, 4, 4));
  position.link_name = "gripper";
  robot.keep(position);
  const auto offence = first(robot, straight());
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->index, 0U);
  robot.keep(inside(box(30, 4, 4)));
  std::vector<Pose2> track = straight();
  track[3].y_m = kAbsent;
  ASSERT_TRUE(first(robot, track));
  EXPECT_EQ(first(robot, track)->index, 3U);
}

TEST(AtStart, TheOutlineAndTheMarginCount) {
  Judged robot;
  robot.keep(inside(box(30, 1, 4)));
  EXPECT_FALSE(first(robot, straight()));
  robot.terms.extent.outline = {
      {0.45, 0.35, 0}, {-0.45, 0.35, 0}, {-0.45, -0.35, 0}, {0.45, -0.35, 0}};
  EXPECT_FALSE(first(robot, straight()));
  robot.terms.extent.margin_m = 0.2;
  EXPECT_TRUE(first(robot, straight()));
}

}  // namespace
}  // namespace drover::scene
