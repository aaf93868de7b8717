// Messages of the planning scene on their way to droverd.
#include "ros2/scene_line.h"

#include <gmock/gmock.h>

#include "json/located_json.h"

namespace drover::ros2 {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr Time kSaid{100s};

std::string line_of(const std::string& message) {
  return scene_line("collision_object", "box1", message, kSaid);
}

TEST(SceneLine, CarriesTheMessageAsItIs) {
  const std::string message = R"({"id":"a \"b\" \\"})";
  const auto line = json::parse(line_of(message));
  ASSERT_TRUE(line.ok());
  EXPECT_EQ(*line->root.find("cmd")->text(), "scene_message");
  EXPECT_EQ(*line->root.find("topic")->text(), "collision_object");
  EXPECT_EQ(line->root.find("at_ns")->integer(), 100'000'000'000);
  EXPECT_EQ(*line->root.find("message")->text(), message);
}

TEST(SceneLine, OfWhatIsRefusedSaysWhereAndWhy) {
  const auto line = json::parse(
      scene_line("planning_constraints", "row", SceneRefusal{"a[1].x", "is no number"}, kSaid));
  ASSERT_TRUE(line.ok());
  EXPECT_EQ(*line->root.find("name")->text(), "row");
  EXPECT_EQ(*line->root.find("path")->text(), "a[1].x");
  EXPECT_EQ(*line->root.find("refused")->text(), "is no number");
  EXPECT_EQ(line->root.find("message"), nullptr);
}

TEST(SceneLine, IsNeverLongerThanDroverdTakes) {
  const std::string longest(kMostSceneLine, '"');  // each is two
  for (const auto& line :
       {line_of(longest), line_of(longest.substr(0, kMostSceneLine / 2)),
        scene_line("collision_object", longest, SceneRefusal{"id", "is too long"}, kSaid)})
    EXPECT_LE(line.size(), kMostSceneLine);
  EXPECT_THAT(line_of(longest), AllOf(HasSubstr("60000 are taken"), HasSubstr("with APPEND"),
                                      HasSubstr(R"("name":"box1")")));
  EXPECT_THAT(scene_line("planning_constraints", "row", longest, kSaid),
              AllOf(HasSubstr("60000 are taken: take fewer"), Not(HasSubstr("APPEND"))));
  EXPECT_THAT(line_of(std::string(1000, 'x')), Not(HasSubstr("refused")));
}

TEST(SceneAnswer, TellsTheJournalWhatWasRefusedOrTakenOtherwise) {
  const auto of = [](const std::string& answer) {
    return read_scene_answer(R"({"scene_feedback":)" + answer + "}");
  };
  auto told = of(R"({"topic":"collision_object","id":"box1","result":"done"})");
  EXPECT_TRUE(told.is_answer);
  EXPECT_EQ(told.words, "");
  told = of(
      R"({"topic":"collision_object","id":"box1","result":"refused","path":"id","reason":"no"})");
  EXPECT_TRUE(told.refused);
  EXPECT_EQ(told.words, "/collision_object 'box1' refused: id: no");
  told = of(R"({"topic":"planning_constraints","result":"refused","reason":"slow down"})");
  EXPECT_EQ(told.words, "/planning_constraints refused: slow down");
  told = of(R"({"topic":"collision_object","id":"b","result":"done","notes":["one","two"]})");
  EXPECT_FALSE(told.refused);
  EXPECT_EQ(told.words, "/collision_object 'b': one; two");
  EXPECT_FALSE(read_scene_answer(R"({"ok":false,"reason":"no"})").is_answer);
  EXPECT_FALSE(read_scene_answer(R"({"at_ns":1})").is_answer);
}

TEST(SceneLines, AreBoundedAndKeepTheirOrder) {
  SceneLines lines;
  EXPECT_TRUE(lines.empty());
  for (std::size_t i = 0; i < SceneLines::kMost; ++i) EXPECT_TRUE(lines.push(std::to_string(i)));
  EXPECT_FALSE(lines.push("one more"));
  EXPECT_EQ(lines.pop(), "0");
  EXPECT_TRUE(lines.push("one more"));
  EXPECT_EQ(lines.pop(), "1");
  SceneLines large;
  std::size_t taken = 0;
  while (large.push(std::string(kMostSceneLine, 'x'))) ++taken;
  EXPECT_EQ(taken, SceneLines::kMostBytes / kMostSceneLine);
}

}  // namespace
}  // namespace drover::ros2
