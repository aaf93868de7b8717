// A broker that stands still for a while, and messages that ask to be retained.
#include "mission/support.h"

namespace drover::mission {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

struct FrozenBroker : testing::Test {
  const Record& log = record("frozen_broker");

  Time step(const std::string& name) const { return log.event("event " + name + "#1"); }
  const Feedback& answer(Time asked) const {
    for (const auto& one : log.feedback)
      if (one.time >= asked) return one;
    throw std::runtime_error("no answer after " + seconds(asked));
  }
};

TEST_F(FrozenBroker, BringsNoStartThatStillMovesTheRobot) {
  const Time goes_on = step("goes_on");
  figure("held back", goes_on - step("old_start"));
  const auto& told = answer(goes_on);
  EXPECT_EQ(told.cmd, "start_task_failse");
  EXPECT_THAT(told.reason, HasSubstr("broker"));
  EXPECT_LT(told.time - goes_on, 2s);
  EXPECT_THAT(log.moving(kNever, step("start")), IsEmpty());
  EXPECT_NEAR(log.truth_at(step("start")).x_m, log.truth.front().x_m, 0.01);
}

TEST_F(FrozenBroker, TakesANewStartSoonAfterwards) {
  EXPECT_EQ(answer(step("start")).cmd, "start_task_success");
  EXPECT_FALSE(log.moving(step("start"), step("start") + 1s).empty());
}

TEST_F(FrozenBroker, DoesNotEndATask) {
  const Time frozen = step("frozen_again");
  const Time cancelled = step("cancel_with_retain");
  figure("stood still while it drove", step("goes_on_again") - frozen);
  Time last = kNever;
  std::size_t looked = 0;
  for (const auto& one : log.sent) {
    if (one.wheel.node != kFirstNode || one.time > cancelled) continue;
    if (last > frozen) {
      ++looked;
      EXPECT_LE(one.time - last, 20ms) << "at " << seconds(one.time);
      EXPECT_TRUE(one.wheel.moves()) << "it stopped at " << seconds(one.time);
    }
    last = one.time;
  }
  EXPECT_GT(looked, 50U);
  const double way_m = log.truth_at(cancelled).x_m - log.truth_at(frozen).x_m;
  EXPECT_NEAR(way_m, 0.5 * to_s(cancelled - frozen), 0.1);
  expect_nav_stays(log, "NAV_RUN", frozen, cancelled);
}

TEST_F(FrozenBroker, AStartWithRetainIsRefused) {
  const auto& told = answer(step("start_with_retain"));
  EXPECT_EQ(told.cmd, "start_task_failse");
  EXPECT_THAT(told.reason, HasSubstr("publish without retain"));
  EXPECT_LT(told.time, step("frozen"));
}

TEST_F(FrozenBroker, ACancelWithRetainIsObeyed) {
  const Time asked = step("cancel_with_retain");
  const auto& told = answer(asked);
  EXPECT_EQ(told.cmd, "cancel_task_success");
  EXPECT_LT(told.time - asked, 100ms);
  tell_way_to_rest(log, asked, step("start_again"));
  // From 0.5 m/s at 0.8 m/s^2 with its jerk.
  EXPECT_LT(roll(log, asked, step("start_again")).rest - asked, 1500ms);
  EXPECT_THAT(log.moving(asked + 1500ms, step("start_again")), IsEmpty());
}

TEST_F(FrozenBroker, AStopWithRetainIsObeyed) {
  const Time asked = step("stop_with_retain");
  ASSERT_TRUE(moved_until(log, asked)) << "it did not drive";
  const auto& told = answer(asked);
  EXPECT_EQ(told.cmd, "terminate_success");
  EXPECT_LT(told.time - asked, 100ms);
  tell_way_to_rest(log, asked, asked + 1900ms);
  EXPECT_THAT(log.moving(asked + kEstop, Time::max()), IsEmpty());
  EXPECT_EQ(log.statuses.back().nav, "NAV_ERROR");
}

TEST_F(FrozenBroker, LeavesEachCommandOneAnswer) {
  auto words =
      std::vector<std::string>{"save_trajectory_success", "start_task_failse", "start_task_failse"};
  words.insert(words.end(), {"start_task_success", "start_nav_success", "cancel_task_success"});
  words.insert(words.end(), {"start_task_success", "start_nav_success", "terminate_success"});
  EXPECT_EQ(log.feedback_words(), words);
}

}  // namespace
}  // namespace drover::mission
