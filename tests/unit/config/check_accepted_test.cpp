// What is warned of until a person accepts it by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(ConfigurationChecks, WarnOfNoEmergencyStopLineUnlessThatIsAccepted) {
  EXPECT_EQ(warnings(kGood), "");
  const auto without = with(
      "    \"estop\": {\"driver\": \"gpio_line\", \"link\": \"panel\", \"line\": \"a\", \"is\": "
      "\"estop\"},\n",
      "");
  EXPECT_THAT(warnings(without), HasSubstr("f:4:14: devices: there is no e-stop line"));
  EXPECT_EQ(problems(without), "");
  auto accepted = without;
  accepted.insert(2, "\"accept\": [\"no_estop\"],");
  EXPECT_EQ(warnings(accepted), "");
}

TEST(ConfigurationChecks, WarnOfABatteryWhoseChargeNobodyTellsUnlessThatIsAccepted) {
  const auto map = testing::TempDir() + "no_soc.json";
  std::ofstream(map) << R"({"name": "m", "source": "s",)"
                        R"( "fields": [{"field": "voltage", "address": 1}]})";
  auto text = with("\"panel\"", "\"bms\": {\"modbus\": \"/dev/bms\"}, \"panel\"");
  text.insert(text.find("    \"estop\""),
              R"("pack": {"driver": "modbus_bms", "link": "bms", "map": ")" + map + "\"},\n");
  EXPECT_EQ(problems(text), "");
  EXPECT_THAT(warnings(text), HasSubstr("devices.pack.map: tells no soc"));
  auto accepted = text;
  accepted.insert(2, "\"accept\": [\"no_soc\"],");
  EXPECT_EQ(warnings(accepted), "");
}

TEST(ConfigurationChecks, WarnOfAChassisThatIsSlowerThanItsLimitUnlessThatIsAccepted) {
  const auto chassis = [](const char* speed, const char* words) {
    return std::string(R"({"links": {"can0": {"can": "can0"}, "panel": {"gpio": "g"}},
      "devices": {"chassis": {"driver": "gt01_can", "link": "can0",
                              "options": {"max_speed_mps": 0.5}},
        "estop": {"driver": "gpio_line", "link": "panel", "line": "a", "is": "estop"}},
      "groups": {"base": {"kind": "twist", "device": "chassis", "track_m": 0.7, "hold": "brake"}},
      "limits": {"max_speed_mps": )") +
           speed +
           R"(}, "scene": {"footprint": [{"x_m": 0.5, "y_m": 0.4}, {"x_m": -0.5, "y_m": 0.4},
        {"x_m": -0.5, "y_m": -0.4}, {"x_m": 0.5, "y_m": -0.4}], "ahead_m": 1},
      "accept": ["no_relay")" +
           words + "]}";
  };
  EXPECT_EQ(problems(chassis("1.5", "")), "");
  EXPECT_THAT(
      warnings(chassis("1.5", "")),
      HasSubstr("limits.max_speed_mps: is 1.5, but with devices.chassis.options.max_speed_mps the "
                "base drives 0.5 at the most: it does not follow what is faster"));
  EXPECT_EQ(warnings(chassis("1.5", R"(, "slow_chassis")")), "")
      << "a metre ahead is far enough for what it drives";
  EXPECT_EQ(warnings(chassis("0.5", "")), "");
  EXPECT_EQ(problems(chassis("1.5", R"(, "slow_chassis", "no_estop", "slow_guard", "no_tilt",
                                       "no_soc", "short_look")")),
            "")
      << "all at once";
}

