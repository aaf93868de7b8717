#include "config/checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(ConfigurationChecks, RefuseTwoDevicesWithOneAddress) {
  EXPECT_EQ(
      problems(with("\"node\": 2", "\"node\": 1")),
      "f:6:71: devices.right.options.node: two devices have one address (can0, odrive node 1):"
      " the other is devices.left.options.node\n");
}

TEST(ConfigurationChecks, AllowOneAddressOnTwoBuses) {
  auto text = with("{\"can\": \"can0\"}", "{\"can\": \"can0\"}, \"can1\": {\"can\": \"can1\"}");
  const std::string_view old = "\"link\": \"can0\", \"options\": {\"node\": 2}";
  text.replace(text.find(old), old.size(), "\"link\": \"can1\", \"options\": {\"node\": 1}");
  EXPECT_EQ(problems(text), "");
  EXPECT_EQ(load_text(text).config.devices[1].link_index, 1u);
}

TEST(ConfigurationChecks, RefuseWhatIsUsedTwice) {
  EXPECT_EQ(problems(with("\"left\": {\"driver\"", "\"right\": {\"driver\"")),
            "f:6:5: devices.right: this key is there twice\n");
  EXPECT_THAT(
      problems(with("{\"can\": \"can0\"}", "{\"can\": \"can0\"}, \"b\": {\"can\": \"can0\"}")),
      HasSubstr("f:2:51: links.b.can: \"can0\" is used by links.can0.can already\n"));
  EXPECT_EQ(problems(with("\"line\": \"b\"", "\"line\": \"a\"")),
            "f:9:64: devices.bumper.line: \"a\" is used by devices.estop.line already\n");
  EXPECT_EQ(problems(with("\"is\": \"bumper\"", "\"is\": \"estop\"")),
            "f:9:75: devices.bumper.is: \"estop\" is used by devices.estop.is already\n");
}

TEST(ConfigurationChecks, RefuseToBackUpAsNoRobotCanOrMay) {
  const auto navigate = [](const std::string& keys, const std::string& limits = "") {
    return with("\"limits\": {", "\"navigate\": {" + keys + "}, \"limits\": {" + limits);
  };
  EXPECT_EQ(problems(navigate(R"("drive": "recorded")")), "");
  EXPECT_THAT(problems(navigate(R"("drive": "either", "backwards_speed_mps": 0.5)")),
              HasSubstr("navigate.backwards_speed_mps: is 0.5, but must be between 0.05 and 0.2"))
      << "nobody looks behind it";
  EXPECT_THAT(problems(navigate(R"("drive": "recorded")", R"("min_speed_mps": 0.3, )")),
              HasSubstr("navigate.backwards_speed_mps: is below limits.min_speed_mps"));
  EXPECT_EQ(problems(navigate(R"("drive": "ahead")", R"("min_speed_mps": 0.3, )")), "");
  EXPECT_THAT(problems(navigate(R"("drive": "recorded", "pivot_angle_deg": 180)")),
              HasSubstr("navigate.pivot_angle_deg: is above 120: no cusp would be a corner"));
  EXPECT_THAT(problems(navigate(R"("drive": "record")")), HasSubstr("recorded"));
}

TEST(ConfigurationChecks, RefuseAnOutputOnALineThatIsAnInput) {
  EXPECT_THAT(problems(with("{\"link\": \"panel\", \"enable_relay\"",
                            "{\"link\": \"panel\", \"lamp\": {\"line\": \"b\"}, \"enable_relay\"")),
              HasSubstr("outputs.lamp.line: \"b\" is used by devices.bumper.line already\n"));
  EXPECT_THAT(
      problems(
          with("{\"link\": \"panel\", \"enable_relay\"", "{\"link\": \"gnss\", \"enable_relay\"")),
      HasSubstr("outputs.link: \"gnss\" is a serial line, but outputs are lines of a GPIO chip\n"));
}

