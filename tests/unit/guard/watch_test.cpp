#include "guard/watch.h"

#include <gtest/gtest.h>

namespace drover::guard {
namespace {

using namespace std::chrono_literals;
constexpr Time kStart{std::chrono::seconds(100)};

/// The guard's cycles after `from` up to and with `to`, while the daemon says nothing new.
bool step_until(Watch& watch, std::uint64_t beats, Time from, Time to) {
  bool holds = false;
  for (Time t = from + 1ms; t <= to; t += 1ms) holds = watch.step(beats, t);
  return holds;
}

TEST(GuardWatch, SendsNothingBeforeASetIsInForce) {
  Watch watch;
  watch.lost();
  EXPECT_FALSE(watch.step(0, kStart));
  EXPECT_FALSE(watch.step(0, kStart + 10s));
}

TEST(GuardWatch, TakesTheBusWhenTheHeartbeatIsLate) {
  Watch watch;
  watch.begin(7, 50ms, kStart);
  EXPECT_FALSE(watch.step(8, kStart + 5ms));
  EXPECT_FALSE(step_until(watch, 8, kStart + 5ms, kStart + 55ms));
  EXPECT_TRUE(watch.step(8, kStart + 56ms));
}

TEST(GuardWatch, LetsTheDaemonShowItselfAfterItWasHeldUpItself) {
  Watch watch;
  watch.begin(7, 50ms, kStart);
  EXPECT_FALSE(watch.step(7, kStart + 180ms));
  EXPECT_FALSE(step_until(watch, 7, kStart + 180ms, kStart + 190ms));
  EXPECT_FALSE(watch.step(8, kStart + 191ms)) << "the daemon was held up as well and goes on";
}

TEST(GuardWatch, TakesTheBusWhenTheDaemonStaysSilentAfterBothWereHeldUp) {
  Watch watch;
  watch.begin(7, 50ms, kStart);
  EXPECT_FALSE(watch.step(7, kStart + 180ms));
  EXPECT_FALSE(step_until(watch, 7, kStart + 180ms, kStart + 200ms));
  EXPECT_TRUE(watch.step(7, kStart + 201ms));
}

TEST(GuardWatch, BeingHeldUpAgainAndAgainPutsTheHoldOffOnlyOnce) {
  Watch watch;
  watch.begin(7, 50ms, kStart);
  EXPECT_FALSE(watch.step(7, kStart + 30ms));
  EXPECT_TRUE(watch.step(7, kStart + 60ms));
}

TEST(GuardWatch, ASetThatIsOfferedAgainIsNoHeartbeat) {
  Watch watch;
  watch.begin(7, 50ms, kStart);
  for (int i = 1; i <= 5; ++i) {
    watch.begin_again(7, 50ms, kStart + i * 10ms);
    EXPECT_FALSE(watch.step(7, kStart + i * 10ms));
  }
  watch.begin_again(7, 50ms, kStart + 60ms);
  EXPECT_TRUE(watch.step(7, kStart + 60ms));
  watch.begin_again(7, 50ms, kStart + 61ms);
  watch.hand_back(kStart + 61ms);
  EXPECT_TRUE(watch.step(7, kStart + 61ms)) << "what is late gets no bus";
  watch.begin_again(8, 50ms, kStart + 62ms);
  watch.hand_back(kStart + 62ms);
  EXPECT_FALSE(watch.step(8, kStart + 62ms));
}

TEST(GuardWatch, AStopBeforeTheFirstSetHoldsUntilTheBusIsAskedFor) {
  Watch watch;
  watch.lost();
  EXPECT_FALSE(watch.step(0, kStart)) << "there is nothing to hold yet";
  watch.begin(7, 50ms, kStart);
  EXPECT_TRUE(watch.step(8, kStart + 1ms));
  watch.hand_back(kStart + 1ms);
  EXPECT_FALSE(watch.step(8, kStart + 2ms));
}

TEST(GuardWatch, TakesTheBusAtOnceWhenTheDaemonDies) {
  Watch watch;
  watch.begin(7, 50ms, kStart);
  watch.lost();
  EXPECT_TRUE(watch.step(7, kStart + 1ms));
}

TEST(GuardWatch, KeepsTheBusWhenTheHeartbeatComesBackUntilItIsAskedForIt) {
  Watch watch;
  watch.begin(7, 50ms, kStart);
  EXPECT_TRUE(step_until(watch, 7, kStart, kStart + 60ms));
  EXPECT_TRUE(watch.step(8, kStart + 65ms));
  watch.hand_back(kStart + 70ms);
  EXPECT_FALSE(watch.step(9, kStart + 75ms));
}

TEST(GuardWatch, DoesNotHandBackToADaemonWhoseHeartbeatIsLate) {
  Watch watch;
  watch.begin(7, 50ms, kStart);
  EXPECT_TRUE(step_until(watch, 7, kStart, kStart + 60ms));
  watch.hand_back(kStart + 70ms);
  EXPECT_TRUE(watch.step(7, kStart + 75ms));
}

TEST(GuardWatch, ANewDaemonDoesNotEndTheHoldByConnecting) {
  Watch watch;
  watch.begin(7, 50ms, kStart);
  watch.lost();
  EXPECT_TRUE(watch.step(7, kStart + 1ms));
  watch.begin(0, 50ms, kStart + 1s);
  EXPECT_TRUE(watch.step(1, kStart + 1s + 5ms));
}

}  // namespace
}  // namespace drover::guard
