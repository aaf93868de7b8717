// A scenario is refused with one sentence that names the key, or read whole.
#include "sim/robot/scenario.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sim/robot/scenario_file.h"

namespace drover::sim {
namespace {

const std::string kPlain = R"({"world": "field.xml",
  "origin": {"latitude_deg": 52, "longitude_deg": 13})";

/// The message with which a scenario of these further members is refused.
std::string refusal(const std::string& members) {
  try {
    (void)parse_scenario(kPlain + members + "}", "/w");
  } catch (const std::exception& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Scenario, RefusesAnUnknownKeyAndNamesTheKnownOnes) {
  EXPECT_EQ(refusal(R"(, "start": {"x": 1})"),
            "start.x: unknown key; known here: x_m, y_m, yaw_deg");
}

TEST(Scenario, RefusesAKeyThatStandsThereTwice) {
  EXPECT_EQ(refusal(R"(, "name": "a", "name": "b")"), "name: the key stands there twice");
}

TEST(Scenario, RefusesTextThatIsNoJson) {
  EXPECT_THROW((void)parse_scenario("{\"world\": ", ""), std::exception);
  EXPECT_THROW((void)parse_scenario("[]", ""), std::exception);
}

TEST(Scenario, RefusesAScenarioWithoutAWorld) {
  EXPECT_THROW((void)parse_scenario("{}", ""), std::runtime_error);
}

TEST(Scenario, HasFurtherDevicesByName) {
  const auto scenario =
      parse_scenario(kPlain + R"(, "gnss": {}, "more": {
        "gnss_rear": {"is": "gnss", "port": "rear", "antenna": {"x_m": -1}},
        "imu_rear": {"is": "imu", "options": {"mount_yaw_deg": 90}},
        "pack": {"is": "battery", "map": ")" +
                         DROVER_SOURCE_DIR + R"(/config/maps/daly_d2.json", "unit": 7}}})",
                     "/w");
  ASSERT_EQ(scenario.more.size(), 3U);
  EXPECT_EQ(scenario.more[0].name, "gnss_rear");
  EXPECT_EQ(scenario.more[0].gnss->antenna_x_m, -1);
  EXPECT_EQ(scenario.more[1].kind(), "imu");
  EXPECT_EQ(scenario.more[2].battery->unit, 7);
}

TEST(Scenario, HasAScannerAtItsPlace) {
  const auto scenario = parse_scenario(
      kPlain + R"(, "lidar": {"place": {"x_m": 0.4, "z_m": 0.1, "yaw_deg": 90}, "reach_m": 8,
                              "options": {"upside_down": true}}})",
      "/w");
  ASSERT_TRUE(scenario.lidar.has_value());
  EXPECT_EQ(scenario.lidar->driver->name, "ld06");
  EXPECT_EQ(scenario.lidar->baud, 230400);
  EXPECT_EQ(scenario.lidar->port, "lidar");
  EXPECT_EQ(scenario.lidar->x_m, 0.4);
  EXPECT_EQ(scenario.lidar->yaw_deg, 90);
  EXPECT_EQ(scenario.lidar->reach_m, 8);
  EXPECT_TRUE(scenario.lidar->options.flag("upside_down"));
  EXPECT_EQ(refusal(R"(, "lidar": {"driver": "witmotion"})"),
            "lidar.driver: no simulated 'witmotion' of this kind; there is: ld06");
  EXPECT_EQ(refusal(R"(, "lidar": {"reach_m": 0})"),
            "lidar.reach_m: must be above 0, and 1000 at most");
}

TEST(Scenario, HangsInertialSensorsOnBuses) {
  const auto scenario = parse_scenario(kPlain + R"(,
    "can": {"can0": {"kind": "vcan"}, "can1": {"kind": "vcan"}},
    "imu": {"driver": "hipnuc_can", "bus": "can1", "options": {"node": 9, "mount_yaw_deg": 90},
            "twin": {"bias_sigma_dps": 1}},
    "more": {"imu_rear": {"is": "imu", "driver": "hipnuc_can", "bus": "can0"}}})",
                                       "/w");
  EXPECT_EQ(scenario.imu->bus, 1U);
  EXPECT_EQ(scenario.imu->options.number("node"), 9);
  EXPECT_EQ(scenario.imu->options.number("bias_sigma_dps"), 1);
  EXPECT_EQ(scenario.more[0].imu->bus, 0U);
}