TEST(ConfigurationChecks, NameAJointAfterItsDeviceUnlessItIsNamed) {
  EXPECT_EQ(load_text(kGood).config.engine.joints[1], "right");
  auto text =
      with("\"options\": {\"node\": 2}", "\"joints\": {\"r\": {}}, \"options\": {\"node\": 2}");
  text.replace(text.find("[\"right\"]"), 9, "[\"r\"]");
  EXPECT_EQ(problems(text), "");
  EXPECT_EQ(load_text(text).config.engine.joints[1], "r");
  EXPECT_THAT(
      problems(with("\"options\": {\"node\": 2}",
                    "\"joints\": {\"r\": {\"channel\": \"left\"}}, \"options\": {\"node\": 2}")),
      HasSubstr("devices.right.joints.r.channel: there is no such channel (one of: axis)"));
  EXPECT_THAT(problems(with("\"options\": {\"node\": 2}",
                            "\"joints\": {\"r\": {}, \"s\": {}}, \"options\": {\"node\": 2}")),
              HasSubstr("devices.right.joints.s.channel: \"axis\" is the joint \"r\" already\n"));
  EXPECT_THAT(problems(with("\"options\": {\"node\": 2}",
                            "\"joints\": {\"left\": {}}, \"options\": {\"node\": 2}")),
              HasSubstr("devices.right.joints.left: \"left\" is used by devices.left already\n"));
}

TEST(ConfigurationChecks, RefuseAKeyOfAnotherKindOfDevice) {
  EXPECT_EQ(problems(with("\"link\": \"gnss\"}", "\"link\": \"gnss\", \"line\": \"a\"}")),
            "f:7:60: devices.gnss.line: is of no use to nmea0183 (leave it out)\n");
  EXPECT_EQ(problems(with("\"line\": \"b\", \"is\": \"bumper\"", "\"is\": \"bumper\"")),
            "f:9:15: devices.bumper.line: is missing (gpio_line needs it)\n");
}

TEST(ConfigurationChecks, RefuseAJointThatNoDeviceHas) {
  EXPECT_THAT(
      problems(with("[\"right\"]", "[\"rigth\"]")),
      HasSubstr(
          "groups.base.right: no device has the joint \"rigth\" (did you mean \"right\"?)\n"));
}

TEST(ConfigurationChecks, RefuseAJointThatIsNoWheelOfTheBase) {
  EXPECT_EQ(problems(with(
                "\"gnss\": {\"driver\"",
                "\"arm\": {\"driver\": \"odrive\", \"link\": \"can0\", \"options\": {\"node\": 9},"
                " \"accept\": [\"no_watchdog\"]},\n\"gnss\": {\"driver\"")),
            "f:7:12: devices.arm: \"arm\" is of no group (name it in groups.base.left or "
            "groups.base.right, or give it a group of its own: groups.arm.joints)\n");
}

TEST(ConfigurationChecks, RefuseAJointThatIsThereTwice) {
  EXPECT_THAT(problems(with("[\"right\"]", "[\"right\", \"right\"]")),
              HasSubstr("groups.base.right: the joint \"right\" is there twice\n"));
}

TEST(ConfigurationChecks, RefuseAJointOnBothSides) {
  EXPECT_THAT(problems(with("[\"right\"]", "[\"right\", \"left\"]")),
              HasSubstr("groups.base.right: the joint \"left\" is on both sides\n"));
}

TEST(ConfigurationChecks, RefuseANameThatCannotBeOne) {
  const std::string longest(48, 'x');
  const auto named = [](const std::string& name) {
    auto text = with("\"right\": {\"driver\"", "\"" + name + "\": {\"driver\"");
    return text.replace(text.find("[\"right\"]"), 9, "[\"" + name + "\"]");
  };
  EXPECT_EQ(problems(named(longest)), "");
  EXPECT_EQ(problems(named("a.b")), "");
  EXPECT_EQ(problems(named(longest + "x")),
            "f:6:5: devices." + longest + "x: the name is too long\n");
  EXPECT_EQ(problems(named("")), "f:6:5: devices.: the name is empty\n");
  EXPECT_EQ(problems(named("a\\u0007")), "f:6:5: devices.a?: the name holds a control character\n");
  for (const char* const turns : {"a\\u0085", "a\\u202E"})
    EXPECT_THAT(problems(named(turns)),
                HasSubstr("devices.a?: the name holds a control character\n"))
        << turns;
}

TEST(ConfigurationChecks, FindThePlaceOfANameWithADot) {
  auto text = with("\"right\": {\"driver\"", "\"left.options\": {\"driver\"");
  text.replace(text.find("[\"right\"]"), 9, "[\"left.options\"]");
  text.replace(text.find("\"node\": 2"), 9, "\"node\": 1");
  EXPECT_THAT(problems(text), HasSubstr("f:6:78: devices.left.options.options.node: two devices"));
}

