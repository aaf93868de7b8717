#include "runtime/command_intake.h"

#include <gmock/gmock.h>

#include <string>
#include <thread>

#include "publish/aimrt/joint_commands.h"

namespace drover::runtime {
namespace {

using testing::ElementsAre;

class CommandIntakeTest : public testing::Test {
 protected:
  bool start() { return ring_->push(QueuedCommand{{{}, {}, StartTask{}}, stops_.asked()}); }
  /// What one cycle obeys, in order.
  std::vector<std::string> cycle() {
    std::vector<std::string> obeyed;
    intake_.take(*ring_, stops_, Time{}, [&](const Command& command) {
      const auto* const start = std::get_if<StartTask>(&command.body);
      obeyed.emplace_back(start != nullptr ? (start->overtaken ? "no start" : "start")
                          : std::holds_alternative<FindHeading>(command.body) ? "search"
                          : std::holds_alternative<CancelTask>(command.body)  ? "cancel"
                                                                              : "stop");
    });
    return obeyed;
  }

  std::unique_ptr<CommandRing> ring_ = std::make_unique<CommandRing>();
  StopRequests stops_;
  CommandIntake intake_;
};

TEST_F(CommandIntakeTest, ObeysStopsAndCommandsInTheOrderInWhichTheyWereAsked) {
  ASSERT_TRUE(start());
  stops_.ask_cancel();
  ASSERT_TRUE(start());
  stops_.ask_stop();
  EXPECT_THAT(cycle(), ElementsAre("start", "cancel", "start", "stop"));
  EXPECT_TRUE(cycle().empty()) << "each once";
}

TEST_F(CommandIntakeTest, HearsAStopWhileTheRingIsFull) {
  while (start()) {
  }
  stops_.ask_stop();
  EXPECT_EQ(cycle().back(), "stop");
}

TEST_F(CommandIntakeTest, HasRoomForAResetBesideTheBurstsOfBothWaysOfJointCommands) {
  const auto bursts = 2 * static_cast<int>(publish::aimrt::JointCommandsConfig{}.command_burst);
  for (int i = 0; i < bursts; ++i)
    ASSERT_TRUE(ring_->push(QueuedCommand{{{}, {}, JointTargets{}}, {}})) << i;
  EXPECT_TRUE(ring_->push(QueuedCommand{{{}, {}, ResetStop{}}, {}}));
}

TEST_F(CommandIntakeTest, TakesManyStopsOfOneCycleAsOne) {
  for (int i = 0; i < 10'000; ++i) stops_.ask_cancel();
  EXPECT_THAT(cycle(), ElementsAre("cancel"));
  EXPECT_TRUE(stops_.obeyed().include(stops_.asked()));
}

TEST_F(CommandIntakeTest, TakesAStartThatAStopHasOvertakenForNone) {
  const auto before = stops_.asked();
  stops_.ask_cancel();
  EXPECT_THAT(cycle(), ElementsAre("cancel"));
  ASSERT_TRUE(ring_->push(QueuedCommand{{{}, {}, StartTask{}}, before}));
  ASSERT_TRUE(start());
  EXPECT_THAT(cycle(), ElementsAre("no start", "start"));
}

TEST_F(CommandIntakeTest, StopsAnotherMotionAgainThatAStopHasOvertaken) {
  const auto before = stops_.asked();
  stops_.ask_cancel();
  EXPECT_THAT(cycle(), ElementsAre("cancel"));
  ASSERT_TRUE(ring_->push(QueuedCommand{{{}, {}, FindHeading{}}, before}));
  EXPECT_THAT(cycle(), ElementsAre("search", "cancel"));
}

TEST_F(CommandIntakeTest, TellsWithEachStopWhichOnesAreObeyedWithIt) {
  stops_.ask_stop();
  const auto first = stops_.ask_cancel();
  ASSERT_TRUE(start());
  const auto second = stops_.ask_cancel();
  std::vector<std::optional<StopCounts>> obeyed;
  intake_.take(*ring_, stops_, Time{},
               [&](const Command& command) { obeyed.push_back(obeyed_with(command.id)); });
  ASSERT_EQ(obeyed.size(), 4U) << "stop, cancel, start, cancel";
  EXPECT_TRUE(obeyed[1]->include(first));
  EXPECT_FALSE(obeyed[1]->include(second)) << "or it would be answered before the start";
  EXPECT_FALSE(obeyed[2]) << "a start answers no stop";
  EXPECT_TRUE(obeyed[3]->include(second));
}

TEST_F(CommandIntakeTest, LosesNoStopThatAnyThreadAsksFor) {
  std::thread main([this] {
    for (int i = 0; i < 1000; ++i) stops_.ask_cancel();
  });
  for (int i = 0; i < 1000; ++i) {
    const auto asked = stops_.ask_stop();
    (void)cycle();
    ASSERT_TRUE(stops_.obeyed().include(asked));
  }
  main.join();
  (void)cycle();
  EXPECT_EQ(stops_.obeyed().cancels, 1000U);
}

}  // namespace
}  // namespace drover::runtime
