// Several receivers, inertial sensors and batteries: what each is for, and where it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "config_text.h"

namespace drover::config {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const std::string kMaps = DROVER_SOURCE_DIR "/config/maps";

/// The good configuration with these devices, each on a line of its own but the batteries.
std::string robot(const std::string& devices) {
  std::string text =
      with("\"panel\": {\"gpio\": \"chip0\"}",
           "\"panel\": {\"gpio\": \"chip0\"}, \"rear\": {\"serial\": \"/dev/rear\"}, "
           "\"bms\": {\"modbus\": \"/dev/bms\"}");
  const std::string first = "\"gnss\": {\"driver\": \"nmea0183\", \"link\": \"gnss\"}";
  return text.replace(text.find(first), first.size(), devices);
}
std::string receivers(const std::string& one, const std::string& other) {
  return robot("\"gnss\": {\"driver\": \"nmea0183\", \"link\": \"gnss\"" + one +
               "},\n\"gnss_rear\": {\"driver\": \"nmea0183\", \"link\": \"rear\"" + other +
               "},\n\"pack\": {\"driver\": \"modbus_bms\", \"link\": \"bms\", \"map\": "
               "\"daly_d2.json\"}");
}
std::string batteries(const std::string& one, const std::string& other) {
  return robot(
      "\"gnss\": {\"driver\": \"nmea0183\", \"link\": \"gnss\"},\n"
      "\"imu\": {\"driver\": \"witmotion\", \"link\": \"rear\"},\n"
      "\"left_pack\": {\"driver\": \"modbus_bms\", \"link\": \"bms\", \"map\": "
      "\"daly_d2.json\"" +
      one +
      "},\n\"right_pack\": {\"driver\": \"modbus_bms\", \"link\": \"bms\", \"map\": "
      "\"daly_d2.json\"" +
      other + "}");
}

TEST(Roles, ASecondOfAKindMustSayWhatItIsFor) {
  EXPECT_EQ(
      problems(receivers("", ""), kMaps),
      "f:8:14: devices.gnss_rear: is a second receiver beside devices.gnss: what is it for? "
      "(\"role\": \"spare\" takes over when the other is not well, \"told\" is only shown)\n");
  EXPECT_THAT(problems(batteries("", ", \"unit\": 9"), kMaps),
              HasSubstr("devices.right_pack: is a second battery beside devices.left_pack: what is "
                        "it for?"));
}

TEST(Roles, TheFirstOfAKindSteersUnlessItSaysOtherwise) {
  const auto told = load_text(receivers("", ", \"role\": \"told\""), kMaps);
  ASSERT_THAT(told.problems, IsEmpty());
  ASSERT_EQ(told.config.engine.receivers.size(), 2U);
  EXPECT_EQ(told.config.engine.receivers[0].role, Role::steers);
  EXPECT_EQ(told.config.engine.receivers[1].role, Role::told);
  EXPECT_EQ(told.config.engine.receivers[1].name, "gnss_rear");
  EXPECT_EQ(problems(receivers(", \"role\": \"told\"", ", \"role\": \"steers\""), kMaps), "");
}

TEST(Roles, OneReceiverSteers) {
  EXPECT_THAT(problems(receivers("", ", \"role\": \"steers\""), kMaps),
              HasSubstr("devices.gnss_rear.role: the robot goes by one receiver, and devices.gnss "
                        "steers (\"spare\" or \"told\")"));
  EXPECT_THAT(problems(receivers(", \"role\": \"told\"", ", \"role\": \"told\""), kMaps),
              HasSubstr("devices.gnss.role: no receiver steers"));
}

TEST(Roles, ASpareReceiverSaysWhereItsAntennaIs) {
  EXPECT_THAT(problems(receivers("", ", \"role\": \"spare\", \"antenna_x_m\": 1"), kMaps),
              HasSubstr("devices.gnss_rear.antenna_y_m: is missing (where the antenna of a spare "
                        "is must be known before it is needed)"));
  const auto loaded =
      load_text(receivers(", \"antenna_x_m\": 0.4, \"antenna_z_m\": 0.9",
                          ", \"role\": \"spare\", \"antenna_x_m\": -0.3, \"antenna_y_m\": 0.1, "
                          "\"heading_baseline_offset_deg\": 90"),
                kMaps);
  ASSERT_THAT(loaded.problems, IsEmpty());
  const auto& estimate = loaded.config.engine.estimate;
  EXPECT_EQ(estimate.antenna_x_m, 0.4) << "of the one that steers";
  ASSERT_EQ(estimate.antennas.size(), 2U);
  EXPECT_EQ(estimate.antennas[0].x_m, 0.4);
  EXPECT_EQ(estimate.antennas[1].x_m, -0.3);
  EXPECT_EQ(estimate.antennas[1].z_m, 0.9) << "left out: as the steering one's";
  EXPECT_EQ(estimate.antennas[1].heading_baseline_offset_deg, 90);
}

TEST(Roles, APositionIsNotTooOldBeforeTheNextOneComes) {
  const std::string slow = ", \"options\": {\"rate_Hz\": 1, \"stale_s\": 2}";
  const std::string of_the_other = ", \"role\": \"told\"";
  EXPECT_THAT(problems(receivers(slow, of_the_other), kMaps),
              HasSubstr("health.gnss_stale_s: 0.3 s is shorter than one and a half periods of "
                        "devices.gnss, 1 Hz: its positions would be too old before the next one "
                        "comes (1.50 or more"));
  EXPECT_EQ(problems(receivers("", of_the_other + slow), kMaps), "") << "it is only shown";
  auto text = receivers(slow, of_the_other);
  text.insert(text.rfind('}'), ", \"health\": {\"gnss_stale_s\": 1.5}");
  EXPECT_EQ(problems(text, kMaps), "");
}

TEST(Roles, TheKeysOfTheEstimateAreTheSteeringOnes) {
  auto text = receivers("", ", \"role\": \"told\"");
  text.insert(text.rfind('}'), ", \"estimate\": {\"antenna_x_m\": 0.7}");
  EXPECT_EQ(load_text(text, kMaps).config.engine.estimate.antennas[0].x_m, 0.7);
  text = receivers(", \"antenna_x_m\": 0.4", ", \"role\": \"told\"");
  text.insert(text.rfind('}'), ", \"estimate\": {\"antenna_x_m\": 0.7}");
  EXPECT_THAT(problems(text, kMaps),
              HasSubstr("devices.gnss.antenna_x_m: differs from estimate.antenna_x_m"));
}

TEST(Roles, PacksInParallelSteerBothAndHaveDifferentUnits) {
  EXPECT_EQ(problems(batteries("", ", \"role\": \"steers\", \"unit\": 9"), kMaps), "");
  EXPECT_THAT(problems(batteries("", ", \"role\": \"steers\""), kMaps),
              HasSubstr("devices.right_pack.unit: \"unit 210 of bms\" is used by "
                        "devices.left_pack.unit already"));
}

TEST(Roles, OtherDevicesHaveNone) {
  EXPECT_THAT(problems(with("\"is\": \"bumper\"", "\"is\": \"bumper\", \"role\": \"spare\"")),
              HasSubstr("devices.bumper.role: is of no use to gpio_line"));
}

/// A recording carries the maps that it was made with.
TEST(Roles, TwoMapsAreReadAgainFromTheirTexts) {
  const auto first = load_text(batteries("", ", \"role\": \"told\", \"unit\": 9"), kMaps);
  ASSERT_THAT(first.problems, IsEmpty());
  const auto again = load_text(first.text, "", first.register_map);
  ASSERT_THAT(again.problems, IsEmpty());
  EXPECT_EQ(again.register_map, first.register_map);
  EXPECT_EQ(again.config.devices.size(), first.config.devices.size());
}

/// So many of each kind; the first of each steers, the others are only told.
std::string so_many(int of_each) {
  std::string links = "\"panel\": {\"gpio\": \"chip0\"}, \"bms\": {\"modbus\": \"/dev/bms\"}";
  std::string devices;
  const auto device = [&](const std::string& name, const std::string& what, int i) {
    devices +=
        "\"" + name + "\": {" + what + ", \"role\": \"" + (i == 1 ? "steers" : "told") + "\"},\n";
  };
  for (int i = 1; i <= of_each; ++i) {
    const std::string number = std::to_string(i);
    if (i > 1) links += ", \"gnss" + number + "\": {\"serial\": \"/dev/gnss" + number + "\"}";
    links += ", \"imu" + number + "\": {\"serial\": \"/dev/imu" + number + "\"}";
    device("gnss" + number,
           "\"driver\": \"nmea0183\", \"link\": \"gnss" + (i > 1 ? number : "") + "\"", i);
    device("imu" + number, "\"driver\": \"witmotion\", \"link\": \"imu" + number + "\"", i);
    device("pack" + number,
           "\"driver\": \"modbus_bms\", \"link\": \"bms\", \"map\": \"daly_d2.json\", \"unit\": " +
               std::to_string(210 + i),
           i);
  }
  std::string text = with("\"panel\": {\"gpio\": \"chip0\"}", links);
  const std::string first = "\"gnss\": {\"driver\": \"nmea0183\", \"link\": \"gnss\"},";
  return text.replace(text.find(first), first.size(), devices);
}

TEST(Roles, ThereMayBeThreeAndFourOfAKind) {
  for (const int count : {3, 4}) {
    const auto loaded = load_text(so_many(count), kMaps);
    ASSERT_THAT(loaded.problems, IsEmpty()) << loaded.problems.front().text("f");
    const auto& engine = loaded.config.engine;
    for (const auto* list : {&engine.receivers, &engine.imus, &engine.batteries}) {
      ASSERT_EQ(list->size(), static_cast<std::size_t>(count));
      EXPECT_EQ((*list)[0].role, Role::steers);
      EXPECT_EQ((*list)[list->size() - 1].role, Role::told);
    }
  }
}

TEST(Roles, AFifthOfAKindIsOneTooMany) {
  const std::string told = problems(so_many(5), kMaps);
  EXPECT_THAT(told, HasSubstr("devices.gnss5: is one receiver too many: there may be 4\n"));
  EXPECT_THAT(told, HasSubstr("devices.imu5: is one inertial sensor too many: there may be 4\n"));
  EXPECT_THAT(told, HasSubstr("devices.pack5: is one battery too many: there may be 4\n"));
}

}  // namespace
}  // namespace drover::config
