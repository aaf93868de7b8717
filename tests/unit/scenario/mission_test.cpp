#include "sim/scenario/mission.h"

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "sim/robot/scenario.h"
#include "sim/robot/scenario_file.h"
#include "sim/scenario/draw.h"
#include "support/temp_folder.h"

namespace drover::sim {
namespace {

using nlohmann::json;

json document() {
  return json::parse(R"({
    "name": "m", "origin": {"latitude_deg": 1, "longitude_deg": 2},
    "start": {"x_m": 3, "y_m": 4, "yaw_deg": 90},
    "gnss": {"antenna": {"x_m": 0.1, "y_m": 0.2, "z_m": 0.6}},
    "mission": {"track": [{"straight_m": 2}], "speed_mps": 0.4}})");
}

std::string refusal(const json& document) {
  try {
    (void)read_mission(document);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refused(const std::string& steps, const std::string& text) {
  auto with = document();
  with["mission"]["steps"] = json::parse(steps);
  EXPECT_NE(refusal(with).find(text), std::string::npos) << refusal(with);
}

TEST(AMission, RefusesWhatItDoesNotKnowAndNamesThePlace) {
  auto with = document();
  with["mission"]["speed"] = 1;
  EXPECT_NE(refusal(with).find("mission.speed"), std::string::npos) << refusal(with);
  expect_refused(R"([{"do": {"jump": 1}}])", "steps[0].do");
  expect_refused(R"([{"do": {"kill": "init"}}])", "steps[0].do.kill");
  expect_refused(R"([{"do": {"kill": "droverd", "signal": "HUP"}}])", "signal");
  expect_refused(R"([{"do": {"freeze": "droverd"}}])", "steps[0].do.thread");
  expect_refused(R"([{"do": {"freeze": "init", "thread": "control"}}])", "steps[0].do.freeze");
  expect_refused(R"([{"when": {"x_above": 1}, "do": {"save": true}}])", "x_above");
  expect_refused(R"([{"do": {"start_task": {"id": 0}}}])", "id");
  expect_refused(R"([{"do": {"joint_commands": {"velocities_radps": {"a": 1}}}}])", "for_s");
  expect_refused(R"([{"do": {"joint_commands": {"velocities_radps": {"a": "fast"}, "for_s": 1}}}])",
                 "joint_commands.velocities_radps.a");
  expect_refused(R"([{"do": {"joint_commands": {"velocities_radps": {"a": 1}, "for_s": 1,
                     "names": "both"}}}])",
                 "joint_commands.names");
  expect_refused(R"([{"do": {"joint_commands": {"velocities_radps": {"a": 1}, "for_s": 1,
                     "content": "ros2"}}}])",
                 "joint_commands.content");
  expect_refused(R"([{"delay_s": -1, "do": {"save": true}}])", "delay_s");
  expect_refused(R"([{"do": [{"save": true}, {"sim": "quit", "x": 1}]}])", "steps[0].do[1].x");
  expect_refused(R"([{"do": {"sim": ["supply", true]}}])", "steps[0].do.sim");
}

TEST(AMission, RefusesAStepAfterWhatNeverHappens) {
  expect_refused(
      R"([{"after": "readdy", "do": {"cli": "stop"}}])",
      "mission.steps[0].after: there is no event and no step of the name \"readdy\" (did "
      "you mean \"ready\"?)");
  auto ends = document();
  ends["mission"]["end"] = {{"after", "nav_succes"}};
  EXPECT_NE(refusal(ends).find("mission.end.after"), std::string::npos) << refusal(ends);
  auto follows = document();
  follows["mission"]["steps"] = json::parse(R"([
    {"after": "pressed", "do": {"cli": "reset"}}, {"after": "exit_drover", "do": {"save": true}},
    {"name": "pressed", "after": "start_nav#2", "do": {"sim": "estop press"}}])");
  EXPECT_EQ(refusal(follows), "accepted");
}

TEST(AMission, NamesTheKeyThatWasMeant) {
  auto track = document();
  track["mission"]["trak"] = track["mission"]["track"];
  track["mission"].erase("track");
  EXPECT_EQ(refusal(track), "mission.track: is missing (is \"trak\" meant to be it?)");
  auto shape = document();
  shape["mission"]["track"] = json::parse(R"([{"straight": 3}])");
  EXPECT_EQ(refusal(shape), "mission.track[0]: must have straight_m, or turn_deg and radius_m");
}

