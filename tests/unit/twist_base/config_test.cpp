// How a base that takes a twist is written, and what is said of slips.
#include <gmock/gmock.h>

#include "crawler_robot.h"

namespace drover::config {
namespace {

using test::crawler_with;
using ::testing::HasSubstr;

std::string problems(std::string_view text) {
  std::string all;
  for (const auto& problem : load_text(text).problems) all += problem.text("f") + "\n";
  return all;
}

TEST(ABaseThatTakesATwist, HasADeviceAndNoJoints) {
  const auto loaded = load_text(test::kCrawlerRobot);
  ASSERT_EQ(problems(test::kCrawlerRobot), "");
  EXPECT_EQ(loaded.config.engine.base.kind, engine::BaseKind::twist);
  EXPECT_EQ(loaded.config.engine.base.track_m, 0.6);
  EXPECT_TRUE(loaded.config.engine.joints.empty());
}

TEST(ABaseThatTakesATwist, NeedsItsDevice) {
  EXPECT_EQ(problems(crawler_with(R"("device": "chassis", )", "")),
            "f:8:22: groups.base.device: is missing (a base of kind \"twist\" needs it)\n");
  EXPECT_THAT(problems(crawler_with(R"("device": "chassis", )", R"("device": "", )")),
              HasSubstr("groups.base.device: is empty"));
}

TEST(ABaseThatTakesATwist, HasNoUseForWheels) {
  EXPECT_THAT(problems(crawler_with(R"("hold": "brake")",
                                    R"("hold": "brake", "wheel_radius_m": 0.1, "left": ["a"])")),
              ::testing::AllOf(
                  HasSubstr("groups.base.wheel_radius_m: is of no use to a base of kind \"twist\""),
                  HasSubstr("groups.base.left: is of no use to a base of kind \"twist\"")));
  EXPECT_THAT(problems(crawler_with(R"("link": "chassis"})",
                                    R"("link": "chassis", "joints": {"left": {}}})")),
              HasSubstr("devices.chassis.joints: is of no use to crawler"));
}

TEST(ABaseThatTakesATwist, NamesADeviceThatThereIs) {
  EXPECT_THAT(problems(crawler_with(R"("device": "chassis")", R"("device": "chasis")")),
              HasSubstr("groups.base.device: there is no device \"chasis\" (did you mean "
                        "\"chassis\"?)"));
  EXPECT_THAT(problems(crawler_with(R"("device": "chassis")", R"("device": "gnss")")),
              HasSubstr("groups.base.device: \"gnss\" takes no twist: it is a nmea0183"));
}

TEST(ABaseOfWheels, HasNoUseForADeviceThatTakesATwist) {
  const auto wheels = crawler_with(
      R"("kind": "twist", "device": "chassis", )",
      R"("kind": "skid_steer", "wheel_radius_m": 0.1, "left": ["l"], "right": ["r"], )");
  std::string text = wheels;
  const std::string chassis = R"("chassis": {"driver": "crawler", "link": "chassis"},)";
  text.insert(text.find(chassis) + chassis.size(), R"(
    "l": {"driver": "odrive", "link": "can0",
          "options": {"node": 1}, "accept": ["no_watchdog"]},
    "r": {"driver": "odrive", "link": "can0",
          "options": {"node": 2}, "accept": ["no_watchdog"]},)");
  text.insert(text.find(R"("chassis": {"serial")"), R"("can0": {"can": "can0"}, )");
  EXPECT_THAT(problems(text),
              HasSubstr("devices.chassis: it takes a twist, and is not the device of the base "
                        "(\"kind\": \"twist\", \"device\": \"chassis\" in groups.base)"));
}

TEST(ABaseThatTakesATwist, IsRefusedWhenNothingStopsItInSilence) {
  EXPECT_THAT(problems(crawler_with(R"("link": "chassis"})",
                                    R"("link": "chassis", "options": {"stops": false}})")),
              HasSubstr("devices.chassis.options: goes on for ever as it was told last"));
}

TEST(ABaseThatTakesATwist, HasALineOfASpeedThatItSpeaks) {
  EXPECT_EQ(
      problems(crawler_with(R"("/dev/drover/chassis")", R"("/dev/drover/chassis", "baud": 9600)")),
      "f:2:66: links.chassis.baud: is 9600, but devices.chassis (crawler) speaks at 115200 "
      "(write that, or leave it out)\n");
  EXPECT_EQ(problems(crawler_with(R"("/dev/drover/chassis")",
                                  R"("/dev/drover/chassis", "baud": 115200)")),
            "");
}

TEST(ABaseThatTakesATwist, IsWarnedOfWhenOnlyARelayStopsItAndThereIsNone) {
  const auto warnings = [](std::string_view text) {
    std::string all;
    for (const auto& warning : load_text(text).warnings) all += warning.text("f") + "\n";
    return all;
  };
  EXPECT_EQ(warnings(test::kCrawlerRobot), "");
  auto text = crawler_with(R"("link": "chassis"})",
                           R"("link": "chassis", "options": {"stops": false},
      "accept": ["no_watchdog"]})");
  EXPECT_EQ(problems(text), "");
  EXPECT_THAT(warnings(text), HasSubstr("f:6:17: devices.chassis.accept: it goes on for ever when "
                                        "its line is cut; there is no outputs.enable_relay"));
  text.replace(text.rfind('}'), 1,
               R"(, "outputs": {"link": "panel", "enable_relay": {"line": "r"}}})");
  EXPECT_EQ(problems(text), "");
  EXPECT_EQ(warnings(text), "");
}

}  // namespace
}  // namespace drover::config
