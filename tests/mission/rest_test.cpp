// Stops that do not work, judged on the true motion.
#include "mission/support.h"

namespace drover::mission {
namespace {

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

bool told(const Record& log, const char* what, Time begin, Time end) {
  for (const Status& status : log.statuses) {
    if (status.time < begin || status.time > end) continue;
    if (status.why.find(what) != std::string::npos) return true;
  }
  return false;
}

TEST(Carried, IsToldRefusesAStartAndCutsNothing) {
  const Record& log = record("carried");
  const Time carried = log.event("event carried#1");
  EXPECT_TRUE(told(log, "pushed or carried", carried, carried + 5s));
  EXPECT_EQ(
      log.feedback_words(),
      (std::vector<std::string>{"save_trajectory_success", "start_task_success",
                                "start_nav_success", "cancel_task_success", "start_task_failse",
                                "start_task_success", "start_nav_success"}));
  EXPECT_NE(log.feedback[4].reason.find("pushed or carried"), std::string::npos)
      << log.feedback[4].reason;
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
  EXPECT_FALSE(told(log, "did not stop", kNever, Time::max()));
  EXPECT_TRUE(log.level_at("enable_relay", log.truth.back().time).value());
  EXPECT_TRUE(log.changes("enable_relay", carried, Time::max()).empty());
}

TEST(RunsOn, IsToldAndLatchedUntilAResetAtTheRobot) {
  const Record& log = record("runs_on");
  const auto& error = log.first_status("NAV_ERROR");
  EXPECT_LT(error.time - log.event("event stopped#1"), 300ms);
  EXPECT_TRUE(told(log, "did not stop", error.time, Time::max()));
  EXPECT_EQ(log.feedback_words().back(), "start_task_failse");
  EXPECT_TRUE(log.level_at("enable_relay", log.event("event reset#1") + 2s).value());
}

}  // namespace
}  // namespace drover::mission