TEST(Scenario, RefusesAnInertialSensorOnTheWrongWire) {
  EXPECT_EQ(refusal(R"(, "imu": {"driver": "hipnuc_can", "bus": "can7"})"),
            "imu.bus: 'can7' is not in 'can'");
  EXPECT_EQ(refusal(R"(, "imu": {"driver": "hipnuc_can", "port": "imu"})"),
            "imu.port: 'hipnuc_can' hangs on a CAN bus");
  EXPECT_EQ(refusal(R"(, "imu": {"driver": "hipnuc_can", "baud": 9600})"),
            "imu.baud: 'hipnuc_can' hangs on a CAN bus");
  EXPECT_EQ(refusal(R"(, "can": {"can0": {"kind": "vcan"}}, "imu": {"bus": "can0"})"),
            "imu.bus: 'witmotion' hangs on a serial line");
  EXPECT_EQ(refusal(R"(, "imu": {"driver": "odrive"})")
                .find("imu.driver: no simulated 'odrive' of this kind; there is: "),
            0U);
}

TEST(Scenario, RefusesFurtherDevicesOfNoKindOrOfAKindsOwnName) {
  EXPECT_EQ(refusal(R"(, "more": {"a": {"is": "lidar"}})"),
            "more.a.is: must be gnss, imu or battery");
  EXPECT_EQ(refusal(R"(, "more": {"gnss": {"is": "gnss"}})"),
            "more.gnss: is the name of the first of its kind");
}

TEST(Scenario, RefusesAWrongType) {
  EXPECT_EQ(refusal(R"(, "start": {"x_m": "1"})"), "start.x_m: must be a number");
  EXPECT_EQ(refusal(R"(, "estop_cuts_power": 1)"), "estop_cuts_power: must be true or false");
  EXPECT_EQ(refusal(R"(, "drives": {})"), "drives: must be a list");
  EXPECT_EQ(refusal(R"(, "can": 3)"), "can: must be an object");
}

TEST(Scenario, RefusesAnUnknownKindOfBus) {
  EXPECT_EQ(refusal(R"(, "can": {"can0": {"kind": "usb"}})"),
            "can.can0.kind: must be one of vcan, canfd, slcan, unix");
}

TEST(Scenario, RefusesADriveOnABusThatIsNotThere) {
  EXPECT_EQ(refusal(R"(, "drives": [{"joint": "a", "driver": "odrive", "bus": "can7"}])"),
            "drives[0].bus: 'can7' is not in 'can'");
}

TEST(Scenario, RefusesADriverWithoutATwin) {
  EXPECT_NE(refusal(R"(, "can": {"can0": {"kind": "vcan"}},
    "drives": [{"joint": "a", "driver": "gpio_line", "bus": "can0"}])")
                .find("drives[0].driver: no simulated 'gpio_line' of this kind; there is: odrive"),
            std::string::npos);
}

TEST(Scenario, RefusesAnOptionThatTheDriverDoesNotHave) {
  EXPECT_EQ(refusal(R"(, "can": {"can0": {"kind": "vcan"}}, "drives": [{"joint": "a",
    "driver": "odrive", "bus": "can0", "options": {"node": 0, "nod": 1}}])")
                .find("drives[0].options.nod: unknown key; known here: "),
            0U);
}

TEST(Scenario, RefusesAnOptionOutsideItsRange) {
  EXPECT_EQ(refusal(R"(, "can": {"can0": {"kind": "vcan"}}, "drives": [{"joint": "a",
    "driver": "odrive", "bus": "can0", "options": {"node": 99}}])")
                .find("drives[0].options.node: must be from 0 to 6"),
            0U);
}

TEST(Scenario, RefusesTwoDrivesOfOneJoint) {
  const std::string drive =
      R"({"joint": "a", "driver": "odrive", "bus": "can0", "options": {"node": 1}})";
  EXPECT_EQ(
      refusal(R"(, "can": {"can0": {"kind": "vcan"}}, "drives": [)" + drive + "," + drive + "]"),
      "drives[1].joint: 'a' has a drive already");
}

