#include "drivers/odrive/driver.h"

#include <gtest/gtest.h>

#include "driver_bench.h"

namespace drover::odrive {
namespace {

TEST(OdriveDriver, SendsNothingBeforeAHeartbeat) {
  Bench bench;
  bench.run(100, AxisRequest::rest);
  bench.run(100, AxisRequest::run, 1.0);
  bench.run(100, AxisRequest::idle);
  EXPECT_TRUE(bench.sent.empty());
  EXPECT_EQ(bench.status.state, AxisState::unknown);
}

/// Its answers alone may be lost, and it may hold the robot; a zero arms nothing.
TEST(OdriveDriver, IsFedBeforeAHeartbeatWhereItHeldBefore) {
  Bench bench;
  bench.held = true;
  bench.run(100, AxisRequest::rest);
  EXPECT_EQ(bench.count(kZero), 100);
  bench.run(100, AxisRequest::run, 1.0);
  EXPECT_EQ(bench.count(kZero), 200);
  EXPECT_EQ(bench.sent.size(), 200U);
  bench.sent.clear();
  bench.run(100, AxisRequest::idle);
  EXPECT_TRUE(bench.sent.empty());
}

TEST(OdriveDriver, IsFedAfterANewLinkOnlyIfItWasInClosedLoop) {
  for (const char* const beat : {kRunningBeat, kIdleBeat}) {
    Bench bench;
    bench.hear(beat);
    bench.run(10, AxisRequest::rest);
    bench.driver.on_link_up(bench.now);
    bench.sent.clear();
    bench.run(100, AxisRequest::rest);
    EXPECT_EQ(bench.count(kZero), beat == kRunningBeat ? 100 : 0) << beat;
    bench.run(1, AxisRequest::idle);
    bench.sent.clear();
    bench.run(100, AxisRequest::rest);
    EXPECT_TRUE(bench.sent.empty()) << "it was let go";
  }
}

TEST(OdriveDriver, IsNotWokenByEstimatesAlone) {
  Bench bench;
  bench.hear("069#00004841000050C0");
  bench.run(100, AxisRequest::rest);
  EXPECT_TRUE(bench.sent.empty());
  EXPECT_EQ(bench.driver.health(bench.now).state, SourceState::stale);
}

TEST(OdriveDriver, DoesNotArmWhenAskedWhileTheDriveWasSilent) {
  Bench bench;
  bench.run(10, AxisRequest::run, 1.0);
  bench.run(200, AxisRequest::run, 1.0, kIdleBeat);
  EXPECT_EQ(bench.count(kClosedLoop), 0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
}

TEST(OdriveDriver, FeedsAnIdleDriveWithZeros) {
  Bench bench;
  bench.hear(kIdleBeat);
  bench.run(40, AxisRequest::rest);
  EXPECT_EQ(bench.count(kZero), 40);
  EXPECT_EQ(bench.sent.size(), 40U);
}

TEST(OdriveDriver, FeedsEvenWhenNobodyCommands) {
  Bench bench;
  bench.arm();
  for (int i = 0; i < 10; ++i) {
    bench.now += milliseconds(5);
    bench.out.clear();
    bench.driver.on_tick(bench.now, bench.out);
    ASSERT_EQ(bench.out.frames.size(), 1U);
    EXPECT_EQ(describe(bench.out.frames[0]), kZero);
  }
}

TEST(OdriveDriver, ArmsWithModeThenZeroThenClosedLoop) {
  Bench bench;
  bench.hear(kIdleBeat);
  bench.run(1, AxisRequest::rest);
  bench.sent.clear();
  bench.run(2, AxisRequest::run, 2.0);
  EXPECT_EQ(bench.sent, (std::vector<std::string>{kMode, kZero, kZero, kClosedLoop}));
  EXPECT_EQ(bench.status.state, AxisState::arming);
}

// What waits for the bus is limited to so many, and the drives are armed all at once.
TEST(OdriveDriver, SendsNoMoreThanTwoFramesInACycleWhileItIsArmed) {
  Bench bench;
  bench.hear("061#0000000101030000");
  bench.run(1, AxisRequest::rest);
  bench.sent.clear();
  std::size_t before = 0;
  for (int i = 0; i < 100; ++i) {
    bench.run(1, AxisRequest::run, 1.0);
    ASSERT_LE(bench.sent.size() - before, 2U) << "cycle " << i;
    before = bench.sent.size();
  }
  EXPECT_EQ(bench.sent[0], kClear);
  EXPECT_GE(bench.count(kClosedLoop), 2);
}

TEST(OdriveDriver, SendsOnlyZeroUntilTheDriveSaysClosedLoopAndRetries) {
  Bench bench;
  bench.hear(kIdleBeat);
  bench.run(1, AxisRequest::rest);
  bench.run(100, AxisRequest::run, 2.0, kIdleBeat);  // 0.5 s
  EXPECT_EQ(bench.motions(), 0);
  EXPECT_EQ(bench.count(kClosedLoop), 5);
  EXPECT_GE(bench.count(kZero), 100);
  bench.hear(kRunningBeat);
  bench.run(1, AxisRequest::run, 2.0 * 3.14159265358979 * 2);
  EXPECT_EQ(bench.sent.back(), "06D#0000004000000000");  // 2 turns/s
}

TEST(OdriveDriver, DoesNotBelieveAClosedLoopFromBeforeItsRequest) {
  Bench bench;
  bench.hear(kRunningBeat);
  bench.run(1, AxisRequest::rest);
  bench.run(1, AxisRequest::run, 2.0);
  bench.hear(kRunningBeat);  // was under way
  bench.run(1, AxisRequest::run, 2.0);
  EXPECT_EQ(bench.motions(), 0);
  bench.run(10, AxisRequest::run, 2.0);
  bench.hear(kRunningBeat);
  bench.run(1, AxisRequest::run, 2.0);
  EXPECT_EQ(bench.motions(), 1);
}

TEST(OdriveDriver, GivesUpArmingInTimeAndSaysWhy) {
  Bench bench;
  bench.hear(kIdleBeat);
  bench.run(1, AxisRequest::rest);
  bench.run(450, AxisRequest::run, 2.0, "061#00000000010E0000");
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason, "does not enter closed loop: not calibrated");
  bench.sent.clear();
  bench.run(100, AxisRequest::run, 2.0, kIdleBeat);
  EXPECT_EQ(bench.count(kClosedLoop), 0);
}

TEST(OdriveDriver, ClearsErrorsOnceForEachRequest) {
  Bench bench;
  const std::string failed = "061#0000000101030000";
  bench.hear(failed);
  bench.run(100, AxisRequest::rest, 0, failed);
  EXPECT_EQ(bench.count(kClear), 0);
  EXPECT_EQ(bench.status.state, AxisState::idle) << "nobody fed it: it is well";
  EXPECT_EQ(bench.status.reason,
            "its watchdog ran out while nobody fed it: cleared at the next start");
  bench.run(200, AxisRequest::run, 1.0, failed);
  EXPECT_EQ(bench.count(kClear), 1);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason, "error does not clear: watchdog expired");
  bench.run(10, AxisRequest::rest, 0, failed);
  bench.run(200, AxisRequest::run, 1.0, failed);
  EXPECT_EQ(bench.count(kClear), 2);
  EXPECT_EQ(bench.motions(), 0);
}

TEST(OdriveDriver, TakesAWatchdogThatRanOutBesideAnotherErrorForAFault) {
  Bench bench;
  bench.hear("061#0010000101030000");
  bench.run(10, AxisRequest::rest, 0, "061#0010000101030000");
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason, "current limit violated; watchdog expired");
}

