// What is read of the messages, field by field.
#include "publish/scene/messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/publish/scene/scene_texts.h"

namespace drover::publish {
namespace {

using scene::CollisionObject;
using scene::SolidPrimitive;
using testing::ElementsAre;
using testing::StartsWith;

CollisionObject read_object(std::string_view text) {
  const auto read = parse_collision_objects(text, Retain::no);
  EXPECT_EQ(outcome(read), "done");
  return read->messages.at(0).result->message;
}

scene::Constraints read_constraints(std::string_view text) {
  const auto read = parse_planning_constraints(text, Retain::no);
  EXPECT_EQ(outcome(read), "done");
  return read->messages.at(0).result->message;
}

TEST(SceneMessages, ReadAHeader) {
  const CollisionObject box = read_object(kBox);
  EXPECT_EQ(box.header.seq, 7U);
  EXPECT_EQ(box.header.stamp, (scene::Stamp{1'700'000'000, 500'000'000}));
  EXPECT_EQ(box.header.frame_id, "base_link");
}

TEST(SceneMessages, ReadAnObject) {
  const CollisionObject box = read_object(kBox);
  EXPECT_EQ(box.id, "box1");
  EXPECT_EQ(box.operation, CollisionObject::ADD);
  ASSERT_EQ(box.primitives.size(), 1U);
  EXPECT_EQ(box.primitives[0].type, SolidPrimitive::BOX);
  EXPECT_THAT(box.primitives[0].dimensions, ElementsAre(0.4, 0.3, 1.2));
  EXPECT_EQ(box.primitive_poses[0].position_m.y, -0.5);
  EXPECT_EQ(box.primitive_poses[0].orientation.w, 1);
}

TEST(SceneMessages, ReadEachShape) {
  const CollisionObject shelf = read_object(kEachShape);
  EXPECT_EQ(shelf.operation, CollisionObject::APPEND);
  EXPECT_EQ(shelf.type.key, "shelf");
  EXPECT_EQ(shelf.type.db, "hall");
  ASSERT_EQ(shelf.primitives.size(), 3U);
  EXPECT_EQ(shelf.primitives[0].type, SolidPrimitive::SPHERE);
  EXPECT_EQ(shelf.primitives[1].type, SolidPrimitive::CYLINDER);
  EXPECT_EQ(shelf.primitives[1].dimensions[SolidPrimitive::CYLINDER_HEIGHT], 1.8);
  EXPECT_EQ(shelf.primitives[2].type, SolidPrimitive::CONE);
  EXPECT_EQ(shelf.primitives[2].dimensions[SolidPrimitive::CONE_RADIUS], 0.2);
  ASSERT_EQ(shelf.meshes.size(), 1U);
  EXPECT_THAT(shelf.meshes[0].triangles, ElementsAre(scene::MeshTriangle{0, 1, 2}));
  ASSERT_EQ(shelf.meshes[0].vertices.size(), 3U);
  EXPECT_EQ(shelf.meshes[0].vertices[2].y, 1);
  EXPECT_EQ(shelf.mesh_poses[0].position_m.x, 4);
  EXPECT_THAT(shelf.planes[0].coef, ElementsAre(1, 0, 0, -20));
  EXPECT_EQ(shelf.plane_poses[0].orientation.w, 1);
}

TEST(SceneMessages, ReadEachConstraint) {
  const scene::Constraints row = read_constraints(kEachConstraint);
  EXPECT_EQ(row.name, "row");
  const auto& joint = row.joint_constraints.at(0);
  EXPECT_EQ(joint.joint_name, "base/y");
  EXPECT_EQ(joint.position, 1.5);
  EXPECT_EQ(joint.tolerance_above, 0.5);
  EXPECT_EQ(joint.tolerance_below, 0.25);
  EXPECT_EQ(joint.weight, 2);
  const auto& position = row.position_constraints.at(0);
  EXPECT_EQ(position.header.frame_id, "1");
  EXPECT_EQ(position.link_name, "base_link");
  EXPECT_EQ(position.target_point_offset.x, 0.4);
  EXPECT_EQ(position.constraint_region.primitives.at(0).dimensions[0], 20);
  EXPECT_EQ(position.constraint_region.primitive_poses.at(0).position_m.x, 10);
  EXPECT_EQ(position.constraint_region.meshes.at(0).vertices[1].x, 5);
  EXPECT_EQ(position.constraint_region.mesh_poses.at(0).position_m.x, 20);
  EXPECT_EQ(position.weight, 0);
  const auto& turn = row.orientation_constraints.at(0);
  EXPECT_EQ(turn.orientation.z, 0.7071067811865476);
  EXPECT_EQ(turn.link_name, "base_link");
  EXPECT_EQ(turn.absolute_x_axis_tolerance, 0.2);
  EXPECT_EQ(turn.absolute_y_axis_tolerance, 0.3);
  EXPECT_EQ(turn.absolute_z_axis_tolerance, 3.2);
  EXPECT_EQ(turn.weight, 0.5);
  const auto& sight = row.visibility_constraints.at(0);
  EXPECT_EQ(sight.target_radius, 0.2);
  EXPECT_EQ(sight.target_pose.pose.position_m.x, 5);
  EXPECT_EQ(sight.cone_sides, 8);
  EXPECT_EQ(sight.sensor_pose.header.frame_id, "base_link");
  EXPECT_EQ(sight.max_view_angle, 0.5);
  EXPECT_EQ(sight.max_range_angle, 0.25);
  EXPECT_EQ(sight.sensor_view_direction, scene::VisibilityConstraint::SENSOR_X);
  EXPECT_EQ(sight.weight, 1);
}

TEST(SceneMessages, TakeWhatIsAbsentForNothing) {
  const CollisionObject pole = read_object(
      R"({"header":{"frame_id":"map"},"id":"pole","primitives":[{"type":3,"dimensions":[2,0.1]}],
          "primitive_poses":[{"position":{"x":1}}]})");
  EXPECT_EQ(pole.operation, CollisionObject::ADD);
  EXPECT_EQ(pole.header.seq, 0U);
  EXPECT_EQ(pole.header.stamp, scene::Stamp{});
  EXPECT_EQ(pole.primitive_poses[0].position_m.z, 0);
  EXPECT_EQ(pole.primitive_poses[0].orientation.w, 1);
  EXPECT_TRUE(pole.meshes.empty() && pole.planes.empty() && pole.type.key.empty());
}

TEST(SceneMessages, TakeAnOrientationWithoutNumbersForNoTurnAndSayIt) {
  EXPECT_EQ(object(with(kBox, R"("x": 0, "y": 0, "z": 0, "w": 1)", "")),
            "done; primitive_poses[0].orientation: all zero, taken as no turn");
  EXPECT_THAT(object(with(kBox, R"("z": 0, "w": 1)", R"("z": 0.7)")),
              StartsWith("primitive_poses[0].orientation: has the length 0.7"));
}

TEST(SceneMessages, KnowTheOtherSpellingsOfAStamp) {
  for (const char* stamp :
       {R"("sec": 4, "nsec": 5)", R"("secs": 4, "nsecs": 5)", R"("sec": 4, "nanosec": 5)"}) {
    const auto text = with(kBox, R"("sec": 1700000000, "nsec": 500000000)", stamp);
    EXPECT_EQ(read_object(text).header.stamp, (scene::Stamp{4, 5})) << stamp;
  }
}

TEST(SceneMessages, RefuseAFieldUnderTwoSpellings) {
  const auto stamp = [](const char* fields) {
    return object(with(kBox, R"("sec": 1700000000, "nsec": 500000000)", fields));
  };
  EXPECT_EQ(stamp(R"("sec": 4, "secs": 4)"),
            "header.stamp.sec: is there twice, the second time as secs");
  EXPECT_EQ(stamp(R"("nanosec": 4, "nsecs": 4)"),
            "header.stamp.nsec: is there twice, the second time as nanosec");
  EXPECT_THAT(stamp(R"("sec": 4, "sec": 4)"),
              StartsWith("whole: header.stamp.sec: line 2, column 44: this key is there twice"));
}

TEST(SceneMessages, RefuseWhatIsOfAnotherKind) {
  const std::tuple<const char*, const char*, const char*> table[] = {
      {R"("box1")", "7", "id: must be a text, not an integer"},
      {R"("box1")", "null", "id: must be a text, not null"},
      {"0.4", R"("0.4")", "primitives[0].dimensions[0]: must be a number, not a text"},
      {"0.4", "null", "primitives[0].dimensions[0]: must be a number, not null"},
      {"0.4", "true", "primitives[0].dimensions[0]: must be a number, not true or false"},
      {"[0.4, 0.3, 1.2]", "0.4", "primitives[0].dimensions: must be a list, not a number"},
      {"[0.4, 0.3, 1.2]", "null", "primitives[0].dimensions: must be a list, not null"},
      {R"([{"type": 1, "dimensions": [0.4, 0.3, 1.2]}])", R"({"type": 1})",
       "primitives: must be a list, not an object"},
      {R"({"type": 1, "dimensions": [0.4, 0.3, 1.2]})", "1",
       "primitives[0]: must be an object, not an integer"},
      {R"("seq": 7)", R"("seq": -1)", "header.seq: must be an integer from 0 to 4294967295"},
      {R"("seq": 7)", R"("seq": 4294967296)",
       "header.seq: must be an integer from 0 to 4294967295"},
      {R"("type": 1)", R"("type": 1.5)", "primitives[0].type: must be an integer from 0 to 255"},
      {R"("type": 1)", R"("type": 256)", "primitives[0].type: must be an integer from 0 to 255"},
      {R"("type": 1)", R"("type": "BOX")", "primitives[0].type: must be an integer, not a text"},
      {R"("operation": 0)", R"("operation": "ADD")", "operation: must be an integer, not a text"},
      {R"("operation": 0)", R"("operation": null)", "operation: must be an integer, not null"},
      {R"("operation": 0)", R"("operation": -1)", "operation: must be an integer from 0 to 255"},
      {R"("operation": 0)", R"("operation": 4)",
       "operation: is 4: it must be ADD 0, REMOVE 1, APPEND 2 or MOVE 3"},
  };
  for (const auto& [what, by, why] : table) EXPECT_EQ(object(with(kBox, what, by)), why);
}

TEST(SceneMessages, MayHaveTheEndOfAStringBehindThem) {
  const std::string end(3, '\0');
  EXPECT_EQ(object(std::string(kBox) + end), "done");
  EXPECT_THAT(object("{" + end + "}"), testing::HasSubstr("NUL"));
  EXPECT_EQ(read_object(std::string(kBox) + end).id, "box1");
}

TEST(SceneMessages, TakeWholeNumbersFromProgramsThatKnowNoIntegers) {
  EXPECT_EQ(read_object(with(kBox, R"("type": 1)", R"("type": 1.0)")).primitives[0].type, 1);
}

TEST(SceneMessages, RefusePlanesWithoutFourNumbersAndTrianglesWithoutThree) {
  EXPECT_EQ(object(with(kEachShape, "[1, 0, 0, -20]", "[1, 0, 0]")),
            "planes[0].coef: has 3 numbers: it must have 4");
  EXPECT_EQ(object(with(kEachShape, "[1, 0, 0, -20]", "[1]")),
            "planes[0].coef: has 1 number: it must have 4");
  EXPECT_EQ(object(with(kEachShape, R"({"coef": [1, 0, 0, -20]})", "{}")),
            "planes[0].coef: has no direction: a, b and c are all 0");
  EXPECT_EQ(object(with(kEachShape, "[0, 1, 2]", "[0, 1, 2, 0]")),
            "meshes[0].triangles[0].vertex_indices: has 4 numbers: it must have 3");
  EXPECT_EQ(object(with(kEachShape, "[0, 1, 2]", "[0, -1, 2]")),
            "meshes[0].triangles[0].vertex_indices[1]: must be an integer from 0 to 4294967295");
}

TEST(SceneMessages, IgnoreUnknownNamesAndSayThem) {
  EXPECT_EQ(object(with(kBox, R"("seq": 7)", R"("seq": 7, "time": 3)")),
            "done; header.time: unknown, ignored");
  EXPECT_EQ(object(with(kBox, R"("operation": 0)", R"("Operation": 1, "": [], "a\nb": {})")),
            "done; Operation: unknown, ignored; \"\": unknown, ignored; a?b: unknown, ignored");
  EXPECT_EQ(constraints(R"({"name": "a", "joint_constraint": []})"),
            "done; joint_constraint: unknown, ignored");
}

TEST(SceneMessages, SayNoMoreThanTenNotes) {
  for (const int unknown : {5000, 10, 9}) {
    // Nine or more unknown names, and two things that are taken otherwise.
    std::string many = "\"planes\": [{\"coef\": [1, 0, 0, 5]}]";
    for (int i = 0; i < unknown; ++i) many += ", \"x" + std::to_string(i) + "\": 0";
    const auto text = with(with(kBox, "\"operation\": 0", many), "\"w\": 1", "\"w\": 0");
    const auto read = parse_collision_objects(text, Retain::no);
    ASSERT_EQ(outcome(read).substr(0, 4), "done");
    EXPECT_EQ(read->messages[0].result->notes.size(), scene::kMaxNotes) << unknown;
    EXPECT_EQ(read->messages[0].result->notes.back(), "and more") << unknown;
  }
}

TEST(SceneMessages, RefuseAPoseOfRos2ThatWouldPlaceTheShapesElsewhere) {
  const auto posed = [](const char* pose, std::string_view text = kBox) {
    return object(
        with(text, "\"operation\"", std::string("\"pose\": ") + pose + ", \"operation\""));
  };
  EXPECT_THAT(posed(R"({"position": {"x": 3}})"), StartsWith("pose: is of ROS 2"));
  EXPECT_THAT(posed(R"({"orientation": {"z": 1}})"), StartsWith("pose: is of ROS 2"));
  EXPECT_EQ(posed("7"), "pose: must be an object, not an integer");
  for (const char* none : {"{}", R"({"position":{"x":0,"y":0,"z":0},"orientation":{"w":1}})",
                           R"({"orientation":{"x":0,"y":0,"z":0,"w":0}})"}) {
    EXPECT_EQ(posed(none), "done; pose: unknown, ignored") << none;
  }
}

TEST(SceneMessages, RefuseAParameterizationOfRos2) {
  const auto told = [](const char* value) {
    return constraints(
        with(kEachConstraint, R"("absolute_x_axis_tolerance": 0.2)",
             std::string(R"("absolute_x_axis_tolerance": 0.2, "parameterization": )") + value));
  };
  EXPECT_THAT(told("1"), StartsWith("orientation_constraints[0].parameterization: is of ROS 2"));
  EXPECT_THAT(told("null"), StartsWith("orientation_constraints[0].parameterization: is of ROS 2"));
  EXPECT_EQ(told("0"), "done; orientation_constraints[0].parameterization: unknown, ignored");
}

}  // namespace
}  // namespace drover::publish
