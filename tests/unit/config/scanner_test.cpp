// A scanner in the configuration: on a line of its own at its own speed, with a field that fits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using testing::HasSubstr;

/// What says where it is, with these other options.
std::string mounted(const std::string& others = "") {
  return R"(, "options": {"mount_x_m": 0.4, "mount_y_m": 0, "mount_z_m": 0.3, "mount_yaw_deg": 0)" +
         others + "}";
}

/// kGood with a scanner, these other members of it, of its line and of a scene for a robot 0.7 m
/// wide.
std::string scanner(const std::string& of_device = mounted(), const std::string& of_link = "",
                    const std::string& of_scene = "") {
  std::string text = with("\"port\": 1883}",
                          R"("port": 1883}, "scene": {"footprint": [
      {"x_m": 0.45, "y_m": 0.35}, {"x_m": -0.45, "y_m": 0.35}, {"x_m": -0.45, "y_m": -0.35},
      {"x_m": 0.45, "y_m": -0.35}])" +
                              of_scene + "}");
  const auto add = [&text](const std::string& before, const std::string& what) {
    const auto at = text.find(before);
    ASSERT_NE(at, std::string::npos);
    text.insert(at, what);
  };
  add(R"("panel": {"gpio")", R"("lidar": {"serial": "/dev/drover/lidar")" + of_link + "}, ");
  add(R"("estop": {"driver")",
      R"("lidar": {"driver": "ld06", "link": "lidar")" + of_device + "}, ");
  return text;
}

TEST(AScanner, IsADeviceOnALineOfItsOwnAtItsOwnSpeed) {
  const auto loaded = load_text(scanner());
  ASSERT_EQ(problems(scanner()), "");
  const auto* device = first(loaded.config, SlotKind::scanner);
  ASSERT_NE(device, nullptr);
  EXPECT_EQ(device->name, "lidar");
  EXPECT_EQ(loaded.config.links[device->link_index].baud, 230400);
  EXPECT_EQ(device->options.number("baud"), 230400);
  EXPECT_EQ(loaded.config.scene.field.ahead_m, 2);
  EXPECT_EQ(loaded.config.scene.field.beside_m, 0.4);
  EXPECT_EQ(problems(scanner(mounted(), R"(, "baud": 230400)")), "");
  EXPECT_EQ(problems(scanner(mounted(), R"(, "baud": 0)")), "");
}

TEST(AScanner, KnowsOneSpeed) {
  EXPECT_THAT(problems(scanner(mounted(), R"(, "baud": 115200)")),
              HasSubstr("links.lidar.baud: is 115200, but devices.lidar (ld06) speaks at 230400 "
                        "(write that, or leave it out)"));
}

TEST(AScanner, SharesItsLineWithNobody) {
  const auto text =
      scanner(mounted() + R"(}, "second": {"driver": "ld06", "link": "lidar")" + mounted());
  EXPECT_THAT(problems(text),
              HasSubstr("devices.second.link: \"lidar\" is a serial line, and devices.lidar hangs "
                        "on it"));
  EXPECT_THAT(problems(scanner(mounted() + R"(}, "imu": {"driver": "witmotion", "link": "lidar")")),
              HasSubstr("devices.imu.link: \"lidar\" is a serial line, and devices.lidar hangs"));
}

TEST(AScanner, IsMountedAndLeavesTheRobotItselfOut) {
  const auto text = scanner(
      R"(, "options": {"mount_x_m": 0.4, "mount_y_m": 0.1, "mount_z_m": 0.3, "mount_yaw_deg": 90,
      "upside_down": true, "self_filter": "0.4 0.3, 0.4 -0.3, -0.4 0"})");
  EXPECT_EQ(problems(text), "");
  EXPECT_THAT(problems(scanner(mounted(R"(, "self_filter": "1 2")"))),
              HasSubstr("devices.lidar.options: self_filter: fewer than 3 corners"));
  EXPECT_THAT(problems(scanner(mounted() + R"(, "role": "steers")")),
              HasSubstr("devices.lidar.role: is of no use to ld06"));
}

TEST(AScanner, HasToSayWhereItIs) {
  for (const char* const key : {"mount_x_m", "mount_y_m", "mount_z_m", "mount_yaw_deg"})
    EXPECT_THAT(problems(scanner("")),
                HasSubstr("devices.lidar.options." + std::string(key) + ": is missing ("));
}

