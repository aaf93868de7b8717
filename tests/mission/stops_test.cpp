// Missions that are ended by force: nothing moves until a person starts again.
#include "mission/support.h"

namespace drover::mission {
namespace {

constexpr Duration kGuard = 100ms;

TEST(Estop, StopsEveryWheelCommandWithin20Milliseconds) {
  const Record& log = record("estop");
  const Time pressed = log.event("sim estop press");
  ASSERT_TRUE(moved_until(log, pressed)) << "it did not drive when the button was pressed";
  const auto last = log.moving(pressed, pressed + 2s);
  figure("last motion after the button", last.empty() ? Duration{} : last.back().time - pressed);
  tell_way_to_rest(log, pressed, pressed + 2s);
  EXPECT_THAT(log.moving(pressed + kEstop, pressed + 2s), testing::IsEmpty());
  for (std::uint8_t node = kFirstNode; node <= kLastNode; ++node) {
    std::size_t zeros = 0;
    for (const auto& one : log.sent)
      if (one.wheel.node == node && one.time > pressed && one.time <= pressed + kEstop &&
          !one.wheel.moves())
        ++zeros;
    EXPECT_GT(zeros, 0U) << "node " << int{node} << " was not told to stop";
  }
}

TEST(Estop, EndsTheTaskAndStaysSoUntilANewStart) {
  const Record& log = record("estop");
  const Time pressed = log.event("sim estop press");
  expect_rest_until_started(log, pressed + kEstop);
  const auto& error = log.first_status("NAV_ERROR", pressed);
  EXPECT_LT(error.time - pressed, 200ms);
  EXPECT_NE(error.why.find("e-stop"), std::string::npos) << error.why;
  EXPECT_EQ(error.document.at("robot").at("robot_status").get<int>() & 1, 1);
  const Time start = next_start(log, pressed);
  ASSERT_NE(start, Time::max()) << "the scenario starts no second task";
  expect_nav_stays(log, "NAV_ERROR", error.time, start - 150ms);
}

TEST(EstopTap, StopsAndEndsTheTaskThoughTheContactIsClosedAgain) {
  const Record& log = record("estop_tap");
  const Time tapped = log.event("sim tap estop");
  ASSERT_TRUE(moved_until(log, tapped));
  EXPECT_THAT(log.moving(tapped + kEstop, Time::max()), testing::IsEmpty());
  const auto& error = log.first_status("NAV_ERROR", tapped);
  EXPECT_LT(error.time - tapped, 200ms);
  EXPECT_NE(error.why.find("e-stop"), std::string::npos) << error.why;
}

TEST(Estop, LetsANewStartReachTheGoalAfterItsRelease) {
  const Record& log = record("estop");
  expect_new_start_succeeds(log, log.event("sim estop release"));
}

// The drives hear nothing any more, and nobody hears them: their bus is off, or its adapter pulled.
struct Severed {
  const char* mission;
  const char* by;
  const char* mended_by;
  const char* reason;        // as soon as it is known
  const char* later_reason;  // when the system has noticed, too
};
class DrivesOutOfReach : public testing::TestWithParam<Severed> {};

TEST_P(DrivesOutOfReach, LetsTheDrivesStopByTheirOwnWatchdogs) {
  const Record& log = record(GetParam().mission);
  const Time off = log.event(GetParam().by);
  ASSERT_TRUE(moved_until(log, off)) << "it did not drive";
  EXPECT_NEAR(log.truth_at(off).vx_mps, 0.5, 0.05);
  // 0.2 s after the last set point they switch off, and the robot rolls out.
  EXPECT_LT(log.truth_at(off + 200ms + 1s).vx_mps, 0.4);
  const Time rest = off + 5s;
  EXPECT_NEAR(log.truth_at(rest).vx_mps, 0, 0.01);
  const double way_m = log.truth_at(rest).x_m - log.truth_at(off).x_m;
  std::printf("  %.2f m without the drives\n", way_m);
  EXPECT_LT(way_m, 1.2);
  EXPECT_NEAR(log.truth_at(log.answered("start_task_success", 2)).x_m, log.truth_at(rest).x_m, 0.01)
      << "it moved before a person started it";
}

TEST_P(DrivesOutOfReach, IsToldAndStaysAnErrorUntilANewStart) {
  const Record& log = record(GetParam().mission);
  const Time off = log.event(GetParam().by);
  const auto& error = log.first_status("NAV_ERROR", off);
  EXPECT_LT(error.time - off, 300ms);
  EXPECT_NE(error.why.find("no drive answers"), std::string::npos) << error.why;
  EXPECT_NE(error.why.find(GetParam().reason), std::string::npos) << error.why;
  EXPECT_EQ(log.feedback_words(),
            (std::vector<std::string>{"save_trajectory_success", "start_task_success",
                                      "start_nav_success", "start_task_failse",
                                      "start_task_success", "start_nav_success"}));
  EXPECT_NE(log.feedback[3].reason.find("no drive answers"), std::string::npos);
  EXPECT_NE(log.feedback[3].reason.find(GetParam().later_reason), std::string::npos);
  const Time restarted = log.event(GetParam().mended_by);
  const Time start = log.answered("start_task_success", 2);
  EXPECT_GT(start, restarted);
  expect_nav_stays(log, "NAV_ERROR", error.time, start - 150ms);
  EXPECT_THAT(log.moving(off + 5ms, start - kEstop), testing::IsEmpty());
}

TEST_P(DrivesOutOfReach, LetsANewStartReachTheGoalWhenItIsMended) {
  const Record& log = record(GetParam().mission);
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
  const Time start = log.answered("start_task_success", 2);
  EXPECT_LT(drive_figures(log, start, log.first_status("NAV_SUCCESS", start).time).goal_m, 0.10);
}

INSTANTIATE_TEST_SUITE_P(
    Each, DrivesOutOfReach,
    testing::Values(Severed{"bus_off", "sim can can0 bus_off", "sim can can0 restart",
                            "can0 is bus-off", "can0 is bus-off"},
                    Severed{"can_replugged", "sim can can0 unplug", "sim can can0 plug",
                            "no encoder estimates", "can0: no such CAN interface"}),
    [](const auto& one) { return std::string(one.param.mission); });

TEST(BrokerRestart, LeavesNoGapOnTheBus) {
  const Record& log = record("broker_restart");
  const Time killed = log.event("signal 9 to mosquitto");
  const Time back = log.event("start mosquitto", 2);
  ASSERT_GT(back, killed);
  Time last = kNever;
  std::size_t looked = 0;
  for (const auto& one : log.sent) {
    if (one.wheel.node != kFirstNode) continue;
    if (last > killed && one.time < back + 5s) {
      ++looked;
      EXPECT_LE(one.time - last, 20ms) << "at " << seconds(one.time);
      EXPECT_TRUE(one.wheel.moves()) << "it stopped at " << seconds(one.time);
    }
    last = one.time;
  }
  EXPECT_GT(looked, 100U);
}

TEST(BrokerRestart, BringsTheStatusBackAndReplaysNothing) {
  const Record& log = record("broker_restart");
  const Time back = log.event("start mosquitto", 2);
  EXPECT_LE(log.first_status("NAV_RUN", back).time - back, 2s);
  for (const auto& line : log.mqtt)
    if (line.time > back) {
      EXPECT_NE(line.topic, "mqtt_control") << line.payload;
    }
}

TEST(BrokerRestart, ReachesTheGoal) {
  const Record& log = record("broker_restart");
  EXPECT_EQ(log.feedback_words(), kStarted);
  expect_good_drive(log);
}

/// After the gateway died or hung: the guard's zeros for every wheel, for as long as `end`.
void expect_guard(const Record& log, Time gone, Time end) {
  ASSERT_TRUE(moved_until(log, gone)) << "it did not drive when the gateway went";
  const auto last = log.moving(gone, end);
  figure("last motion after it went", last.empty() ? Duration{} : last.back().time - gone);
  tell_way_to_rest(log, gone, end);
  EXPECT_THAT(log.moving(gone + kGuard, end), testing::IsEmpty());
  for (std::uint8_t node = kFirstNode; node <= kLastNode; ++node) {
    Time before = gone;
    std::size_t zeros = 0;
    for (const auto& one : log.sent) {
      if (one.wheel.node != node || one.wheel.moves() || one.time <= gone || one.time > end)
        continue;
      if (zeros == 0) figure("the guard's first zero after it went", one.time - gone);
      // The first within the promise, then one each 10 ms.
      EXPECT_LE(one.time - before, zeros == 0 ? kGuard : 15ms) << "at " << seconds(one.time);
      before = one.time;
      ++zeros;
    }
    EXPECT_GT(zeros, 0U) << "node " << int{node};
    EXPECT_LE(end - before, 15ms) << "the guard gave up";
  }
}

TEST(KillOnRamp, IsStoppedByTheGuardWithin100Milliseconds) {
  const Record& log = record("kill_on_ramp");
  expect_guard(log, log.event("signal 9 to droverd"), log.event("start droverd", 2));
}

TEST(KillOnRamp, HoldsTheRobotOnTheSlope) {
  expect_held_on_the_ramp(record("kill_on_ramp"));
}

TEST(KillOnRamp, TellsTheTruthAfterTheRestartAndStaysStopped) {
  const Record& log = record("kill_on_ramp");
  const Time back = log.event("start droverd", 2);
  const auto first = std::find_if(log.statuses.begin(), log.statuses.end(),
                                  [back](const Status& status) { return status.time > back; });
  ASSERT_NE(first, log.statuses.end());
  EXPECT_LE(first->time - back, 1s);
  const Time start = next_start(log, back);
  const Time until = start == Time::max() ? start : start - 150ms;
  for (const auto& status : log.statuses) {
    if (status.time < back || status.time > until) continue;
    EXPECT_TRUE(status.nav == "NAV_FREE" || status.nav == "NAV_ERROR")
        << status.nav << " at " << seconds(status.time);
  }
  EXPECT_GT(std::min(until, log.event("the end")) - back, 2s) << "too short to prove anything";
  expect_rest_until_started(log, back);
}

TEST(KillOnRamp, LetsANewStartReachTheGoal) {
  const Record& log = record("kill_on_ramp");
  // Its mechanics were proved before: no first way at 0.05 m/s.
  EXPECT_GT(log.truth_at(next_start(log, log.event("start droverd", 2)) + 3s).vx_mps, 0.3);
  expect_new_start_succeeds(log, log.event("start droverd", 2));
}

TEST(Hang, IsStoppedByTheGuardWithin100Milliseconds) {
  const Record& log = record("hang");
  expect_guard(log, log.event("signal 19 to droverd"), log.event("signal 18 to droverd"));
}

TEST(Hang, StaysStoppedAfterTheGatewayWakesAndSaysWhoStoppedIt) {
  const Record& log = record("hang");
  const Time woken = log.event("signal 18 to droverd");
  expect_rest_until_started(log, woken);
  const auto& error = log.first_status("NAV_ERROR", woken);
  EXPECT_LE(error.time - woken, 1s);
  EXPECT_NE(error.why.find("guard"), std::string::npos) << error.why;
  const Time start = next_start(log, woken);
  const Time until = start == Time::max() ? start : start - 150ms;
  expect_nav_stays(log, "NAV_ERROR", error.time, until);
  EXPECT_GT(std::min(until, log.event("the end")) - woken, 2s) << "too short to prove anything";
}

TEST(Hang, LetsANewStartReachTheGoal) {
  const Record& log = record("hang");
  expect_new_start_succeeds(log, log.event("signal 18 to droverd"));
}

}  // namespace
}  // namespace drover::mission
