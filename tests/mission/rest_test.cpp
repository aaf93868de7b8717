// Stops that do not work, judged on the true motion.
#include "mission/support.h"

namespace drover::mission {
namespace {

bool told(const Record& log, const char* what, Time begin, Time end) {
  for (const Status& status : log.statuses) {
    if (status.time < begin || status.time > end) continue;
    if (status.why.find(what) != std::string::npos) return true;
  }
  return false;
}

TEST(RunsOn, LosesItsPowerAndComesToRest) {
  const Record& log = record("runs_on");
  const Time stopped = log.event("event stopped#1");
  EXPECT_GT(log.truth_at(stopped).vx_mps, 0.3);
  EXPECT_TRUE(log.level_at("enable_relay", stopped).value());
  const auto cuts = log.changes("enable_relay", stopped, stopped + 3s);
  ASSERT_FALSE(cuts.empty()) << "the relay did not fall";
  figure("relay open after the stop", cuts.front().time - stopped);
  tell_way_to_rest(log, stopped, stopped + 4s);
  EXPECT_NEAR(log.truth_at(stopped + 4s).vx_mps, 0, 0.01);
}

TEST(Carried, IsToldRefusesAStartAndCutsNothing) {
  const Record& log = record("carried");
  const Time carried = log.event("event carried#1");
  EXPECT_TRUE(told(log, "pushed or carried", carried, carried + 5s));
  EXPECT_EQ(
      log.feedback_words(),
      (std::vector<std::string>{"save_trajectory_success", "start_task_success",
                                "start_nav_success", "cancel_task_success", "start_task_failse",
                                "start_task_failse", "start_task_success", "start_nav_success"}));
  EXPECT_NE(log.feedback[4].reason.find("pushed or carried"), std::string::npos)
      << log.feedback[4].reason;
  EXPECT_NE(log.feedback[5].reason.find("jumped by"), std::string::npos) << log.feedback[5].reason;
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
  EXPECT_FALSE(told(log, "did not stop", kNever, Time::max()));
  EXPECT_TRUE(log.level_at("enable_relay", log.truth.back().time).value());
  EXPECT_TRUE(log.changes("enable_relay", carried, Time::max()).empty());
}

TEST(RunsOn, IsToldAndLatchedUntilAResetAtTheRobot) {
  const Record& log = record("runs_on");
  const auto& error = log.first_status("NAV_ERROR");
  EXPECT_LT(error.time - log.event("event stopped#1"), 300ms);
  // It is faster than it may be before the time for a stop is over, or after it.
  EXPECT_TRUE(told(log, "did not stop", error.time, Time::max()) ||
              told(log, "runs away", error.time, Time::max()));
  EXPECT_EQ(log.feedback_words().back(), "start_task_failse");
  EXPECT_TRUE(log.level_at("enable_relay", log.event("event reset#1") + 2s).value());
}

// On ground that is too steep for a base that only its drives hold, a cut lets it roll.
TEST(RunsOnRamp, LosesItsPowerBecauseItIsDriven) {
  const Record& log = record("runs_on_ramp");
  const auto& error = log.first_status("NAV_ERROR");
  EXPECT_TRUE(told(log, "the ground falls by", error.time, error.time)) << error.why;
  const auto cuts = log.changes("enable_relay", error.time, Time::max());
  ASSERT_EQ(cuts.size(), 1U) << "the relay did not fall";
  figure("relay open after the stop", cuts.front().time - error.time);
  figure("way until the relay opened", roll(log, error.time, cuts.front().time).way_m, "m");
  EXPECT_TRUE(told(log, "did not stop", error.time, Time::max()));
}

TEST(RollsOnRamp, KeepsItsPowerBecauseItRolls) {
  const Record& log = record("rolls_on_ramp");
  const auto& error = log.first_status("NAV_ERROR");
  EXPECT_TRUE(told(log, "the ground falls by", error.time, error.time)) << error.why;
  const Time dipped = log.event("event dipped#1");
  const Roll rolled = roll(log, dipped, log.truth.back().time);
  figure("way that it rolled back", rolled.way_m, "m");
  figure("fastest", rolled.fastest_mps, "m/s");
  EXPECT_GT(rolled.way_m, 0.5) << "it did not roll: this proves nothing";
  EXPECT_TRUE(told(log, "moves without a command", dipped, Time::max()));
  EXPECT_FALSE(told(log, "did not stop", kNever, Time::max()));
  EXPECT_TRUE(log.changes("enable_relay", error.time, Time::max()).empty());
}

TEST(RestOnRamp, CutsNothingWhateverEncodersReceiverAndPeopleDo) {
  const Record& log = record("rest_on_ramp");
  const Time cancelled = log.event("event cancelled#1");
  ASSERT_GT(log.truth_at(cancelled).z_m - log.truth.front().z_m, 0.05) << "it is not on the ramp";
  const Roll held = roll(log, cancelled + 1s, log.event("event well#1"));
  figure("way at rest with frozen encoders", held.way_m, "m");
  EXPECT_LT(held.way_m, 0.05);
  const Time pushed = log.event("event pushed#1");
  figure("way by hand", roll(log, pushed, pushed + 3s).way_m, "m");
  EXPECT_FALSE(told(log, "did not stop", kNever, Time::max()));
  EXPECT_TRUE(log.changes("enable_relay", cancelled, Time::max()).empty());
}

TEST(RestOnRamp, DrivesOnAfterwards) {
  const Record& log = record("rest_on_ramp");
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
}

}  // namespace
}  // namespace drover::mission
