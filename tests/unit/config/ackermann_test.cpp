// How a base that steers is written.
#include <gmock/gmock.h>

#include <string>

#include "config/load.h"

namespace drover::config {
namespace {

using ::testing::HasSubstr;

constexpr std::string_view kSteered = R"({
  "robot": "hunter",
  "links": {"can0": {"can": "can0"}, "gnss": {"serial": "/dev/gnss", "baud": 115200},
            "panel": {"gpio": "chip"}},
  "devices": {
    "chassis": {"driver": "agilex_hunter", "link": "can0"},
    "gnss": {"driver": "nmea0183", "link": "gnss"},
    "estop": {"driver": "gpio_line", "link": "panel", "line": "5", "is": "estop"}},
  "groups": {"base": {"kind": "ackermann", "device": "chassis", "track_m": 0.605,
    "wheelbase_m": 0.65, "max_steering_rad": 0.55, "steering_rate_radps": 0.4,
    "hold": "level_ground_only"}},
  "protocol": {"vz": "steering_angle"},
  "accept": ["no_relay"]
})";

std::string steered_with(const std::string& from, const std::string& to) {
  std::string text(kSteered);
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string told(std::string_view text) {
  std::string all;
  for (const auto& problem : load_text(text).problems) all += problem.text("f") + "\n";
  return all;
}

TEST(ABaseThatSteers, IsADeviceWithItsGeometry) {
  ASSERT_EQ(told(kSteered), "");
  const auto loaded = load_text(kSteered);
  const auto& base = loaded.config.engine.base;
  EXPECT_EQ(base.kind, engine::BaseKind::ackermann);
  EXPECT_EQ(base.wheelbase_m, 0.65);
  EXPECT_EQ(base.max_steering_rad, 0.55);
  EXPECT_EQ(base.steering_rate_radps, 0.4);
  EXPECT_EQ(loaded.config.protocol.vz, "steering_angle");
}

TEST(ABaseThatSteers, NeedsAllOfIt) {
  EXPECT_THAT(told(steered_with(R"("wheelbase_m": 0.65,)", "")),
              HasSubstr("groups.base.wheelbase_m: is missing"));
  EXPECT_THAT(told(steered_with(R"( "steering_rate_radps": 0.4,)", "")),
              HasSubstr("groups.base.steering_rate_radps: is missing"));
}

TEST(ABaseThatSteers, IsOfTheKindOfItsDevice) {
  EXPECT_THAT(told(steered_with("agilex_hunter", "agilex_v2")),
              HasSubstr("groups.base.kind: \"chassis\" is an agilex_v2, which does not steer"));
  EXPECT_THAT(told(steered_with(R"("ackermann")", R"("twist")")),
              HasSubstr("is of no use to a base of kind \"twist\""));
  const std::string angles = R"(
    "wheelbase_m": 0.65, "max_steering_rad": 0.55, "steering_rate_radps": 0.4,)";
  std::string twist = steered_with(R"("ackermann")", R"("twist")");
  twist.erase(twist.find(angles), angles.size());
  EXPECT_THAT(told(twist),
              HasSubstr("groups.base.kind: \"chassis\" is an agilex_hunter, which steers"));
}

TEST(ABaseThatSteers, HasTheNumbersOfItsDevice) {
  EXPECT_THAT(told(steered_with(R"("wheelbase_m": 0.65)", R"("wheelbase_m": 0.7)")),
              HasSubstr("groups.base.wheelbase_m: is 0.7, but 0.65 in "
                        "devices.chassis.options.wheelbase_m"));
  EXPECT_THAT(told(steered_with(R"("track_m": 0.605)", R"("track_m": 0.6)")),
              HasSubstr("groups.base.track_m: is 0.6, but 0.605"));
  EXPECT_THAT(told(steered_with(R"("max_steering_rad": 0.55)", R"("max_steering_rad": 0.6)")),
              HasSubstr("groups.base.max_steering_rad: is above 0.576"));
}

TEST(ABaseThatDoesNotSteer, ShowsNoAngle) {
  EXPECT_THAT(told(steered_with(R"("kind": "ackermann")", R"("kind": "twist")")),
              HasSubstr("protocol.vz: is steering_angle, but this base does not steer"));
}

}  // namespace
}  // namespace drover::config
