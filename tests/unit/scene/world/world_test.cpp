#include "scene/world/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "unit/scene/world/yard.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;
using yard::add_box;
using yard::at;
using yard::expect_at;
using yard::only;
using yard::Yard;

TEST(World, AddsAnObjectInMap) {
  Yard yard;
  EXPECT_EQ(yard.apply(add_box("box1", at(3, 4, 0.5))), "added");
  expect_at(yard.place_of("box1"), 3, 4, 0.5);
}

TEST(World, OneIsMapToo) {
  Yard yard;
  EXPECT_EQ(yard.apply(add_box("box1", at(3, 4), "1")), "added");
  expect_at(yard.place_of("box1"), 3, 4, 0);
}

TEST(World, AddReplacesAnObjectOfThatId) {
  Yard yard;
  yard.apply(add_box("box1", at(3, 4)));
  EXPECT_EQ(yard.apply(add_box("box1", at(5, 6))), "replaced");
  ASSERT_EQ(yard.world.objects().size(), 1U);
  expect_at(yard.place_of("box1"), 5, 6, 0);
}

TEST(World, ABadAddKeepsTheOldObject) {
  Yard yard;
  yard.apply(add_box("box1", at(3, 4)));
  const std::uint64_t revision = yard.world.revision();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(yard.apply(add_box("box1", at(5, 6), "moon")), HasSubstr("unknown frame \"moon\""));
  EXPECT_THAT(yard.apply(add_box("box1", at(nan, 6))), HasSubstr("primitive_poses[0]: not finite"));
  EXPECT_THAT(yard.apply(add_box("box1", at(2e5, 6))), HasSubstr("farther than 100 km"));
  CollisionObject poses = add_box("box1", at(5, 6));
  poses.primitive_poses.push_back(at(1, 1));
  EXPECT_THAT(yard.apply(poses), HasSubstr("primitive_poses: 2 poses for 1 shape"));
  CollisionObject bare = add_box("box1", at(5, 6));
  bare.primitives.clear();
  bare.primitive_poses.clear();
  EXPECT_THAT(yard.apply(bare), HasSubstr("no shape"));
  CollisionObject heavy = add_box("box1", at(5, 6));
  heavy.meshes = {yard::mesh(100'001)};
  EXPECT_THAT(yard.apply(heavy), HasSubstr("at most 100000"));
  expect_at(yard.place_of("box1"), 3, 4, 0);
  EXPECT_EQ(yard.world.revision(), revision);
}

TEST(World, NoFrameAndUnknownFramesPlaceNothing) {
  Yard yard;
  for (const char* frame : {"", "0", "/", "moon", "base"})
    EXPECT_THAT(yard.apply(add_box("box1", at(1, 1), frame)), HasSubstr("header.frame_id"))
        << frame;
  EXPECT_TRUE(yard.world.objects().empty());
}

TEST(World, NothingIsPlacedBeforeMapHasAnOrigin) {
  Yard yard;
  yard.world = World{};
  EXPECT_THAT(yard.apply(add_box("box1", at(1, 1))), HasSubstr("map has no origin yet"));
}

TEST(World, ShapesWithoutAPoseAreAtTheFrame) {
  Yard yard;
  CollisionObject message = add_box("box1", at(3, 4));
  message.primitives.push_back(yard::box(1, 1, 1));
  EXPECT_EQ(yard.apply(message), "added");
  expect_at(yard.place_of("box1", 1), 0, 0, 0);
}

TEST(World, RemoveNeedsTheIdOfOneObject) {
  Yard yard;
  yard.apply(add_box("box1", at(3, 4)));
  yard.apply(add_box("box2", at(5, 4)));
  EXPECT_THAT(yard.apply(only(CollisionObject::REMOVE, "")), HasSubstr("id: empty"));
  EXPECT_THAT(yard.apply(only(CollisionObject::REMOVE, "box3")),
              HasSubstr("there is no object \"box3\""));
  EXPECT_EQ(yard.world.objects().size(), 2U);
  EXPECT_EQ(yard.apply(only(CollisionObject::REMOVE, "box1")), "removed");
  ASSERT_EQ(yard.world.objects().size(), 1U);
  EXPECT_EQ(yard.world.objects()[0].id, "box2");
}

TEST(World, RemoveNeedsNoFrame) {
  Yard yard;
  yard.apply(add_box("box1", at(3, 4)));
  CollisionObject message = only(CollisionObject::REMOVE, "box1");
  message.header.frame_id = "";
  EXPECT_EQ(yard.apply(message), "removed");
}

TEST(World, AnUnknownOperationIsRefused) {
  Yard yard;
  CollisionObject message = add_box("box1", at(3, 4));
  message.operation = 4;
  EXPECT_THAT(yard.apply(message), HasSubstr("operation: 4; allowed: 0 ADD, 1 REMOVE"));
}

TEST(World, AppendCreatesWhatIsMissing) {
  Yard yard;
  CollisionObject message = add_box("box1", at(3, 4));
  message.operation = CollisionObject::APPEND;
  EXPECT_EQ(yard.apply(message), "added");
  expect_at(yard.place_of("box1"), 3, 4, 0);
}

TEST(World, AppendPlacesByItsOwnHeader) {
  Yard yard;
  yard.drive(1, 0, {10, 0, kPi / 2});
  yard.apply(add_box("box1", at(3, 4)));
  CollisionObject message = add_box("box1", at(1, 0), "base_link");
  message.operation = CollisionObject::APPEND;
  EXPECT_EQ(yard.apply(message), "extended");
  expect_at(yard.place_of("box1", 0), 3, 4, 0);
  expect_at(yard.place_of("box1", 1), 10, 1, 0);
}

TEST(World, MoveGivesEveryShapeItsNewPose) {
  Yard yard;
  CollisionObject object = add_box("box1", at(3, 4));
  object.meshes = {yard::mesh(1)};
  object.mesh_poses = {at(1, 1)};
  object.planes = {{{0, 0, 1, 0}}};
  object.plane_poses = {at(2, 2)};
  yard.apply(object);
  CollisionObject message = only(CollisionObject::MOVE, "box1");
  message.primitive_poses = {at(7, 8, 0.1)};
  message.mesh_poses = {at(9, 9)};
  message.plane_poses = {at(0, 6)};
  EXPECT_EQ(yard.apply(message), "moved");
  const Object& moved = *yard.world.object("box1");
  expect_at(moved.primitives[0].in_map.position_m, 7, 8, 0.1);
  expect_at(moved.meshes[0].in_map.position_m, 9, 9, 0);
  expect_at(moved.planes[0].in_map.position_m, 0, 6, 0);
}

TEST(World, MoveWithAnotherNumberOfPosesIsRefused) {
  Yard yard;
  CollisionObject object = add_box("box1", at(3, 4));
  object.primitives.push_back(yard::box(1, 1, 1));
  yard.apply(object);
  CollisionObject message = only(CollisionObject::MOVE, "box1");
  EXPECT_THAT(yard.apply(message), HasSubstr("primitive_poses: 0 poses for 2 primitives"));
  message.primitive_poses = {at(7, 8)};
  EXPECT_THAT(yard.apply(message), HasSubstr("primitive_poses: 1 pose for 2 primitives"));
  message.primitive_poses = {at(7, 8), at(7, 9), at(7, 10)};
  EXPECT_THAT(yard.apply(message), HasSubstr("primitive_poses: 3 poses for 2 primitives"));
  message.primitive_poses = {at(7, 8), at(7, 9)};
  message.mesh_poses = {at(1, 1)};
  EXPECT_THAT(yard.apply(message), HasSubstr("mesh_poses: 1 pose for 0 meshes"));
  expect_at(yard.place_of("box1"), 3, 4, 0);
}

TEST(World, MoveWithOneBadPoseMovesNothing) {
  Yard yard;
  CollisionObject object = add_box("box1", at(3, 4));
  object.primitives.push_back(yard::box(1, 1, 1));
  yard.apply(object);
  CollisionObject message = only(CollisionObject::MOVE, "box1");
  message.primitive_poses = {at(7, 8), at(std::numeric_limits<double>::infinity(), 9)};
  EXPECT_THAT(yard.apply(message), HasSubstr("primitive_poses[1]"));
  expect_at(yard.place_of("box1"), 3, 4, 0);
}

TEST(World, MoveCarriesNoGeometry) {
  Yard yard;
  yard.apply(add_box("box1", at(3, 4)));
  CollisionObject message = add_box("box1", at(5, 5));
  message.operation = CollisionObject::MOVE;
  EXPECT_THAT(yard.apply(message), HasSubstr("primitives: a MOVE carries no geometry"));
  expect_at(yard.place_of("box1"), 3, 4, 0);
}

TEST(World, MoveOfWhatIsNotThereIsRefused) {
  Yard yard;
  CollisionObject message = only(CollisionObject::MOVE, "box1");
  message.primitive_poses = {at(1, 1)};
  EXPECT_THAT(yard.apply(message), HasSubstr("id: there is no object \"box1\""));
}

TEST(World, ListsNamesInTheOrderInWhichTheyCame) {
  Yard yard;
  for (const char* id : {"c", "a", "b"}) yard.apply(add_box(id, at(1, 1)));
  yard.apply(add_box("c", at(2, 2)));
  std::string ids;
  for (const Object& object : yard.world.objects()) ids += object.id;
  EXPECT_EQ(ids, "cab");
}

TEST(World, EveryChangeHasARevisionOfItsOwn) {
  Yard yard;
  std::uint64_t last = yard.world.revision();
  const auto changed = [&] { return std::exchange(last, yard.world.revision()) != last; };
  yard.apply(add_box("a", at(1, 1)));
  EXPECT_TRUE(changed());
  EXPECT_EQ(yard.world.object("a")->revision, last);
  yard.apply(add_box("b", at(1, 1)));
  EXPECT_TRUE(changed());
  EXPECT_NE(yard.world.object("a")->revision, last);
  CollisionObject move = only(CollisionObject::MOVE, "a");
  move.primitive_poses = {at(2, 2)};
  yard.apply(move);
  EXPECT_TRUE(changed());
  EXPECT_EQ(yard.world.object("a")->revision, last);
  yard.apply(only(CollisionObject::REMOVE, "a"));
  EXPECT_TRUE(changed());
  yard.apply(only(CollisionObject::REMOVE, "a"));
  EXPECT_FALSE(changed());
  yard.world.clear();
  EXPECT_TRUE(changed());
  EXPECT_TRUE(yard.world.objects().empty());
}

TEST(World, KeepsAThousandObjects) {
  Yard yard;
  for (int i = 0; i < 1000; ++i)
    ASSERT_EQ(yard.apply(add_box("box" + std::to_string(i), at(i, 0))), "added");
  EXPECT_EQ(yard.apply(add_box("one", at(0, 0))),
            "id: 1 more objects beside 1000: at most 1000 are kept");
  EXPECT_EQ(yard.apply(add_box("box7", at(0, 1))), "replaced");
  yard.apply(only(CollisionObject::REMOVE, "box7"));
  EXPECT_EQ(yard.apply(add_box("one", at(0, 0))), "added");
}

TEST(World, KeepsAHundredThousandTrianglesHoweverTheyCome) {
  Yard yard;
  CollisionObject message = add_box("roof", at(0, 0));
  message.meshes = {yard::mesh(60'000)};
  EXPECT_EQ(yard.apply(message), "added");
  EXPECT_EQ(yard.apply(message), "replaced");
  message.operation = CollisionObject::APPEND;
  EXPECT_EQ(yard.apply(message),
            "meshes: 60000 more triangles beside 60000: at most 100000 are kept");
  message.meshes = {yard::mesh(40'000)};
  EXPECT_EQ(yard.apply(message), "extended");
  EXPECT_EQ(yard.world.amount().triangles, 100'000U);
}

TEST(World, ShowsAnObjectAsTheMessageThatMakesItAgain) {
  Yard yard;
  CollisionObject object = add_box("box1", at(3, 4, 0.5, 1));
  object.meshes = {yard::mesh(2)};
  object.mesh_poses = {at(1, 1)};
  object.planes = {{{0, 1, 1, 3}}};
  yard.apply(object);
  const CollisionObject message = as_message(*yard.world.object("box1"));
  Yard other;
  EXPECT_EQ(other.apply(message), "added");
  expect_at(other.place_of("box1"), 3, 4, 0.5);
  EXPECT_EQ(other.world.object("box1")->meshes[0].shape.triangles.size(), 2U);
  EXPECT_EQ(other.world.object("box1")->planes[0].shape.coef[3], 3);
}

}  // namespace
}  // namespace drover::scene
