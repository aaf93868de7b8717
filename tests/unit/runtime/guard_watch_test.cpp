#include "runtime/guard_watch.h"

#include <gtest/gtest.h>

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

class AGuardWatch : public ::testing::Test {
 protected:
  /// Cycles of 5 ms; true when the bus was asked back in one of them.
  bool pass(Duration time, bool calm = true, bool at_once = false) {
    bool asked = false;
    for (const Time end = now + time; now < end;) {
      now += 5ms;
      if (guard_lives) ++signs.beats;
      (void)watch.update(signs, now);
      asked |= watch.ask_back(calm, at_once, now);
    }
    return asked;
  }
  void beat() {
    ++signs.beats;
    (void)watch.update(signs, now);
  }

  Time now{100s};
  bool guard_lives = true;
  GuardSigns signs;
  GuardWatch watch{50ms};
};

TEST_F(AGuardWatch, KnowsNoGuardThatWasNeverHeard) {
  EXPECT_FALSE(watch.alive(now));
}

TEST_F(AGuardWatch, GivesTheGuardWhatItGivesTheDaemonAndThreeCyclesMore) {
  guard_lives = false;
  beat();
  pass(75ms);
  EXPECT_TRUE(watch.alive(now));
  pass(5ms);
  EXPECT_FALSE(watch.alive(now));
  beat();
  EXPECT_TRUE(watch.alive(now));
}

/// Both stood still together: the guard is given what it gives droverd then.
TEST_F(AGuardWatch, JudgesNoGuardWhileItWasHeldUpItself) {
  pass(20ms);
  now += 300ms;
  (void)watch.update(signs, now);
  EXPECT_TRUE(watch.alive(now));
  guard_lives = false;
  pass(25ms);
  EXPECT_TRUE(watch.alive(now));
  pass(5ms);
  EXPECT_FALSE(watch.alive(now));
  now += 300ms;
  (void)watch.update(signs, now);
  EXPECT_FALSE(watch.alive(now)) << "once for each silence";
}

TEST_F(AGuardWatch, DoesNotTakeAGuardThatDiedMeanwhileForOneThatHolds) {
  signs.holds = true;
  pass(20ms);
  now += 300ms;
  (void)watch.update(signs, now);
  EXPECT_FALSE(watch.holds(now)) << "the drives are its own at once";
}

TEST_F(AGuardWatch, DoesNotBelieveForEverThatADeadGuardHoldsTheBus) {
  guard_lives = false;
  signs.holds = true;
  beat();
  pass(75ms);
  EXPECT_TRUE(watch.holds(now));
  pass(5ms);
  EXPECT_FALSE(watch.holds(now)) << "nobody sends anything then";
  EXPECT_FALSE(pass(2s)) << "who is gone is not asked";
}

TEST_F(AGuardWatch, TakesAGuardThatGoesOnForWhatItIsAtOnce) {
  guard_lives = false;
  signs.holds = true;
  beat();
  pass(1s);
  EXPECT_FALSE(watch.holds(signs, now));
  ++signs.beats;
  EXPECT_TRUE(watch.holds(signs, now)) << "before the next cycle looks at it";
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

/// Two would write otherwise, and what sank meanwhile would be torn back.
TEST_F(AGuardWatch, KnowsThatTheGuardMissedItsOwnHeartbeat) {
  pass(20ms);
  EXPECT_FALSE(watch.missed_us());
  now += 45ms;
  beat();
  EXPECT_FALSE(watch.missed_us()) << "the guard bears 50 ms";
  now += 50ms;
  beat();
  EXPECT_TRUE(watch.missed_us());
  now += 5ms;
  beat();
  EXPECT_FALSE(watch.missed_us()) << "it has a heartbeat again";
}

TEST_F(AGuardWatch, TellsOfALatchAndOfAStopSetThatTheGuardDidNotTake) {
  signs.holds = true;
  (void)watch.update(signs, now);
  EXPECT_FALSE(watch.latched());
  EXPECT_FALSE(watch.refuses_set());
  signs.latched = true;
  signs.set_refused = true;
  (void)watch.update(signs, now);
  EXPECT_TRUE(watch.latched());
  EXPECT_TRUE(watch.refuses_set());
}

}  // namespace
}  // namespace drover::runtime
