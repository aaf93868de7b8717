#include "publish/scene/stored_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/message/split.h"
#include "tests/unit/publish/scene/scene_texts.h"

namespace drover::publish {
namespace {

constexpr GeodeticPoint kField{23.1496524965, 113.0196366456667, 20.25};

template <class Message>
std::string as_text(const Message& message) {
  json::JsonText out;
  write_scene(out, message);
  return out.take();
}

scene::CollisionObject shelf() {
  return parse_collision_objects(kEachShape, Retain::no)->messages.at(0).result->message;
}

TEST(StoredTexts, OfAnObjectAreReadWithTheirOriginToTheBit) {
  auto object = shelf();
  object.operation = scene::CollisionObject::ADD;
  const auto read = read_stored_object(stored_text(scene::StoredObject{{object}, kField}));
  ASSERT_TRUE(read.ok()) << read.error().why;
  ASSERT_EQ(read->messages.size(), 1U);
  EXPECT_EQ(as_text(read->messages[0]), as_text(object));
  EXPECT_EQ(read->origin.latitude_deg, kField.latitude_deg);
  EXPECT_EQ(read->origin.longitude_deg, kField.longitude_deg);
  EXPECT_EQ(read->origin.altitude_m, kField.altitude_m);
}

TEST(StoredTexts, OfAnObjectAreReadWithHowWellItsPlaceIsKnown) {
  const std::string text = stored_text(scene::StoredObject{{shelf()}, kField, 0.1 + 0.02});
  const auto read = read_stored_object(text);
  ASSERT_TRUE(read.ok()) << read.error().why;
  EXPECT_EQ(read->place_sigma_m, 0.1 + 0.02);
  // What is of `map`, and all that was stored before this was kept, has no error.
  const std::string before = stored_text(scene::StoredObject{{shelf()}, kField});
  EXPECT_EQ(before.find("place_sigma_m"), std::string::npos);
  EXPECT_EQ(read_stored_object(before)->place_sigma_m, 0);
}

TEST(StoredTexts, OfAnObjectAreRefusedWhenHowWellItsPlaceIsKnownIsDamaged) {
  const std::string good = stored_text(scene::StoredObject{{shelf()}, kField, 0.125});
  for (const char* bad : {"-0.125", "null", "\"0.125\"", "1e999"}) {
    std::string text = good;
    text.replace(text.find("0.125"), 5, bad);
    EXPECT_FALSE(read_stored_object(text).ok()) << bad;
  }
}

TEST(StoredTexts, OfAnObjectOfAnySizeAreReadAgain) {
  auto object = shelf();
  object.operation = scene::CollisionObject::ADD;
  while (object.primitives.size() < 5 * scene::kMaxShapes) {
    object.primitives.push_back(object.primitives.front());
    object.primitive_poses.push_back(object.primitive_poses.front());
  }
  const auto read =
      read_stored_object(stored_text(scene::StoredObject{scene::in_messages(object), kField}));
  ASSERT_TRUE(read.ok()) << read.error().why;
  std::size_t shapes = 0;
  for (const auto& message : read->messages) shapes += message.primitives.size();
  EXPECT_EQ(shapes, object.primitives.size());
}

TEST(StoredTexts, OfConstraintsAreReadAgain) {
  const auto row =
      parse_planning_constraints(kEachConstraint, Retain::no)->messages.at(0).result->message;
  const auto read = read_stored_set(stored_text(scene::StoredSet{row, kField}));
  ASSERT_TRUE(read.ok()) << read.error().why;
  EXPECT_EQ(as_text(read->message), as_text(row));
}

TEST(StoredTexts, ThatAreDamagedAreRefused) {
  const std::string good = stored_text(scene::StoredObject{{shelf()}, kField});
  ASSERT_TRUE(read_stored_object(good).ok());
  const std::string origin = good.substr(0, good.find('\n') + 1);
  const std::string messages = good.substr(origin.size());
  for (const std::string& bad :
       {std::string(), origin, origin + "[]", good.substr(0, good.size() - 1), good.substr(1),
        "{}\n" + messages, "null\n" + messages, messages, origin + R"([{"id":"a"}])"})
    EXPECT_FALSE(read_stored_object(bad).ok()) << bad.substr(0, 80);
}

}  // namespace
}  // namespace drover::publish
