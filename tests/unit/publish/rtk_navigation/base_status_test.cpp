#include "publish/rtk_navigation/base_status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "tests/unit/publish/examples.h"

namespace drover::publish {
namespace {

using json::Node;

const Node& at(const json::Document& document, const char* group, const char* field) {
  return *document.root.find(group)->find(field);
}

Snapshot good_snapshot() {
  Snapshot snapshot;
  snapshot.nav.locate = LocateState::good;
  snapshot.gnss.health = SourceState::fresh;
  snapshot.gnss.position.quality = FixQuality::rtk_fixed;
  snapshot.gnss.position.latitude_deg = 1;
  snapshot.gnss.position.longitude_deg = 2;
  snapshot.gnss.heading_deg = 45;
  snapshot.gnss.pose_latitude_deg = 23.1496524965123;
  snapshot.gnss.pose_longitude_deg = 113.0196366456667;
  snapshot.pose.x_m = 12.5;
  snapshot.pose.yaw_rad = 0;  // east
  snapshot.pose.wz_radps = 0.004363323129985824;
  AxisSnapshot axis;
  axis.health = SourceState::fresh;
  axis.state = AxisState::running;
  EXPECT_TRUE(snapshot.axes.push_back(axis));
  return snapshot;
}

json::Document status(const Snapshot& snapshot, const RtkConfig& config = {}) {
  return document_of(BaseStatus(config).text(snapshot));
}

BatterySnapshot good_battery() {
  BatterySnapshot battery;
  battery.configured = true;
  battery.health = SourceState::fresh;
  battery.time = Time{std::chrono::seconds(10)};
  battery.sample.soc_percent = 68;
  battery.sample.voltage_V = 51;
  battery.sample.current_A = -8;
  battery.sample.remaining_Ah = 34;
  battery.sample.temperature_degC = 23;
  battery.sample.flow = BatteryFlow::discharging;
  return battery;
}

TEST(BaseStatus, HasEveryFieldOfTheDocumentWithItsType) {
  const auto document = document_of(example("base_status"));
  for (const auto& ours : {status(Snapshot{}), status(good_snapshot())}) {
    for (const auto& group : *document.root.object()) {
      const Node* our_group = ours.root.find(group.key);
      ASSERT_NE(our_group, nullptr) << group.key;
      for (const auto& field : *group.node.object()) {
        const Node* value = our_group->find(field.key);
        ASSERT_NE(value, nullptr) << group.key << "." << field.key;
        EXPECT_EQ(value->number().has_value(), field.node.number().has_value()) << field.key;
        EXPECT_EQ(value->text() != nullptr, field.node.text() != nullptr) << field.key;
        EXPECT_EQ(value->boolean() != nullptr, field.node.boolean() != nullptr) << field.key;
      }
    }
  }
}

TEST(BaseStatus, AddsNothingBesideWhatItDeclares) {
  const auto document = document_of(example("base_status"));
  const auto ours = status(good_snapshot());
  std::vector<std::string> added;
  for (const auto& group : *ours.root.object()) {
    const Node* theirs = document.root.find(group.key);
    ASSERT_NE(theirs, nullptr) << group.key;
    for (const auto& field : *group.node.object()) {
      if (theirs->find(field.key) == nullptr) added.push_back(group.key + "." + field.key);
    }
  }
  EXPECT_THAT(added, testing::ElementsAre("bms.valid", "nav.owner", "nav.why", "robot.valid"));
}

TEST(BaseStatus, SaysHowManyMetresAreLeftOnlyWithoutAFix) {
  Snapshot snapshot = good_snapshot();
  snapshot.nav.metres_left = 12.5;
  EXPECT_EQ(at(status(snapshot), "nav", "metres_left").number(), 12.5);
  snapshot.nav.metres_left = kAbsent;
  EXPECT_EQ(status(snapshot).root.find("nav")->find("metres_left"), nullptr);
}

TEST(BaseStatus, SaysHowWrongThePlaceMayBeWhileThereIsOne) {
  Snapshot snapshot = good_snapshot();
  snapshot.nav.error_bound_m = 0.02449;
  EXPECT_EQ(at(status(snapshot), "nav", "error_bound_m").number(), 0.024);
  snapshot.nav.error_bound_m = kAbsent;
  EXPECT_EQ(status(snapshot).root.find("nav")->find("error_bound_m"), nullptr);
}

TEST(BaseStatus, BeforeAnythingIsKnownItClaimsNothing) {
  const auto ours = status(Snapshot{});
  EXPECT_EQ(*at(ours, "nav", "locate").text(), "LOCATE_UNINIT");
  EXPECT_EQ(*at(ours, "nav", "status").text(), "NAV_FREE");
  EXPECT_EQ(at(ours, "rtk", "status").integer(), 0);
  EXPECT_EQ(at(ours, "rtk", "latitude").number(), 0);
  EXPECT_EQ(at(ours, "bms", "error").integer(), 1);
  EXPECT_FALSE(*at(ours, "bms", "valid").boolean());
  for (const char* sensor : {"imu", "laser", "robot"}) {
    EXPECT_FALSE(*at(ours, "sensor", sensor).boolean()) << sensor;
  }
  EXPECT_EQ(at(ours, "robot", "robot_status").integer(), 8);
}

TEST(BaseStatus, CallsTheInertialSensorGoodOnlyWhenThereIsOneAndItIsFresh) {
  Snapshot snapshot = good_snapshot();
  for (const bool configured : {false, true}) {
    for (const SourceState state :
         {SourceState::never_heard, SourceState::fresh, SourceState::stale}) {
      snapshot.imu.configured = configured;
      snapshot.imu.health = state;
      EXPECT_EQ(*at(status(snapshot), "sensor", "imu").boolean(),
                configured && state == SourceState::fresh);
    }
  }
}

TEST(BaseStatus, NeverWritesWhatIsNoNumber) {
  Snapshot snapshot = good_snapshot();
  const double bad = std::numeric_limits<double>::quiet_NaN();
  BaseStatus publisher{RtkConfig{}};
  publisher.text(snapshot);
  snapshot.pose.x_m = snapshot.pose.yaw_rad = snapshot.worst_vx_mps = bad;
  snapshot.pose.wz_radps = std::numeric_limits<double>::infinity();
  snapshot.gnss.pose_latitude_deg = snapshot.gnss.pose_longitude_deg = bad;
  const auto ours = document_of(publisher.text(snapshot));
  EXPECT_EQ(at(ours, "pose", "x").number(), 12.5);
  EXPECT_EQ(at(ours, "rtk", "latitude").number(), 23.1496524965);
  EXPECT_EQ(at(ours, "rtk", "angle").number(), 90);
}

TEST(BaseStatus, TakesRtkOfThePosesOwnInstantWhileLocated) {
  const auto ours = status(good_snapshot());
  EXPECT_EQ(at(ours, "rtk", "latitude").number(), 23.1496524965);
  EXPECT_EQ(at(ours, "rtk", "longitude").number(), 113.0196366457);
  EXPECT_EQ(at(ours, "rtk", "angle").number(), 90);
  EXPECT_EQ(at(ours, "robot", "vz").number(), 0.0044);
}

TEST(BaseStatus, ShowsTheSteeringAngleWhereItIsAskedFor) {
  Snapshot snapshot = good_snapshot();
  snapshot.base.configured = true;
  snapshot.base.steering_rad = -0.25;
  snapshot.pose.wz_radps = 0;
  RtkConfig config;
  config.vz = TurnShown::steering_angle;
  BaseStatus publisher{config};
  EXPECT_EQ(at(document_of(publisher.text(snapshot)), "robot", "vz").number(), -0.25);
  snapshot.base.steering_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(at(document_of(publisher.text(snapshot)), "robot", "vz").number(), -0.25);
  EXPECT_EQ(at(status(snapshot), "robot", "vz").number(), 0);
}

TEST(BaseStatus, TakesTheReceiversLastWordWhenNotLocated) {
  Snapshot snapshot = good_snapshot();
  snapshot.nav.locate = LocateState::lost;
  const auto ours = status(snapshot);
  EXPECT_EQ(*at(ours, "nav", "locate").text(), "LOCATE_FALSE");
  EXPECT_EQ(at(ours, "rtk", "latitude").number(), 1);
  EXPECT_EQ(at(ours, "rtk", "angle").number(), 45);
}

// The robot went on by dead reckoning since the receiver spoke last.
TEST(BaseStatus, KeepsTheLastPoseWhenTheReceiverIsSilentAndThePlaceIsLost) {
  BaseStatus publisher{RtkConfig{}};
  Snapshot snapshot = good_snapshot();
  publisher.text(snapshot);
  snapshot.gnss.health = SourceState::stale;
  snapshot.nav.locate = LocateState::lost;
  const auto lost = document_of(publisher.text(snapshot));
  EXPECT_EQ(at(lost, "rtk", "latitude").number(), 23.1496524965);
  EXPECT_EQ(at(lost, "rtk", "longitude").number(), 113.0196366457);
}

TEST(BaseStatus, ASilentReceiverHasNoFix) {
  Snapshot snapshot = good_snapshot();
  snapshot.gnss.health = SourceState::stale;
  EXPECT_EQ(at(status(snapshot), "rtk", "status").integer(), 0);
}

TEST(BaseStatus, KnowsOnlyTheDocumentsFixStates) {
  const int expected[] = {0, 1, 2, 1, 4, 5, 0, 0, 0};
  for (int i = 0; i < 9; ++i) EXPECT_EQ(rtk_status(static_cast<FixQuality>(i)), expected[i]) << i;
  EXPECT_EQ(rtk_status(static_cast<FixQuality>(9)), 0);
}

TEST(BaseStatus, CountsAnglesInTheConfiguredConvention) {
  using enum HeadingConvention;
  EXPECT_EQ(angle_deg_from_compass(clockwise_from_north, 90), 90);
  EXPECT_EQ(angle_deg_from_compass(clockwise_from_north, 360), 0);
  EXPECT_EQ(angle_deg_from_compass(counterclockwise_from_north, 90), 270);
  EXPECT_EQ(angle_deg_from_compass(counterclockwise_from_north, 0), 0);
  EXPECT_EQ(angle_deg_from_compass(counterclockwise_from_east, 90), 0);
  EXPECT_EQ(angle_deg_from_compass(counterclockwise_from_east, 0), 90);
  EXPECT_EQ(angle_deg_from_compass(counterclockwise_from_east, 180), 270);
}

TEST(BaseStatus, PublishesStopsAsTheChassisStatusBits) {
  Snapshot snapshot;
  const auto estop = static_cast<std::size_t>(Line::estop);
  const auto bumper = static_cast<std::size_t>(Line::bumper);
  snapshot.line_active[estop] = true;
  EXPECT_EQ(robot_status(snapshot), 8) << "a line that is not configured says nothing";
  snapshot.line_configured[estop] = true;
  snapshot.stop_latched = true;
  EXPECT_EQ(robot_status(snapshot), 8 + 1 + 4) << "it stays stopped when the button is released";
  snapshot.line_active[estop] = false;
  EXPECT_EQ(robot_status(snapshot), 8 + 4);
  snapshot.line_configured[bumper] = snapshot.line_active[bumper] = true;
  EXPECT_EQ(robot_status(snapshot), 8 + 4 + 16);
}

TEST(BaseStatus, CallsTheBaseHealthyOnlyWhenEveryDriveIs) {
  Snapshot snapshot = good_snapshot();
  EXPECT_TRUE(*at(status(snapshot), "sensor", "robot").boolean());
  AxisSnapshot axis = snapshot.axes[0];
  axis.health = SourceState::stale;
  ASSERT_TRUE(snapshot.axes.push_back(axis));
  EXPECT_FALSE(*at(status(snapshot), "sensor", "robot").boolean());
  snapshot.axes[1].health = SourceState::fresh;
  snapshot.axes[1].state = AxisState::fault;
  EXPECT_FALSE(*at(status(snapshot), "sensor", "robot").boolean());
}

TEST(BaseStatus, CallsTheScannerHealthyOnlyWhenItIsThereAndAnswers) {
  Snapshot snapshot = good_snapshot();
  EXPECT_FALSE(*at(status(snapshot), "sensor", "laser").boolean());
  const auto near = static_cast<std::size_t>(Line::zone_near);
  snapshot.line_configured[near] = true;
  EXPECT_FALSE(*at(status(snapshot), "sensor", "laser").boolean());
  snapshot.line_health[near] = SourceState::fresh;
  EXPECT_TRUE(*at(status(snapshot), "sensor", "laser").boolean());
}

TEST(BaseStatus, CallsTheScannersHealthyOnlyWhenEachIs) {
  Snapshot snapshot = good_snapshot();
  for (const SourceState first :
       {SourceState::never_heard, SourceState::fresh, SourceState::stale}) {
    snapshot.scanners.clear();
    ASSERT_TRUE(snapshot.scanners.push_back({.name = "front", .health = first, .source = {}}));
    EXPECT_EQ(*at(status(snapshot), "sensor", "laser").boolean(), first == SourceState::fresh);
    ASSERT_TRUE(
        snapshot.scanners.push_back({.name = "rear", .health = SourceState::stale, .source = {}}));
    EXPECT_FALSE(*at(status(snapshot), "sensor", "laser").boolean());
  }
  // Of a robot that has both, both count.
  snapshot.scanners.clear();
  ASSERT_TRUE(
      snapshot.scanners.push_back({.name = "front", .health = SourceState::fresh, .source = {}}));
  const auto near = static_cast<std::size_t>(Line::zone_near);
  snapshot.line_configured[near] = true;
  EXPECT_FALSE(*at(status(snapshot), "sensor", "laser").boolean());
  snapshot.line_health[near] = SourceState::fresh;
  EXPECT_TRUE(*at(status(snapshot), "sensor", "laser").boolean());
}

TEST(BaseStatus, PowerIsPercentOrVoltsAsConfigured) {
  Snapshot snapshot = good_snapshot();
  snapshot.axes[0].bus_V = 48.5;
  EXPECT_EQ(at(status(snapshot), "robot", "power").number(), 0);
  EXPECT_EQ(at(status(snapshot, {.power = PowerUnit::volts}), "robot", "power").number(), 48.5);
  snapshot.battery = good_battery();
  EXPECT_EQ(at(status(snapshot), "robot", "power").number(), 68);
  EXPECT_EQ(at(status(snapshot, {.power = PowerUnit::volts}), "robot", "power").number(), 51);
}

/// What a field is written as.
std::string written(const std::string& text, const std::string& group, const std::string& field) {
  const auto at = text.find("\"" + field + "\":", text.find("\"" + group + "\":"));
  const auto begin = at + field.size() + 3;
  return text.substr(begin, text.find_first_of(",}", begin) - begin);
}

TEST(BaseStatus, RoundsEachValueToItsUnit) {
  Snapshot snapshot = good_snapshot();
  snapshot.battery = good_battery();
  snapshot.battery.sample.current_A = -1.199999999999818;
  snapshot.battery.sample.voltage_V = 51.20000000000001;
  snapshot.battery.sample.soc_percent = 67.6000001;
  snapshot.battery.sample.remaining_Ah = 33.999999999;
  snapshot.battery.sample.temperature_degC = 23.04;
  snapshot.nav.metres_left = 7.600000001;
  snapshot.pose.x_m = 12.30000000000002;
  snapshot.pose.y_m = -1e-9;
  snapshot.pose.yaw_rad = 3.14159265358979;
  snapshot.pose.wz_radps = -0.00001;
  snapshot.worst_vx_mps = 0.49999999999;
  snapshot.pose.vy_mps = -0.3000000001;
  const auto text = BaseStatus(RtkConfig{}).text(snapshot);
  const struct {
    const char* group;
    const char* field;
    const char* text;
  } kExpected[] = {{"bms", "current", "-1.2"},
                   {"bms", "voltage", "51.2"},
                   {"bms", "soc", "67.6"},
                   {"bms", "remaining_capacity", "34"},
                   {"bms", "tem", "23"},
                   {"nav", "metres_left", "7.6"},
                   {"pose", "x", "12.3"},
                   {"pose", "y", "0"},
                   {"pose", "yaw", "3.14159"},
                   {"robot", "power", "68"},
                   {"robot", "vx", "0.5"},
                   {"robot", "vy", "-0.3"},
                   {"robot", "vz", "0"},
                   {"rtk", "angle", "270"},
                   {"rtk", "latitude", "23.1496524965"},
                   {"rtk", "longitude", "113.0196366457"}};
  for (const auto& [group, field, expected] : kExpected)
    EXPECT_EQ(written(text, group, field), expected) << group << "." << field;
  EXPECT_EQ(written(BaseStatus({.power = PowerUnit::volts}).text(snapshot), "robot", "power"),
            "51.2");
  snapshot.pose.yaw_rad = std::numbers::pi / 2 + 1e-7;  // a hair west of north
  EXPECT_EQ(written(BaseStatus(RtkConfig{}).text(snapshot), "rtk", "angle"), "0");
}

TEST(BaseStatus, KeepsTheLastOfABatteryThatIsSilentAndMarksItUnknown) {
  Snapshot snapshot = good_snapshot();
  snapshot.battery = good_battery();
  BaseStatus publisher{RtkConfig{}};
  const auto before = document_of(publisher.text(snapshot));
  EXPECT_TRUE(*at(before, "bms", "valid").boolean());
  EXPECT_EQ(at(before, "bms", "error").integer(), 0);
  EXPECT_EQ(at(before, "bms", "status").integer(), 2);
  snapshot.battery.health = SourceState::stale;
  snapshot.battery.sample = {};
  const auto after = document_of(publisher.text(snapshot));
  EXPECT_FALSE(*at(after, "bms", "valid").boolean());
  EXPECT_EQ(at(after, "bms", "error").integer(), 1);
  EXPECT_EQ(at(after, "bms", "soc").number(), 68);
  EXPECT_EQ(at(after, "bms", "voltage").number(), 51);
  EXPECT_EQ(at(after, "bms", "current").number(), -8);
  EXPECT_EQ(at(after, "robot", "power").number(), 68);
}

TEST(BaseStatus, NeverCallsABatteryKnownWhoseChargeIsNot) {
  Snapshot snapshot = good_snapshot();
  snapshot.battery = good_battery();
  snapshot.battery.sample.soc_percent = kAbsent;
  EXPECT_FALSE(*at(status(snapshot), "bms", "valid").boolean());
  EXPECT_EQ(at(status(snapshot), "bms", "error").integer(), 1);
}

TEST(BaseStatus, TellsThePacksAlarmsAndTheCharger) {
  Snapshot snapshot = good_snapshot();
  snapshot.battery = good_battery();
  snapshot.battery.sample.alarm = BatteryAlarm::warning;
  snapshot.battery.sample.flow = BatteryFlow::charging;
  snapshot.battery.sample.charger_connected = true;
  EXPECT_EQ(at(status(snapshot), "bms", "error").integer(), 2);
  EXPECT_EQ(at(status(snapshot), "bms", "status").integer(), 5);
  snapshot.battery.sample.alarm = BatteryAlarm::critical;
  EXPECT_EQ(at(status(snapshot), "bms", "error").integer(), 3);
}

TEST(BaseStatus, SaysWhyTheCauseFirst) {
  Snapshot snapshot = good_snapshot();
  ASSERT_TRUE(snapshot.why.push_back(Reason("e-stop pressed")));
  ASSERT_TRUE(snapshot.why.push_back(Reason("receiver silent")));
  const auto ours = status(snapshot);
  const auto& why = *at(ours, "nav", "why").list();
  ASSERT_EQ(why.size(), 2U);
  EXPECT_EQ(*why[0].text(), "e-stop pressed");
}

}  // namespace
}  // namespace drover::publish
