// Shapes and poses: what each must have to be one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/scene/message/messages.h"

namespace drover::scene {
namespace {

using testing::StartsWith;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string with_primitive(const SolidPrimitive& primitive) {
  CollisionObject object = good_object();
  object.primitives[2] = primitive;
  return outcome(object);
}

std::string with_mesh(const Mesh& mesh) {
  CollisionObject object = good_object();
  object.meshes[0] = mesh;
  return outcome(object);
}

std::string with_plane(const Plane& plane) {
  CollisionObject object = good_object();
  object.planes[0] = plane;
  return outcome(object);
}

std::string with_turn(const Quaternion& turn) {
  CollisionObject object = good_object();
  object.primitive_poses[1].orientation = turn;
  return outcome(object);
}

TEST(Solids, HaveExactlyTheirDimensions) {
  const std::pair<std::uint8_t, std::size_t> table[] = {{SolidPrimitive::BOX, 3},
                                                        {SolidPrimitive::SPHERE, 1},
                                                        {SolidPrimitive::CYLINDER, 2},
                                                        {SolidPrimitive::CONE, 2}};
  for (const auto& [type, right] : table) {
    for (std::size_t count = 0; count < 5; ++count) {
      const std::string said = with_primitive(solid(type, std::vector<double>(count, 0.5)));
      if (count == right) {
        EXPECT_EQ(said, "done");
      } else {
        EXPECT_THAT(said, StartsWith("primitives[2].dimensions: has " + std::to_string(count)));
      }
    }
  }
}

TEST(Solids, HaveTheHeightFirst) {
  EXPECT_EQ(with_primitive(solid(SolidPrimitive::CYLINDER, {1})),
            "primitives[2].dimensions: has 1 number: CYLINDER has 2 dimensions: height, radius");
  EXPECT_EQ(with_primitive(solid(SolidPrimitive::CONE, {})),
            "primitives[2].dimensions: has 0 numbers: CONE has 2 dimensions: height, radius");
  const std::size_t cylinder[] = {SolidPrimitive::CYLINDER_HEIGHT, SolidPrimitive::CYLINDER_RADIUS};
  EXPECT_THAT(cylinder, testing::ElementsAre(0, 1));
  const std::size_t cone[] = {SolidPrimitive::CONE_HEIGHT, SolidPrimitive::CONE_RADIUS};
  EXPECT_THAT(cone, testing::ElementsAre(0, 1));
}

TEST(Solids, HaveTheLengthsOfABoxInTheOrderXYZ) {
  const std::size_t box[] = {SolidPrimitive::BOX_X, SolidPrimitive::BOX_Y, SolidPrimitive::BOX_Z};
  EXPECT_THAT(box, testing::ElementsAre(0, 1, 2));
  EXPECT_EQ(int{SolidPrimitive::SPHERE_RADIUS}, 0);
}

TEST(Solids, AreOfOneOfFourTypes) {
  for (int type = 0; type < 256; ++type) {
    const std::string said = with_primitive(solid(static_cast<std::uint8_t>(type), {0.5, 0.5}));
    if (type >= SolidPrimitive::BOX && type <= SolidPrimitive::CONE) continue;
    EXPECT_EQ(said, "primitives[2].type: is " + std::to_string(type) +
                        ": it must be BOX 1, SPHERE 2, CYLINDER 3 or CONE 4");
  }
}

TEST(Solids, AreLargerThanNothingAndSmallerThanALand) {
  for (const double size_m : {0.0, -0.0, -1.0, kNaN, kInfinity, -kInfinity, 10'000.1, 1e300}) {
    const std::string said = with_primitive(solid(SolidPrimitive::CYLINDER, {1, size_m}));
    EXPECT_THAT(said, StartsWith("primitives[2].dimensions[1]: is ")) << size_m;
  }
  // Its square is 0, and it would be in nobody's way.
  EXPECT_EQ(with_primitive(solid(SolidPrimitive::SPHERE, {1e-300})),
            "primitives[2].dimensions[0]: is 1e-300: it must be from 1e-06 to 10000 m");
  EXPECT_THAT(with_primitive(solid(SolidPrimitive::BOX, {1, 1, 0.9e-6})),
              StartsWith("primitives[2].dimensions[2]: is 9e-07"));
  EXPECT_EQ(with_primitive(solid(SolidPrimitive::CYLINDER, {-2, 1})),
            "primitives[2].dimensions[0]: is -2: it must be from 1e-06 to 10000 m");
  for (const double size_m : {1e-6, 10'000.0})
    EXPECT_EQ(with_primitive(solid(SolidPrimitive::CYLINDER, {1, size_m})), "done") << size_m;
}

TEST(Meshes, HaveATriangle) {
  EXPECT_EQ(with_mesh({{}, {{0, 0, 0}}}), "meshes[0].triangles: has no triangle");
  EXPECT_EQ(with_mesh({}), "meshes[0].triangles: has no triangle");
}

TEST(Meshes, NameOnlyVerticesThatAreThere) {
  Mesh mesh = tetrahedron();
  mesh.triangles[3][1] = 4;
  EXPECT_EQ(with_mesh(mesh),
            "meshes[0].triangles[3].vertex_indices[1]: is 4: there are 4 vertices, counted from 0");
  mesh.triangles[3][1] = 0xFFFF'FFFF;
  EXPECT_THAT(with_mesh(mesh), StartsWith("meshes[0].triangles[3].vertex_indices[1]: is 42949"));
}

TEST(Meshes, HaveVerticesThatArePlaces) {
  for (const double y_m : {kNaN, kInfinity, -kInfinity, 1.1e7, -1e300}) {
    Mesh mesh = tetrahedron();
    mesh.vertices[2].y = y_m;
    EXPECT_THAT(with_mesh(mesh), StartsWith("meshes[0].vertices[2].y: is ")) << y_m;
  }
}

TEST(Meshes, HaveAtMostTenThousandTrianglesInAMessage) {
  CollisionObject object = good_object();
  object.meshes.assign(2, tetrahedron());
  object.mesh_poses.assign(2, Pose{});
  object.meshes[0].triangles.assign(5000, {0, 1, 2});
  object.meshes[1].triangles.assign(5000, {0, 1, 2});
  EXPECT_EQ(outcome(object), "done");
  object.meshes[1].triangles.push_back({0, 1, 2});
  EXPECT_EQ(outcome(object), "meshes: has 10001 triangles, at most 10000 are allowed in a message");
}

TEST(Meshes, HaveABoundedNumberOfVertices) {
  Mesh mesh = tetrahedron();
  mesh.vertices.resize(30'000);
  EXPECT_EQ(with_mesh(mesh), "done");
  mesh.vertices.resize(30'001);
  EXPECT_EQ(with_mesh(mesh), "meshes: has 30001 vertices, at most 30000 are allowed in a message");
}

TEST(Planes, HaveADirection) {
  EXPECT_EQ(with_plane({{0, 0, 0, 1}}), "planes[0].coef: has no direction: a, b and c are all 0");
  EXPECT_EQ(with_plane({}), "planes[0].coef: has no direction: a, b and c are all 0");
  for (const double c : {1e-10, 1e10, 1e300, 5e-324})
    EXPECT_THAT(with_plane({{0, 0, c, 0}}), StartsWith("planes[0].coef: a, b and c have")) << c;
}

TEST(Planes, NeedNotBeOfUnitLength) {
  EXPECT_EQ(with_plane({{0, 0, 2, -1}}), "done");
  EXPECT_EQ(with_plane({{3, 4, 0, 1000}}), "done");
}

TEST(Planes, HaveFiniteNumbers) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (const double value : {kNaN, kInfinity, -kInfinity}) {
      Plane plane{{1, 1, 1, 1}};
      plane.coef[i] = value;
      EXPECT_EQ(with_plane(plane),
                "planes[0].coef[" + std::to_string(i) + "]: is no finite number");
    }
  }
}

TEST(Planes, AreNotBeyondTheWorld) {
  EXPECT_THAT(with_plane({{0, 0, 1, 1e8}}), StartsWith("planes[0].coef[3]: is too far away"));
  EXPECT_THAT(with_plane({{0, 0, 1e-8, 1}}), StartsWith("planes[0].coef[3]: is too far away"));
  EXPECT_EQ(with_plane({{0, 0, 1e8, 1e8}}), "done");
}

TEST(Poses, AreFinitePlaces) {
  for (const double z_m : {kNaN, kInfinity, -kInfinity, 1.1e7}) {
    CollisionObject object = good_object();
    object.plane_poses[0].position_m.z = z_m;
    EXPECT_THAT(outcome(object), StartsWith("plane_poses[0].position.z: is ")) << z_m;
  }
  CollisionObject object = good_object();
  object.plane_poses[0].position_m = {322'100, 4.5e6, -3};
  EXPECT_EQ(outcome(object), "done");
}

TEST(Turns, ThatAreAllZeroAreNoTurnAndSaid) {
  CollisionObject object = good_object();
  object.primitive_poses[1].orientation = {0, 0, 0, 0};
  const auto result = validate(object);
  ASSERT_TRUE(result.ok());
  const Quaternion& turn = result->message.primitive_poses[1].orientation;
  EXPECT_EQ(turn.w, 1);
  EXPECT_EQ(turn.x, 0);
  EXPECT_THAT(result->notes,
              testing::ElementsAre("primitive_poses[1].orientation: all zero, taken as no turn"));
}

TEST(Turns, NearUnitLengthGetIt) {
  for (const double length : {0.9991, 1.0009}) {
    CollisionObject object = good_object();
    object.primitive_poses[1].orientation = {0.6 * length, 0, 0, 0.8 * length};
    const auto result = validate(object);
    ASSERT_TRUE(result.ok()) << length;
    const Quaternion& turn = result->message.primitive_poses[1].orientation;
    EXPECT_NEAR(turn.w, 0.6, 1e-15);
    EXPECT_NEAR(turn.z, 0.8, 1e-15);
    ASSERT_EQ(result->notes.size(), 1U);
    EXPECT_THAT(result->notes[0], StartsWith("primitive_poses[1].orientation: of the length "));
  }
}

TEST(Turns, OfSinglePrecisionGetUnitLengthWithoutAWord) {
  CollisionObject object = good_object();
  object.primitive_poses[1].orientation = {0.70710670, 0, 0, 0.70710680};
  const auto result = validate(object);
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(result->notes.empty());
  const Quaternion& turn = result->message.primitive_poses[1].orientation;
  EXPECT_NEAR(std::hypot(turn.w, turn.z), 1, 1e-15);
}

TEST(Turns, OfAnotherLengthAreRefused) {
  for (const double length : {0.9989, 1.0011, 0.5, 2.0, 1e-9, 1e200}) {
    EXPECT_THAT(with_turn({0.6 * length, 0, 0, 0.8 * length}),
                StartsWith("primitive_poses[1].orientation: has the length "))
        << length;
  }
  for (const double huge : {1e200, 1e300}) {
    EXPECT_THAT(with_turn({huge, 0, 0, 0}), testing::HasSubstr("has the length 1e+"));
    EXPECT_THAT(with_turn({1, huge, 0, 0}), testing::HasSubstr("has the length 1e+"));
  }
}

TEST(Turns, AreFinite) {
  EXPECT_EQ(with_turn({kNaN, 0, 0, 0}), "primitive_poses[1].orientation.w: is no finite number");
  EXPECT_EQ(with_turn({1, 0, kInfinity, 0}),
            "primitive_poses[1].orientation.y: is no finite number");
}

}  // namespace
}  // namespace drover::scene
