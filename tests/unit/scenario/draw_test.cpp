#include "sim/scenario/draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace drover::sim {
namespace {

using nlohmann::json;

json scenario() {
  return json::parse(R"({"start": {"from": 1, "to": 2}, "mission": {"steps": [
    {"delay_s": {"from": 0.5, "to": 3}, "do": {"sim": ["supply dip", {"from": 0.1, "to": 1}]}},
    {"delay_s": 2, "when": {"x_m_above": {"from": -1, "to": 1}}}]}})");
}

double delay_s(std::uint64_t seed) {
  auto document = scenario();
  draw_mission(document, seed);
  return document.at("/mission/steps/0/delay_s"_json_pointer).get<double>();
}

TEST(DrawMission, StaysWithinTheBoundsAndUsesThemWhole) {
  double least = 10;
  double most = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    least = std::min(least, delay_s(seed));
    most = std::max(most, delay_s(seed));
  }
  EXPECT_GE(least, 0.5);
  EXPECT_LT(least, 0.6);
  EXPECT_LE(most, 3);
  EXPECT_GT(most, 2.9);
}

TEST(DrawMission, GivesEachSeedAndEachPlaceItsOwnNumberAndAlwaysTheSame) {
  EXPECT_EQ(delay_s(7), delay_s(7));
  std::set<double> different;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) different.insert(delay_s(seed));
  EXPECT_EQ(different.size(), 50U);
  auto two = json::parse(R"({"mission": [{"from": 0, "to": 1}, {"from": 0, "to": 1}]})");
  draw_mission(two, 1);
  EXPECT_NE(two["mission"][0], two["mission"][1]);
}

TEST(DrawMission, DrawsInsideOfListsAndLeavesAllElseAsItIs) {
  auto document = scenario();
  draw_mission(document, 1);
  EXPECT_TRUE(document.at("/mission/steps/0/do/sim/1"_json_pointer).is_number());
  EXPECT_TRUE(document.at("/mission/steps/1/when/x_m_above"_json_pointer).is_number());
  EXPECT_EQ(document.at("/mission/steps/1/delay_s"_json_pointer), 2);
  EXPECT_EQ(document["start"], scenario()["start"]) << "only missions are drawn";
}

TEST(DrawMission, NamesThePlaceOfBoundsThatAreNone) {
  for (const char* range : {R"({"from": 1, "to": 1})", R"({"from": "a", "to": 1})"}) {
    json document{{"mission", {{"steps", json::array({{{"delay_s", json::parse(range)}}})}}}};
    try {
      draw_mission(document, 1);
      ADD_FAILURE() << range;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("mission.steps[0].delay_s"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace drover::sim
