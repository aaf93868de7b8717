// Two receivers, two inertial sensors, two batteries: one of each dies, then the other.
#include <algorithm>
#include <cmath>

#include "mission/support.h"

namespace drover::mission {
namespace {

/// How long after `begin` it was told for the first time.
Duration told_after(const Record& log, Time begin, const std::string& words) {
  for (const auto& status : log.statuses)
    if (status.time >= begin && status.why.find(words) != std::string::npos)
      return status.time - begin;
  ADD_FAILURE() << "never told: " << words;
  return Duration::max();
}

/// The place that is told, against the true one.
double worst_m(const Record& log, Time begin, Time end) {
  double worst = 0;
  for (const auto& status : log.statuses) {
    if (status.time < begin || status.time > end) continue;
    const TruthLine truth = log.truth_at(status.time);
    worst = std::max(worst, std::hypot(status.sim.x_m - truth.x_m, status.sim.y_m - truth.y_m));
  }
  return worst;
}

/// Of what holds in every mission all but the rates of the inertial sensor's state.
void expect_all_but_the_states(const Record& log, double bound_m) {
  EXPECT_THAT(check_frames(log), testing::IsEmpty());
  EXPECT_THAT(check_motion(log, Holding::unmoved), testing::IsEmpty());
  EXPECT_THAT(check_truth(log, bound_m), testing::IsEmpty());
  EXPECT_THAT(check_form(log), testing::IsEmpty());
  EXPECT_THAT(check_rate(log), testing::IsEmpty());
  EXPECT_THAT(check_pose(log), testing::IsEmpty());
}

TEST(OneOfEachDies, IsToldAndDrivenThrough) {
  const Record& log = record("one_of_each_dies");
  const Time receiver = log.event("sim gnss silent");
  const Time imu = log.event("sim imu unplug");
  const Time battery = log.event("sim battery silent");
  const Duration by_receiver =
      told_after(log, receiver, "gnss gives nothing to go by: gnss_rear steers in its place");
  EXPECT_LT(by_receiver, 700ms);
  EXPECT_LT(told_after(log, imu, "imu gives nothing to go by: imu_rear steers in its place"),
            700ms);
  EXPECT_LT(told_after(log, battery, "battery unknown: no answer"), 6s);
  for (const auto& status : log.statuses) {
    if (status.time < log.answered("start_nav_success")) continue;
    EXPECT_EQ(status.locate, "LOCATE_TRUE") << seconds(status.time);
    if (status.time > imu + 700ms) {
      EXPECT_TRUE(status.document.at("sensor").at("imu").get<bool>()) << seconds(status.time);
    }
    if (status.time > battery + 1s) {
      EXPECT_TRUE(status.document.at("bms").at("valid").get<bool>()) << "the other is heard";
      EXPECT_NEAR(status.document.at("bms").at("soc").get<double>(), 80, 2);
    }
  }
  EXPECT_EQ(log.feedback_words(), kStarted);
  const Time begin = log.answered("start_nav_success");
  const Time success = log.first_status("NAV_SUCCESS", begin).time;
  const double off_m = worst_m(log, receiver, success);
  figure("farthest off after the receiver died", off_m, "m");
  figure("told after the receiver died", by_receiver);
  EXPECT_LT(off_m, 0.10);
  expect_good_drive(log);
}

TEST(TwoOfEachKill, IsBroughtToRestByTheGuard) {
  const Record& log = record("two_of_each_kill");
  const Time killed = log.event("signal 9 to droverd");
  const Time back = log.event("start droverd", 2);
  ASSERT_TRUE(moved_until(log, killed)) << "it did not drive when the gateway went";
  EXPECT_THAT(log.moving(killed + 100ms, back), testing::IsEmpty());
  std::size_t zeros = 0;
  for (const Sent& one : log.sent)
    if (one.time > killed && one.time < back && !one.wheel.moves() && ++zeros == 1)
      figure("the guard's first zero after it went", one.time - killed);
  EXPECT_GT(zeros, 100U) << "nobody speaks to the drives";
  tell_way_to_rest(log, killed, back);
  EXPECT_LT(roll(log, killed, back).way_m, 0.35);
  EXPECT_LT(roll(log, killed, back).rest - killed, 800ms);
  expect_rest_until_started(log, back);
}

/// The next program never heard those that are dead.
TEST(TwoOfEachKill, GoesOnWithTheSparesThatSteeredWhenDroverdWasRestarted) {
  const Record& log = record("two_of_each_kill");
  const Time ended = log.event("signal 15 to droverd");
  const Time back = log.event("start droverd", 3);
  ASSERT_TRUE(moved_until(log, ended)) << "it did not drive when the gateway was ended";
  const Time start = next_start(log, back);
  ASSERT_NE(start, Time::max());
  const auto told_at = [&](Time begin, Time end, const char* words) {
    return std::any_of(log.statuses.begin(), log.statuses.end(), [&](const Status& status) {
      return status.time > begin && status.time < end &&
             status.why.find(words) != std::string::npos;
    });
  };
  for (const char* const words : {"gnss gives nothing to go by: gnss_rear steers in its place",
                                  "imu gives nothing to go by: imu_rear steers in its place"}) {
    EXPECT_TRUE(told_at(log.event("event imu#1"), ended, words)) << words;
    EXPECT_TRUE(told_at(back, start, words)) << words;
  }
  auto words = kStarted;
  for (int i = 0; i < 2; ++i)
    words.insert(words.end(), {"start_task_success", "start_nav_success"});
  EXPECT_EQ(log.feedback_words(), words);
  const Time success = log.first_status("NAV_SUCCESS", start).time;
  for (const auto& status : log.statuses) {
    if (status.time < start) continue;
    EXPECT_EQ(status.locate, "LOCATE_TRUE") << seconds(status.time);
    EXPECT_TRUE(status.document.at("sensor").at("imu").get<bool>()) << seconds(status.time);
    EXPECT_TRUE(status.document.at("bms").at("valid").get<bool>()) << seconds(status.time);
  }
  const double off_m = worst_m(log, start, success);
  figure("farthest off by the spares", off_m, "m");
  EXPECT_LT(off_m, 0.10);
  const auto figures = drive_figures(log, start, success);
  EXPECT_LT(figures.rms_m, 0.05);
  EXPECT_LT(figures.goal_m, 0.10);
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
  EXPECT_THAT(log.moving(log.event("the end") - 100ms, Time::max()), testing::IsEmpty());
  // A spare steers some seconds after a start at the earliest: the sensor before it may come yet.
  expect_all_but_the_states(log, 0.25);
}

TEST(BothOfEachDie, StopAsOneThatHasOne) {
  const Record& log = record("both_of_each_die");
  const Time battery = log.event("sim battery battery_right silent");
  const Time imu = log.event("sim imu imu_rear silent");
  const Time receiver = log.event("sim gnss gnss_rear none");
  EXPECT_LT(told_after(log, battery, "no battery is heard"), 8s);
  EXPECT_LT(told_after(log, imu, "imu gives nothing to go by, and neither does imu_rear"), 1s);
  EXPECT_LT(told_after(log, receiver, "gnss gives nothing to go by, and neither does gnss_rear"),
            2500ms);
  const auto& error = log.first_status("NAV_ERROR", receiver);
  figure("from the last receiver's silence to the end of the task", error.time - receiver);
  // It drove as far as dead reckoning goes, and waited for a receiver for
  // navigate.locate_timeout_s.
  EXPECT_GT(error.time - receiver, 60s);
  const Roll rolled = roll(log, receiver, error.time);
  figure("way after the last receiver's silence", rolled.way_m, "m");
  EXPECT_LT(rolled.way_m, 10) << "by the wheels alone, estimate.bound_run_m";
  EXPECT_THAT(log.moving(error.time, Time::max()), testing::IsEmpty());
  EXPECT_LT(worst_m(log, log.event("sim gnss silent"), receiver), 0.10);
  expect_all_but_the_states(log, 0.30);  // of the sensor that is dead at its end
}

}  // namespace
}  // namespace drover::mission
