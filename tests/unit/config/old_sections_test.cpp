// The first form of the configuration is refused, and today's text of it means the same.
#include "config/old_sections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fuzz/config_dump.h"
#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::Not;

const std::string kFolder = DROVER_SOURCE_DIR "/config";

/// The sections of the example as they stood in the first form.
constexpr auto kOld = R"({
  "buses": [{"name": "can0", "interface": "can0"}],
  "drives": [
    {"joint": "front_left", "driver": "odrive", "bus": "can0",
     "options": {"node": 1, "gear_ratio": 1, "reversed": false, "watchdog_timeout_s": 0.1}},
    {"joint": "rear_left", "driver": "odrive", "bus": "can0",
     "options": {"node": 2, "gear_ratio": 1, "reversed": false, "watchdog_timeout_s": 0.1}},
    {"joint": "front_right", "driver": "odrive", "bus": "can0",
     "options": {"node": 3, "gear_ratio": 1, "reversed": true, "watchdog_timeout_s": 0.1}},
    {"joint": "rear_right", "driver": "odrive", "bus": "can0",
     "options": {"node": 4, "gear_ratio": 1, "reversed": true, "watchdog_timeout_s": 0.1}}
  ],
  "base": {
    "wheel_radius_m": 0.165, "track_m": 0.6, "yaw_slip_factor": 1.7,
    "hold": "level_ground_only", "max_tilt_deg": 3, "hold_again": true,
    "left": ["front_left", "rear_left"], "right": ["front_right", "rear_right"]
  },
  "gnss": {"driver": "nmea0183", "port": "/dev/drover/gnss", "baud": 115200,
           "options": {"rate_Hz": 10, "latency_s": 0.08}},
  "imu": {"driver": "witmotion", "port": "/dev/drover/imu", "baud": 115200,
          "options": {"rate_Hz": 100, "mount_roll_deg": 0, "mount_pitch_deg": 0,
                      "mount_yaw_deg": 0}},
  "battery": {"driver": "modbus_bms", "map": "maps/daly_d2.json", "port": "/dev/drover/battery",
              "baud": 9600, "options": {"max_voltage_V": 60, "charger_current_A": 2}},
  "lines": {
    "chip": "pinctrl-bcm2711",
    "bumper": {"line": "GPIO6"},
    "estop": {"line": "GPIO5", "options": {"active_level": "low"}},
    "zone_far": {"line": "GPIO13"},
    "zone_near": {"line": "GPIO19"}
  },
  "outputs": {
    "chip": "pinctrl-bcm2711",
    "enable_relay": {"line": "GPIO16"}, "lamp": {"line": "GPIO20"},
    "buzzer": {"line": "GPIO21"}, "watchdog": {"line": "GPIO26"}
  }
})";

Json example() {
  std::ifstream file(kFolder + "/drover.json");
  return Json::parse(file, nullptr, true, /*ignore_comments=*/true);
}

/// The example without the sections that had another form.
Json rest_of_example() {
  auto rest = example();
  for (const char* key : {"links", "devices", "groups", "outputs"}) rest.erase(key);
  return rest;
}

std::string old_example() {
  auto old = rest_of_example();
  old.update(Json::parse(kOld));
  return old.dump(1);
}

std::string meaning(const Loaded& loaded) {
  for (const auto& problem : loaded.problems) ADD_FAILURE() << problem.text("f");
  if (!loaded.problems.empty()) return "nothing";
  return fuzz::dump(loaded.config, [](bool holds) { EXPECT_TRUE(holds); });
}

TEST(OldSections, OfWhichNothingIsLeftPointAtNoNewText) {
  const auto loaded = load_text(R"({"drives": []})");
  EXPECT_EQ(loaded.new_sections, "");
  ASSERT_EQ(loaded.problems.size(), 1U);
  EXPECT_EQ(loaded.problems[0].text("f"),
            "f:1:2: drives: is no key any more (it belongs to \"devices\")");
}

