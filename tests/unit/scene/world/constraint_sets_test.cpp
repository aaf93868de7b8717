// Constraints by name: kept, replaced, cleared, refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/scene/world/yard.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;
using yard::Yard;

Constraints inside_a_box(const std::string& name, const std::string& frame = "map") {
  Constraints set;
  set.name = name;
  PositionConstraint position;
  position.header.frame_id = frame;
  position.link_name = "base_link";
  position.constraint_region.primitives = {yard::box(10, 10, 2)};
  set.position_constraints = {position};
  return set;
}

Constraints steady(const std::string& joint) {
  Constraints set;
  set.name = "steady";
  JointConstraint bound;
  bound.joint_name = joint;
  set.joint_constraints = {bound};
  return set;
}

TEST(ConstraintSets, AreKeptByTheirName) {
  Yard yard;
  EXPECT_EQ(yard.apply(inside_a_box("yard")), "added");
  EXPECT_EQ(yard.apply(inside_a_box("row")), "added");
  EXPECT_EQ(yard.apply(inside_a_box("yard")), "replaced");
  ASSERT_EQ(yard.world.constraints().size(), 2U);
  EXPECT_EQ(yard.world.constraints()[0].message.name, "yard");
  EXPECT_NE(yard.world.constraint_set("row"), nullptr);
  EXPECT_EQ(yard.world.constraint_set("lane"), nullptr);
}

TEST(ConstraintSets, ASetThatListsNothingClearsItsName) {
  Yard yard;
  yard.apply(inside_a_box("yard"));
  yard.apply(inside_a_box("row"));
  Constraints nothing;
  nothing.name = "yard";
  EXPECT_EQ(yard.apply(nothing), "removed");
  EXPECT_EQ(yard.apply(nothing), "name: there are no constraints \"yard\"");
  EXPECT_EQ(yard.world.constraints().size(), 1U);
}

TEST(ConstraintSets, ABadSetKeepsTheOldOne) {
  Yard yard;
  yard.apply(inside_a_box("yard"));
  const std::uint64_t revision = yard.world.revision();
  Constraints bad = inside_a_box("yard");
  bad.position_constraints.push_back(inside_a_box("yard", "moon").position_constraints[0]);
  EXPECT_THAT(yard.apply(bad), HasSubstr("position_constraints[1].header.frame_id: unknown frame"));
  EXPECT_EQ(yard.world.revision(), revision);
  EXPECT_EQ(yard.world.constraint_set("yard")->message.position_constraints.size(), 1U);
}

TEST(ConstraintSets, EveryHeaderNamesAFrameThatThereIs) {
  Yard yard;
  Constraints set;
  set.name = "view";
  set.orientation_constraints.resize(1);
  set.orientation_constraints[0].header.frame_id = "0";
  EXPECT_THAT(yard.apply(set), HasSubstr("orientation_constraints[0].header.frame_id: no frame"));
  set.orientation_constraints.clear();
  set.visibility_constraints.resize(1);
  auto& visibility = set.visibility_constraints[0];
  EXPECT_THAT(yard.apply(set), HasSubstr("visibility_constraints[0].target_pose.header.frame_id"));
  visibility.target_pose.header.frame_id = "1";
  EXPECT_THAT(yard.apply(set), HasSubstr("visibility_constraints[0].sensor_pose.header.frame_id"));
  visibility.sensor_pose.header.frame_id = "lidar";
  EXPECT_EQ(yard.apply(set), "added");
}

TEST(ConstraintSets, WhatIsInMapNeedsItsOrigin) {
  Yard yard;
  yard.world = World{};
  EXPECT_THAT(yard.apply(inside_a_box("yard")), HasSubstr("map has no origin yet"));
  EXPECT_THAT(yard.apply(steady("base/x")), HasSubstr("map has no origin yet"));
  EXPECT_EQ(yard.apply(inside_a_box("yard", "base_link")), "added");
  EXPECT_EQ(yard.apply(steady("mast")), "added");
}

TEST(ConstraintSets, KeepAThousandConstraints) {
  Yard yard;
  for (int i = 0; i < 10; ++i) {
    Constraints set = inside_a_box("set" + std::to_string(i));
    set.position_constraints.resize(100, set.position_constraints[0]);
    ASSERT_EQ(yard.apply(set), "added");
  }
  EXPECT_EQ(yard.apply(inside_a_box("yard")),
            ": 1 more constraints beside 1000: at most 1000 are kept");
  EXPECT_EQ(yard.apply(inside_a_box("set3")), "replaced");
  EXPECT_EQ(yard.apply(inside_a_box("yard")), "added");
}

TEST(ConstraintSets, TheirMeshesCountWithThoseOfTheObjects) {
  Yard yard;
  CollisionObject roof = yard::add_box("roof", yard::at(0, 0));
  roof.meshes = {yard::mesh(60'000)};
  yard.apply(roof);
  Constraints set = inside_a_box("yard");
  set.position_constraints[0].constraint_region.meshes = {yard::mesh(40'001)};
  EXPECT_THAT(yard.apply(set), HasSubstr("40001 more triangles beside 60000"));
}

}  // namespace
}  // namespace drover::scene