TEST(OdriveDriver, TellsAnUnfedDriveOfTheOldFirmwareToo) {
  Bench bench(options().set("firmware", std::string("0.5.6")));
  bench.hear("061#0008000001000000");
  bench.run(10, AxisRequest::rest, 0, "061#0008000001000000");
  EXPECT_EQ(bench.status.state, AxisState::idle);
  bench.run(20, AxisRequest::rest, 0, "061#0008000001010000");
  EXPECT_EQ(bench.status.state, AxisState::fault) << "the motor reports an error, too";
}

TEST(OdriveDriver, RunsAfterAnErrorThatClears) {
  Bench bench;
  bench.hear("061#0000000101030000");
  bench.run(1, AxisRequest::rest);
  bench.run(10, AxisRequest::run, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::arming);
  bench.hear(kRunningBeat);
  EXPECT_EQ(bench.status.state, AxisState::running);
}

TEST(OdriveDriver, TakesLeavingClosedLoopWithoutAnErrorForAFault) {
  Bench bench;
  bench.arm();
  bench.run(10, AxisRequest::run, 1.0);
  EXPECT_EQ(bench.motions(), 10);
  bench.hear(kIdleBeat);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason, "left closed loop");
  bench.sent.clear();
  bench.run(200, AxisRequest::run, 1.0, kIdleBeat);
  EXPECT_EQ(bench.motions(), 0);
  EXPECT_EQ(bench.count(kClosedLoop), 0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  bench.run(1, AxisRequest::rest);
  EXPECT_EQ(bench.status.state, AxisState::idle);
  bench.run(2, AxisRequest::run);
  EXPECT_EQ(bench.count(kClosedLoop), 1);
}

