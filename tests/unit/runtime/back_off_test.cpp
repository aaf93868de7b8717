#include "runtime/back_off.h"

#include <gtest/gtest.h>

#include "runtime/link_keeper.h"

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

TEST(ABackOff, WaitsTwiceAsLongAfterEachTryUpToItsLongest) {
  BackOff retry(50ms, 300ms);
  const Time now{100s};
  EXPECT_TRUE(retry.due(now)) << "nothing was tried yet";
  for (const auto pause : {50ms, 100ms, 200ms, 300ms, 300ms}) {
    retry.tried(now);
    EXPECT_EQ(retry.next() - now, pause);
    EXPECT_FALSE(retry.due(now + pause - 1ms));
    EXPECT_TRUE(retry.due(now + pause));
  }
}

TEST(ABackOff, BeginsAnewAfterASuccess) {
  BackOff retry(50ms, 300ms);
  const Time now{100s};
  retry.tried(now);
  retry.tried(now);
  retry.succeeded();
  EXPECT_EQ(retry.next() - now, 100ms) << "when to try is not changed";
  retry.tried(now);
  EXPECT_EQ(retry.next() - now, 50ms);
}

TEST(ABackOff, TriesAtOnceWhenTold) {
  BackOff retry(50ms, 300ms);
  const Time now{100s};
  retry.tried(now);
  retry.try_now();
  EXPECT_TRUE(retry.due(now));
  retry.tried(now);
  EXPECT_EQ(retry.next() - now, 50ms);
}

/// An arm falls when its motors' time-outs, of 100 ms, run out.
TEST(ThePauseOfALink, OpensWhatWasGoneForAMomentBeforeAMotorLetsGo) {
  for (Duration gone{}; gone <= 70ms; gone += 1ms) {
    BackOff retry = kLinkPause;
    Time at{100s};
    while (at < Time{100s} + gone) {
      retry.tried(at);
      at = retry.next();
    }
    EXPECT_LE(at - Time{100s}, 80ms) << gone.count();
  }
}

}  // namespace
}  // namespace drover::runtime
