// What droverd writes is what the command line reads: a name that differs shows as "-".
#include "publish/status/status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "cli/show.h"
#include "cli/show_devices.h"

namespace drover::cli {
namespace {

using namespace std::chrono_literals;

constexpr Time kNow{100s};

void fill_devices(Snapshot& s) {
  s.gnss.configured = true;
  s.gnss.health = SourceState::fresh;
  s.gnss.position = {23.1496524721, 113.0196377172, 29.237, -5, FixQuality::rtk_fixed, 28, 0.6,
                     1.0,           0.011,          0.012};
  s.gnss.position_time = kNow - 50ms;
  s.gnss.velocity = {0.512, 91.5};
  s.gnss.receiver_heading_deg = 179.8;
  s.gnss.heading_deg = 89.8;
  s.gnss.heading_time = kNow - 200ms;
  s.gnss.pose_heading_deg = 12.5;
  s.gnss.source.overflows = 7;
  s.imu.configured = true;
  s.imu.health = SourceState::fresh;
  s.imu.time = kNow - 10ms;
  s.imu.sample.acceleration_mps2 = {0.125, 0.25, 9.75};
  s.imu.sample.angular_velocity_radps = {0.0021, 0.0032, -0.0075};
  s.imu.sample.temperature_degC = 31;
  s.imu.gyro_bias_radps = {0.00119, 0.00281, -0.00726};
  s.imu.gyro_bias_sigma_radps = 0.00021;
  s.imu.roll_rad = 0.0125;
  s.imu.pitch_rad = -0.0375;
  s.battery.configured = true;
  s.battery.health = SourceState::fresh;
  s.battery.time = kNow - 1s;
  s.battery.sample.voltage_V = 26.51;
  s.battery.sample.current_A = -1.25;
  s.battery.sample.soc_percent = 83.5;
  s.battery.sample.remaining_Ah = 33.4;
  s.battery.sample.temperature_degC = 22.5;
  s.battery.sample.mosfet_degC = 24.5;
  s.battery.sample.min_cell_V = 3.311;
  s.battery.sample.max_cell_V = 3.317;
}

Snapshot full_snapshot() {
  Snapshot s;
  s.time = kNow;
  fill_devices(s);
  AxisSnapshot axis;
  axis.joint = "front_left";
  axis.state = AxisState::running;
  axis.health = SourceState::fresh;
  axis.motion.position_rad = 12.345;
  axis.motion.velocity_radps = 3.021;
  axis.motion.effort_Nm = 1.75;
  axis.last_motion = kNow - 5ms;
  axis.inverter_degC = 41;
  axis.motor_degC = 52;
  axis.bus_V = 26.3;
  axis.bus_A = 0.7;
  (void)s.axes.push_back(axis);
  LinkSnapshot link;
  link.name = "can0";
  link.is_bus = link.up = true;
  link.reason = "can0 is error-passive";
  link.received = 4711;
  link.sent = 815;
  link.dropped = 3;
  link.refused = 2;
  (void)s.links.push_back(link);
  s.line_configured[0] = s.line_active[0] = true;
  s.output_configured[0] = s.output_on[0] = true;
  (void)s.scanners.push_back({.name = "lidar",
                              .health = SourceState::fresh,
                              .source = {.reason = "the scanner is blind in 2 of 24 sectors"},
                              .time = kNow - 60ms,
                              .turn_Hz = 9.97,
                              .points = 451,
                              .returns = 437,
                              .nearest_m = 0.984,
                              .nearest_deg = 90.2});
  s.joint_command = {true, 120, 3, "joint 'wing': there is no such joint"};
  s.estimator = {1, 2, 3, 4, 5};
  s.notices_dropped = 6;
  s.nav.owner = Owner::joint_command;
  s.nav.owner_timeout_s = 0.1;
  (void)s.why.push_back("e-stop pressed");
  return s;
}

class StatusViews : public testing::Test {
 protected:
  StatusViews() {
    publish::DaemonStatus daemon;
    daemon.robot = "field";
    daemon.now = kNow;
    daemon.joint_commands_unread = 40;
    daemon.joint_commands_of_rivals = 7;
    daemon.joint_commands_rivals = "two programs write";
    auto document = json::parse(publish::status_json(full_snapshot(), daemon));
    if (!document) ADD_FAILURE() << document.error().text();
    if (document) status = document->root;
  }
  std::string shown(std::string_view name) const {
    for (const auto& each : device_views())
      if (each.name == name) {
        EXPECT_EQ(missing(each, status), "") << name;
        return each.show(status);
      }
    ADD_FAILURE() << "no view " << name;
    return {};
  }
  static void expect(const std::string& text, std::initializer_list<const char*> parts) {
    for (const char* part : parts)
      EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  }
  json::Node status;
};

TEST_F(StatusViews, ShowTheReceiver) {
  expect(shown("gnss"), {"rtk fixed", "satellites 28", "hdop 0.60", "corrections 1.0 s old",
                         "latitude 23.149652472 deg", "longitude 113.019637717 deg",
                         "altitude 29.237 m", "east 0.011 m", "north 0.012 m", "speed 0.512 m/s",
                         "course 91.5 deg", "as received 179.80 deg (0.2 s old)",
                         "robot's, less the mounting 89.80 deg", "age 0.050 s", "fresh"});
}

TEST_F(StatusViews, ShowTheInertialSensor) {
  expect(shown("imu"), {"0.125", "9.750", "-0.0075", "-0.00726", "sigma z 0.00021 rad/s",
                        "roll 0.0125 rad", "pitch -0.0375 rad", "31.0 C", "age 0.010 s", "fresh"});
}

TEST_F(StatusViews, ShowTheBattery) {
  expect(shown("bms"), {"83.5 %", "remaining 33.4 Ah", "26.51 V", "-1.25 A", "lowest 3.311 V",
                        "highest 3.317 V", "cells 22.5 C", "switch 24.5 C", "age 1.000 s"});
}

TEST_F(StatusViews, ShowBusesAndDrives) {
  expect(shown("can"), {"can0", "received 4711", "sent 815", "dropped 3", "refused 2",
                        "can0 is error-passive", "front_left", "running", "12.345 rad",
                        "3.021 rad/s", "1.75 Nm", "motor 52 C", "inverter 41 C", "bus 26.3 V"});
}

TEST_F(StatusViews, ShowLinesAndOutputs) {
  expect(shown("gpio"), {"estop", "ACTIVE"});
}

TEST_F(StatusViews, ShowTheWholeInShort) {
  EXPECT_EQ(show_status(status).find("aside"), std::string::npos) << "as most bases";
  expect(show_status(status), {"field", "e-stop pressed", "can0", "can0 is error-passive"});
  expect(
      show_status(status),
      {"owner     joint_command, stops 0.1 s after its last message",
       "joints    heard, 120 followed, 3 refused, 40 of a flood not read, 7 of a second program, "
       "last: joint 'wing': there is no such joint"});
  const auto& nav = *status.find("nav");
  EXPECT_EQ(*nav.find("owner")->text(), "joint_command");
  EXPECT_DOUBLE_EQ(nav.find("owner_timeout_s")->number().value_or(0), 0.1);
}

TEST_F(StatusViews, ShowTheScannerAmongTheSensors) {
  expect(show_status(status),
         {"scanner   lidar           10.0 turns/s  437 of 451 points seen  "
          "nearest 0.98 m, +90° left  fresh  0.06 s old  the scanner is blind in 2 of 24 sectors"});
}

TEST(StatusInShort, TellsAWayToTheSide) {
  Snapshot s;
  s.pose.vy_mps = -0.3;
  const auto text = show_status(json::parse(publish::status_json(s, {}))->root);
  EXPECT_NE(text.find("rad/s  aside -0.30 m/s\n"), std::string::npos) << text;
}

TEST(StatusInShort, TellsWhatIsOddWithABaseThatIsHeard) {
  Snapshot s;
  s.time = kNow;
  s.base.configured = true;
  s.base.health = SourceState::fresh;
  s.base.last_motion = kNow - 10ms;
  s.base.source.reason = "its error word is 0080";
  const auto text = show_status(json::parse(publish::status_json(s, {}))->root);
  EXPECT_NE(text.find("fresh  its error word is 0080\n"), std::string::npos) << text;
}

TEST(StatusInShort, SaysNothingOfTheSilenceOfATask) {
  Snapshot s;
  s.nav.owner = Owner::task;
  s.nav.owner_timeout_s = 0.1;
  const auto text = show_status(json::parse(publish::status_json(s, {}))->root);
  EXPECT_NE(text.find("owner     task\n"), std::string::npos) << text;
}

TEST(StatusInShort, TellsOfAStopThatABootWouldForget) {
  const auto shown = [](const char* trouble) {
    publish::DaemonStatus daemon;
    daemon.stop_trouble = trouble;
    const auto document = json::parse(publish::status_json(full_snapshot(), daemon));
    return document ? show_status(document->root) : document.error().text();
  };
  EXPECT_NE(shown("cannot write /x: Read-only file system")
                .find("FORGOTTEN over a boot: cannot write /x: Read-only file system"),
            std::string::npos);
  EXPECT_EQ(shown("").find("FORGOTTEN"), std::string::npos);
}

TEST(StatusInShort, TellsWhetherTheRobotIsShownToRos2) {
  publish::DaemonStatus daemon;
  const auto shown = [&daemon] {
    const auto document = json::parse(publish::status_json(full_snapshot(), daemon));
    return document ? show_status(document->root) : document.error().text();
  };
  EXPECT_EQ(shown().find("ros2"), std::string::npos) << "it is not configured";
  daemon.ros2.configured = true;
  EXPECT_NE(shown().find("drover-ros2 does not ask"), std::string::npos);
  daemon.ros2.connected = true;
  daemon.ros2.mode = "localhost";
  daemon.ros2.readers = 3;
  EXPECT_NE(shown().find("localhost  3 readers\n"), std::string::npos);
  daemon.ros2.incompatible = 2;
  EXPECT_NE(shown().find("3 readers  2 ASK FOR ANOTHER QUALITY"), std::string::npos);
  daemon.ros2.reason = "the DDS domain cannot be made";
  EXPECT_NE(shown().find("localhost  the DDS domain cannot be made"), std::string::npos);
}

TEST(StatusInShort, TellsOnWhichNetworkRos2SeesTheRobot) {
  publish::DaemonStatus daemon;
  const auto shown = [&daemon] {
    const auto document = json::parse(publish::status_json(full_snapshot(), daemon));
    return document ? show_status(document->root) : document.error().text();
  };
  daemon.ros2.configured = true;
  daemon.ros2.connected = true;
  daemon.ros2.mode = "network";
  daemon.ros2.readers = 3;
  EXPECT_THAT(shown(),
              testing::HasSubstr("network  NONE IS THERE: this computer only  3 readers\n"));
  daemon.ros2.network = "eth0 192.0.2.2";
  EXPECT_THAT(shown(), testing::HasSubstr("network  eth0 192.0.2.2  3 readers\n"));
  daemon.ros2.unused = "wlan0 192.0.2.130";
  EXPECT_THAT(shown(),
              testing::HasSubstr("network  eth0 192.0.2.2  3 readers  NOT ON wlan0 192.0.2.130\n"));
  daemon.ros2.network.clear();
  daemon.ros2.reason = "the DDS domain cannot be made";
  EXPECT_THAT(shown(), testing::HasSubstr("network  the DDS domain cannot be made"));
}

TEST(StatusInShort, TellsWhatCameOfTheSceneFromRos2) {
  publish::DaemonStatus daemon;
  daemon.ros2.configured = true;
  daemon.ros2.connected = true;
  daemon.ros2.scene_done = 13;
  daemon.ros2.scene_refused = 1;
  daemon.ros2.scene_refusal = "collision_object 'no\u202Eabc\x1B[31m': id: is bad";
  const auto document = json::parse(publish::status_json(full_snapshot(), daemon));
  ASSERT_TRUE(document);
  EXPECT_NE(show_status(document->root)
                .find("\nros2 scene 13 done  1 refused, last collision_object 'no?abc?[31m': id"),
            std::string::npos)
      << "the label and the value are two words, and nothing turns the line or moves the terminal";
}

TEST(StatusInShort, CountsAnswersThatNobodyGot) {
  const auto shown = [](std::uint64_t lost) {
    publish::DaemonStatus daemon;
    daemon.broker_connected = true;
    daemon.answers_lost = lost;
    const auto document = json::parse(publish::status_json(full_snapshot(), daemon));
    return document ? show_status(document->root) : document.error().text();
  };
  EXPECT_NE(shown(4).find("broker    connected  4 ANSWERS LOST\n"), std::string::npos);
  EXPECT_NE(shown(0).find("broker    connected\n"), std::string::npos);
}

class WhatIsFree : public testing::Test {
 protected:
  WhatIsFree() {
    s.time = kNow;
    s.clearance = {.configured = true,
                   .time = kNow - 60ms,
                   .ahead_m = 2.31,
                   .back_m = 3,
                   .left_rad = 3.14159,
                   .right_rad = 0.7,
                   .first = "crate is in the way, 2.31 m ahead"};
  }
  json::Node status() const {
    auto document = json::parse(publish::status_json(s, {}));
    if (!document) ADD_FAILURE() << document.error().text();
    return document ? document->root : json::Node{};
  }
  void expect_shown(const char* part) const {
    const auto text = show_status(status());
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  }
  Snapshot s;
};

TEST_F(WhatIsFree, IsShownWithWhatIsMetFirst) {
  expect_shown(
      "free      2.31 m ahead, 3.00 m back, 180 deg left, 40 deg right; "
      "crate is in the way, 2.31 m ahead\n");
  s.clearance.along_m = 7.5;
  expect_shown("40 deg right, 7.50 m on its track; crate");
}

TEST_F(WhatIsFree, IsTellingWhyItIsNotKnown) {
  s.clearance = {.configured = true, .unknown = "the lidar sees nothing"};
  expect_shown("free      not known: the lidar sees nothing\n");
}

TEST_F(WhatIsFree, NamesTheConstraintThatDoesNotHold) {
  s.clearance.broken = "the fence of field_north: 0.20 m outside";
  expect_shown("\n          the fence of field_north: 0.20 m outside\n");
}

TEST_F(WhatIsFree, IsOfTheStatusWithItsAge) {
  const auto document = status();
  const auto& free = *document.find("clearance");
  EXPECT_NEAR(free.find("age_s")->number().value_or(0), 0.06, 1e-9);
  EXPECT_EQ(free.find("right_rad")->number().value_or(0), 0.7);
  EXPECT_TRUE(free.find("along_m")->is_null()) << "there is no task";
}

TEST_F(WhatIsFree, IsNotSpokenOfWhereNobodyLooks) {
  s.clearance = {};
  const auto document = status();
  EXPECT_TRUE(document.find("clearance")->is_null());
  EXPECT_EQ(show_status(document).find("free "), std::string::npos);
}

TEST(StatusInShort, ShowsADashForWhatWasNeverHeardAndNoNumbers) {
  Snapshot s;
  s.time = kNow;
  s.gnss.configured = s.imu.configured = s.battery.configured = true;
  s.battery.source.reason = "no line to it";
  AxisSnapshot axis;
  axis.joint = "front_left";
  axis.source.reason = "no heartbeat yet";
  (void)s.axes.push_back(axis);
  s.line_configured[0] = s.line_active[0] = true;
  const auto document = json::parse(publish::status_json(s, {}));
  ASSERT_TRUE(document);
  const auto text = show_status(document->root);
  for (const char* part :
       {"pose      -\n", "gnss      -  never heard\n", "battery   -  never heard  no line to it\n",
        "front_left    -  never heard  no heartbeat yet\n", "estop -"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  EXPECT_EQ(text.find("--"), std::string::npos) << text;
  for (const auto& view : device_views())
    if (view.name == "gnss") {
      EXPECT_NE(view.show(document->root).find("satellites -"), std::string::npos)
          << view.show(document->root);
    }
}

TEST(StatusInShort, TellsNoYawBeforeOneIsKnown) {
  Snapshot s;
  s.time = kNow;
  s.pose.time = kNow;
  s.pose.position_sigma_m = 0.012;
  const auto pose = [&s](double yaw_sigma_rad) {
    s.pose.yaw_sigma_rad = yaw_sigma_rad;
    const auto document = json::parse(publish::status_json(s, {}));
    return document ? show_status(document->root) : std::string();
  };
  EXPECT_NE(pose(0.01).find("  yaw 0.000 rad  +- 0.012 m"), std::string::npos) << pose(0.01);
  EXPECT_NE(pose(kPi).find("  yaw -  +- 0.012 m"), std::string::npos) << pose(kPi);
}

TEST_F(StatusViews, CarryEveryCounter) {
  const auto count = [this](const char* part, const char* key) {
    return status.find(part)->find(key)->integer().value_or(-1);
  };
  EXPECT_EQ(count("estimator", "absurd"), 1);
  EXPECT_EQ(count("estimator", "late"), 2);
  EXPECT_EQ(count("estimator", "repeated"), 3);
  EXPECT_EQ(count("estimator", "refused"), 4);
  EXPECT_EQ(count("estimator", "broken"), 5);
  EXPECT_EQ(count("cycle", "notices_dropped"), 6);
  EXPECT_EQ(count("gnss", "overflows"), 7);
  EXPECT_EQ(count("joint_commands", "unread"), 40);
  EXPECT_EQ(count("joint_commands", "of_rivals"), 7);
  EXPECT_EQ(*status.find("joint_commands")->find("rivals")->text(), "two programs write");
}

}  // namespace
}  // namespace drover::cli