TEST(OldSections, AreEachToldAtTheirPlace) {
  const auto told = problems(kOld);
  EXPECT_THAT(told, HasSubstr("f:2:3: buses: is no key any more (it belongs to \"links\": the new "
                              "text stands below)\n"));
  for (const char* key : {"drives", "base", "gnss", "imu", "battery", "lines", "outputs.chip"})
    EXPECT_THAT(told, HasSubstr(std::string(": ") + key + ": is no key any more")) << key;
  EXPECT_THAT(told, Not(HasSubstr("missing")));
}

TEST(OldSections, DoNotHideAMistakeElsewhere) {
  auto text = std::string(kOld);
  text.insert(1, R"("limits": {"max_sped_mps": 1},)");
  EXPECT_THAT(problems(text), HasSubstr("limits.max_sped_mps: is no known key"));
}

TEST(OldSections, HaveANewTextThatIsGoodInTheirStead) {
  const auto loaded = load_text(old_example(), kFolder);
  auto rest = rest_of_example().dump(1);
  rest.insert(1, "\n" + loaded.new_sections + ",");
  EXPECT_EQ(meaning(load_text(rest, kFolder)), meaning(load_file(kFolder + "/drover.json")));
}

TEST(OldSections, OfARecordingMeanWhatTheyMeant) {
  EXPECT_EQ(meaning(load_text(in_todays_form(old_example()), kFolder)),
            meaning(load_file(kFolder + "/drover.json")));
}

TEST(OldSections, TakeWhatWasLeftOutAsItWasTaken) {
  const auto text = in_todays_form(R"({
    "buses": [{"name": "a", "interface": "can0"}, {"name": "b", "interface": "can1"}],
    "drives": [{"joint": "l", "driver": "odrive", "bus": "b", "options": {"node": 1},
                "accept": ["no_watchdog"]},
               {"joint": "r", "driver": "odrive", "bus": "a", "options": {"node": 1},
                "accept": ["no_watchdog"]}],
    "base": {"wheel_radius_m": 0.1, "track_m": 0.5, "hold": "brake", "left": ["l"],
             "right": ["r"]},
    "gnss": {}, "battery": {"map": "maps/daly_d2.json"},
    "outputs": {"chip": "other", "lamp": {"line": "x"}}, "lines": {"chip": "c"}})");
  const auto loaded = load_text(text, kFolder);
  ASSERT_EQ(problems(text, kFolder), "");
  const auto& c = loaded.config;
  EXPECT_EQ(c.devices[0].link_index, 1u);
  EXPECT_EQ(c.devices[2].driver, "nmea0183");
  EXPECT_EQ(c.links[2].serial, "/dev/drover/gnss");
  EXPECT_EQ(c.links[2].baud, 115200);
  EXPECT_EQ(c.links[3].modbus, "/dev/drover/battery");
  EXPECT_EQ(c.outputs.chip, "other");
  EXPECT_EQ(c.engine.base.kind, engine::BaseKind::skid_steer) << "as it behaved";
}

TEST(OldSections, KeepTheirMistakes) {
  const auto text = in_todays_form(R"({"drives": [{"joint": "a", "driver": "odriv", "bus": "x"}],
                                       "lines": {"chip": "c", "estopp": {"line": "l"}}})");
  EXPECT_THAT(problems(text), HasSubstr("\"odriv\" is not one of"));
  EXPECT_THAT(problems(text), HasSubstr("\"estopp\" is not one of"));
}

TEST(OldSections, DoNotSteerTheTerminal) {
  const auto loaded = load_text(
      "{\"buses\": [{\"name\": \"\\u001b[2J\xC2\x9B\x7F\","
      "\"interface\": \"\\u00e4\"}]}");
  EXPECT_THAT(loaded.new_sections, HasSubstr(R"("\u001b[2J\u009b\u007f")"));
  EXPECT_THAT(loaded.new_sections, HasSubstr("\xC3\xA4"));
}

TEST(OldSections, AreNotFoundInTodaysForm) {
  EXPECT_EQ(in_todays_form(kGood), kGood);
  EXPECT_EQ(in_todays_form("no JSON"), "no JSON");
  EXPECT_EQ(load_text(kGood).new_sections, "");
}

}  // namespace
}  // namespace drover::config