/// The message with which these members of a drive on can0 are refused.
std::string drive_refusal(const std::string& members) {
  return refusal(R"(, "can": {"can0": {"kind": "vcan"}}, "drives": [)" + members + "]");
}

TEST(Scenario, RefusesADriveWithAnotherNumberOfJointsThanItsDriverTurns) {
  EXPECT_EQ(drive_refusal(R"({"joint": "a", "driver": "zlac8015d", "bus": "can0"})"),
            "drives[0].joints: 'zlac8015d' turns 2, here are 1");
  EXPECT_EQ(drive_refusal(R"({"joints": ["a", "b"], "driver": "odrive", "bus": "can0"})"),
            "drives[0].joints: 'odrive' turns 1, here are 2");
  EXPECT_EQ(drive_refusal(R"({"joint": "a", "joints": ["a"], "driver": "odrive", "bus": "can0"})"),
            "drives[0].joints: say either 'joint' or 'joints'");
  EXPECT_EQ(drive_refusal(R"({"joints": [], "driver": "odrive", "bus": "can0"})"),
            "drives[0].joints: must be a list of texts");
}

TEST(Scenario, RefusesAJointOrANameThatAnotherDriveHas) {
  const std::string pair =
      R"({"joints": ["a", "b"], "name": "pair", "driver": "zlac8015d", "bus": "can0",
          "options": {"node": 1}})";
  const auto second = [&pair](const std::string& members) {
    return drive_refusal(
        pair + R"(, {"driver": "odrive", "bus": "can0", "options": {"node": 1}, )" + members + "}");
  };
  EXPECT_EQ(second(R"("joint": "b")"), "drives[1].joint: 'b' has a drive already");
  EXPECT_EQ(second(R"("joint": "pair")"), "drives[1].joint: 'pair' has a drive already");
  EXPECT_EQ(second(R"("joint": "c", "name": "a")"), "drives[1].name: 'a' is another drive's");
  EXPECT_EQ(drive_refusal(R"({"joints": ["a", "a"], "driver": "zlac8015d", "bus": "can0"})"),
            "drives[0].joints: 'a' stands there twice");
}

TEST(Scenario, RefusesADriveOnAnotherWireThanItsDrivers) {
  EXPECT_EQ(drive_refusal(R"({"joint": "a", "driver": "odrive", "serial": {}})"),
            "drives[0].serial: 'odrive' hangs on a CAN bus");
}

TEST(Scenario, RefusesALevelThatIsNone) {
  EXPECT_EQ(refusal(R"(, "lines": {"estop": "closed"})"),
            "lines.estop: must be the active level, low or high, or unwired");
}

TEST(Scenario, RefusesAnOriginThatIsNoPlace) {
  EXPECT_THROW((void)parse_scenario(
                   R"({"world": "w", "origin": {"latitude_deg": 91, "longitude_deg": 0}})", ""),
               std::runtime_error);
}

TEST(Scenario, RefusesAFarZoneInsideTheNearOne) {
  EXPECT_EQ(refusal(R"(, "zones": {"near_m": 1, "far_m": 0.5})"),
            "zones.far_m: must not be below near_m");
}

TEST(Scenario, RefusesAFileThatIsNotThere) {
  EXPECT_THROW((void)load_scenario("/no/such/scenario.json"), std::runtime_error);
}

TEST(Scenario, FindsTheWorldBesideItself) {
  const auto scenario = parse_scenario(kPlain + "}", "/a/scenarios/../worlds");
  EXPECT_EQ(scenario.world, "/a/worlds/field.xml");
}

TEST(Scenario, HasFailSafeLinesUnlessItSaysOtherwise) {
  EXPECT_FALSE(parse_scenario(kPlain + "}", "").lines[0].active_high);
  const auto scenario =
      parse_scenario(kPlain + R"(, "lines": {"estop": "high", "bumper": "unwired"}})", "");
  EXPECT_TRUE(scenario.lines[0].active_high);
  EXPECT_FALSE(scenario.lines[1].wired);
  EXPECT_TRUE(scenario.lines[2].wired);
}

TEST(Scenario, PutsItsEventsInOrder) {
  const auto scenario = parse_scenario(
      kPlain + R"(, "events": [{"at_s": 2, "command": "b"}, {"at_s": 0.5, "command": "a"}]})", "");
  ASSERT_EQ(scenario.events.size(), 2U);
  EXPECT_EQ(scenario.events[0].command, "a");
  EXPECT_EQ(scenario.events[0].at, std::chrono::milliseconds(500));
}

