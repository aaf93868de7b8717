// The section `scene`: what is refused, with its place and what to do, and what follows from it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/clearance/clearance_watch.h"
#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using testing::HasSubstr;

constexpr std::string_view kBox = R"({"x_m": 0.45, "y_m": 0.35}, {"x_m": -0.45, "y_m": 0.35}, )"
                                  R"({"x_m": -0.45, "y_m": -0.35}, {"x_m": 0.45, "y_m": -0.35})";

/// kGood with a scene of this footprint and these other members, on line 14.
std::string scene(std::string_view corners, const std::string& others = "") {
  return with("\"port\": 1883}", "\"port\": 1883},\n  \"scene\": {\"footprint\": [" +
                                     std::string(corners) + "]" + others + "}");
}

std::string corners(std::initializer_list<std::pair<double, double>> all) {
  std::string text;
  for (const auto& [x_m, y_m] : all)
    text += (text.empty() ? "" : ", ") + ("{\"x_m\": " + std::to_string(x_m)) +
            ", \"y_m\": " + std::to_string(y_m) + "}";
  return text;
}

TEST(SceneSection, LeftOutAsksNobodyToLookAround) {
  const auto config = load_text(kGood).config;
  EXPECT_FALSE(config.scene.configured);
  EXPECT_FALSE(config.engine.clearance_required);
}

TEST(SceneSection, ThatIsThereAsksForSomebodyWhoLooksAround) {
  const auto text =
      scene(kBox, R"(, "reaction_s": 0.4, "again_m": 0.1, "again_s": 2, "wait_s": 5)");
  EXPECT_EQ(problems(text), "");
  EXPECT_EQ(warnings(text), "");
  const auto config = load_text(text).config;
  EXPECT_TRUE(config.scene.configured);
  EXPECT_TRUE(config.engine.clearance_required);
  EXPECT_EQ(config.engine.clearance.reaction_s, 0.4);
  EXPECT_EQ(config.engine.clearance.again_m, 0.1);
  EXPECT_EQ(config.engine.clearance.again_s, 2);
  EXPECT_EQ(config.engine.clearance.wait_s, 5);
  EXPECT_EQ(config.engine.clearance.max_age_s, engine::ClearanceConfig{}.max_age_s);
}

TEST(SceneSection, TellsTheEngineHowFarTheRobotReachesAndWhatItsMarginIsGoodFor) {
  const auto clearance_of = [](const std::string& text) {
    EXPECT_EQ(problems(text), "");
    return load_text(text).config.engine.clearance;
  };
  const auto clearance = clearance_of(scene(kBox));
  EXPECT_NEAR(clearance.reach_m, std::hypot(0.45, 0.35), 1e-12);
  EXPECT_EQ(clearance.beside_m, 0.05);
  EXPECT_EQ(clearance_of(scene(kBox, R"(, "margin_m": 2)")).beside_m, 0.05);
  EXPECT_EQ(clearance_of(scene(kBox, R"(, "margin_m": 0.06)")).beside_m, 0.03);
  EXPECT_EQ(clearance_of(scene(kBox, R"(, "margin_m": 0)")).beside_m, 0.01);
}

TEST(SceneSection, NeedsAFootprint) {
  EXPECT_THAT(problems(with("\"port\": 1883}", "\"port\": 1883}, \"scene\": {}")),
              HasSubstr("f:13:57: scene.footprint: is missing (corners of what the robot covers"));
  EXPECT_EQ(problems(scene(corners({{1, 1}, {-1, -1}}))),
            "f:14:26: scene.footprint: has 2 entries, but needs at least 3 entries\n");
}

TEST(SceneSection, KeepsACounterClockwiseFootprintAsItIs) {
  const auto config = load_text(scene(kBox)).config;
  ASSERT_EQ(config.scene.footprint.size(), 4U);
  EXPECT_EQ(config.scene.footprint[0].x_m, 0.45);
  EXPECT_EQ(config.scene.footprint[0].y_m, 0.35);
  EXPECT_EQ(config.scene.footprint[1].x_m, -0.45);
}

