// What holds of every robot of the simulator, while it drives.
#include <gmock/gmock.h>

#include <set>

#include "drover/registry.h"
#include "whole_robot.h"

namespace drover::test {
namespace {

class AnyRobot : public testing::TestWithParam<std::string> {};

TEST_P(AnyRobot, DrivesATaskWithoutAnAllocation) {
  WholeRobot robot(GetParam());
  robot.start_task();
  ASSERT_EQ(robot.seen().nav.status, NavStatus::run) << robot.why();
  robot.drive_s(60);
  EXPECT_EQ(robot.seen().nav.status, NavStatus::success) << robot.why();
  EXPECT_NEAR(robot.robot.truth().pose.x_m, robot.path.points.back().x_m, 0.2);
  EXPECT_EQ(robot.allocations, 0U);
  for (std::size_t link = 0; link < robot.gateway.wiring().links.size(); ++link)
    EXPECT_EQ(robot.gateway.refused(link), 0U) << robot.gateway.wiring().links[link].name.view();
}

/// The messages of this cycle on the device's link.
std::vector<Message> messages_to(const gateway::Gateway& gateway, const gateway::Slot& slot,
                                 Packet& packet) {
  if (slot.made.frames != nullptr) {
    const auto& frames = gateway.output().frames[slot.link];
    return {frames.begin(), frames.end()};
  }
  packet.clear();
  for (const auto& stream : gateway.output().streams)
    if (stream.link == slot.link)
      for (const auto byte : stream.bytes) (void)packet.push_back(byte);
  return {packet};
}

/// Counts for each channel of the base the cycles in which it was told nothing.
class Told {
 public:
  explicit Told(const WholeRobot& robot) : robot_(robot) {
    for (const gateway::Slot& slot : robot.gateway.wiring().slots)
      for (std::size_t i = 0; slot.of_base && i < slot.axes.size(); ++i)
        channels.push_back({&slot, robot.loaded.config.devices[slot.place].driver, i});
  }
  void cycle() {
    Packet packet;
    for (Channel& it : channels) {
      bool told = false;
      for (const Message& message : messages_to(robot_.gateway, *it.slot, packet))
        told = told || tells(it, message);
      it.untold = told ? 0 : it.untold + 1;
      it.longest = std::max(it.longest, it.untold);
    }
  }
  struct Channel {
    const gateway::Slot* slot;
    std::string driver;
    std::size_t number;  ///< within the device
    int untold = 0;
    int longest = 0;
  };
  std::vector<Channel> channels;

 private:
  bool tells(const Channel& channel, const Message& message) const {
    const Actuator& actuator = *channel.slot->made.actuator;
    const FrameEffect kind = actuator.effect(message, robot_.now).kind;
    if (kind != FrameEffect::stop && kind != FrameEffect::motion) return false;
    // It asks for currents, of all four of its motors in one frame.
    if (channel.driver == "robomaster_c620") return true;
    return std::isfinite(actuator.setpoint_radps(message, channel.number)) ||
           std::isfinite(actuator.setpoint_twist(message, channel.number).vx_mps);
  }

  const WholeRobot& robot_;
};

/// Cycles between two: a twist leaves each `command_period_s`, which is 20 ms.
int untold_between(const std::string& driver) {
  return driver.starts_with("gt01") ? 3 : 0;
}

/// In a task, while it is cancelled, and at rest for a while.
TEST_P(AnyRobot, TellsEachChannelOfItsBaseSomethingEachCycle) {
  WholeRobot robot(GetParam());
  robot.start_task();
  ASSERT_EQ(robot.seen().nav.status, NavStatus::run) << robot.why();
  robot.run_s(1);
  Told told(robot);
  const auto cycles = [&](int count) {
    for (int i = 0; i < count; ++i) {
      robot.cycle();
      told.cycle();
    }
  };
  cycles(600);
  robot.command(CancelTask{});
  cycles(1000);
  EXPECT_FALSE(told.channels.empty());
  for (const auto& it : told.channels)
    EXPECT_LE(it.longest, untold_between(it.driver)) << it.slot->name.view() << " " << it.number;
}

/// So that what is shown of any robot is shown of each driver.
TEST(TheRobotsOfTheSimulator, HaveADeviceOfEachDriver) {
  std::set<std::string_view> missing;
  for (const DriverEntry& entry : driver_registry()) missing.insert(entry.name);
  for (const std::string& robot : simulated_robots()) {
    const auto loaded = config::load_file(robot_file(robot, ".drover.json"));
    ASSERT_TRUE(loaded.problems.empty()) << loaded.problems.front().text(robot);
    for (const auto& device : loaded.config.devices) missing.erase(device.driver);
  }
  EXPECT_THAT(missing, testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(OfTheSimulator, AnyRobot, testing::ValuesIn(simulated_robots()),
                         [](const auto& robot) { return robot.param; });

}  // namespace
}  // namespace drover::test