TEST(Scenario, HasNoRelayNoBrakeAndNoWormGearUnlessItSaysSo) {
  const auto plain = parse_scenario(kPlain + "}", "");
  EXPECT_FALSE(plain.relay_feeds_drives || plain.brake || plain.worm_gear);
  const auto wired = parse_scenario(
      kPlain + R"(, "relay_feeds_drives": true, "brake": true, "worm_gear": true})", "");
  EXPECT_TRUE(wired.relay_feeds_drives && wired.brake && wired.worm_gear);
}

TEST(Scenario, ChangesOneDriveOfItsRobotByTheJointsName) {
  auto robot = nlohmann::json::parse(R"({"name": "a", "drives": [
    {"joint": "left", "options": {"node": 1, "gear_ratio": 10}},
    {"joint": "right", "options": {"node": 2, "gear_ratio": 10}}]})");
  change_document(robot,
                  nlohmann::json::parse(
                      R"({"name": "b", "drives": {"right": {"options": {"gear_ratio": 5}}}})"));
  EXPECT_EQ(robot, nlohmann::json::parse(R"({"name": "b", "drives": [
    {"joint": "left", "options": {"node": 1, "gear_ratio": 10}},
    {"joint": "right", "options": {"node": 2, "gear_ratio": 5}}]})"));
}

TEST(Scenario, ChangesADriveOfTwoJointsByAnyOfItsNames) {
  for (const char* name : {"left", "right", "wheels"}) {
    auto robot = nlohmann::json::parse(R"({"drives": [
      {"name": "wheels", "joints": ["left", "right"], "options": {"node": 1}}]})");
    change_document(robot, {{"drives", {{name, {{"options", {{"node", 3}}}}}}}});
    EXPECT_EQ(robot["drives"][0]["options"]["node"], 3) << name;
  }
}

TEST(Scenario, RefusesToChangeADriveThatIsNotThere) {
  auto robot = nlohmann::json::parse(R"({"drives": [{"joint": "left"}]})");
  try {
    change_document(robot, nlohmann::json::parse(R"({"drives": {"tail": {}}})"));
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "drives.tail: there is no drive of this joint to change");
  }
}

TEST(Scenario, ReadsAWholeRobotWithComments) {
  const auto scenario = parse_scenario(kPlain + R"(, // the buses
    "can": {"can0": {"kind": "slcan"}},
    "drives": [{"joint": "front_left", "driver": "odrive", "bus": "can0", "options": {"node": 5}},
               {"joints": ["l", "r"], "driver": "zlac8015d", "bus": "can0"}],
    "gnss": {"baud": 38400, "antenna": {"z_m": 0.8, "heading_offset_deg": 90}},
    "imu": {"baud": 230400, "place": {"z_m": 0.2}, "options": {"mount_yaw_deg": -90},
            "twin": {"bias_sigma_dps": 1}},
    "player": {"anything": [1]}})",
                                       "");
  EXPECT_EQ(scenario.buses[0].kind, CanKind::slcan);
  ASSERT_EQ(scenario.drives.size(), 2U);
  EXPECT_EQ(scenario.drives[1].joints, (std::vector<std::string>{"l", "r"}));
  EXPECT_FALSE(scenario.drives[1].serial);
  EXPECT_EQ(scenario.drives[0].options.number("node"), 5);
  ASSERT_TRUE(scenario.gnss);
  EXPECT_EQ(scenario.gnss->baud, 38400);
  EXPECT_EQ(scenario.gnss->antenna_z_m, 0.8);
  EXPECT_EQ(scenario.gnss->heading_offset_deg, 90);
  ASSERT_TRUE(scenario.imu);
  EXPECT_EQ(scenario.imu->z_m, 0.2);
  EXPECT_EQ(scenario.imu->options.number("baud"), 230400);
  EXPECT_EQ(scenario.imu->options.number("mount_yaw_deg"), -90);
  EXPECT_EQ(scenario.imu->options.number("bias_sigma_dps"), 1);
}

}  // namespace
}  // namespace drover::sim
