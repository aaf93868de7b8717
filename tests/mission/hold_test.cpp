// What held the robot on a slope holds it again; what stopped it still stops it.
#include "mission/support.h"

namespace drover::mission {
namespace {

/// How the robot rolled between two instants.
struct Roll {
  double way_m = 0;
  double fastest_mps = 0;
  Time rest = kNever;  ///< from then on it stood
};

Roll roll(const Record& log, Time begin, Time end) {
  Roll found;
  const auto from = log.truth_at(begin);
  found.rest = begin;
  for (const auto& line : log.truth) {
    if (line.time < begin || line.time > end) continue;
    found.way_m = std::max(found.way_m, std::hypot(line.x_m - from.x_m, line.y_m - from.y_m));
    found.fastest_mps = std::max(found.fastest_mps, std::abs(line.vx_mps));
    if (std::abs(line.vx_mps) > 0.01) found.rest = line.time;
  }
  return found;
}

/// Both programs away from `gone` to `back`, and what came of it by `end`.
void expect_held_again(const Record& log, Time gone, Time back, Time end) {
  ASSERT_GT(log.truth_at(gone).z_m - log.truth.front().z_m, 0.1) << "it is not on the ramp";
  const Roll before = roll(log, gone, back);
  const Roll after = roll(log, back, end);
  std::printf("  rolled %.2f m, up to %.2f m/s, without anybody; %.2f m in %s from the start on\n",
              before.way_m, before.fastest_mps, after.way_m, seconds(after.rest - back).c_str());
  EXPECT_LT(after.rest - back, 2500ms);
  // At 0.8 m/s^2 from what it had, and before that the time in which programs and drives get ready.
  const double v_mps = after.fastest_mps;
  EXPECT_LT(after.way_m, v_mps * v_mps / (2 * 0.8) + 0.6 * v_mps + 0.05);
  EXPECT_LT(roll(log, after.rest + 100ms, end).way_m, 0.01) << "it is not held";
}

TEST(RestartOnRamp, HoldsTheRobotAgainAfterAnOrderlyRestartOfBothPrograms) {
  const Record& log = record("restart_on_ramp");
  const Time ended = log.event("signal 15 to droverd");
  const Time guard_ended = log.event("signal 15 to drover-guard");
  EXPECT_LT(roll(log, ended + 1500ms, guard_ended).way_m, 0.02) << "the guard holds it meanwhile";
  expect_held_again(log, guard_ended, log.event("start droverd", 2),
                    log.event("signal 9 to droverd"));
}

TEST(RestartOnRamp, HoldsTheRobotAgainAfterBothProgramsWereKilled) {
  const Record& log = record("restart_on_ramp");
  const Time killed = log.event("signal 9 to droverd");
  const Time start = next_start(log, killed);
  ASSERT_NE(start, Time::max());
  expect_held_again(log, killed, log.event("start droverd", 3), start - kEstop);
}

TEST(RestartOnRamp, LetsANewStartReachTheGoal) {
  const Record& log = record("restart_on_ramp");
  expect_new_start_succeeds(log, log.event("start droverd", 3));
}

TEST(DipOnRamp, HoldsTheRobotAgainAsSoonAsTheDrivesHaveTheirSupply) {
  const Record& log = record("dip_on_ramp");
  const Time dipped = log.event("sim supply dip 0.5");
  expect_held_again(log, dipped, dipped + 500ms, log.event("start drover release"));
}

TEST(DipOnRamp, IsNotLetGoOnASlopeByAWordAlone) {
  const Record& log = record("dip_on_ramp");
  const Time asked = log.event("start drover release");
  EXPECT_LT(roll(log, asked, asked + 1900ms).way_m, 0.01);
  // Drives that had been released would take no start.
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
}

TEST(StopAndKill, RefusesAStartUntilTheStopIsReset) {
  const Record& log = record("stop_and_kill");
  const Time stopped = log.event("start drover stop");
  const Time reset = log.event("start drover reset");
  EXPECT_THAT(log.moving(stopped + 100ms, reset), testing::IsEmpty());
  auto words = kStarted;
  words.insert(words.end(), {"start_task_failse", "start_task_success", "start_nav_success"});
  EXPECT_EQ(log.feedback_words(), words);
  EXPECT_NE(log.feedback.at(3).reason.find("reset the stop first"), std::string::npos)
      << log.feedback.at(3).reason;
  EXPECT_LT(log.feedback.at(3).time, reset);
}

TEST(StopAndKill, SaysAfterTheRestartWhyItIsStopped) {
  const Record& log = record("stop_and_kill");
  const Time back = log.event("start droverd", 2);
  const Time reset = log.event("start drover reset");
  std::size_t looked = 0;
  for (const auto& status : log.statuses) {
    if (status.time < back + 1s || status.time > reset) continue;
    ++looked;
    EXPECT_NE(status.why.find("emergency stop of an operator"), std::string::npos) << status.why;
    EXPECT_EQ(status.document.at("robot").at("robot_status").get<int>() & 4, 4);
  }
  EXPECT_GT(looked, 50U);
}

TEST(StopAndKill, LetsANewStartReachTheGoalAfterTheReset) {
  const Record& log = record("stop_and_kill");
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
  EXPECT_GT(next_start(log, log.event("start drover reset")), log.event("start drover reset"));
}

}  // namespace
}  // namespace drover::mission
