// What a person reads beside the map.
#include "sim/scenario/view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drover::sim {
namespace {

TEST(AView, HasADashForWhatIsNotKnownYet) {
  EXPECT_EQ(error_words(0.0142), "error 0.014 m (one sigma)");
  EXPECT_EQ(error_words(NAN), "error -");
  EXPECT_EQ(
      wheel_words(nlohmann::json::parse(
          R"([{"joint":"left","velocity_radps":1.2},{"joint":"right","velocity_radps":null}])")),
      "rad/s  left 1.20  right -");
}

TEST(AView, TellsTheWayThatIsLeftAndHowLongItTakes) {
  EXPECT_EQ(way_left(7.31, 0.5), "7.3 m left, about 15 s");
}

TEST(AView, TellsNoTimeOfARobotThatStands) {
  EXPECT_EQ(way_left(7.31, 0), "7.3 m left");
  EXPECT_EQ(way_left(7.31, -0.01), "7.3 m left");
}

TEST(AView, TellsNoWayThatNobodyKnows) {
  EXPECT_EQ(way_left(NAN, 0.5), "-");
}

TEST(AView, TellsHowFarTheWayIsFreeWhereThatIsKnown) {
  using nlohmann::json;
  for (const char* nothing : {"null", R"({"nav": {}})", R"({"clearance": null})"}) {
    EXPECT_EQ(free_room(json::parse(nothing)), "") << nothing;
    EXPECT_EQ(first_in_the_way(json::parse(nothing)), "") << nothing;
  }
  const auto status = json::parse(R"({"clearance": {"ahead_m": 2.314, "back_m": 3,
      "left_rad": 3.14159, "right_rad": 0.7, "first": "box1 is in the way, 2.31 m ahead",
      "unknown": ""}})");
  EXPECT_EQ(free_room(status), "ahead 2.31 m, back 3.00 m, left 180 deg, right 40 deg");
  EXPECT_EQ(first_in_the_way(status), "box1 is in the way, 2.31 m ahead");
  EXPECT_EQ(free_room(json::parse(R"({"clearance": {"unknown": "no position"}})")), "no position");
}

TEST(AView, TellsOfTheSensorsThatTheRobotHas) {
  using nlohmann::json;
  EXPECT_EQ(sensor_words(json()), "");
  EXPECT_EQ(sensor_words(json::parse(R"({"battery": null, "imu": {}})")), "");
  EXPECT_EQ(sensor_words(json::parse(R"({"imu": {"health": "silent", "roll_rad": null}})")),
            "IMU silent");
  EXPECT_EQ(sensor_words(json::parse(
                R"({"battery": {"soc_percent": 84, "voltage_V": 26.4, "current_A": -1.2},
                    "imu": {"health": "fresh", "roll_rad": 0.1, "pitch_rad": 0}})")),
            "battery 84.0 % 26.4 V -1.2 A; IMU fresh, roll 5.7 pitch 0.0 deg");
}

}  // namespace
}  // namespace drover::sim
