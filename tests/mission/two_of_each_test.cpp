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

TEST(OneOfEachDies, IsToldAndDrivenThrough) {
  const Record& log = record("one_of_each_dies");
  const Time receiver = log.event("sim gnss silent");
  const Time imu = log.event("sim imu unplug");
  const Time battery = log.event("sim battery silent");
  const Duration by_receiver =
      told_after(log, receiver, "gnss gives nothing to go by: gnss_rear steers in its place");
  EXPECT_LT(by_receiver, 700ms);
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

TEST(BothOfEachDie, StopAsOneThatHasOne) {
  const Record& log = record("both_of_each_die");
  const Time battery = log.event("sim battery battery_right silent");
  const Time imu = log.event("sim imu imu_rear silent");
  const Time receiver = log.event("sim gnss gnss_rear none");
  EXPECT_LT(told_after(log, battery, "no battery is heard"), 8s);
  EXPECT_LT(told_after(log, imu, "imu"), 1s);
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
  // Of what holds in every mission all but the states of the sensor that is dead at its end.
  EXPECT_THAT(check_frames(log), testing::IsEmpty());
  EXPECT_THAT(check_motion(log, Holding::unmoved), testing::IsEmpty());
  EXPECT_THAT(check_truth(log, 0.30), testing::IsEmpty());
  EXPECT_THAT(check_form(log), testing::IsEmpty());
  EXPECT_THAT(check_rate(log), testing::IsEmpty());
  EXPECT_THAT(check_pose(log), testing::IsEmpty());
}

}  // namespace
}  // namespace drover::mission
