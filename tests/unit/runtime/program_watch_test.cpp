#include "runtime/program_watch.h"

#include <gtest/gtest.h>

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

constexpr Duration kCycle = 5ms;

class ProgramWatchTest : public testing::Test {
 protected:
  /// Cycles for so long; the main thread looks each 0.1 s if it lives.
  void cycles(Duration time, const char* reported, bool main_lives = true) {
    for (const Time end = now_ + time; now_ < end;) {
      now_ += kCycle;
      if (main_lives && now_ >= next_look_) {
        ++looks_;
        next_look_ = now_ + 100ms;
      }
      (void)watch_.update(reported, looks_, now_);
    }
  }

  ProgramWatch watch_;
  std::uint64_t looks_ = 0;
  Time now_ = Time{50s};
  Time next_look_ = now_;
};

TEST_F(ProgramWatchTest, SaysWhatTheMainThreadReportsAndThatItIsOver) {
  cycles(2s, nullptr);
  EXPECT_TRUE(watch_.why().empty());
  cycles(kCycle, "the publish thread stands still");
  EXPECT_EQ(watch_.why().view(), "the publish thread stands still");
  cycles(kCycle, nullptr);
  EXPECT_FALSE(watch_.trouble());
}

TEST_F(ProgramWatchTest, NoticesWithinASecondThatTheMainThreadItselfStandsStill) {
  cycles(2s, nullptr);
  cycles(950ms, nullptr, false);
  EXPECT_EQ(watch_.why().view(), "droverd's main thread stands still");
}

TEST_F(ProgramWatchTest, BlamesNobodyWhenTheWholeDaemonWasStopped) {
  cycles(2s, nullptr);
  now_ += 10s;
  cycles(kCycle, nullptr, false);
  EXPECT_FALSE(watch_.trouble());
}

TEST_F(ProgramWatchTest, LeavesTheDrivesToTheGuardAfterTheRobotCameToRest) {
  cycles(1s, "x");
  EXPECT_FALSE(watch_.leaves_to_guard(now_, false)) << "it still stops";
  EXPECT_TRUE(watch_.leaves_to_guard(now_, true));
  cycles(2500ms, "x");
  EXPECT_TRUE(watch_.leaves_to_guard(now_, false)) << "no stop takes so long";
}

TEST_F(ProgramWatchTest, KeepsTheDrivesWhileAllIsWell) {
  cycles(5s, nullptr);
  EXPECT_FALSE(watch_.leaves_to_guard(now_, true));
}

}  // namespace
}  // namespace drover::runtime
