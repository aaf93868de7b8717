#include "scene/message/split.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/scene/message/messages.h"

namespace drover::scene {
namespace {

/// The parts put one after the other, as APPEND does.
CollisionObject together(const std::vector<CollisionObject>& parts) {
  CollisionObject all = parts.at(0);
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (std::size_t i = 1; i < parts.size(); ++i) {
    append(all.primitives, parts[i].primitives);
    append(all.primitive_poses, parts[i].primitive_poses);
    append(all.meshes, parts[i].meshes);
    append(all.mesh_poses, parts[i].mesh_poses);
    append(all.planes, parts[i].planes);
    append(all.plane_poses, parts[i].plane_poses);
  }
  return all;
}

TEST(InMessages, WhatFitsIsOneAsItIs) {
  const CollisionObject object = good_object();
  const auto parts = in_messages(object);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].operation, CollisionObject::ADD);
  EXPECT_EQ(parts[0].id, object.id);
  EXPECT_EQ(parts[0].header.frame_id, "map");
  EXPECT_EQ(parts[0].primitives.size(), 4U);
  EXPECT_EQ(parts[0].meshes.size(), 1U);
  EXPECT_EQ(parts[0].planes.size(), 1U);
}

TEST(InMessages, WithoutAShapeIsOne) {
  CollisionObject object;
  object.id = "a";
  object.operation = CollisionObject::REMOVE;
  const auto parts = in_messages(object);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].operation, CollisionObject::REMOVE);
}

TEST(InMessages, WhatIsLargerIsAnAddAndAppendsThatAreEachTaken) {
  CollisionObject object = good_object();
  object.primitives.assign(2500, solid(SolidPrimitive::SPHERE, {1}));
  object.primitive_poses.clear();
  for (int i = 0; i < 2500; ++i) object.primitive_poses.push_back(at(i, 0, 0));
  object.meshes.assign(7, tetrahedron());
  for (int i = 0; i < 7; ++i) object.meshes[i].vertices[3].z = i + 1;
  for (Mesh& mesh : object.meshes) mesh.triangles.resize(4000, {0, 1, 2});
  object.mesh_poses.assign(7, at(0, 1, 0));
  const auto parts = in_messages(object);
  ASSERT_EQ(parts.size(), 4U) << "two meshes each, and the last alone";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_EQ(parts[i].operation, i == 0 ? CollisionObject::ADD : CollisionObject::APPEND);
    EXPECT_EQ(outcome(parts[i]), "done");
  }
  const CollisionObject all = together(parts);
  ASSERT_EQ(all.primitives.size(), 2500U);
  for (int i = 0; i < 2500; ++i) ASSERT_EQ(all.primitive_poses[i].position_m.x, i);
  ASSERT_EQ(all.meshes.size(), 7U);
  for (int i = 0; i < 7; ++i) EXPECT_EQ(all.meshes[i].vertices[3].z, i + 1);
  EXPECT_EQ(all.planes.size(), 1U);
}

TEST(InMessages, MeshesWithManyVerticesAreApart) {
  CollisionObject object = good_object();
  object.meshes.assign(3, tetrahedron());
  for (Mesh& mesh : object.meshes) mesh.vertices.resize(20'000);
  object.mesh_poses.clear();
  const auto parts = in_messages(object);
  ASSERT_EQ(parts.size(), 3U);
  for (const CollisionObject& part : parts) EXPECT_EQ(outcome(part), "done");
}

TEST(InMessages, AMeshThatNoMessageCarriesEndsTheSplittingToo) {
  CollisionObject object = good_object();
  object.meshes.assign(2, tetrahedron());
  object.meshes[0].triangles.assign(20'000, {0, 1, 2});
  EXPECT_EQ(in_messages(object).size(), 2U);
}

}  // namespace
}  // namespace drover::scene
