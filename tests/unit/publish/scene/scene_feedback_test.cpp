#include "publish/scene/scene_feedback.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "json/located_json.h"
#include "tests/unit/publish/scene/scene_texts.h"

namespace drover::publish {
namespace {

using testing::HasSubstr;

std::string answered(std::string_view text) {
  return scene_feedback_text(answer_to(parse_collision_objects(text, Retain::no)->messages.at(0)));
}

TEST(SceneFeedback, SaysWhatIsDone) {
  EXPECT_EQ(answered(kBox), R"({"topic":"collision_object","id":"box1","seq":7,"operation":"ADD",)"
                            R"("result":"done"})");
  EXPECT_EQ(answered(R"({"id": "box1", "operation": 1})"),
            R"({"topic":"collision_object","id":"box1","operation":"REMOVE","result":"done"})");
}

TEST(SceneFeedback, SaysWhereAndWhyAMessageIsRefused) {
  EXPECT_EQ(answered(with(kBox, "0.4", "0")),
            R"({"topic":"collision_object","id":"box1","seq":7,"operation":"ADD",)"
            R"("result":"refused","path":"primitives[0].dimensions[0]",)"
            R"("reason":"is 0: it must be from 1e-06 to 10000 m"})");
}

TEST(SceneFeedback, SaysWhatWasTakenOtherwise) {
  EXPECT_EQ(answered(with(kBox, R"("operation": 0)", R"("colour": "red")")),
            R"({"topic":"collision_object","id":"box1","seq":7,"operation":"ADD",)"
            R"("result":"done","notes":["colour: unknown, ignored"]})");
}

TEST(SceneFeedback, AnswersConstraintsByTheirName) {
  const auto read = parse_planning_constraints(kEachConstraint, Retain::no);
  EXPECT_EQ(scene_feedback_text(answer_to(read->messages.at(0))),
            R"({"topic":"planning_constraints","name":"row","result":"done"})");
}

TEST(SceneFeedback, AnswersAPayloadThatIsNoMessage) {
  const auto read = parse_collision_objects("{\"id\": [1 2]}", Retain::no);
  ASSERT_FALSE(read.ok());
  EXPECT_EQ(scene_feedback_text(answer_to(kTopicCollisionObject, read.error())),
            R"({"topic":"collision_object","result":"refused","path":"id[1]",)"
            R"("reason":"line 1, column 11: a comma is missing before this"})");
}

TEST(SceneFeedback, AnswersAListByAList) {
  const auto read = parse_collision_objects("[" + std::string(kBox) + ", {}]", Retain::no);
  std::vector<SceneAnswer> answers;
  for (const auto& message : read->messages) answers.push_back(answer_to(message));
  EXPECT_EQ(scene_feedback_text(answers),
            R"([{"topic":"collision_object","id":"box1","seq":7,"operation":"ADD",)"
            R"("result":"done"},)"
            R"({"topic":"collision_object","operation":"ADD","result":"refused","path":"id",)"
            R"("reason":"is empty: it must be named"}])");
  EXPECT_EQ(scene_feedback_text(std::span<const SceneAnswer>{}), "[]");
}

TEST(SceneFeedback, TellsWhatTheWorldRefuses) {
  SceneAnswer answer = answer_to(parse_collision_objects(kBox, Retain::no)->messages.at(0));
  answer.refusal = scene::Refusal{"", "there is no object of this id"};
  EXPECT_THAT(scene_feedback_text(answer),
              HasSubstr(R"("result":"refused","reason":"there is no object of this id")"));
}

TEST(SceneFeedback, IsBoundedAndAlwaysJson) {
  const std::string long_id(5000, '\x01');
  SceneAnswer answer{.topic = kTopicCollisionObject};
  answer.refusal = scene::Refusal{long_id, long_id};
  const std::string text = scene_feedback_text(answer);
  EXPECT_LT(text.size(), 800U);
  EXPECT_TRUE(json::parse(text).ok());
}

/// The examples of the README, each with the answer that stands below it.
TEST(SceneFeedback, IsWhatTheReadmeShows) {
  std::ifstream file(std::string(DROVER_SOURCE_DIR) + "/src/publish/scene/README.md");
  std::string line;
  std::string message;
  int shown = 0;
  for (bool inside = false; std::getline(file, line);) {
    if (line.starts_with("```")) {
      inside = line == "```json";
      message = inside ? "" : message;
    } else if (inside && line.starts_with("{\"topic\":")) {
      const bool constraints = line.find("planning_constraints") != line.npos;
      const auto answer = [](const auto& read, std::string_view topic) {
        return read.ok() ? answer_to(read->messages.at(0)) : answer_to(topic, read.error());
      };
      EXPECT_EQ(
          scene_feedback_text(constraints ? answer(parse_planning_constraints(message, Retain::no),
                                                   kTopicPlanningConstraints)
                                          : answer(parse_collision_objects(message, Retain::no),
                                                   kTopicCollisionObject)),
          line);
      message.clear();
      ++shown;
    } else if (inside) {
      message += line + "\n";
    }
  }
  EXPECT_GE(shown, 8);
}

}  // namespace
}  // namespace drover::publish
