// `drover stop` beside a droverd that does not hear it: first its publish thread stands still, then
// all of it.
#include <array>
#include <fstream>

#include "mission/support.h"

namespace drover::mission {
namespace {

/// One of the two, as the record tells it.
struct Deaf {
  const char* fault;
  Time gone;     ///< from then on droverd hears nothing
  Time stopped;  ///< the stop was given
  Time back;     ///< droverd goes on
  Time reset;
};

std::array<Deaf, 2> both(const Record& log) {
  return {
      Deaf{"publish thread", log.event("freeze publish of droverd"), log.event("start drover stop"),
           log.event("thaw droverd"), log.event("start drover reset")},
      Deaf{"droverd", log.event("signal 19 to droverd"), log.event("start drover stop", 2),
           log.event("signal 18 to droverd"), log.event("start drover reset", 2)}};
}

TEST(StopWhileHung, StopsTheRobotAtOnceWhateverHangs) {
  const Record& log = record("stop_while_hung");
  for (const auto& one : both(log)) {
    SCOPED_TRACE(one.fault);
    ASSERT_TRUE(moved_until(log, one.gone)) << "it did not drive";
    const auto moving = log.moving(one.stopped, one.reset);
    figure("last motion after the stop",
           moving.empty() ? Duration{} : moving.back().time - one.stopped);
    tell_way_to_rest(log, one.stopped, one.reset);
    EXPECT_THAT(log.moving(one.stopped + kEstop, one.reset), testing::IsEmpty());
    const Roll rolled = roll(log, one.stopped, one.reset);
    EXPECT_LT(rolled.rest - one.stopped, 1s);
    EXPECT_LT(rolled.way_m, 0.15);
  }
}

TEST(StopWhileHung, KeepsTheDrivesHoldingUntilTheReset) {
  const Record& log = record("stop_while_hung");
  for (const auto& one : both(log)) {
    SCOPED_TRACE(one.fault);
    for (std::uint8_t node = kFirstNode; node <= kLastNode; ++node) {
      Time last = one.stopped;
      Duration gap{};
      for (const auto& set_point : log.sent) {
        if (set_point.wheel.node != node || set_point.time < last || set_point.time > one.reset)
          continue;
        gap = std::max(gap, set_point.time - last);
        last = set_point.time;
      }
      // Their watchdog runs out after 0.2 s; then they would let go.
      EXPECT_LT(std::max(gap, one.reset - last), 50ms) << "node " << int{node};
    }
  }
}

TEST(StopWhileHung, IsAnsweredWithWhoObeyed) {
  const Record& log = record("stop_while_hung");
  std::ifstream answers(log.folder / "drover.log");
  const std::string stopped =
      "done: drover-guard stops the robot; droverd did not answer within 1 s";
  for (const auto& wanted : {stopped, std::string("done: the stop is over"), stopped,
                             std::string("done: the stop is over")}) {
    std::string line;
    std::getline(answers, line);
    EXPECT_EQ(line, wanted);
  }
  EXPECT_EQ(log.all("end of drover with status 0").size(), 4U);
}

TEST(StopWhileHung, IsKnownToDroverdWhenItHearsAgain) {
  const Record& log = record("stop_while_hung");
  for (const auto& one : both(log)) {
    SCOPED_TRACE(one.fault);
    const auto& error = log.first_status("NAV_ERROR", one.back);
    EXPECT_LE(error.time - one.back, 1s);
    std::size_t looked = 0;
    for (const auto& status : log.statuses) {
      if (status.time < one.back + 500ms || status.time > one.reset) continue;
      ++looked;
      EXPECT_NE(status.why.find("emergency stop of an operator"), std::string::npos) << status.why;
    }
    EXPECT_GT(looked, 5U);
  }
}

TEST(StopWhileHung, IsFollowedByNoStartBeforeTheReset) {
  const Record& log = record("stop_while_hung");
  auto words = kStarted;
  for (int i = 0; i < 2; ++i)
    words.insert(words.end(), {"start_task_failse", "start_task_success", "start_nav_success"});
  EXPECT_EQ(log.feedback_words(), words);
  for (const auto& one : both(log)) {
    SCOPED_TRACE(one.fault);
    EXPECT_GT(next_start(log, one.stopped), one.reset);
    expect_rest_until_started(log, one.stopped + kEstop);
  }
  for (const auto& answer : log.feedback)
    if (answer.cmd == "start_task_failse") {
      EXPECT_NE(answer.reason.find("reset the stop first"), std::string::npos) << answer.reason;
    }
}

TEST(StopWhileHung, LetsANewStartReachTheGoalAfterTheReset) {
  const Record& log = record("stop_while_hung");
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
  const Time start = log.answered("start_nav_success", 3);
  EXPECT_LT(drive_figures(log, start, log.first_status("NAV_SUCCESS", start).time).goal_m, 0.10);
}

}  // namespace
}  // namespace drover::mission