TEST(ConfigurationChecks, WarnOfMotorsThatTurnSlowerThanTheLimitNeeds) {
  const auto hubs = [](const char* rpm, const char* gear_ratio) {
    return std::string(R"({"links": {"can0": {"can": "can0"}, "panel": {"gpio": "g"}},
      "devices": {"hubs": {"driver": "zlac8015d", "link": "can0",
                           "joints": {"left": {"channel": "left"}, "right": {"channel": "right"}},
                           "options": {"max_rpm": )") +
           rpm + R"(, "gear_ratio": )" + gear_ratio +
           R"(, "encoder_lines": 1024}},
        "estop": {"driver": "gpio_line", "link": "panel", "line": "a", "is": "estop"}},
      "groups": {"base": {"kind": "differential", "left": ["left"], "right": ["right"],
                          "track_m": 0.5, "wheel_radius_m": 0.1, "hold": "brake"}},
      "limits": {"max_speed_mps": 1.2}, "accept": ["no_relay"]})";
  };
  EXPECT_EQ(problems(hubs("100", "1")), "");
  EXPECT_THAT(warnings(hubs("100", "1")),
              HasSubstr("limits.max_speed_mps: is 1.2, but with devices.hubs.options.max_rpm the "
                        "base drives 1.047 at the most"));
  EXPECT_EQ(warnings(hubs("120", "1")), "") << "1.26 m/s";
  EXPECT_THAT(warnings(hubs("300", "3")), HasSubstr("drives 1.047 at the most"));
}

TEST(ConfigurationChecks, WarnOfGroundWhoseSlopeNobodyTellsUnlessThatIsAccepted) {
  auto text = with(R"("hold": "brake")", R"("hold": "level_ground_only")");
  EXPECT_THAT(warnings(text), HasSubstr("groups.base.hold: without an inertial sensor"));
  EXPECT_EQ(problems(text), "");
  auto accepted = text;
  accepted.insert(2, "\"accept\": [\"no_tilt\"],");
  EXPECT_EQ(warnings(accepted), "");
  const std::string_view gnss = R"("gnss": {"driver": "nmea0183", "link": "gnss"},)";
  text.replace(text.find(gnss), gnss.size(),
               std::string(gnss) + R"("imu": {"driver": "witmotion", "link": "imu"},)");
  const std::string_view panel = R"("panel": {"gpio")";
  text.replace(text.find(panel), panel.size(),
               R"("imu": {"serial": "/dev/drover/imu"}, "panel": {"gpio")");
  EXPECT_EQ(problems(text), "");
  EXPECT_EQ(warnings(text), "");
}

TEST(ConfigurationChecks, WarnOfADriveThatOnlyARelayStopsWhenThereIsNone) {
  const auto without = with(R"(, "enable_relay": {"line": "r"})", "");
  EXPECT_EQ(problems(without), "");
  EXPECT_EQ(warnings(without),
            "f:5:84: devices.left.accept: it goes on for ever when its line is cut, and so does 1 "
            "other; there is no outputs.enable_relay, so nothing of this gateway stops it then (an "
            "enable_relay in its supply, or \"accept\": [\"no_relay\"] at the top of the file when "
            "that is meant)\n");
  auto accepted = without;
  accepted.insert(2, "\"accept\": [\"no_relay\"],");
  EXPECT_EQ(warnings(accepted), "");
}

TEST(ConfigurationChecks, WarnOfABaseThatOnlyItsDrivesHoldWhenNoRelayTakesTheirPower) {
  auto text = with(R"(, "enable_relay": {"line": "r"})", "");
  for (int side = 0; side < 2; ++side) {
    const std::string_view accepted = R"(}, "accept": ["no_watchdog"]},)";
    text.replace(text.find(accepted), accepted.size(), R"(, "watchdog_timeout_s": 0.2}},)");
  }
  EXPECT_EQ(problems(text), "");
  EXPECT_EQ(warnings(text), "");
  text.replace(text.find("\"brake\""), 7, "\"level_ground_only\"");
  text.insert(2, "\"accept\": [\"no_tilt\"],");
  EXPECT_THAT(warnings(text),
              AllOf(StartsWith("f:11:"),
                    HasSubstr("groups.base.hold: where a stop does not work the drives let go and "
                              "then the enable relay opens, but there is no outputs.enable_relay: "
                              "drives that do not listen keep their power (")));
  text.replace(text.find("no_tilt\""), 8, "no_tilt\", \"no_relay\"");
  EXPECT_EQ(warnings(text), "");
}

