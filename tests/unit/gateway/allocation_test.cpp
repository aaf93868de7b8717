#include <gtest/gtest.h>

#include <random>

#include "one_of_each_input.h"
#include "recorded_run.h"
#include "support/allocation_counter.h"
#include "support/simulated_robots.h"

namespace drover::gateway {
namespace {

TEST(Gateway, AllocatesNothingWhateverReachesIt) {
  Gateway gateway(load_robot().config);
  OneOfEachInput all;
  std::vector<bool> seen(kInputKinds, false);
  for (const auto& input : all.inputs) seen[kind_of(input)] = true;
  EXPECT_EQ(std::count(seen.begin(), seen.end(), false), 0) << "a kind of input is not tried";
  test::AllocationCounter counter;
  for (int round = 0; round < 20; ++round)
    for (Input input : all.inputs) {
      input.time += round * std::chrono::milliseconds(100);
      gateway.apply(input);
    }
  EXPECT_EQ(counter.count(), 0U);
}

/// What every device listens to, with anything in it, and what a person may ask meanwhile.
class Chatter final {
 public:
  explicit Chatter(Gateway& gateway) : gateway_(gateway) {}

  void say(Time now) {
    const Wiring& wiring = gateway_.wiring();
    for (const Slot& slot : wiring.slots) {
      if (slot.made.frames != nullptr)
        for (const FrameFilter& filter : slot.made.frames->listens()) frame(slot, filter, now);
      if (slot.made.bytes != nullptr) bytes(slot, now);
      if (slot.made.levels != nullptr) levels(slot, now);
    }
    if (any() % 8 == 0) command(now);
  }

 private:
  std::uint32_t any() { return static_cast<std::uint32_t>(random_()); }
  void frame(const Slot& slot, const FrameFilter& filter, Time now) {
    CanFrame frame;
    frame.extended = filter.extended;
    frame.id = (filter.id & filter.mask) |
               (any() & ~filter.mask & (filter.extended ? 0x1FFFFFFFU : 0x7FFU));
    frame.len = static_cast<std::uint8_t>(any() % 3 == 0 ? any() % 9 : 8);
    for (auto& byte : frame.data) byte = static_cast<std::uint8_t>(any() % 4 == 0 ? any() : 0);
    gateway_.apply({now, FrameHeard{slot.link, frame}});
  }
  void bytes(const Slot& slot, Time now) {
    std::array<std::uint8_t, 40> some{};
    for (auto& byte : some) byte = static_cast<std::uint8_t>(any());
    gateway_.apply({now, BytesHeard{slot.link, some}});
  }
  void levels(const Slot& slot, Time now) {
    LevelsRead read{slot.link, {}};
    for (std::size_t i = 0; i < gateway_.wiring().links[slot.link].slots.size(); ++i)
      (void)read.levels.push_back(any() % 50 != 0);
    gateway_.apply({now, read});
  }
  void command(Time now) {
    Command command{{RequestId::Source::cli, ++asked_}, now, {}};
    JointTargets targets;
    (void)targets.joints.push_back({static_cast<AxisId>(any() % 4), 0.0});
    switch (any() % 5) {
      case 0: command.body = EngageStop{}; break;
      case 1: command.body = ResetStop{}; break;
      case 2: command.body = ArmHold{}; break;
      case 3: command.body = ReleaseHold{true}; break;
      default: command.body = targets;
    }
    gateway_.apply({now, CommandGiven{command}});
  }

  Gateway& gateway_;
  std::minstd_rand random_{1};
  std::uint64_t asked_ = 0;
};

class AnyRobot : public testing::TestWithParam<std::string> {};

TEST_P(AnyRobot, AllocatesNothingWhateverItsDevicesSay) {
  const auto loaded = config::load_file(test::robot_file(GetParam(), ".drover.json"));
  ASSERT_TRUE(loaded.problems.empty());
  Gateway gateway(loaded.config);
  Chatter chatter(gateway);
  RecordEncoder encoder;
  test::AllocationCounter counter;
  Time now{std::chrono::seconds(100)};
  std::size_t bytes = 0;
  for (int i = 0; i < 2000; ++i, now += std::chrono::milliseconds(5)) {
    for (LinkId link = 0; link < gateway.wiring().links.size(); ++link)
      if (i % 400 == 0) gateway.apply({now, LinkUp{link}});
    if (i % 400 < 300) chatter.say(now);  // and silence
    gateway.apply({now, Tick{true, i % 500 > 450, false}});
    bytes += encoder.output(gateway).size();
  }
  EXPECT_EQ(counter.count(), 0U);
  EXPECT_GT(bytes, 0U);
}
INSTANTIATE_TEST_SUITE_P(OfTheSimulator, AnyRobot, testing::ValuesIn(test::simulated_robots()),
                         [](const auto& robot) { return robot.param; });

TEST(RecordEncoder, AllocatesNothing) {
  Gateway gateway(load_robot().config);
  RecordEncoder encoder;
  OneOfEachInput all;
  RobotRun run = a_run();
  test::AllocationCounter counter;
  std::size_t bytes = 0;
  for (const auto* inputs : {&all.inputs, &run.inputs})
    for (const auto& input : *inputs) {
      bytes += encoder.input(input).size();
      gateway.apply(input);
      if (std::holds_alternative<Tick>(input.body)) bytes += encoder.output(gateway).size();
    }
  EXPECT_EQ(counter.count(), 0U);
  EXPECT_GT(bytes, 0U);
}

}  // namespace
}  // namespace drover::gateway