TEST(ConfigurationChecks, RefuseLimitsThatContradictEachOther) {
  EXPECT_EQ(problems(with("0.8", "0.1, \"min_speed_mps\": 0.2")),
            "f:12:53: limits.min_speed_mps: is above limits.max_speed_mps\n");
  EXPECT_EQ(problems(with("\"limits\"", "\"estimate\": {\"bound_start_m\": 0.5},\n  \"limits\"")),
            "f:12:33: estimate.bound_start_m: is above estimate.bound_run_m"
            " (a task would start and pause at once)\n");
  EXPECT_EQ(problems(with("\"limits\"",
                          "\"control\": {\"tick_Hz\": 50},\n"
                          "  \"guard\": {\"limit_ms\": 49},\n  \"limits\"")),
            "f:13:25: guard.limit_ms: is shorter than 2.5 control cycles (50 ms)\n");
}

TEST(ConfigurationChecks, RefuseABrokerThatIsHalfASocketAndHalfANetworkAddress) {
  EXPECT_EQ(problems(with("127.0.0.1", "/run/mosquitto/drover.sock")),
            "f:13:58: mqtt.port: must be 0 when mqtt.host is the path of a Unix socket\n");
  EXPECT_EQ(problems(with("1883", "0")),
            "f:13:41: mqtt.port: is 0, but mqtt.host is no path of a Unix socket"
            " (1883 is usual)\n");
  EXPECT_EQ(problems(with("1883", "1883, \"password_file\": \"/p\"")),
            "f:13:64: mqtt.password_file: is given without mqtt.username\n");
}