TEST(ConfigurationChecks, PointAtTheTopForWhatIsAcceptedThere) {
  EXPECT_THAT(problems(with("\"no_watchdog\"", "\"no_watchdog\", \"no_relay\"")),
              HasSubstr("devices.left.accept: \"no_relay\" is not accepted here (write it into the "
                        "\"accept\" at the top of the file)"));
  auto text = std::string(kGood);
  text.insert(2, "\"accept\": [\"no_watchdog\"],");
  EXPECT_THAT(
      problems(text),
      HasSubstr("accept: \"no_watchdog\" is not accepted here (write it into the \"accept\" "
                "of the drive)"));
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

TEST(Warnings, TellOfADriveThatGoesOnForSecondsWhenItsLineIsCut) {
  const auto after = [](const std::string& seconds, const std::string& words) {
    return warnings(std::string("{\"accept\": [") + words + "]," +
                    with(R"("options": {"node": 1}, "accept": ["no_watchdog"])",
                         R"("options": {"node": 1, "watchdog_timeout_s": )" + seconds + "}")
                        .substr(1));
  };
  EXPECT_EQ(after("0.5", ""), "");
  EXPECT_THAT(after("5", ""),
              HasSubstr("devices.left.options: it goes on for 5 s when its line is cut"));
  EXPECT_EQ(after("5", R"("slow_watchdog")"), "");
}

TEST(Warnings, TellOfARobotThatDrivesWithoutItsGuard) {
  const auto text = with(R"("limits": {)", R"("guard": {"required": false}, "limits": {)");
  EXPECT_THAT(warnings(text), HasSubstr("guard.required: is false: the robot drives without"));
  EXPECT_EQ(warnings("{\"accept\": [\"no_guard\"]," + text.substr(1)), "");
}

TEST(Warnings, TellOfAnAntennaFarFromItsBase) {
  const auto at = [](const std::string& antenna, const std::string& words) {
    return warnings(std::string("{\"accept\": [") + words + "], \"estimate\": {" + antenna + "}," +
                    std::string(kGood).substr(1));
  };
  EXPECT_EQ(at(R"("antenna_x_m": -1.5, "antenna_y_m": 0.8)", ""), "") << "of a track of 0.6 m";
  EXPECT_THAT(at(R"("antenna_x_m": -5)", ""),
              HasSubstr("estimate: the antenna is 5 m from base_link, on a base whose track is 0.6 "
                        "m (antenna_x_m and antenna_y_m in metres, or"));
  EXPECT_EQ(at(R"("antenna_x_m": -5)", R"("far_antenna")"), "");
}

TEST(Warnings, TellOfMechanicsThatNobodyLooksAtUnlessThatIsAccepted) {
  const auto first_way = [](const std::string& way_m, const std::string& words) {
    return warnings("{\"accept\": [" + words + "], \"navigate\": {\"first_way_m\": " + way_m +
                    "}," + std::string(kGood).substr(1));
  };
  EXPECT_EQ(first_way("0.3", ""), "");
  EXPECT_THAT(first_way("0", ""),
              HasSubstr("navigate.first_way_m: is 0: nothing looks whether wheels, gyro and "
                        "receiver agree before it drives fast, so a wrong unit, gear or side is "
                        "not noticed (0.3 is usual, or \"accept\": [\"no_first_way\"]"));
  EXPECT_EQ(first_way("0", R"("no_first_way")"), "");
}

TEST(Warnings, TellOfADriveWhoseSilenceIsNoticedLateUnlessThatIsAccepted) {
  const auto stale = [](const std::string& all_s, const std::string& own_s,
                        const std::string& words) {
    return warnings(
        "{\"accept\": [" + words + "], \"health\": {\"drive_stale_s\": " + all_s + "}," +
        with(R"("options": {"node": 1})", R"("options": {"node": 1, "stale_s": )" + own_s + "}")
            .substr(1));
  };
  EXPECT_EQ(stale("0.5", "2", ""), "") << "the shorter one acts";
  EXPECT_EQ(stale("2", "0.5", ""), "");
  EXPECT_THAT(stale("2", "0.6", ""),
              HasSubstr("health.drive_stale_s: is 2, and devices.left.options.stale_s is 0.6: the "
                        "robot drives on for 0.6 s when the drive is silent; up to 0.5 s is usual "
                        "(a shorter one of the two, or \"accept\": [\"late_silence\"]"));
  EXPECT_EQ(stale("2", "0.6", R"("late_silence")"), "");
}

TEST(Warnings, TellOfASlopeThatIsAllowedAndStopsAllTheSame) {
  const auto allowed = [](const char* hold, const std::string& most_deg) {
    const auto text = with(R"("hold": "brake")", "\"hold\": \"" + std::string(hold) +
                                                     "\", \"max_tilt_deg\": " + most_deg);
    return warnings(R"({"accept": ["no_tilt"],)" + text.substr(1));
  };
  EXPECT_EQ(allowed("level_ground_only", "25"), "");
  EXPECT_THAT(
      allowed("level_ground_only", "30"),
      HasSubstr("groups.base.max_tilt_deg: is 30, but health.tilt_limit_deg stops the robot "
                "at 25 already (25 or less)"));
  EXPECT_EQ(allowed("brake", "30"), "") << "is of no use there";
}

TEST(Warnings, TellOfAnEmergencyStopWhoseBrokenWireReadsAsReleased) {
  const auto active = [](const char* line, const std::string& level, const std::string& words) {
    const auto plain = std::string("\"is\": \"") + line + "\"";
    return warnings(
        "{\"accept\": [" + words + "]," +
        with(plain, plain + R"(, "options": {"active_level": ")" + level + "\"}").substr(1));
  };
  EXPECT_EQ(active("estop", "low", ""), "");
  EXPECT_THAT(
      active("estop", "high", ""),
      HasSubstr("f:8:111: devices.estop.options.active_level: is high: when its wire breaks "
                "it reads as released, and the button stops nothing (a normally closed "
                "contact that feeds the line high, and \"low\", or \"accept\": "
                "[\"estop_not_fail_safe\"]"));
  EXPECT_EQ(active("estop", "high", R"("estop_not_fail_safe")"), "");
  EXPECT_EQ(active("bumper", "high", ""), "");
}

