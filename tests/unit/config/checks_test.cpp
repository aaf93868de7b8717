#include "config/checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using testing::HasSubstr;

TEST(ConfigurationChecks, RefuseTwoDrivesWithOneAddress) {
  EXPECT_EQ(problems(with("\"node\": 2", "\"node\": 1")),
            "f:5:79: drives[1].options.node: two drives have one address (can0, odrive node 1):"
            " the other is drives[0].options.node\n");
}

TEST(ConfigurationChecks, AllowOneAddressOnTwoBuses) {
  auto text = with("\"interface\": \"can0\"}",
                   "\"interface\": \"can0\"}, {\"name\": \"can1\", \"interface\": \"can1\"}");
  const std::string_view old = "\"bus\": \"can0\", \"options\": {\"node\": 2}";
  text.replace(text.find(old), old.size(), "\"bus\": \"can1\", \"options\": {\"node\": 1}");
  EXPECT_EQ(problems(text), "");
  EXPECT_EQ(load_text(text).config.drives[1].bus_index, 1u);
}

TEST(ConfigurationChecks, RefuseABusThatDoesNotExist) {
  EXPECT_EQ(problems(with("\"bus\": \"can0\", \"options\": {\"node\": 2}",
                          "\"bus\": \"cna0\", \"options\": {\"node\": 2}")),
            "f:5:51: drives[1].bus: there is no bus named \"cna0\" (did you mean \"can0\"?)\n");
}

TEST(ConfigurationChecks, RefuseANameThatIsUsedTwice) {
  EXPECT_THAT(problems(with("\"joint\": \"right\"", "\"joint\": \"left\"")),
              HasSubstr("f:5:15: drives[1].joint: \"left\" is used by drives[0].joint already\n"));
  EXPECT_EQ(problems(with("\"interface\": \"can0\"}",
                          "\"interface\": \"can0\"}, {\"name\": \"b\", \"interface\": \"can0\"}")),
            "f:2:79: buses[1].interface: \"can0\" is used by buses[0].interface already\n");
  EXPECT_EQ(problems(with("\"line\": \"b\"", "\"line\": \"a\"")),
            "f:10:73: lines.bumper.line: \"a\" is used by lines.estop.line already\n");
}

TEST(ConfigurationChecks, RefuseAJointThatNoDriveHas) {
  EXPECT_EQ(problems(with("[\"right\"]", "[\"rigth\"]")),
            "f:7:80: base.right: no drive has the joint \"rigth\" (did you mean \"right\"?)\n");
}

TEST(ConfigurationChecks, RefuseAJointThatIsNoWheelOfTheBase) {
  const std::string_view right = "{\"joint\": \"right\", ";
  const std::string_view arm =
      "{\"joint\": \"arm\", \"driver\": \"odrive\", \"bus\": \"can0\", "
      "\"options\": {\"node\": 9}}, ";
  EXPECT_EQ(problems(with(right, std::string(arm) + std::string(right))),
            "f:5:15: drives[1].joint: \"arm\" is no wheel of the base: joints outside the base are "
            "not supported yet (name it in base.left or base.right, or leave the drive out)\n");
}

TEST(ConfigurationChecks, RefuseAJointThatIsThereTwice) {
  EXPECT_EQ(problems(with("[\"right\"]", "[\"right\", \"right\"]")),
            "f:7:80: base.right: the joint \"right\" is there twice\n");
}

TEST(ConfigurationChecks, RefuseAJointOnBothSides) {
  EXPECT_EQ(problems(with("[\"right\"]", "[\"right\", \"left\"]")),
            "f:7:80: base.right: the joint \"left\" is on both sides\n");
}

TEST(ConfigurationChecks, RefuseAJointNameThatDoesNotFit) {
  const std::string longest(48, 'x');
  const auto named = [](const std::string& name) {
    auto text = with("\"joint\": \"right\"", "\"joint\": \"" + name + "\"");
    return text.replace(text.find("[\"right\"]"), 9, "[\"" + name + "\"]");
  };
  EXPECT_EQ(problems(named(longest)), "");
  EXPECT_EQ(problems(named(longest + "x")), "f:5:15: drives[1].joint: is too long\n");
}

TEST(ConfigurationChecks, RefuseAChoiceThatDoesNotExist) {
  EXPECT_EQ(problems(with("\"driver\": \"odrive\", \"bus\": \"can0\", \"options\": {\"node\": 2}",
                          "\"driver\": \"odriv\", \"bus\": \"can0\", \"options\": {\"node\": 2}")),
            "f:5:34: drives[1].driver: \"odriv\" is not one of: odrive, zlac8015d"
            " (did you mean \"odrive\"?)\n");
  EXPECT_THAT(problems(with("\"node\": 2", "\"node\": 2, \"firmware\": \"0.5\"")),
              HasSubstr("drives[1].options.firmware: \"0.5\" is not one of: 0.6, 0.5.6"));
}

TEST(ConfigurationChecks, RefuseADriverOfAnotherKindOfLink) {
  EXPECT_THAT(problems(with("\"port\": \"/dev", "\"driver\": \"odrive\", \"port\": \"/dev")),
              HasSubstr("gnss.driver: \"odrive\" is not one of: nmea0183"));
}