TEST(OdriveDriver, AsksForTheReasonAtOnceWhenADriveStops) {
  Bench bench;
  bench.arm();
  bench.hear("061#0020000001030000");
  bench.run(2, AxisRequest::run, 1.0);
  EXPECT_EQ(bench.count("063#R"), 1);
  bench.hear("063#0020000000200000");
  EXPECT_EQ(bench.status.reason, "left closed loop: motor over temperature");
  EXPECT_EQ(bench.status.error_code, 0x2000U);
}

TEST(OdriveDriver, AsksForAllThreeReasonsOnOldFirmware) {
  Bench bench(options().set("firmware", std::string("0.5.6")));
  bench.arm();
  bench.hear("061#4000000001010000");
  bench.run(5, AxisRequest::run, 1.0);
  EXPECT_EQ(bench.count("063#R"), 1);
  EXPECT_EQ(bench.count("064#R"), 1);
  EXPECT_EQ(bench.count("07D#R"), 1);
  bench.hear("063#0000000008000000");
  bench.run(1, AxisRequest::run, 1.0);
  EXPECT_EQ(bench.status.reason, "left closed loop: motor failed; unbalanced phases");
}

TEST(OdriveDriver, StaysLockedWhenTheHeartbeatComesBackInClosedLoop) {
  Bench bench;
  bench.arm();
  bench.run(70, AxisRequest::run, 1.0);  // 0.35 s without a heartbeat
  EXPECT_EQ(bench.status.state, AxisState::unknown);
  bench.sent.clear();
  bench.run(100, AxisRequest::run, 1.0, kRunningBeat);
  EXPECT_EQ(bench.motions(), 0);
  EXPECT_GE(bench.count(kZero), 99);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason, "heartbeat ceased while armed");
}

TEST(OdriveDriver, WaitsForAHeartbeatAsLongAsConfigured) {
  auto patient = options();
  patient.set("heartbeat_timeout_s", 1.0);
  Bench bench(patient);
  bench.arm();
  bench.run(190, AxisRequest::run, 1.0);  // 0.95 s
  EXPECT_EQ(bench.status.state, AxisState::running);
  bench.run(20, AxisRequest::run, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::unknown);
  EXPECT_EQ(bench.status.reason, "no heartbeat for more than 1.0 s");
}

TEST(OdriveDriver, StaysLockedAfterAGapThatNoCycleSaw) {
  Bench bench;
  bench.arm();
  bench.now += milliseconds(400);  // the gateway itself was held up
  bench.hear(kRunningBeat);
  bench.run(20, AxisRequest::run, 1.0);
  EXPECT_EQ(bench.motions(), 0);
  EXPECT_EQ(bench.status.state, AxisState::fault) << "it does not obey, whatever the drive says";
  bench.run(1, AxisRequest::rest);
  EXPECT_EQ(bench.status.state, AxisState::running) << "the task is over: a new one may start";
}

TEST(OdriveDriver, GoesIdleOnlyAfterZeroAndWhenSlow) {
  Bench bench;
  bench.arm();
  bench.run(5, AxisRequest::run, 5.0);
  bench.hear("069#0000000000000040");  // 2 turns/s
  bench.sent.clear();
  bench.run(20, AxisRequest::idle);
  EXPECT_EQ(bench.count(kIdle), 0);
  EXPECT_EQ(bench.count(kZero), 20);
  bench.hear("069#0000000000000000");
  bench.run(1, AxisRequest::idle);
  EXPECT_EQ(bench.count(kIdle), 1);
  bench.hear(kIdleBeat);
  bench.run(40, AxisRequest::idle);
  EXPECT_EQ(bench.count(kIdle), 1);
}

TEST(OdriveDriver, GoesIdleAtLastWhenItNeverSlowsDown) {
  Bench bench;
  bench.arm();
  bench.hear("069#0000000000000040");
  bench.run(250, AxisRequest::idle, 0, kRunningBeat);
  EXPECT_GE(bench.count(kIdle), 2);
}

TEST(OdriveDriver, TurnsNoNumberIntoZeroAndCountsIt) {
  Bench bench;
  bench.arm();
  bench.run(1, AxisRequest::run, std::nan(""));
  bench.run(1, AxisRequest::run, INFINITY);
  EXPECT_EQ(bench.motions(), 0);
  EXPECT_EQ(bench.driver.bad_setpoints(), 2U);
}

TEST(OdriveDriver, ClampsToItsVelocityLimitAndCountsIt) {
  Bench bench(options().set("velocity_limit_turnps", 2.0));
  bench.arm();
  bench.run(1, AxisRequest::run, -1000.0);
  EXPECT_EQ(bench.sent.back(), "06D#000000C000000000");
  EXPECT_EQ(bench.driver.bad_setpoints(), 1U);
}