TEST(ConfigurationChecks, RefuseAChannelTopicWithoutANameOrWithALongOne) {
  const auto text = [](const std::string& topic) {
    return with("1883}", "1883},\n  \"aimrt\": {\"imu_state\": \"" + topic + "\"}");
  };
  EXPECT_EQ(problems(text("")), "f:14:26: aimrt.imu_state: is empty\n");
  const std::string too_long =
      "f:14:26: aimrt.imu_state: is too long (at most 196 bytes; / and other signs count three)\n";
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

TEST(ConfigurationChecks, RefuseInputsOfANetworkUnlessThatIsSaid) {
  const auto text = [](const std::string& members) {
    return with("1883}", "1883},\n  \"ros2\": {" + members + "}");
  };
  const std::string stop = R"("inputs": {"e_stop": true})";
  EXPECT_EQ(problems(text(R"("mode": "network")")), "");
  EXPECT_EQ(problems(text(stop)), "") << "of this computer";
  EXPECT_NE(problems(text(R"("mode": "network", )" + stop)).find("whoever reaches"),
            std::string::npos);
  EXPECT_EQ(problems(text(R"("mode": "network", "network_inputs": true, )" + stop)), "");
  const std::string drive = R"("inputs": {"cmd_vel": "twist_stamped"})";
  EXPECT_EQ(problems(text(drive)), "");
  EXPECT_NE(problems(text(R"("mode": "network", )" + drive)).find("whoever reaches"),
            std::string::npos);
  EXPECT_NE(problems(text(R"("inputs": {"cmd_vel": true})")), "") << "as what it comes is said";
  const std::string joints = R"("inputs": {"joint_command": true})";
  EXPECT_EQ(problems(text(joints)), "");
  EXPECT_NE(problems(text(R"("mode": "network", )" + joints)).find("whoever reaches"),
            std::string::npos);
}

TEST(ConfigurationChecks, OpenTheSceneToRos2UsersWhereThereIsOne) {
  const auto text = [](const std::string& members) {
    return with("1883}", "1883},\n  \"ros2\": {\"inputs\": {" + members + "}}");
  };
  for (const std::string input : {"collision_object", "planning_constraints"}) {
    EXPECT_NE(problems(text("\"" + input + "\": true")).find("ros2.inputs." + input),
              std::string::npos);
    EXPECT_EQ(problems(text("\"" + input + "\": false")), "");
  }
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
  const std::string_view accepted = ", \"accept\": [\"no_watchdog\"]},\n    \"gnss\"";
  EXPECT_EQ(
      problems(with(accepted, "},\n    \"gnss\"")),
      "f:6:62: devices.right.options: keeps its last velocity for ever: the drive has no watchdog "
      "set (set its watchdog, or \"accept\": [\"no_watchdog\"] when that is meant)\n");
  auto text = with(accepted, "},\n    \"gnss\"");
  const std::string_view node = "\"node\": 2";
  text.replace(text.find(node), node.size(), "\"node\": 2, \"watchdog_timeout_s\": 0.2");
  EXPECT_EQ(problems(text), "");
  EXPECT_THAT(
      problems(with(accepted, ", \"accept\": [\"no_watchdgo\"]},\n    \"gnss\"")),
      HasSubstr("devices.right.accept: nothing of the name \"no_watchdgo\" can be accepted here "
                "(did you mean \"no_watchdog\"?)"));
}

TEST(ConfigurationChecks, RefuseAPathThatAServiceWouldLookForElsewhere) {
  const std::string why =
      " is no absolute path: a service has no home, and its working folder is /";
  const auto told = [](const std::string& section, const std::string& key,
                       const std::string& path) {
    return problems(
        with("\"limits\"", "\"" + section + "\": {\"" + key + "\": \"" + path + "\"}, \"limits\""));
  };
  EXPECT_EQ(told("paths", "state", "~/state"),
            "f:12:22: paths.state: \"~/state\"" + why + " (a path like \"/var/lib/drover\")\n");
  EXPECT_THAT(told("paths", "state", ""), HasSubstr("paths.state: \"\"" + why));
  EXPECT_THAT(told("paths", "run", "run"), HasSubstr("paths.run: \"run\"" + why));
  EXPECT_THAT(told("guard", "socket", "guard.sock"),
              HasSubstr("guard.socket: \"guard.sock\"" + why));
  EXPECT_EQ(told("guard", "socket", "/tmp/guard.sock"), "");
  const auto password = [](const std::string& path) {
    return problems(with("\"port\": 1883",
                         "\"port\": 1883, \"username\": \"a\", "
                         "\"password_file\": \"" +
                             path + "\""));
  };
  EXPECT_THAT(password("~/p"), HasSubstr("mqtt.password_file: \"~/p\"" + why));
  EXPECT_EQ(password("/etc/p"), "");
  EXPECT_EQ(password(""), "");
}

TEST(ConfigurationChecks, RefuseTheAddressThatNoUnitAnswers) {
  const auto unit = [](const std::string& written) {
    auto text = with("\"panel\"", "\"bms\": {\"modbus\": \"/dev/bms\"}, \"panel\"");
    return problems(text.insert(text.find("    \"estop\""),
                                R"("pack": {"driver": "modbus_bms", "link": "bms", "map": )"
                                R"("daly_d2.json")" +
                                    written + "},\n"));
  };
  EXPECT_THAT(unit(", \"unit\": 0"),
              HasSubstr("devices.pack.unit: is 0, which all units hear and none answers (leave it "
                        "out for its usual one, 210)\n"));
  EXPECT_EQ(unit(", \"unit\": 1"), "");
  EXPECT_EQ(unit(""), "");
}

TEST(ConfigurationChecks, TellOfABatteryThatIsAskedAtAnotherSpeedThanItsMapKnows) {
  const auto told = [](const std::string& baud, const std::string& second = "") {
    auto text = with("\"panel\"", "\"bms\": {\"modbus\": \"/dev/bms\"" + baud + "}, \"panel\"");
    return warnings(text.insert(
        text.find("    \"estop\""),
        R"("pack": {"driver": "modbus_bms", "link": "bms", "map": "daly_d2.json"},)" + second));
  };
  EXPECT_THAT(told(R"(, "baud": 115200)"),
              HasSubstr("links.bms.baud: is 115200, but by its map devices.pack speaks at 9600 "
                        "(leave it out, unless the device was set to it)\n"));
  const auto differs = testing::Not(HasSubstr("by its map"));
  EXPECT_THAT(told(R"(, "baud": 9600)"), differs);
  EXPECT_THAT(told(""), differs);
  // Set to the speed of another one.
  EXPECT_THAT(told(R"(, "baud": 115200)",
                   R"("other": {"driver": "modbus_bms", "link": "bms", "map": "jk_pb.json"},)"),
              differs);
}

TEST(ConfigurationChecks, SayWhichMapsThereAreWhereNoneOrAMisspeltOneIsNamed) {
  const auto told = [](const std::string& map) {
    auto text = with("\"panel\"", "\"bms\": {\"modbus\": \"/dev/bms\"}, \"panel\"");
    return problems(
        text.insert(text.find("    \"estop\""),
                    R"("pack": {"driver": "modbus_bms", "link": "bms")" + map + "},\n"));
  };
  EXPECT_THAT(told(""), HasSubstr("devices.pack.map: is missing (modbus_bms needs it; one of: "
                                  "daly_d2.json, jk_pb.json, or a file of your own)"));
  EXPECT_THAT(told(R"(, "map": "jk")"), HasSubstr("(did you mean \"jk_pb.json\"?)"));
  EXPECT_THAT(told(R"(, "map": "bms_of_mine.json")"),
              HasSubstr("(there are: daly_d2.json, jk_pb.json)"));
}

TEST(ConfigurationChecks, SayWhereTheyLookedForAMapThatIsNotThere) {
  const auto with_map = [](const std::string& map) {
    auto text = with("\"panel\"", "\"bms\": {\"modbus\": \"/dev/bms\"}, \"panel\"");
    return text.insert(
        text.find("    \"estop\""),
        R"("pack": {"driver": "modbus_bms", "link": "bms", "map": ")" + map + "\"},\n");
  };
  const auto told = problems(with_map("maps/none_of_mine.json"));
  EXPECT_THAT(told, StartsWith("f:8:56: devices.pack.map: there is no \"maps/none_of_mine.json\" "
                               "beside this file, nor among the installed maps in /"));
  EXPECT_THAT(told, testing::AnyOf(HasSubstr("(there are: "), HasSubstr("(did you mean "),
                                   HasSubstr("(none are installed there)")));
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
  EXPECT_EQ(problems(with_map("/no/such/map.json")),
            "f:8:56: devices.pack.map: there is no file \"/no/such/map.json\"\n");
}