TEST(AScanner, IsOnTheRobotOrClose) {
  const auto at = [](const char* x_m, const char* y_m, const char* z_m) {
    return problems(scanner(R"(, "options": {"mount_yaw_deg": 0, "mount_x_m": )" +
                            std::string(x_m) + R"(, "mount_y_m": )" + y_m + R"(, "mount_z_m": )" +
                            z_m + "}"));
  };
  EXPECT_EQ(at("0.74", "0", "0.3"), "");
  EXPECT_EQ(at("0.65", "0.55", "0.05"), "") << "0.28 m from the corner";
  EXPECT_EQ(at("-0.45", "-0.35", "1"), "");
  EXPECT_THAT(at("0.7", "0.6", "0.3"),
              HasSubstr("devices.lidar.options.mount_x_m: with mount_y_m it is 0.35 m outside of "
                        "scene.footprint (metres ahead of base_link, and to its left"));
  EXPECT_THAT(at("0", "-3.5", "0.3"), HasSubstr("it is 3.15 m outside of scene.footprint"));
  EXPECT_THAT(at("0", "0", "0.02"),
              HasSubstr("devices.lidar.options.mount_z_m: its beams, 0.02 m above the ground, are "
                        "below scene.ground_clearance_m, 0.05 m"));
  EXPECT_THAT(at("0", "0", "3"), HasSubstr("3.00 m above the ground, are above scene.height_m, "
                                           "1.00 m"));
}

TEST(AScanner, NeedsASceneThatLooksAtWhatItSees) {
  auto text = scanner();
  const auto begin = text.find(R"(, "scene": )");
  text.erase(begin, text.rfind("]}") + 2 - begin);
  EXPECT_THAT(problems(text),
              HasSubstr("devices.lidar: is a scanner, and nobody looks at what it sees"));
}

TEST(AScanner, LeavesLessOfTheMarginToCurvesThatChange) {
  const auto beside_m = [](const std::string& margin_m) {
    const auto text = scanner(mounted(), "", R"(, "margin_m": )" + margin_m);
    EXPECT_EQ(problems(text), "");
    return load_text(text).config.engine.clearance.beside_m;
  };
  EXPECT_EQ(beside_m("0.1"), 0.025);
  EXPECT_EQ(beside_m("0"), 0.01);
  EXPECT_EQ(beside_m("2"), 0.05);
}

TEST(AScanner, HasAFieldAsWideAsTheRobotAndAsLongAsItsStop) {
  EXPECT_EQ(problems(scanner(mounted(), "", R"(, "field": {"ahead_m": 3, "beside_m": 0.35})")), "");
  EXPECT_THAT(problems(scanner(mounted(), "", R"(, "field": {"beside_m": 0.3})")),
              HasSubstr("scene.field.beside_m: 0.30 m is narrower than the robot, which reaches "
                        "0.35 m to a side by scene.footprint (\"field\": {\"beside_m\": 0.35} or "
                        "more in the section \"scene\""));
  EXPECT_THAT(problems(scanner(mounted(), "", R"(, "field": {"beside_m": 0.345})")),
              HasSubstr("{\"beside_m\": 0.35}"));
  EXPECT_THAT(problems(scanner(mounted(), "", R"(, "field": {"ahead_m": 0})")),
              HasSubstr("scene.field.ahead_m: is 0, but must be between 0.2 and 10"));
  EXPECT_THAT(warnings(scanner(mounted(), "", R"(, "field": {"ahead_m": 0.5})")),
              HasSubstr("scene.field.ahead_m: is shorter than the way to stop"));
  EXPECT_THAT(warnings(scanner()), testing::Not(HasSubstr("scene.field")));
}

TEST(AScanner, IsOneOfFourAtMost) {
  std::string more = mounted();
  std::string links;
  for (int i = 2; i <= 5; ++i) {
    const auto name = "lidar" + std::to_string(i);
    more += "}, \"" + name + R"(": {"driver": "ld06", "link": ")" + name + "\"" + mounted();
    links += "}, \"" + name + R"(": {"serial": "/dev/)" + name + "\"";
  }
  EXPECT_THAT(problems(scanner(more, links)),
              HasSubstr("devices.lidar5: is one scanner too many: there may be 4"));
}

}  // namespace
}  // namespace drover::config