TEST(ConfigurationChecks, RefuseOptionsOfTheDriver) {
  EXPECT_EQ(problems(with("\"node\": 2", "\"node\": 2.5")),
            "f:5:79: drives[1].options.node: is a number, but a whole number is expected"
            " (write it without a fraction)\n");
  EXPECT_EQ(problems(with("\"node\": 2", "\"node\": 63")),
            "f:5:79: drives[1].options.node: is 63, but must be between 0 and 62\n");
  EXPECT_EQ(problems(with("\"node\": 2", "\"node\": 2, \"reversed\": 1")),
            "f:5:94: drives[1].options.reversed: is an integer, but true or false is expected\n");
  EXPECT_EQ(problems(with("{\"node\": 2}", "3")),
            "f:5:70: drives[1].options: is an integer, but an object is expected\n");
}

TEST(ConfigurationChecks, RefuseOptionsThatDoNotFitTogether) {
  EXPECT_EQ(problems(with("\"node\": 2", "\"node\": 2, \"watchdog_enable_endpoint\": 5")),
            "f:5:70: drives[1].options: watchdog_enable_endpoint and watchdog_timeout_endpoint are"
            " given together or not at all\n");
  EXPECT_THAT(problems(with("{\"line\": \"a\"}",
                            "{\"line\": \"a\", \"options\": {\"active_debounce_s\": 0.1}}")),
              HasSubstr("lines.estop.options: active_debounce_s must be 0"));
}

TEST(ConfigurationChecks, FillInTheDefaultsOfOptions) {
  const auto options = load_text(kGood).config.drives[0].options;
  EXPECT_EQ(options.text("firmware"), "0.6");
  EXPECT_EQ(options.number("gear_ratio"), 1);
  EXPECT_FALSE(options.flag("reversed"));
}

TEST(ConfigurationChecks, GiveTheReceiversDriverTheBaudRateOfThePort) {
  const auto text = with("115200", "57600");
  EXPECT_EQ(problems(text), "");
  EXPECT_EQ(load_text(text).config.gnss.options.number("baud"), 57600);
  EXPECT_EQ(problems(with("115200", "57600, \"options\": {\"baud\": 9600}")),
            "f:9:75: gnss.options.baud: differs from gnss.baud"
            " (leave it out: it follows gnss.baud)\n");
}

TEST(ConfigurationChecks, RefuseLimitsThatContradictEachOther) {
  EXPECT_EQ(problems(with("0.8", "0.1, \"min_speed_mps\": 0.2")),
            "f:8:53: limits.min_speed_mps: is above limits.max_speed_mps\n");
  EXPECT_EQ(problems(with("\"limits\"", "\"estimate\": {\"bound_start_m\": 0.5},\n  \"limits\"")),
            "f:8:33: estimate.bound_start_m: is above estimate.bound_run_m"
            " (a task would start and pause at once)\n");
  EXPECT_EQ(problems(with("\"limits\"",
                          "\"control\": {\"tick_Hz\": 50},\n"
                          "  \"guard\": {\"limit_ms\": 49},\n  \"limits\"")),
            "f:9:25: guard.limit_ms: is shorter than 2.5 control cycles (50 ms)\n");
}

TEST(ConfigurationChecks, RefuseABrokerThatIsHalfASocketAndHalfANetworkAddress) {
  EXPECT_EQ(problems(with("127.0.0.1", "/run/mosquitto/drover.sock")),
            "f:11:58: mqtt.port: must be 0 when mqtt.host is the path of a Unix socket\n");
  EXPECT_EQ(problems(with("1883", "0")),
            "f:11:41: mqtt.port: is 0, but mqtt.host is no path of a Unix socket"
            " (1883 is usual)\n");
  EXPECT_EQ(problems(with("1883", "1883, \"password_file\": \"/p\"")),
            "f:11:64: mqtt.password_file: is given without mqtt.username\n");
}

TEST(ConfigurationChecks, RefuseAChannelTopicWithoutANameOrWithALongOne) {
  const auto text = [](const std::string& topic) {
    return with("1883}", "1883},\n  \"aimrt\": {\"imu_state\": \"" + topic + "\"}");
  };
  EXPECT_EQ(problems(text("")), "f:12:26: aimrt.imu_state: is empty\n");
  const std::string too_long =
      "f:12:26: aimrt.imu_state: is too long (at most 196 bytes; / and other signs count three)\n";
  EXPECT_EQ(problems(text(std::string(197, 'x'))), too_long);
  EXPECT_EQ(problems(text(std::string(66, '/'))), too_long);
  EXPECT_EQ(problems(text(std::string(196, 'x'))), "");
  EXPECT_EQ(problems(text("/imu")), "");
}

