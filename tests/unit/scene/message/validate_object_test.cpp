// CollisionObject: what each operation needs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/scene/message/messages.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

CollisionObject operation(std::uint8_t which) {
  CollisionObject object = good_object();
  object.operation = which;
  return object;
}

/// New poses and nothing else.
CollisionObject move() {
  CollisionObject object = operation(CollisionObject::MOVE);
  object.primitives.clear();
  object.meshes.clear();
  object.planes.clear();
  return object;
}

TEST(CollisionObjects, WithEachShapeAreTaken) {
  EXPECT_EQ(outcome(operation(CollisionObject::ADD)), "done");
  EXPECT_EQ(outcome(operation(CollisionObject::APPEND)), "done");
}

TEST(CollisionObjects, KnowFourOperations) {
  EXPECT_EQ(int{CollisionObject::ADD}, 0);
  EXPECT_EQ(int{CollisionObject::REMOVE}, 1);
  EXPECT_EQ(int{CollisionObject::APPEND}, 2);
  EXPECT_EQ(int{CollisionObject::MOVE}, 3);
  for (int which = 4; which < 256; ++which)
    EXPECT_EQ(outcome(operation(static_cast<std::uint8_t>(which))),
              "operation: is " + std::to_string(which) +
                  ": it must be ADD 0, REMOVE 1, APPEND 2 or MOVE 3");
}

TEST(CollisionObjects, AreNamedWhateverIsDoneWithThem) {
  for (std::uint8_t which = CollisionObject::ADD; which <= CollisionObject::MOVE; ++which) {
    CollisionObject object = operation(which);
    object.id.clear();
    EXPECT_EQ(outcome(object), "id: is empty: it must be named") << int{which};
  }
}

TEST(CollisionObjects, HaveIdsThatShowAsTheyAre) {
  for (const char* id : {"a\nb", "a\tb", "\x7f", "\xC2\x85", "\u2028", "a\u202Eb", "\u061C"}) {
    CollisionObject object = good_object();
    object.id = id;
    EXPECT_EQ(outcome(object), "id: contains a control character") << id;
  }
  for (const char* id : {"\xFF", "a\xC3", "\xED\xA0\x80", "\xC0\xAF", "\xE0\x80\xAF",
                         "\xF0\x80\x80\xAF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80"}) {
    CollisionObject object = good_object();
    object.id = id;
    EXPECT_EQ(outcome(object), "id: is no UTF-8") << id;
  }
  for (const char* id : {"box 1", "箱子", "été", "🌳", "../x"}) {
    CollisionObject object = good_object();
    object.id = id;
    EXPECT_EQ(outcome(object), "done") << id;
  }
}

TEST(CollisionObjects, HaveIdsOfABoundedLength) {
  CollisionObject object = good_object();
  object.id = std::string(200, 'x');
  EXPECT_EQ(outcome(object), "done");
  object.id += 'x';
  EXPECT_EQ(outcome(object), "id: has 201 bytes, at most 200 are allowed");
}

TEST(CollisionObjects, KeepTheirDatabaseType) {
  CollisionObject object = good_object();
  object.type = {"mug", "household"};
  const auto result = validate(object);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->message.type.key, "mug");
  EXPECT_EQ(result->message.type.db, "household");
  object.type.db = "\n";
  EXPECT_EQ(outcome(object), "type.db: contains a control character");
  object.type = {std::string(201, 'k'), ""};
  EXPECT_THAT(outcome(object), StartsWith("type.key: has 201 bytes"));
}

TEST(CollisionObjects, AreNotPlacedWithoutAFrame) {
  for (const std::uint8_t which : {CollisionObject::ADD, CollisionObject::APPEND}) {
    CollisionObject object = operation(which);
    object.header.frame_id = "0";
    EXPECT_EQ(outcome(object),
              "header.frame_id: is 0, no frame: a place needs one, as map or base_link");
    object.header.frame_id = "";
    EXPECT_EQ(outcome(object), "header.frame_id: is empty: a place needs one, as map or base_link");
  }
  CollisionObject object = move();
  object.header.frame_id = "/0";
  EXPECT_THAT(outcome(object), StartsWith("header.frame_id: is 0, no frame"));
  for (const char* frame : {"1", "map", "base_link", "/map"}) {
    object.header.frame_id = frame;
    EXPECT_EQ(outcome(object), "done") << frame;
  }
  object.header.frame_id = "ma\np";
  EXPECT_EQ(outcome(object), "header.frame_id: contains a control character");
}