TEST(Warnings, TellOfWheelsOfOneBaseThatAreToldInDifferentUnits) {
  const auto two = [](const std::string& right) {
    return std::string(R"({"links": {"can0": {"can": "can0"}, "panel": {"gpio": "g"}},
      "devices": {
        "l": {"driver": "cia402", "link": "can0", "joints": {"left": {"channel": "motor"}},
              "options": {"node": 1, "velocity_units_per_rps": 60, "gear_ratio": 25,
                          "acceleration": 0, "deceleration": 0}},
        "r": {"driver": "cia402", "link": "can0", "joints": {"right": {"channel": "motor"}},
              "options": {"node": 2, )") +
           right + R"(, "acceleration": 0, "deceleration": 0}},
        "estop": {"driver": "gpio_line", "link": "panel", "line": "a", "is": "estop"}},
      "groups": {"base": {"kind": "differential", "left": ["left"], "right": ["right"],
                          "track_m": 0.5, "wheel_radius_m": 0.1, "hold": "brake"}},
      "outputs": {"link": "panel", "enable_relay": {"line": "r"}},
      "limits": {"max_speed_mps": 0.8}, "accept": ["slow_chassis"]})";
  };
  const auto told = [&](const std::string& right) {
    EXPECT_EQ(problems(two(right)), "");
    return warnings(two(right));
  };
  EXPECT_EQ(told(R"("velocity_units_per_rps": 60, "gear_ratio": 25, "reversed": true)"), "");
  EXPECT_EQ(told(R"("velocity_units_per_rps": 600, "gear_ratio": 25)"),
            "f:7:64: devices.r.options.velocity_units_per_rps: is 600, but 60 in "
            "devices.l.options.velocity_units_per_rps: the wheels of one base are told in "
            "different units; is that meant?\n");
  EXPECT_EQ(told(R"("velocity_units_per_rps": 60, "gear_ratio": 5)"),
            "f:7:82: devices.r.options.gear_ratio: is 5, but 25 in devices.l.options.gear_ratio: "
            "the wheels of one base have different gears; is that meant?\n");
}

