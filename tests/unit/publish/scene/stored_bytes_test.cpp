// What the scene reckons with for its store is no less than what is written.
#include "scene/world/stored_bytes.h"

#include <gtest/gtest.h>

#include <cfloat>

#include "publish/scene/stored_text.h"
#include "scene/message/split.h"
#include "scene/world/amount.h"
#include "store/scene_store.h"

namespace drover::scene {
namespace {

constexpr double kLong = -DBL_MIN;  // its digits are the most that a double has

Pose long_pose() {
  return {{kLong, kLong, kLong}, {kLong, kLong, kLong, kLong}};
}

constexpr GeodeticPoint kLongOrigin{kLong, kLong, kLong};

std::string text_of(const Object& object) {
  return publish::stored_text(
      StoredObject{in_messages(as_message(object)), kLongOrigin, object.place_sigma_m});
}

std::size_t bytes_of(const Object& object) {
  return amount_of(object).bytes;
}

/// With its line in the file.
std::size_t written(const std::string& kind, const std::string& name, const std::string& text) {
  const auto file = store::encode_named_texts(store::kSceneFile, {{kind, name, 1.7e9, text}});
  const auto none = store::encode_named_texts(store::kSceneFile, {});
  EXPECT_TRUE(file.ok() && none.ok());
  return file.ok() && none.ok() ? file->size() - none->size() : 0;
}

Object long_object(std::size_t primitives, std::size_t meshes, std::size_t triangles,
                   std::size_t vertices, std::size_t planes) {
  Object object;
  object.id = std::string(200, '"');
  object.place_sigma_m = -kLong;
  object.type = {std::string(200, '\\'), std::string(200, '"')};
  object.primitives.assign(primitives,
                           {{SolidPrimitive::BOX, {kLong, kLong, kLong}}, {}, long_pose()});
  Mesh mesh;
  mesh.triangles.assign(triangles, {29'999, 29'999, 29'999});
  mesh.vertices.assign(vertices, {kLong, kLong, kLong});
  object.meshes.assign(meshes, {mesh, {}, long_pose()});
  object.planes.assign(planes, {{{kLong, kLong, kLong, kLong}}, {}, long_pose()});
  return object;
}

TEST(StoredBytes, AreNoLessThanAnObjectIsWritten) {
  for (const Object& object :
       {long_object(1, 0, 0, 0, 0), long_object(3000, 0, 0, 0, 0), long_object(0, 0, 0, 0, 2500),
        long_object(0, 1, 10'000, 30'000, 0), long_object(0, 30, 6'000, 3, 0),
        long_object(0, 3000, 1, 3, 0), long_object(0, 6, 1, 16'000, 0),
        long_object(1001, 1001, 2, 3, 1001)}) {
    const std::size_t text = written("object", object.id, text_of(object));
    EXPECT_LE(text, bytes_of(object));
    EXPECT_GT(text, bytes_of(object) / 4) << "it is a bound and no guess";
  }
}

TEST(StoredBytes, AreNoLessThanConstraintsAreWritten) {
  const std::string name(200, '"');
  const Header header{4'294'967'295U, {4'294'967'295U, 999'999'999U}, name};
  Constraints set;
  set.name = name;
  set.joint_constraints.assign(3, {name, kLong, kLong, kLong, kLong});
  PositionConstraint position;
  position.header = header;
  position.link_name = name;
  position.target_point_offset = {kLong, kLong, kLong};
  position.constraint_region = {{{SolidPrimitive::BOX, {kLong, kLong, kLong}}},
                                {long_pose()},
                                {{{{1, 2, 3}}, {{kLong, kLong, kLong}}}},
                                {long_pose()}};
  position.weight = kLong;
  set.position_constraints.assign(3, position);
  set.orientation_constraints.assign(
      3, {header, {kLong, kLong, kLong, kLong}, name, kLong, kLong, kLong, kLong});
  set.visibility_constraints.assign(3, {kLong,
                                        {header, long_pose()},
                                        -2'147'483'647,
                                        {header, long_pose()},
                                        kLong,
                                        kLong,
                                        2,
                                        kLong});
  const std::size_t text =
      written("constraint", name, publish::stored_text(StoredSet{set, kLongOrigin}));
  EXPECT_LE(text, amount_of(set).bytes);
  EXPECT_GT(text, amount_of(set).bytes / 4);
}

TEST(StoredBytes, OfAllThatIsKeptFitIntoTheStore) {
  EXPECT_LT(kMost.texts, store::kSceneFile.max_texts) << "one is the store's own";
  EXPECT_LE(kMost.bytes + 4096, store::kSceneFile.max_bytes);
}

}  // namespace
}  // namespace drover::scene