TEST(AMission, StartsItsTrackWhereTheRobotStandsAndEndsAtTheLastPoint) {
  const auto mission = read_mission(document());
  ASSERT_EQ(mission.track.size(), 5U);
  EXPECT_NEAR(mission.track.back().x_m, 3, 1e-12);
  EXPECT_NEAR(mission.track.back().y_m, 6, 1e-12);
  EXPECT_EQ(mission.target_id, 5U);
  EXPECT_EQ(mission.track_name, "m");
  EXPECT_DOUBLE_EQ(mission.antenna.y_m, 0.2);
}

TEST(AMission, ReadsStepsWithTheirActions) {
  auto with = document();
  with["mission"]["steps"] = json::parse(R"([
    {"name": "n", "after": "start_nav#2", "delay_s": 1.5, "when": {"pitch_rad_below": -0.1},
     "do": [{"kill": "droverd", "signal": "STOP"}, {"publish": {"cmd": "x"}, "retain": true},
            {"publish": "{broken", "topic": "t"}, {"start_task": {"id": 2, "speed_mps": 0.3}},
            {"sim": ["supply dip", 0.5]},
            {"freeze": "droverd", "thread": "publish"}, {"thaw": "droverd"},
            {"joint_commands": {"velocities_radps": {"a": 1, "b": "nan"}, "for_s": 2}}]}])");
  const auto mission = read_mission(with);
  ASSERT_EQ(mission.steps.size(), 1U);
  const auto& step = mission.steps[0];
  EXPECT_EQ(step.after.count, 2U);
  EXPECT_EQ(step.delay, std::chrono::milliseconds(1500));
  ASSERT_TRUE(step.when);
  EXPECT_FALSE(step.when->above);
  ASSERT_EQ(step.actions.size(), 8U);
  EXPECT_EQ(step.actions[0].signal, SIGSTOP);
  EXPECT_EQ(step.actions[1].text, R"({"cmd":"x"})");
  EXPECT_EQ(step.actions[1].topic, "mqtt_control");
  EXPECT_TRUE(step.actions[1].retain);
  EXPECT_EQ(step.actions[2].text, "{broken");
  EXPECT_EQ(step.actions[3].id, 2U);
  EXPECT_EQ(step.actions[4].text, "supply dip 0.5");
  EXPECT_EQ(step.actions[5].text, "droverd");
  EXPECT_EQ(step.actions[5].thread, "publish");
  EXPECT_EQ(step.actions[6].kind, Action::Kind::thaw);
  const auto& stream = step.actions[7].stream;
  ASSERT_EQ(stream.joints.size(), 2U);
  EXPECT_EQ(stream.joints[0].velocity_radps, 1);
  EXPECT_TRUE(std::isnan(stream.joints[1].velocity_radps));
  EXPECT_EQ(stream.lasts, std::chrono::seconds(2));
}

TEST(AMission, ReadsACommandLineOfWordsThatMayHaveBlanks) {
  auto with = document();
  with["mission"]["steps"] = json::parse(R"([{"do": [{"cli": " task  cancel "},
    {"cli": ["task", "start", "row 7", "--id", 5, "--speed", {"from": 0.2, "to": 0.4}]}]}])");
  draw_mission(with, 1);
  const auto actions = read_mission(with).steps.at(0).actions;
  using Words = std::vector<std::string>;
  EXPECT_EQ(actions[0].words, (Words{"task", "cancel"}));
  ASSERT_EQ(actions[1].words.size(), 7U);
  EXPECT_EQ(actions[1].words[2], "row 7");
  EXPECT_EQ(actions[1].words[4], "5");
  EXPECT_EQ(shown_words({"traj", "show", "row 7", ""}), "traj show 'row 7' ''");
  expect_refused(R"([{"do": {"cli": ["stop", true]}}])",
                 "steps[0].do.cli: must be words and numbers");
  expect_refused(R"([{"do": {"cli": 5}}])", "steps[0].do.cli");
}

TEST(SetMember, ChangesOneMemberAndRefusesWhatIsNoAssignment) {
  auto changed = document();
  set_member(changed, "mission.speed_mps=0.3");
  set_member(changed, "mission.track_name=row 7");
  const auto mission = read_mission(changed);
  EXPECT_DOUBLE_EQ(mission.speed_mps, 0.3);
  EXPECT_EQ(mission.track_name, "row 7");
  EXPECT_THROW(set_member(changed, "mission"), std::runtime_error);
  EXPECT_THROW(set_member(changed, "=1"), std::runtime_error);
  EXPECT_THROW(set_member(changed, "name.x=1"), std::runtime_error);
}

