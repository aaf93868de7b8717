#include "sim/scenario/story.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace drover::sim {
namespace {

using nlohmann::json;

Time at(double s) {
  return Time{from_s(s)};
}

Step step(const std::string& name, const std::string& after, double delay_s = 0) {
  Step step;
  step.name = name;
  step.after = parse_event_name(after);
  step.delay = from_s(delay_s);
  return step;
}

std::vector<std::string> due(Story& story, double s, const json& truth = nullptr) {
  std::vector<std::string> names;
  for (const auto* one : story.take_due(at(s), truth)) names.push_back(one->name);
  return names;
}

using Names = std::vector<std::string>;

TEST(EventName, RefusesACountThatIsNone) {
  for (const auto* text : {"ready#", "ready#0", "ready#x", "ready#2x", "#2"})
    EXPECT_THROW(parse_event_name(text), std::runtime_error) << text;
}

TEST(AStory, DoesNothingBeforeTheEventOrTheDelay) {
  const std::vector<Step> steps{step("a", "ready", 2)};
  Story story(steps);
  EXPECT_EQ(due(story, 1000), Names{});
  EXPECT_EQ(story.next(at(1000)), Time::max());
  story.happened("start_nav", at(1000));
  story.happened("ready", at(1001));
  EXPECT_EQ(due(story, 1002.999), Names{});
  EXPECT_EQ(story.next(at(1002)), at(1003));
  EXPECT_EQ(due(story, 1003), Names{"a"});
}

TEST(AStory, DoesEachStepOnce) {
  const std::vector<Step> steps{step("a", "ready")};
  Story story(steps);
  story.happened("ready", at(1));
  EXPECT_EQ(due(story, 1), Names{"a"});
  story.happened("ready", at(2));
  EXPECT_EQ(due(story, 2), Names{});
}

TEST(AStory, WaitsForTheSecondTimeWhenToldSo) {
  const std::vector<Step> steps{step("a", "ready#2")};
  Story story(steps);
  EXPECT_EQ(story.happened("ready", at(1)), 1U);
  EXPECT_EQ(due(story, 5), Names{});
  EXPECT_EQ(story.happened("ready", at(6)), 2U);
  EXPECT_EQ(due(story, 6), Names{"a"});
  EXPECT_TRUE(story.has_happened({"ready", 2}));
  EXPECT_FALSE(story.has_happened({"ready", 3}));
}

TEST(AStory, HoldsAStepUntilTheConditionIsTrue) {
  std::vector<Step> steps{step("a", "start_nav", 1)};
  steps[0].when = Condition{"x_m", true, 8};
  Story story(steps);
  story.happened("start_nav", at(0));
  EXPECT_FALSE(story.asks_for_truth(at(0.5))) << "the delay first";
  EXPECT_TRUE(story.asks_for_truth(at(1)));
  EXPECT_EQ(due(story, 1), Names{}) << "no answer of the simulator";
  EXPECT_EQ(due(story, 1, {{"y_m", 9}}), Names{});
  EXPECT_EQ(due(story, 1, {{"x_m", 8.0}}), Names{});
  EXPECT_GT(story.next(at(1)), at(1)) << "a look now and then, no spinning";
  EXPECT_EQ(due(story, 2, {{"x_m", 8.1}}), Names{"a"});
  EXPECT_FALSE(story.asks_for_truth(at(3)));
}

TEST(AStory, TellsOfAStepThatNeverCame) {
  const std::vector<Step> steps{step("estop", "startnav")};
  Story story(steps);
  (void)story.happened("start_nav", at(1));
  EXPECT_EQ(story.left(), Names{"step \"estop\" never came: \"startnav\" did not happen"});
  (void)story.happened("startnav", at(2));
  EXPECT_EQ(due(story, 2), Names{"estop"});
  EXPECT_TRUE(story.left().empty());
}

}  // namespace
}  // namespace drover::sim