TEST(Warnings, TellOfABrokerThatTheServiceDoesNotReach) {
  const auto at = [](const std::string& mqtt, const std::string& words) {
    return warnings("{\"accept\": [" + words + "]," +
                    with(R"("host": "127.0.0.1", "port": 1883)", mqtt).substr(1));
  };
  for (const auto* here : {R"("host": "127.0.1.1", "port": 1883)", R"("host": "::1", "port": 1883)",
                           R"("host": "localhost", "port": 1883)",
                           R"("host": "/run/mosquitto/drover.sock", "port": 0)",
                           R"("host": "192.168.1.7", "port": 1883, "enabled": false)"})
    EXPECT_EQ(at(here, ""), "") << here;
  EXPECT_THAT(at(R"("host": "192.168.1.7", "port": 1883)", ""),
              HasSubstr("f:13:20: mqtt.host: \"192.168.1.7\" is not this computer, and "
                        "droverd.service speaks with no other one: it never connects "
                        "(IPAddressAllow=192.168.1.7 under [Service] by \"systemctl edit "
                        "droverd\"; when that is done, \"accept\": [\"remote_broker\"] at the top "
                        "of the file)"));
  EXPECT_THAT(at(R"("host": "broker.lan", "port": 1883)", ""),
              HasSubstr("(its address in place of its name, and IPAddressAllow= with that address "
                        "under [Service] by"));
  EXPECT_EQ(at(R"("host": "192.168.1.7", "port": 1883)", R"("remote_broker")"), "");
}

/// The one that is misspelt may be it.
TEST(Warnings, MissNoDeviceWhileTheDriverOfOneIsNotKnown) {
  const auto text = with("\"driver\": \"gpio_line\", \"link\": \"panel\", \"line\": \"a\"",
                         "\"driver\": \"gpio_lime\", \"link\": \"panel\", \"line\": \"a\"");
  EXPECT_THAT(problems(text), HasSubstr("devices.estop.driver: "));
  EXPECT_THAT(warnings(text), testing::Not(HasSubstr("there is no e-stop line")));
}

TEST(Warnings, TellWhatALineMayBeThatSaysNothingOfIt) {
  EXPECT_THAT(problems(with(", \"is\": \"bumper\"", "")),
              HasSubstr("devices.bumper.is: is missing (gpio_line needs it; one of: estop, "));
}

TEST(Warnings, AreEachAcceptedByTheWordThatTheyTell) {
  for (const auto* word :
       {"no_estop", "slow_guard", "no_tilt", "no_soc", "no_relay", "short_look", "slow_chassis",
        "far_antenna", "slow_watchdog", "no_guard", "falls", "no_first_way", "late_silence",
        "estop_not_fail_safe", "remote_broker", "early_time_out", "swings", "mixed_bus"})
    EXPECT_EQ(
        problems("{\"accept\": [\"" + std::string(word) + "\"]," + std::string(kGood).substr(1)),
        "")
        << word;
}

}  // namespace
}  // namespace drover::config