TEST(CollisionObjects, AreStampedWithATime) {
  CollisionObject object = good_object();
  object.header.stamp = {0xFFFF'FFFF, 999'999'999};
  object.header.seq = 0xFFFF'FFFF;
  EXPECT_EQ(outcome(object), "done");
  object.header.stamp.nsec = 1'000'000'000;
  EXPECT_EQ(outcome(object), "header.stamp.nsec: is 1000000000: it must be below 1000000000");
}

TEST(CollisionObjects, NeedAShapeToBeAdded) {
  for (const std::uint8_t which : {CollisionObject::ADD, CollisionObject::APPEND}) {
    CollisionObject object = move();
    object.operation = which;
    EXPECT_EQ(outcome(object),
              "primitives: there is no shape: it must have primitives, meshes or planes");
  }
}

TEST(CollisionObjects, HaveNoMorePosesThanShapes) {
  CollisionObject object = good_object();
  object.primitive_poses.resize(5);
  EXPECT_EQ(outcome(object), "primitive_poses: has 5 poses for 4 shapes");
  object = good_object();
  object.mesh_poses.resize(2);
  EXPECT_EQ(outcome(object), "mesh_poses: has 2 poses for 1 shape");
  object = good_object();
  object.planes.clear();
  EXPECT_EQ(outcome(object), "plane_poses: has 1 pose for 0 shapes");
}

TEST(CollisionObjects, HaveIdentityForEachPoseThatIsMissing) {
  CollisionObject object = good_object();
  object.primitive_poses.resize(2);
  object.plane_poses.clear();
  const auto result = validate(object);
  ASSERT_TRUE(result.ok());
  ASSERT_EQ(result->message.primitive_poses.size(), 4U);
  EXPECT_EQ(result->message.primitive_poses[1].position_m.x, 2);
  EXPECT_EQ(result->message.primitive_poses[3].position_m.x, 0);
  EXPECT_EQ(result->message.primitive_poses[3].orientation.w, 1);
  EXPECT_EQ(result->message.plane_poses.size(), 1U);
  EXPECT_THAT(
      result->notes,
      testing::ElementsAre("primitive_poses: 2 of 4 are missing, taken as the origin of the frame",
                           "plane_poses: 1 of 1 are missing, taken as the origin of the frame"));
}

TEST(CollisionObjects, HaveABoundedNumberOfShapes) {
  CollisionObject object = good_object();
  object.primitives.assign(1000, solid(SolidPrimitive::SPHERE, {1}));
  EXPECT_THAT(outcome(object), StartsWith("done"));
  object.primitives.push_back(object.primitives[0]);
  EXPECT_THAT(outcome(object), StartsWith("primitives: has 1001 primitives, at most 1000"));
  object = good_object();
  object.planes.assign(1001, object.planes[0]);
  EXPECT_THAT(outcome(object), StartsWith("planes: has 1001 planes, at most 1000"));
  object = good_object();
  object.meshes.assign(1001, tetrahedron());
  EXPECT_THAT(outcome(object), StartsWith("meshes: has 1001 meshes, at most 1000"));
}

TEST(Removing, TakesAnIdAndLooksAtNothingElse) {
  CollisionObject object;
  object.id = "shelf";
  object.operation = CollisionObject::REMOVE;
  EXPECT_EQ(outcome(object), "done");
  object.header.frame_id = "0";
  EXPECT_EQ(outcome(object), "done");
}

TEST(Removing, HandsOnNoShapeThatNobodyChecked) {
  CollisionObject object = operation(CollisionObject::REMOVE);
  object.primitives[0].dimensions.clear();
  object.meshes[0].triangles[0][0] = 99;
  object.header.stamp.nsec = 0xFFFF'FFFF;
  const auto result = validate(object);
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(result->message.primitives.empty() && result->message.primitive_poses.empty());
  EXPECT_TRUE(result->message.meshes.empty() && result->message.mesh_poses.empty());
  EXPECT_TRUE(result->message.planes.empty() && result->message.plane_poses.empty());
  EXPECT_EQ(result->message.header.stamp, Stamp{});
  EXPECT_THAT(outcome(object), HasSubstr("shapes and poses are ignored"));
}

TEST(Moving, CarriesPosesAndNoGeometry) {
  EXPECT_EQ(outcome(move()), "done");
  CollisionObject object = move();
  object.primitives = good_object().primitives;
  EXPECT_THAT(outcome(object), StartsWith("primitives: must be empty"));
  object = move();
  object.meshes = {tetrahedron()};
  EXPECT_THAT(outcome(object), StartsWith("meshes: must be empty"));
  object = move();
  object.planes = {{{1, 0, 0, 0}}};
  EXPECT_THAT(outcome(object), StartsWith("planes: must be empty"));
}

TEST(Moving, NeedsAPose) {
  CollisionObject object = move();
  object.primitive_poses.clear();
  object.mesh_poses.clear();
  EXPECT_EQ(outcome(object), "done") << "the pose of the plane is left";
  object.plane_poses.clear();
  EXPECT_EQ(outcome(object), "primitive_poses: there is no pose: MOVE has one for each shape");
}

TEST(Moving, ChecksItsPosesAsOthers) {
  CollisionObject object = move();
  object.mesh_poses[0].orientation = {2, 0, 0, 0};
  EXPECT_THAT(outcome(object), StartsWith("mesh_poses[0].orientation: has the length 2"));
  object = move();
  object.primitive_poses.assign(1001, Pose{});
  EXPECT_THAT(outcome(object), StartsWith("primitive_poses: has 1001 poses, at most 1000"));
}

TEST(Notes, AreBounded) {
  CollisionObject object = good_object();
  object.primitives.assign(100, solid(SolidPrimitive::SPHERE, {1}));
  object.primitive_poses.assign(100, {{}, {0, 0, 0, 0}});
  const auto result = validate(object);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->notes.size(), kMaxNotes);
  EXPECT_EQ(result->notes.back(), "and more");
}

TEST(CollisionObjects, AreTakenAgainAsTheyWereTaken) {
  CollisionObject object = good_object();
  object.primitive_poses[0].orientation = {0.6 * 1.0005, 0, 0, 0.8 * 1.0005};
  object.plane_poses.clear();
  const auto once = validate(object);
  ASSERT_TRUE(once.ok());
  EXPECT_FALSE(once->notes.empty());
  EXPECT_EQ(outcome(once->message), "done");
}

}  // namespace
}  // namespace drover::scene