TEST(ConfigurationChecks, RefuseADriveThatLetsGoBeforeTheGuardTakesOver) {
  const auto watchdog = [](const char* seconds) {
    return with(R"("options": {"node": 1})",
                std::string(R"("options": {"node": 1, "watchdog_timeout_s": )") + seconds + "}");
  };
  EXPECT_EQ(problems(watchdog("0.08")), "");
  EXPECT_THAT(problems(watchdog("0.06")),
              HasSubstr("devices.left.options: the drive lets go before drover-guard takes over"));
  auto alone = watchdog("0.06");
  alone.insert(2, R"("guard": {"required": false},)");
  EXPECT_EQ(problems(alone), "");
}

// It is at rest before the guard speaks, and holds there: of that somebody's word is needed.
TEST(ConfigurationChecks, AllowADriveThatHoldsBeforeTheGuardTakesOver) {
  const auto wheels = [](const std::string& options) {
    std::string text(kGood);
    const auto from = text.find("    \"left\": {");
    return text.replace(
        from, text.find("    \"gnss\": {", from) - from,
        R"("wheels": {"driver": "zlac8015d", "link": "can0", "options": {)" + options + R"(},
    "joints": {"left": {"channel": "left"}, "right": {"channel": "right"}}},
)");
  };
  const auto holds = wheels(R"("silence_ms": 40, "silence_holds": true)");
  EXPECT_EQ(problems(holds), "");
  EXPECT_EQ(warnings(holds), "");
  const auto nobody_knows = wheels(R"("silence_ms": 40)");
  EXPECT_EQ(problems(nobody_knows), "");
  EXPECT_THAT(warnings(nobody_knows),
              HasSubstr("devices.wheels.options: the drive lets go before drover-guard takes over "
                        "when droverd dies: lets go, as far as is known, after 0.040 s"));
  EXPECT_EQ(warnings("{\"accept\": [\"early_time_out\"]," + nobody_knows.substr(1)), "");
  EXPECT_EQ(warnings(wheels(R"("silence_ms": 200)")), "");
}

