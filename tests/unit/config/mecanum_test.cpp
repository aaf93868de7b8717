// A base on mecanum wheels as it is written.
#include <gmock/gmock.h>

#include "config_text.h"

namespace drover::config {
namespace {

using ::testing::HasSubstr;

constexpr std::string_view kOnRollers = R"({
  "robot": "rollers",
  "links": {"can0": {"can": "can0"}, "gnss": {"serial": "/dev/gnss", "baud": 115200},
            "panel": {"gpio": "chip"}},
  "devices": {
    "wheels": {"driver": "robomaster_c620", "link": "can0", "accept": ["no_watchdog"],
      "options": {"velocity_gain_Nms_per_rad": 0.3},
      "joints": {"fl": {"channel": "1"}, "fr": {"channel": "2"},
                 "rl": {"channel": "3"}, "rr": {"channel": "4"}}},
    "gnss": {"driver": "nmea0183", "link": "gnss"},
    "estop": {"driver": "gpio_line", "link": "panel", "line": "5", "is": "estop"}},
  "groups": {"base": {"kind": "mecanum", "wheel_radius_m": 0.076, "track_m": 0.44,
    "wheelbase_m": 0.36, "left": ["fl", "rl"], "right": ["fr", "rr"],
    "hold": "level_ground_only"}},
  "outputs": {"link": "panel", "enable_relay": {"line": "16"}}
})";

std::string rollers_with(const std::string& from, const std::string& to) {
  std::string text(kOnRollers);
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string findings(std::string_view text) {
  std::string all;
  for (const auto& problem : load_text(text).problems) all += problem.text("f") + "\n";
  return all;
}

TEST(ABaseOnMecanumWheels, NamesItsFrontWheelsFirst) {
  ASSERT_EQ(findings(kOnRollers), "");
  const auto loaded = load_text(kOnRollers);
  const auto& base = loaded.config.engine.base;
  EXPECT_EQ(base.kind, engine::BaseKind::mecanum);
  EXPECT_EQ(base.wheelbase_m, 0.36);
  EXPECT_EQ(loaded.config.engine.joints[base.left[0]].view(), "fl");
  EXPECT_EQ(loaded.config.engine.joints[base.right[1]].view(), "rr");
}

TEST(ABaseOnMecanumWheels, GoesAsideInASceneUnlessScannersLookAround) {
  EXPECT_FALSE(load_text(kOnRollers).config.engine.clearance_aside);
  constexpr const char* kOutputs = R"("outputs": {)";
  const std::string in_a_scene = rollers_with(kOutputs, R"("scene": {"height_m": 1,
      "footprint": [{"x_m": 0.45, "y_m": 0.35}, {"x_m": -0.4, "y_m": 0.35},
                    {"x_m": -0.4, "y_m": -0.35}, {"x_m": 0.45, "y_m": -0.35}]},
    "outputs": {)");
  EXPECT_EQ(findings(in_a_scene), "");
  EXPECT_TRUE(load_text(in_a_scene).config.engine.clearance_aside);
  std::string with_lidar = in_a_scene;
  const auto add = [&with_lidar](const std::string& before, const std::string& what) {
    const auto at = with_lidar.find(before);
    ASSERT_NE(at, std::string::npos);
    with_lidar.insert(at, what);
  };
  add(R"("panel": {"gpio")", R"("lidar": {"serial": "/dev/drover/lidar"}, )");
  add(R"("estop": {"driver")", R"("lidar": {"driver": "ld06", "link": "lidar", "options":
      {"mount_x_m": 0.4, "mount_y_m": 0, "mount_z_m": 0.35, "mount_yaw_deg": 0}}, )");
  EXPECT_EQ(findings(with_lidar), "");
  EXPECT_TRUE(load_text(with_lidar).config.engine.clearance_required);
  EXPECT_FALSE(load_text(with_lidar).config.engine.clearance_aside);
}

TEST(ABaseOnMecanumWheels, NeedsItsWheelbase) {
  EXPECT_THAT(findings(rollers_with(R"("wheelbase_m": 0.36, )", "")),
              HasSubstr("groups.base.wheelbase_m: is missing"));
  EXPECT_THAT(findings(rollers_with("mecanum", "skid_steer")),
              HasSubstr("is of no use to a base of kind \"skid_steer\""));
}

TEST(ABaseOnMecanumWheels, HasTwoWheelsOnEachSide) {
  std::string three = rollers_with(R"(["fl", "rl"])", R"(["fl"])");
  const auto at = three.find(R"(["fr", "rr"])");
  three.replace(at, 12, R"(["fr", "rl", "rr"])");
  const std::string told = findings(three);
  EXPECT_THAT(told, HasSubstr("groups.base.left: a mecanum base has two wheels on each side"));
  EXPECT_THAT(told, HasSubstr("groups.base.right: a mecanum base has two wheels on each side"));
}

}  // namespace
}  // namespace drover::config
