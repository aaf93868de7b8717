#include "gateway/slots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "recorded_run.h"

namespace drover::gateway {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Wiring, HasTheBusesFirstAndAPlaceForEachDevice) {
  engine::Environment environment;
  const Wiring wiring = wire_up(load_robot().config, environment);
  std::vector<std::string> links;
  for (const Link& link : wiring.links) links.emplace_back(link.name);
  EXPECT_THAT(links, ElementsAre("can0", "gnss", "imu", "battery", "lines"));
  std::vector<std::string> slots;
  for (const Slot& slot : wiring.slots) slots.emplace_back(slot.name);
  EXPECT_THAT(slots, ElementsAre("left", "right", "gnss", "imu", "battery", "estop", "bumper"));
  EXPECT_THAT(wiring.links[0].slots, ElementsAre(0, 1));
  EXPECT_THAT(wiring.links[4].slots, ElementsAre(5, 6));
}

TEST(Wiring, TellsEachDevicesHealthWhereTheEngineLooks) {
  engine::Environment environment;
  const Wiring wiring = wire_up(load_robot().config, environment);
  EXPECT_EQ(wiring.slots[1].tells_health[0], &environment.axes[1]);
  EXPECT_EQ(wiring.slots[2].tells_health[0], &environment.gnss[0]);
  EXPECT_EQ(wiring.slots[3].tells_health[0], &environment.imu[0]);
  EXPECT_EQ(wiring.slots[4].tells_health[0], &environment.battery[0]);
  EXPECT_EQ(wiring.slots[6].tells_health[0],
            &environment.lines[static_cast<std::size_t>(drover::Line::bumper)]);
}

TEST(Wiring, GivesTheSlowThreadWhatIsPolled) {
  engine::Environment environment;
  const Wiring wiring = wire_up(load_robot().config, environment);
  for (const Slot& slot : wiring.slots)
    EXPECT_EQ(slot.thread == Slot::Thread::slow, slot.kind == SlotKind::battery);
}

TEST(Wiring, LeavesAScannerAndItsLineToTheScene) {
  auto text = changed(robot_configuration(), R"("gnss": {"serial")",
                      R"("lidar": {"serial": "/dev/drover/lidar"}, "gnss": {"serial")");
  text = changed(text, R"("gnss": {"driver")",
                 R"("lidar": {"driver": "ld06", "link": "lidar", "options": {"mount_x_m": 0.4,
      "mount_y_m": 0, "mount_z_m": 0.3, "mount_yaw_deg": 0}}, "gnss": {"driver")");
  text = changed(text, R"("limits": {)",
                 R"("scene": {"footprint": [{"x_m": 0.5, "y_m": 0.35}, {"x_m": -0.5, "y_m": 0.35},
      {"x_m": -0.5, "y_m": -0.35}, {"x_m": 0.5, "y_m": -0.35}]}, "limits": {)");
  const auto loaded = load_robot(text);
  ASSERT_TRUE(loaded.problems.empty()) << loaded.problems.front().text("robot");
  engine::Environment environment;
  const Wiring wiring = wire_up(loaded.config, environment);
  for (const Link& link : wiring.links) EXPECT_NE(link.name, "lidar");
  for (const Slot& slot : wiring.slots) EXPECT_NE(slot.name, "lidar");
  EXPECT_EQ(wiring.slots[2].name, "gnss");
  EXPECT_EQ(wiring.links[wiring.slots[2].link].name, "gnss");
}

TEST(Wiring, PutsBusesAndDrivesFirstWhereverTheyStand) {
  auto text = changed(robot_configuration(), R"(    "can0": {"can": "can0"},)", "");
  text = changed(text, R"("panel": {"gpio": "chip0"})",
                 R"("panel": {"gpio": "chip0"}, "can0": {"can": "can0"})");
  const std::string gnss = R"(    "gnss": {"driver": "nmea0183", "link": "gnss"},)";
  text = changed(changed(text, gnss, ""), R"("devices": {)", R"("devices": {)" + gnss);
  engine::Environment environment;
  const auto loaded = load_robot(text);
  ASSERT_TRUE(loaded.problems.empty());
  const Wiring wiring = wire_up(loaded.config, environment);
  EXPECT_EQ(wiring.links[0].name, "can0");
  EXPECT_EQ(wiring.slots[0].name, "left");
  EXPECT_EQ(wiring.slots[2].name, "gnss");
}

TEST(Wiring, RefusesADriverOfAnotherKindNamingItsPlace) {
  auto config = load_robot().config;
  config.devices[1].driver = "nmea0183";
  engine::Environment environment;
  try {
    wire_up(config, environment);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("devices.right: no driver \"nmea0183\" of this kind"));
  }
}

/// The e-stop hangs on a chip of its own, the bumper stays on the first one.
class TwoChips : public ::testing::Test {
 protected:
  static std::string text() {
    auto text = changed(robot_configuration(), R"("panel": {"gpio": "chip0"})",
                        R"("panel": {"gpio": "chip0"}, "cab": {"gpio": "chip1"})");
    return changed(text, R"("link": "panel", "line": "a", "is": "estop")",
                   R"("link": "cab", "line": "a", "is": "estop")");
  }
  TwoChips() : gateway(load_robot(text()).config) {}
  LinkId link(const char* name) const {
    for (std::size_t i = 0; i < gateway.wiring().links.size(); ++i)
      if (gateway.wiring().links[i].name == name) return static_cast<LinkId>(i);
    throw std::logic_error(name);
  }
  void cycle(bool estop_high, bool bumper_high) {
    now += std::chrono::milliseconds(5);
    for (const auto& [chip, high] : {std::pair{"cab", estop_high}, {"panel", bumper_high}}) {
      LevelsRead read;
      read.link = link(chip);
      (void)read.levels.push_back(high);
      gateway.apply({now, read});
    }
    gateway.apply({now, Tick{true, false}});
  }
  std::string why() const {
    std::string all;
    for (const Reason& reason : gateway.snapshot().why) all += std::string(reason.view()) + "; ";
    return all;
  }

  Time now{std::chrono::seconds(100)};
  Gateway gateway;
};

TEST_F(TwoChips, AreBothRead) {
  const auto cycles = [this](bool estop_high, bool bumper_high) {
    for (int i = 0; i < 20; ++i) cycle(estop_high, bumper_high);
    return why();
  };
  EXPECT_THAT(cycles(true, true), Not(AnyOf(HasSubstr("e-stop"), HasSubstr("bumper"))));
  EXPECT_THAT(cycles(false, true), AllOf(HasSubstr("e-stop"), Not(HasSubstr("bumper"))));
  EXPECT_THAT(cycles(true, false), HasSubstr("bumper touched"));
}

TEST_F(TwoChips, AreLostEachByItself) {
  cycle(true, true);
  for (int i = 0; i < 400; ++i) {
    now += std::chrono::milliseconds(5);
    LevelsRead read;
    read.link = link("panel");
    (void)read.levels.push_back(true);
    gateway.apply({now, read});
    gateway.apply({now, Tick{true, false}});
  }
  EXPECT_THAT(why(), HasSubstr("line e-stop")) << "its chip says nothing any more";
  EXPECT_THAT(why(), Not(HasSubstr("line bumper")));
}

}  // namespace
}  // namespace drover::gateway