TEST(Configuration, LooksAtADriveThoughOneWithALongerNumberIsWrong) {
  std::string drives;
  std::string left;
  for (int i = 0; i <= 10; ++i) {
    const auto joint = "w" + std::to_string(i);
    const auto node = std::to_string(i == 10 ? 99 : i + 1);
    drives += (i == 0 ? "\"" : ",\"") + joint +
              R"(": {"driver": "odrive", "link": "can0", "options": {"node": )" + node + "}" +
              (i == 1 ? "" : R"(, "accept": ["no_watchdog"])") + "}";
    if (i > 0) left += (i == 1 ? "\"" : ", \"") + joint + "\"";
  }
  const auto text = R"({"links": {"can0": {"can": "can0"}}, "devices": {)" + drives +
                    R"(}, "groups": {"base": {"kind": "skid_steer", "wheel_radius_m": 0.1,
                    "track_m": 0.5, "hold": "brake", "left": [)" +
                    left + R"(], "right": ["w0"]}}, "accept": ["no_estop"]})";
  const auto told = problems(text);
  EXPECT_THAT(told, HasSubstr("devices.w10.options.node: is 99"));
  EXPECT_THAT(told, HasSubstr("devices.w1.options: keeps its last velocity for ever"));
}

TEST(Broker, IsAHostAndNoUrl) {
  const auto host = [](const std::string& text) {
    return problems(with(R"("host": "127.0.0.1")", R"("host": ")" + text + R"(")"));
  };
  EXPECT_EQ(host("broker.local"), "");
  EXPECT_EQ(host("fe80::1"), "");
  EXPECT_THAT(host("mqtt://192.168.1.5:1883"),
              testing::HasSubstr(
                  R"(is no name or address of a host ("192.168.1.5"; the port is mqtt.port))"));
  EXPECT_THAT(host("192.168.1.5:1883"), testing::HasSubstr(R"(("192.168.1.5"; the port)"));
  EXPECT_THAT(host("tcp://"), testing::HasSubstr(R"(a name like "127.0.0.1")"));
}

TEST(Milliseconds, AreNamedWhereSecondsAreGiven) {
  EXPECT_THAT(problems(with(R"("limits": {)", R"("guard": {"limit_ms": 0.05}, "limits": {)")),
              testing::HasSubstr("it is in milliseconds: 0.05 s are 50"));
}

TEST(BitRates, AreSetByTheSystem) {
  EXPECT_THAT(
      problems(with(R"({"can": "can0"})", R"({"can": "can0", "bitrate": 500000})")),
      testing::HasSubstr("links.can0.bitrate: is no known key (the system sets the bit rate"));
}

/// What stands in the place of a wrong value is not what somebody wrote: nothing is told of it.
class AWrongValue : public testing::TestWithParam<std::array<const char*, 2>> {};

TEST_P(AWrongValue, IsTheOnlyThingThatIsTold) {
  const auto [piece, instead] = GetParam();
  const auto told = problems(with(piece, instead));
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
}

INSTANTIATE_TEST_SUITE_P(
    Somewhere, AWrongValue,
    testing::Values(
        std::array{R"("links": {"can0": {"can": "can0"},
            "gnss": {"serial": "/dev/drover/gnss", "baud": 115200}, "panel": {"gpio": "chip0"}})",
                   R"("links": 5)"},
        std::array{R"({"driver": "nmea0183", "link": "gnss"})", R"("nmea0183")"},
        std::array{R"({"driver": "odrive", "link": "can0", "options": {"node": 1},)"
                   R"( "accept": ["no_watchdog"]})",
                   "1"},
        std::array{R"("is": "bumper")", R"("is": "")"},
        std::array{R"({"link": "panel", "enable_relay": {"line": "r"}})", "true"},
        std::array{R"("wheel_radius_m": 0.165)", R"("wheel_radius_m": "")"},
        std::array{R"("left": ["left"])", R"("left": "")"},
        std::array{R"("groups": {"base": {"kind": "skid_steer", "wheel_radius_m": 0.165, )"
                   R"("track_m": 0.6, "left": ["left"], "right": ["right"], "hold": "brake"}})",
                   R"("groups": 5)"},
        std::array{R"("127.0.0.1", "port": 1883)", R"(5, "port": 0)"},
        std::array{R"("127.0.0.1", "port": 1883)", R"("/run/mqtt", "port": 1.5)"},
        std::array{R"("port": 1883)", R"("username": 5, "password_file": "/etc/p", "port": 1883)"},
        // The link's key is the slip: on a serial line nobody has use of a parity.
        std::array{R"("panel": {"gpio": "chip0"}},
  "devices": {)",
                   R"("panel": {"gpio": "chip0"}, "bms": {"serial": "/dev/b", "parity": "even"}},
  "devices": {"battery": {"driver": "modbus_bms", "link": "bms", "map": "daly_d2.json"},)"}));

}  // namespace
}  // namespace drover::config