TEST(SceneSection, TurnsAClockwiseFootprintRound) {
  const auto text = scene(corners({{0.5, -0.4}, {-0.5, -0.4}, {-0.5, 0.4}, {0.5, 0.4}}));
  EXPECT_EQ(problems(text), "");
  const auto footprint = load_text(text).config.scene.footprint;
  ASSERT_EQ(footprint.size(), 4U);
  double twice_m2 = 0;
  for (std::size_t i = 0; i < 4; ++i)
    twice_m2 += footprint[i].x_m * footprint[(i + 1) % 4].y_m -
                footprint[i].y_m * footprint[(i + 1) % 4].x_m;
  EXPECT_NEAR(twice_m2, 1.6, 1e-9);
}

TEST(SceneSection, NamesTheCornerThatPointsInwardsWhicheverWayRound) {
  EXPECT_THAT(
      problems(scene(corners({{0.5, 0.4}, {0, 0.1}, {-0.5, 0.4}, {-0.5, -0.4}, {0.5, -0.4}}))),
      HasSubstr("scene.footprint[1]: points inwards: the footprint has to be convex"));
  EXPECT_THAT(
      problems(scene(corners({{0.5, -0.4}, {-0.5, -0.4}, {-0.5, 0.4}, {0, 0.1}, {0.5, 0.4}}))),
      HasSubstr("scene.footprint[3]: points inwards"));
}

TEST(SceneSection, RefusesSidesThatCross) {
  // A star of five: at each corner it turns to the same side.
  EXPECT_THAT(problems(scene(
                  corners({{1, 0}, {-0.81, 0.59}, {0.31, -0.95}, {0.31, 0.95}, {-0.81, -0.59}}))),
              HasSubstr("scene.footprint: its sides cross each other"));
}

TEST(SceneSection, RefusesTheSameCornerTwice) {
  EXPECT_THAT(problems(scene(corners({{1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 1}}))),
              HasSubstr("scene.footprint[4]: is the same place as corner 0 (from 0) "
                        "(the last side closes by itself)"));
}

TEST(SceneSection, RefusesAFootprintWithoutArea) {
  EXPECT_THAT(problems(scene(corners({{1, 0}, {0, 0}, {-1, 0}}))),
              HasSubstr("scene.footprint: covers less than 0.01 m2"));
}

TEST(SceneSection, RefusesAFootprintElsewhereThanBaseLink) {
  EXPECT_THAT(problems(scene(corners({{1, 0.4}, {0.1, 0.4}, {0.1, -0.4}, {1, -0.4}}))),
              HasSubstr("scene.footprint: base_link (0, 0) is outside of it"));
  EXPECT_EQ(problems(scene(corners({{1, 0.4}, {0, 0.4}, {0, -0.4}, {1, -0.4}}))), "");
}

TEST(SceneSection, RefusesAFootprintThatLeavesTheWheelsOut) {
  EXPECT_THAT(
      problems(scene(corners({{1, 0.4}, {-1, 0.4}, {-1, -0.2}, {1, -0.2}}))),
      HasSubstr("scene.footprint: does not reach the wheels, 0.3 m to each side of base_link "
                "by groups.base.track_m"));
}

TEST(SceneSection, BoundsCornersAndMargin) {
  EXPECT_THAT(problems(scene(corners({{20.5, 1}, {-1, 1}, {-1, -1}}))),
              HasSubstr("scene.footprint[0].x_m: is 20.5, but must be between -20 and 20"));
  EXPECT_THAT(problems(scene(kBox, R"(, "margin_m": -0.1)")),
              HasSubstr("scene.margin_m: is -0.1, but must be between 0 and 5"));
  EXPECT_THAT(
      problems(scene(R"({"x_m": 1, "y": 1}, {"x_m": -1, "y_m": 1}, {"x_m": -1, "y_m": -1})")),
      HasSubstr("scene.footprint[0].y: is no known key (did you mean \"y_m\"?)"));
}

TEST(SceneSection, RefusesARobotThatIsAllClearance) {
  EXPECT_THAT(problems(scene(kBox, R"(, "height_m": 0.3, "ground_clearance_m": 0.3)")),
              HasSubstr("scene.ground_clearance_m: is not below scene.height_m"));
}

