#include "runtime/guard_watch.h"

#include <gtest/gtest.h>

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

class AGuardWatch : public ::testing::Test {
 protected:
  /// Cycles of 5 ms; true when the bus was asked back in one of them.
  bool pass(Duration time, bool calm = true, bool rolls = false) {
    bool asked = false;
    for (const Time end = now + time; now < end;) {
      now += 5ms;
      (void)watch.update(signs, now);
      asked |= watch.ask_back(calm, rolls, now);
    }
    return asked;
  }
  void beat() {
    ++signs.beats;
    (void)watch.update(signs, now);
  }

  Time now{100s};
  GuardSigns signs;
  GuardWatch watch{50ms};
};

TEST_F(AGuardWatch, KnowsNoGuardThatWasNeverHeard) {
  EXPECT_FALSE(watch.alive(now));
}

TEST_F(AGuardWatch, GivesTheGuardWhatItGivesTheDaemonAndThreeCyclesMore) {
  beat();
  pass(75ms);
  EXPECT_TRUE(watch.alive(now));
  pass(5ms);
  EXPECT_FALSE(watch.alive(now));
  beat();
  EXPECT_TRUE(watch.alive(now));
}

TEST_F(AGuardWatch, AsksTheBusBackAfterHalfASecondAndAgainWhenItIsNotGiven) {
  EXPECT_FALSE(pass(2s)) << "the guard does not hold it";
  signs.holds = true;
  EXPECT_FALSE(pass(500ms));
  EXPECT_TRUE(pass(10ms));
  EXPECT_FALSE(pass(495ms));
  EXPECT_TRUE(pass(10ms));
}

TEST_F(AGuardWatch, AsksAtOnceForARobotThatRolls) {
  signs.holds = true;
  EXPECT_FALSE(pass(30ms, true, true));
  EXPECT_TRUE(pass(10ms, true, true));
}

TEST_F(AGuardWatch, LeavesTheBusToAGuardWhileATaskRunsOrTheProgramIsIll) {
  signs.holds = true;
  EXPECT_FALSE(pass(2s, false));
  EXPECT_TRUE(pass(10ms));
}

TEST_F(AGuardWatch, LeavesTheBusToAGuardThatIsLatchedAndTellsOfTheLatchOnce) {
  signs.holds = true;
  signs.latched = true;
  EXPECT_TRUE(watch.update(signs, now));
  EXPECT_FALSE(watch.update(signs, now));
  EXPECT_FALSE(pass(2s));
  signs.latched = false;
  EXPECT_TRUE(pass(10ms));
}

}  // namespace
}  // namespace drover::runtime
