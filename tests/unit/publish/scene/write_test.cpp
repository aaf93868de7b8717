// What is written of a message is what would be read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "scene/message/split.h"
#include "tests/unit/publish/scene/scene_texts.h"

namespace drover::publish {
namespace {

TEST(SceneTexts, HaveEveryFieldInTheDocumentsOrder) {
  scene::CollisionObject object;
  object.header = {7, {1, 2}, "map"};
  object.id = "box1";
  object.primitives = {{1, {0.4, 0.3, 1.2}}};
  object.primitive_poses = {{{2, -0.5, 0.6}, {}}};
  object.meshes = {{{{0, 1, 2}}, {{0, 0, 0}}}};
  object.planes = {{{1, 0, 0, -20}}};
  EXPECT_EQ(
      written(object),
      R"({"header":{"seq":7,"stamp":{"sec":1,"nsec":2},"frame_id":"map"},"id":"box1",)"
      R"("type":{"key":"","db":""},"primitives":[{"type":1,"dimensions":[0.4,0.3,1.2]}],)"
      R"("primitive_poses":[{"position":{"x":2,"y":-0.5,"z":0.6},)"
      R"("orientation":{"x":0,"y":0,"z":0,"w":1}}],)"
      R"("meshes":[{"triangles":[{"vertex_indices":[0,1,2]}],"vertices":[{"x":0,"y":0,"z":0}]}],)"
      R"("mesh_poses":[],"planes":[{"coef":[1,0,0,-20]}],"plane_poses":[],"operation":0})");
}

TEST(SceneTexts, OfAnObjectAreReadAsTheyWereWritten) {
  for (const std::string_view text : {kBox, kEachShape}) {
    const auto read = parse_collision_objects(text, Retain::no);
    ASSERT_EQ(outcome(read), "done");
    const std::string once = written(read->messages[0].result->message);
    const auto again = parse_collision_objects(once, Retain::no);
    ASSERT_EQ(outcome(again), "done");
    EXPECT_EQ(written(again->messages[0].result->message), once);
  }
}

TEST(SceneTexts, OfConstraintsAreReadAsTheyWereWritten) {
  const auto read = parse_planning_constraints(kEachConstraint, Retain::no);
  ASSERT_EQ(outcome(read), "done");
  const std::string once = written(read->messages[0].result->message);
  const auto again = parse_planning_constraints(once, Retain::no);
  ASSERT_EQ(outcome(again), "done");
  EXPECT_EQ(written(again->messages[0].result->message), once);
}

TEST(SceneTexts, KeepNumbersToTheBit) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-1e7, 1e7);
  for (int i = 0; i < 200; ++i) {
    scene::CollisionObject object;
    object.header.frame_id = "map";
    object.id = "a";
    object.primitives = {{2, {std::abs(place(random)) / 1e4 + 1e-300}}};
    object.primitive_poses = {{{place(random), place(random), 5e-324}, {}}};
    const auto read = parse_collision_objects(written(object), Retain::no);
    ASSERT_EQ(outcome(read), "done");
    const auto& back = read->messages[0].result->message;
    EXPECT_EQ(back.primitives[0].dimensions, object.primitives[0].dimensions);
    EXPECT_EQ(back.primitive_poses[0].position_m.x, object.primitive_poses[0].position_m.x);
    EXPECT_EQ(back.primitive_poses[0].position_m.y, object.primitive_poses[0].position_m.y);
    EXPECT_EQ(back.primitive_poses[0].position_m.z, 5e-324);
  }
}

/// The scene's bound is ten of the largest meshes that a message may carry.
TEST(SceneTexts, OfAnObjectAsLargeAsTheSceneMayBeCanBeReadAgain) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-1e7, 1e7);
  scene::CollisionObject object;
  object.header.frame_id = "map";
  object.id = "hill";
  object.meshes.resize(1);
  object.meshes[0].triangles.assign(10'000, {29'997, 29'998, 29'999});
  for (int i = 0; i < 30'000; ++i)
    object.meshes[0].vertices.push_back({place(random), place(random), place(random)});
  object.mesh_poses.resize(1);
  const std::string text = written(object);
  SceneLimits tenth = kStoredSceneLimits;
  tenth.max_bytes /= 10;
  tenth.max_values /= 10;
  EXPECT_EQ(outcome(parse_collision_objects(text, Retain::no, tenth)), "done");
  object.meshes.push_back(object.meshes[0]);
  EXPECT_EQ(scene::in_messages(object).size(), 2U);
}

TEST(SceneTexts, KeepTheSignOfZero) {
  const auto read = parse_collision_objects(with(kBox, "-0.5", "-0.0"), Retain::no);
  const auto again =
      parse_collision_objects(written(read->messages.at(0).result->message), Retain::no);
  EXPECT_TRUE(std::signbit(again->messages.at(0).result->message.primitive_poses[0].position_m.y));
}

}  // namespace
}  // namespace drover::publish
