// A list, what is not read at all, and how much of it may come.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/publish/scene/scene_texts.h"

namespace drover::publish {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(ScenePayloads, JudgeEachOfAListByItself) {
  const std::string list = "[" + std::string(kBox) + ", 7, " + with(kBox, "\"box1\"", "\"\"") +
                           ", " + std::string(kEachShape) + "]";
  const auto read = parse_collision_objects(list, Retain::no);
  ASSERT_TRUE(read.ok());
  EXPECT_TRUE(read->is_list);
  ASSERT_EQ(read->messages.size(), 4U);
  EXPECT_TRUE(read->messages[0].result.ok());
  EXPECT_EQ(read->messages[1].result.error().why, "must be an object, not an integer");
  EXPECT_EQ(read->messages[2].result.error().path, "id");
  EXPECT_TRUE(read->messages[3].result.ok());
  EXPECT_EQ(read->messages[3].name, "shelf");
}

TEST(ScenePayloads, NameWhatIsRefused) {
  const auto read = parse_collision_objects(
      R"({"header": {"seq": 9, "frame_id": 3}, "id": "a\nb", "operation": 3})", Retain::no);
  ASSERT_TRUE(read.ok());
  const auto& message = read->messages.at(0);
  EXPECT_EQ(message.name, "a?b");
  EXPECT_EQ(message.seq, 9U);
  EXPECT_EQ(message.operation, "MOVE");
  EXPECT_EQ(message.result.error().path, "header.frame_id");
  const auto odd =
      parse_collision_objects(R"({"header": [], "id": 1, "operation": 9})", Retain::no);
  EXPECT_EQ(odd->messages.at(0).name, "");
  EXPECT_EQ(odd->messages.at(0).seq, 0U);
  EXPECT_EQ(odd->messages.at(0).operation, "");
}

/// Programs that know no integers send 2.0.
TEST(ScenePayloads, EchoTheSeqHoweverItIsWritten) {
  const auto seq = [](const std::string& written) {
    const auto read = parse_collision_objects(
        R"({"header": {"seq": )" + written + R"(, "frame_id": "map"}, "id": "a", "operation": 1})",
        Retain::no);
    return read->messages.at(0).seq;
  };
  EXPECT_EQ(seq("2"), 2U);
  EXPECT_EQ(seq("2.0"), 2U);
  EXPECT_EQ(seq("2e0"), 2U);
  EXPECT_EQ(seq("4294967295.0"), 4294967295U);
  EXPECT_EQ(seq("2.5"), 0U);
  EXPECT_EQ(seq("4294967296"), 0U);
  EXPECT_EQ(seq("-1"), 0U);
}

TEST(ScenePayloads, AreNoneInAnEmptyPayloadOrList) {
  EXPECT_EQ(object(""), "nothing");
  EXPECT_EQ(object("[]"), "nothing");
  EXPECT_EQ(outcome(parse_collision_objects("", Retain::stored)), "nothing");
}

TEST(ScenePayloads, ThatAreRetainedAreRefused) {
  for (const Retain retain : {Retain::asked, Retain::stored}) {
    EXPECT_THAT(outcome(parse_collision_objects(kBox, retain)), HasSubstr("was retained"));
    EXPECT_THAT(outcome(parse_planning_constraints(kEachConstraint, retain)),
                HasSubstr("was retained"));
  }
}

TEST(ScenePayloads, RefuseTextsThatAreNoMessage) {
  EXPECT_EQ(object("7"), "whole: : must be a message or a list of them, not an integer");
  EXPECT_EQ(object("null"), "whole: : must be a message or a list of them, not null");
  EXPECT_THAT(object("{\"id\": NaN}"), StartsWith("whole: id: line 1, column 8: "));
  EXPECT_THAT(object("{\"id\": \"a\""), StartsWith("whole: "));
  EXPECT_THAT(object("{} {}"), StartsWith("whole: "));
  EXPECT_THAT(object("\xFF"), StartsWith("whole: "));
}

TEST(ScenePayloads, RefuseMoreThanALimit) {
  SceneLimits limits;
  limits.max_messages = 2;
  EXPECT_THAT(outcome(parse_collision_objects("[{}, {}, {}]", Retain::no, limits)),
              HasSubstr("has 3 messages, at most 2"));
  limits.max_bytes = 100;
  EXPECT_THAT(outcome(parse_collision_objects(kBox, Retain::no, limits)), HasSubstr("bytes"));
  const std::string deep = std::string(11, '[') + std::string(11, ']');
  EXPECT_THAT(object(deep), HasSubstr("nested deeper than 10 levels"));
  std::string values = "{\"primitives\": [0";
  for (int i = 0; i < 300'000; ++i) values += ",0";
  EXPECT_THAT(object(values + "]}"), HasSubstr("more than 300000 values"));
  std::string elements = "{\"id\": \"a\", \"meshes\": [{}";
  for (int i = 0; i < 30'000; ++i) elements += ",{}";
  EXPECT_EQ(object(elements + "]}"), "meshes: has 30001 elements, at most 30000 are allowed");
}

TEST(ScenePayloads, MayBeAsDeepAsTheDeepestFieldInAList) {
  EXPECT_EQ(constraints("[" + std::string(kEachConstraint) + "]"), "done");
}

TEST(ScenePayloads, MayCarryTenThousandTriangles) {
  std::string mesh = R"([{"header":{"frame_id":"map"},"id":"hill","mesh_poses":[{}],"meshes":[{)"
                     R"("triangles":[{"vertex_indices":[0,1,2]})";
  for (int i = 1; i < 10'000; ++i) mesh += ",{\"vertex_indices\":[0,1,2]}";
  mesh += R"(],"vertices":[{"x":0.123456789,"y":0,"z":0})";
  for (int i = 1; i < 5'000; ++i) mesh += ",{\"x\":0.123456789,\"y\":0.987654321,\"z\":0.5}";
  mesh += "]}]}]";
  EXPECT_EQ(object(mesh), "done");
}

}  // namespace
}  // namespace drover::publish