TEST(SceneSection, RefusesAWayOfJudgingHeightsThatThereIsNot) {
  EXPECT_THAT(problems(scene(kBox, R"(, "heights": "ignored")")),
              HasSubstr("scene.heights: \"ignored\" is not one of: robot, ignore "
                        "(did you mean \"ignore\"?)"));
}

TEST(SceneSection, HasFramesByName) {
  const auto text =
      scene(kBox, R"(, "frames": {"mast": {"z_m": 1.2, "yaw_deg": 90}, "camera": {}})");
  EXPECT_EQ(problems(text), "");
  const auto frames = load_text(text).config.scene.frames;
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].name, "mast");
  EXPECT_EQ(frames[0].z_m, 1.2);
  EXPECT_EQ(frames[0].yaw_deg, 90);
  EXPECT_EQ(frames[1].name, "camera");
}

TEST(SceneSection, RefusesFramesWithNamesThatMessagesUseOtherwise) {
  for (const std::string name : {"map", "base_link", "0", "1", "/map", "/1"})
    EXPECT_THAT(problems(scene(kBox, ", \"frames\": {\"" + name + "\": {}}")),
                HasSubstr("scene.frames." + name + ": \"" + name + "\" means something else"))
        << name;
  EXPECT_THAT(problems(scene(kBox, R"(, "frames": {"/mast": {}})")),
              HasSubstr("scene.frames./mast: begins with a slash, which messages leave out "
                        "(write \"mast\")"));
  EXPECT_THAT(problems(scene(kBox, R"(, "frames": {"mast": {}, "mast": {}})")), HasSubstr("mast"));
}

TEST(SceneSection, WarnsOfALookThatIsTooShortForTheFastestSpeed) {
  const auto text = scene(kBox, R"(, "ahead_m": 0.5, "along_m": 0.8)");
  EXPECT_EQ(problems(text), "");
  EXPECT_EQ(warnings(text),
            "f:14:155: scene.ahead_m: reaches for 0.53 m/s: without a track the robot is no "
            "faster, though "
            "limits.max_speed_mps is 0.80, because what was not looked at is not free (1.03 m or "
            "more, or \"accept\": [\"short_look\"] at the top of the file when that is meant)\n"
            "f:14:171: scene.along_m: reaches for 0.70 m/s: a task is no faster, though "
            "limits.max_speed_mps is 0.80, because what was not looked at is not free (1.03 m or "
            "more, or \"accept\": [\"short_look\"] at the top of the file when that is meant)\n");
  EXPECT_EQ(warnings(scene(kBox, R"(, "ahead_m": 1.03, "along_m": 1.03)")), "");
  EXPECT_THAT(warnings(scene(kBox, R"(, "ahead_m": 1.01)")), HasSubstr("scene.ahead_m"));
}

TEST(SceneSection, DoesNotWarnOfAShortLookThatIsMeant) {
  auto text = scene(kBox, R"(, "ahead_m": 0.5)");
  text.insert(1, R"("accept": ["short_look"],)");
  EXPECT_EQ(warnings(text), "");
}

TEST(SceneSection, WarnsOfTheSpeedThatTheEnginePermits) {
  const auto loaded = load_text(scene(kBox, R"(, "ahead_m": 0.5)"));
  engine::ClearanceWatch watch(loaded.config.engine.clearance, loaded.config.engine.limits, true);
  Clearance found;
  found.t = Time(from_s(10));
  found.twist = {0.3, 0};
  found.ahead_m = loaded.config.scene.ahead_m;
  BodyMotion body;
  body.known = true;
  watch.on_clearance(found);
  watch.update({.now = found.t, .body = body, .path = 0, .commanded = found.twist});
  ASSERT_EQ(watch.unknown(), "");
  ASSERT_EQ(loaded.warnings.size(), 1U);
  std::array<char, 32> speed{};
  std::snprintf(speed.data(), speed.size(), "for %.2f m/s", watch.caps().ahead_mps);
  EXPECT_THAT(loaded.warnings[0].message, HasSubstr(speed.data()));
}

}  // namespace
}  // namespace drover::config