TEST(AMission, IsRecordedWithTheAntennaThatTheGatewayIsToldOf) {
  auto with = document();
  with["gateway"]["estimate"]["antenna_y_m"] = -0.1;
  const auto mission = read_mission(with);
  EXPECT_DOUBLE_EQ(mission.antenna.x_m, 0.1);
  EXPECT_DOUBLE_EQ(mission.antenna.y_m, -0.1);
}

// Every scenario that is delivered can be played: the player and the simulator both read it.
TEST(TheScenarios, AreReadByThePlayerAndByTheSimulator) {
  std::size_t count = 0;
  const auto folder = std::filesystem::path(DROVER_SOURCE_DIR) / "sim/scenarios";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto file = entry.path().string();
    auto document = load_scenario_document(file);
    draw_mission(document, 1);
    const auto mission = read_mission(document);
    EXPECT_EQ(mission.name, entry.path().stem().string());
    std::size_t joints = 0;
    for (const auto& drive : load_scenario(file).drives) joints += drive.joints.size();
    EXPECT_GE(joints, 2U) << file;
    EXPECT_TRUE(std::filesystem::exists(load_scenario(file).world)) << file;
    EXPECT_TRUE(std::filesystem::exists(robot_file_of(file))) << file;
    ++count;
  }
  EXPECT_GE(count, 10U);
}

class ARobotFile : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  const test::TempFolder temp_;
  std::filesystem::path folder_ = temp_.path();
};

TEST_F(ARobotFile, MustBeThereAndMustNotNameAnother) {
  write("a/s.json", R"({"robot": "../b/none.json"})");
  EXPECT_THROW(load_scenario_document((folder_ / "a/s.json").string()), std::runtime_error);
  write("b/r.json", R"({"robot": "x.json"})");
  write("a/s.json", R"({"robot": "../b/r.json"})");
  EXPECT_THROW(load_scenario_document((folder_ / "a/s.json").string()), std::runtime_error);
  write("a/s.json", R"({"robot": 1})");
  EXPECT_THROW(load_scenario_document((folder_ / "a/s.json").string()), std::runtime_error);
}

TEST_F(ARobotFile, KeepsWhatTheScenarioRemovesFromItsGateway) {
  write("b/r.json", R"({"world": "w.xml"})");
  write("a/s.json", R"({"robot": "../b/r.json",
    "gateway": {"outputs": null, "devices": {"imu": null}}})");
  const auto merged = load_scenario_document((folder_ / "a/s.json").string());
  ASSERT_TRUE(merged["gateway"].contains("outputs")) << merged;
  EXPECT_TRUE(merged["gateway"]["outputs"].is_null());
  EXPECT_TRUE(merged["gateway"]["devices"]["imu"].is_null());
}

TEST_F(ARobotFile, NamesAMapBesideItOrOneOfTheClones) {
  write("b/r.json", R"({"world": "w.xml", "battery": {"map": "m.json"},
    "more": {"second": {"is": "battery", "map": "jk.json"}, "third": {"map": "none.json"}}})");
  write("b/m.json", "{}");
  write("config/maps/jk.json", "{}");
  write("a/s.json", R"({"robot": "../b/r.json"})");
  const auto merged = load_scenario_document((folder_ / "a/s.json").string());
  EXPECT_EQ(merged["battery"]["map"], (folder_ / "b/m.json").string());
  EXPECT_EQ(merged["more"]["second"]["map"], (folder_ / "config/maps/jk.json").string());
  EXPECT_EQ(merged["more"]["third"]["map"], "none.json") << "it may be an installed one";
}

TEST_F(ARobotFile, LiesBelowTheScenariosOwnMembers) {
  write("b/r.json", R"({"world": "w.xml", "gnss": {"baud": 9600, "port": "p"}, "can": {"a": 1}})");
  write("a/s.json", R"({"robot": "../b/r.json", "gnss": {"baud": 4800}, "can": null})");
  const auto merged = load_scenario_document((folder_ / "a/s.json").string());
  EXPECT_EQ(merged, json::parse(R"({"world": "../b/w.xml", "gnss": {"baud": 4800, "port": "p"}})"));
}

}  // namespace
}  // namespace drover::sim
