#include "runtime/supervisor.h"

#include <gtest/gtest.h>

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

class SupervisorTest : public testing::Test {
 protected:
  SupervisorTest() {
    supervisor_.watch({"quick", &quick_, 700ms});
    supervisor_.watch({"slow", &slow_, 5s});
  }
  /// Looks each period for so long; the first trouble, or "".
  std::string look(Duration time, bool quick_moves, bool slow_moves) {
    for (const Time end = now_ + time; now_ < end;) {
      now_ += Supervisor::kPeriod;
      if (quick_moves) ++quick_;
      if (slow_moves) ++slow_;
      if (const auto* stalled = supervisor_.stalled(now_)) return stalled->trouble;
    }
    return "";
  }

  std::atomic<std::uint64_t> quick_{0};
  std::atomic<std::uint64_t> slow_{0};
  Supervisor supervisor_;
  Time now_ = Time{100s};
};

TEST_F(SupervisorTest, IsContentWhileEachThreadMovesWithinItsOwnLimit) {
  EXPECT_EQ(look(10s, true, true), "");
  EXPECT_EQ(look(4s, true, false), "");
}

TEST_F(SupervisorTest, NamesTheThreadThatStandsStillWithinASecond) {
  (void)look(2s, true, true);
  const Time stopped = now_;
  EXPECT_EQ(look(2s, false, true), "quick");
  EXPECT_LT(now_ - stopped, 1s - Supervisor::kPeriod);
  EXPECT_EQ(look(1s, true, true), "") << "it moves again";
}

TEST_F(SupervisorTest, JudgesNobodyAfterItWasHeldUpItself) {
  (void)look(2s, true, true);
  now_ += 8s;
  EXPECT_EQ(supervisor_.stalled(now_), nullptr);
  EXPECT_EQ(look(2s, false, true), "quick") << "but what goes on standing still";
}

}  // namespace
}  // namespace drover::runtime