TEST(ConfigurationChecks, KnowTheNamesAndContentsOfTheChannel) {
  const auto text = [](const std::string& member) {
    return with("1883}", "1883},\n  \"aimrt\": {" + member + "}");
  };
  EXPECT_EQ(problems(text(R"("joint_state_names": "both", "touch_state_names": "aimrt_1x")")), "");
  EXPECT_EQ(problems(text(R"("imu_state_content": "json")")), "");
  EXPECT_NE(problems(text(R"("joint_state_names": "aimrt")")).find("document, aimrt_1x, both"),
            std::string::npos);
  EXPECT_NE(problems(text(R"("touch_state_content": "ros2")")).find("pb, json"), std::string::npos);
}

TEST(ConfigurationChecks, ResolveNamesToNumbers) {
  const auto loaded = load_text(kGood);
  const auto& engine = loaded.config.engine;
  ASSERT_EQ(engine.base.right.size(), 1u);
  EXPECT_EQ(engine.base.right[0], 1);
  EXPECT_EQ(engine.joints[0], "left");
  EXPECT_TRUE(engine.line_configured[static_cast<std::size_t>(Line::estop)]);
  EXPECT_FALSE(engine.line_configured[static_cast<std::size_t>(Line::zone_far)]);
}

TEST(ConfigurationChecks, RefuseADriveThatNothingStopsUnlessItIsAcceptedByName) {
  const std::string_view accepted = ", \"accept\": [\"no_watchdog\"]}\n";
  EXPECT_EQ(
      problems(with(accepted, "}\n")),
      "f:5:70: drives[1].options: keeps its last velocity for ever: the drive has no watchdog "
      "set (set its watchdog, or \"accept\": [\"no_watchdog\"] when that is meant)\n");
  auto text = with(accepted, "}\n");
  const std::string_view node = "\"node\": 2";
  text.replace(text.find(node), node.size(), "\"node\": 2, \"watchdog_timeout_s\": 0.2");
  EXPECT_EQ(problems(text), "");
  EXPECT_THAT(
      problems(with(accepted, ", \"accept\": [\"no_watchdgo\"]}\n")),
      HasSubstr("drives[1].accept: nothing of the name \"no_watchdgo\" can be accepted here "
                "(did you mean \"no_watchdog\"?)"));
}

TEST(ConfigurationChecks, RefuseTwoDevicesOnOnePort) {
  EXPECT_THAT(problems(with("\"gnss\": {\"port\": \"/dev/drover/gnss\", \"baud\": 115200},",
                            "\"gnss\": {\"port\": \"/dev/ttyUSB0\", \"baud\": 115200},"
                            "\"imu\": {\"driver\": \"witmotion\", \"port\": \"/dev//ttyUSB0\"},")),
              HasSubstr("imu.port: two devices on one port (/dev//ttyUSB0): the other is "
                        "gnss.port"));
}

TEST(ConfigurationChecks, WarnOfNoEmergencyStopLineUnlessThatIsAccepted) {
  EXPECT_EQ(warnings(kGood), "");
  const auto without = with("\"estop\": {\"line\": \"a\"}, ", "");
  EXPECT_THAT(warnings(without), HasSubstr("f:10:12: lines: there is no e-stop line"));
  EXPECT_EQ(problems(without), "");
  auto accepted = without;
  accepted.insert(2, "\"accept\": [\"no_estop\"],");
  EXPECT_EQ(warnings(accepted), "");
}

TEST(ConfigurationChecks, WarnOfAGuardThatWaitsLongUnlessThatIsAccepted) {
  const auto slow = [](int limit_ms) {
    return with("\"mqtt\"",
                "\"guard\": {\"limit_ms\": " + std::to_string(limit_ms) + "}, \"mqtt\"");
  };
  EXPECT_EQ(warnings(slow(200)), "");
  EXPECT_THAT(warnings(slow(250)), HasSubstr("guard.limit_ms: the wheels go on for 250 ms"));
  auto accepted = slow(250);
  accepted.insert(2, "\"accept\": [\"slow_guard\"],");
  EXPECT_EQ(warnings(accepted), "");
}

TEST(Configuration, LooksAtADriveThoughOneWithALongerNumberIsWrong) {
  std::string drives;
  std::string left;
  for (int i = 0; i <= 10; ++i) {
    const auto joint = "w" + std::to_string(i);
    const auto node = std::to_string(i == 10 ? 99 : i + 1);
    drives += (i == 0 ? "" : ",") + (R"({"joint": ")" + joint) +
              R"(", "driver": "odrive", "bus": "can0", "options": {"node": )" + node + "}" +
              (i == 1 ? "" : R"(, "accept": ["no_watchdog"])") + "}";
    if (i > 0) left += (i == 1 ? "\"" : ", \"") + joint + "\"";
  }
  const auto text = R"({"buses": [{"name": "can0", "interface": "can0"}], "drives": [)" + drives +
                    R"(], "base": {"wheel_radius_m": 0.1, "track_m": 0.5, "hold": "brake",
                    "left": [)" +
                    left + R"(], "right": ["w0"]}, "accept": ["no_estop"]})";
  const auto told = problems(text);
  EXPECT_THAT(told, HasSubstr("drives[10].options.node: is 99"));
  EXPECT_THAT(told, HasSubstr("drives[1].options: keeps its last velocity for ever"));
}

}  // namespace
}  // namespace drover::config
