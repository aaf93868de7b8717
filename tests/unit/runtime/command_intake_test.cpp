#include "runtime/command_intake.h"

#include <gmock/gmock.h>

#include <string>
#include <thread>

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
      obeyed.emplace_back(std::holds_alternative<StartTask>(command.body)    ? "start"
                          : std::holds_alternative<CancelTask>(command.body) ? "cancel"
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

TEST_F(CommandIntakeTest, TakesManyStopsOfOneCycleAsOne) {
  for (int i = 0; i < 10'000; ++i) stops_.ask_cancel();
  EXPECT_THAT(cycle(), ElementsAre("cancel"));
  EXPECT_TRUE(stops_.obeyed().include(stops_.asked()));
}

TEST_F(CommandIntakeTest, StopsAStartAgainThatAStopHasOvertaken) {
  const auto before = stops_.asked();
  stops_.ask_cancel();
  EXPECT_THAT(cycle(), ElementsAre("cancel"));
  ASSERT_TRUE(ring_->push(QueuedCommand{{{}, {}, StartTask{}}, before}));
  EXPECT_THAT(cycle(), ElementsAre("start", "cancel"));
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