TEST(OdriveDriver, AppliesGearRatioAndSignBothWays) {
  Bench bench(options().set("gear_ratio", 4.0).set("reversed", true));
  bench.arm();
  bench.run(1, AxisRequest::run, 3.14159265358979);
  EXPECT_EQ(bench.sent.back(), "06D#000000C000000000");  // -2 turns/s
  bench.hear("069#00008040000000C0");
  EXPECT_EQ(describe(bench.out), "axis_motion axis=0 position_rad=-6.28319 velocity_radps=3.14159");
}

TEST(OdriveDriver, KeepsItsDistanceBetweenSetPointsButStopsAtOnce) {
  Bench bench;
  bench.arm();
  bench.now += milliseconds(10);
  const auto step = [&](double velocity_radps) {
    bench.now += milliseconds(1);
    bench.out.clear();
    const Setpoint wanted[] = {{AxisRequest::run, velocity_radps}};
    bench.driver.on_setpoints(wanted, bench.now, bench.out);
    bench.driver.on_tick(bench.now, bench.out);
    return bench.out.frames.size();
  };
  EXPECT_EQ(step(1.0), 1U);
  EXPECT_EQ(step(1.1), 0U);
  EXPECT_EQ(step(0.0), 1U);
  EXPECT_EQ(describe(bench.out.frames[0]), kZero);
  EXPECT_EQ(step(0.0), 0U);
}

TEST(OdriveDriver, ReportsItsStatusWithEachHeartbeat) {
  Bench bench;
  for (int i = 0; i < 5; ++i) bench.hear(kIdleBeat);
  EXPECT_EQ(bench.statuses, 5);
}

TEST(OdriveDriver, DropsAnEffortThatIsOld) {
  Bench bench;
  bench.hear("07C#0000003F8FC2F53E");
  bench.hear("069#0000000000000000");
  EXPECT_NE(describe(bench.out).find("effort_Nm=0.48"), std::string::npos);
  bench.now += milliseconds(150);
  bench.hear("069#0000000000000000");
  EXPECT_EQ(describe(bench.out).find("effort_Nm"), std::string::npos);
}

TEST(OdriveDriver, PollsRarelyAndOneFrameAtATime) {
  Bench bench(options().set("poll_s", 0.5));
  bench.hear(kIdleBeat);
  bench.run(400, AxisRequest::rest, 0, kIdleBeat);  // 2 s
  for (const char* id : {"063#R", "07C#R", "075#R", "077#R"})
    EXPECT_NEAR(bench.count(id), 4, 1) << id;
}

TEST(OdriveDriver, ReportsAnotherMaster) {
  Bench bench;
  bench.hear(kIdleBeat);
  bench.hear("069#0000000000000000");
  bench.hear(kZero);
  EXPECT_TRUE(bench.driver.health(bench.now).reason.empty()) << "zeros are the guard's";
  bench.hear("06D#0000004000000000");
  EXPECT_EQ(bench.driver.health(bench.now).reason,
            "somebody else commands it: id 0x06D on the bus");
  EXPECT_EQ(bench.driver.health(bench.now).bad, 0U);
  bench.run(1, AxisRequest::rest);
  EXPECT_EQ(bench.status.state, AxisState::fault) << "also while this gateway lets it rest";
  bench.run(400, AxisRequest::rest, 0, kIdleBeat);
  EXPECT_EQ(bench.status.state, AxisState::idle);
}

TEST(OdriveDriver, StopsAtOnceWhenSomebodyElseCommandsIt) {
  Bench bench;
  bench.arm();
  bench.run(10, AxisRequest::run, 1.0);
  bench.hear("06D#0000004000000000");
  bench.sent.clear();
  bench.run(400, AxisRequest::run, 1.0, kRunningBeat);
  EXPECT_EQ(bench.motions(), 0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason, "somebody else commands it: id 0x06D on the bus");
  EXPECT_TRUE(bench.status.powered) << "still in closed loop";
}

/// The guard never sends it, though it stops: it lets go, and the robot rolls.
TEST(OdriveDriver, SomebodyElsesIdleIsAFault) {
  Bench bench;
  bench.arm();
  bench.run(10, AxisRequest::run, 1.0);
  bench.hear(kZero);
  bench.run(1, AxisRequest::run, 1.0);
  ASSERT_EQ(bench.status.state, AxisState::running) << "the guard's is welcome";
  bench.hear(kIdle);
  bench.run(1, AxisRequest::run, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason, "somebody else commands it: id 0x067 on the bus");
}

TEST(OdriveDriver, DoesNotMindWhoOnlyReads) {
  Bench bench;
  bench.arm();
  bench.hear("064#0005010000000000");
  bench.run(20, AxisRequest::run, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::running);
}

}  // namespace
}  // namespace drover::odrive
