// What held the robot on a slope holds it again; what stopped it still stops it.
#include "mission/robot.h"
#include "mission/support.h"

namespace drover::mission {
namespace {

/// Both programs away from `gone` to `back`, and what came of it by `end`.
void expect_held_again(const Record& log, Time gone, Time back, Time end) {
  ASSERT_GT(log.truth_at(gone).z_m - log.truth.front().z_m, 0.1) << "it is not on the ramp";
  const Roll before = roll(log, gone, back);
  const Roll after = roll(log, back, end);
  figure("rolled without anybody", before.way_m, "m");
  figure("rolled until it was held", after.way_m, "m");
  figure("fastest", after.fastest_mps, "m/s");
  figure("held after", after.rest - back);
  EXPECT_LT(after.rest - back, 2500ms);
  // A ramp from what it had, and before that the time in which programs and drives get ready.
  const double v_mps = after.fastest_mps;
  EXPECT_LT(after.way_m, braking_way_m(v_mps) + 0.6 * v_mps + 0.05);
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

/// With nobody there, and without power.
class HeldWithoutPower : public testing::TestWithParam<const char*> {};

TEST_P(HeldWithoutPower, StandsOnTheSlopeWhileBothProgramsAreDead) {
  const Record& log = record(GetParam());
  const Time killed = log.event("signal 9 to droverd");
  const Time back = log.event("start droverd", 2);
  ASSERT_GT(log.truth_at(killed).z_m - log.truth.front().z_m, 0.05) << "it is not on the ramp";
  EXPECT_GT(log.truth_at(killed).vx_mps, 0.3);
  EXPECT_FALSE(log.level_at("enable_relay", killed + 100ms).value()) << "nobody has its line";
  const Roll alone = roll(log, killed, back);
  figure("way until it stood", alone.way_m, "m");
  EXPECT_LT(alone.way_m, 0.15);
  EXPECT_LT(roll(log, killed + 600ms, back).way_m, 0.01);
}

TEST_P(HeldWithoutPower, HasItsPowerAgainAndIsHeldAgainWithoutAJolt) {
  const Record& log = record(GetParam());
  const Time back = log.event("start droverd", 2);
  const Time end = log.event("event cancelled#1");
  EXPECT_TRUE(log.level_at("enable_relay", end).value());
  const Roll after = roll(log, back, end);
  figure("way from the start on", after.way_m, "m");
  EXPECT_LT(after.way_m, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Each, HeldWithoutPower,
                         testing::Values("brake_on_ramp", "worm_gear_on_ramp"),
                         [](const auto& one) { return std::string(one.param); });

/// When the drives had their supply again.
Time dip_ended(const Record& log) {
  const std::string words = "sim supply dip ";
  const auto dip =
      std::find_if(log.events.begin(), log.events.end(),
                   [&words](const EventLine& event) { return event.text.starts_with(words); });
  if (dip == log.events.end()) throw std::runtime_error("no dip");
  return log.event("event dipped#1") + from_s(std::stod(dip->text.substr(words.size())));
}

/// The hardest braking of the body from `begin` to `end`, over a tenth of a second.
double hardest_mps2(const Record& log, Time begin, Time end) {
  double hardest = 0;
  for (Time t = begin; t + 100ms <= end; t += 10ms) {
    const double slower_mps =
        std::abs(log.truth_at(t).vx_mps) - std::abs(log.truth_at(t + 100ms).vx_mps);
    hardest = std::max(hardest, slower_mps / 0.1);
  }
  return hardest;
}

TEST(DipOnRamp, HoldsTheRobotAgainAsSoonAsTheDrivesHaveTheirSupply) {
  const Record& log = record("dip_on_ramp");
  expect_held_again(log, log.event("event dipped#1"), dip_ended(log),
                    log.event("start drover release"));
}

TEST(DipOnRamp, RampsTheWheelsDownFromTheSpeedThatTheyHave) {
  const Record& log = record("dip_on_ramp");
  const Time back = dip_ended(log);
  const Time end = log.event("start drover release");
  const double fastest_mps = roll(log, back, end).fastest_mps;
  const auto ramp = log.moving(back, end);
  double first_mps = 0;
  for (const auto& one : ramp) first_mps = std::max(first_mps, log.rim_mps(one));
  figure("set points of the ramp", static_cast<double>(ramp.size()), "frames");
  figure("ramp begins with", first_mps, "m/s");
  figure("hardest braking", hardest_mps2(log, back, end), "m/s/s");
  if (fastest_mps < 0.1) return;  // a short dip: nothing to ramp down
  ASSERT_FALSE(ramp.empty()) << "no set point of the ramp came to the wire";
  EXPECT_GT(first_mps, 0.6 * fastest_mps);
  EXPECT_LT(hardest_mps2(log, back, end), 2.0) << "it is jerked to rest";
}

TEST(DipOnRamp, IsNotLetGoOnASlopeByAWordAlone) {
  const Record& log = record("dip_on_ramp");
  const Time asked = log.event("start drover release");
  EXPECT_LT(roll(log, asked, asked + 1900ms).way_m, 0.01);
  // Drives that had been released would take no start.
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
}

TEST(LongDipOnRamp, CatchesARobotThatRollsFastByARampWithinTheLimit) {
  const Record& log = record("long_dip_on_ramp");
  const Time back = dip_ended(log);
  const Time end = log.truth.back().time;
  const Roll after = roll(log, back, end);
  const double hardest = hardest_mps2(log, back, end);
  figure("rolled without power", roll(log, log.event("event dipped#1"), back).way_m, "m");
  figure("rolled until it was held", after.way_m, "m");
  figure("fastest", after.fastest_mps, "m/s");
  figure("hardest braking", hardest, "m/s/s");
  figure("held after", after.rest - back);
  EXPECT_GT(after.fastest_mps, 1.5) << "it does not roll fast enough to show anything";
  const auto ramp = log.moving(back, end);
  ASSERT_FALSE(ramp.empty()) << "no set point of the ramp came to the wire";
  double first_mps = 0;
  for (const auto& one : ramp) first_mps = std::max(first_mps, log.rim_mps(one));
  figure("ramp begins with", first_mps, "m/s");
  EXPECT_GT(first_mps, 0.8 * after.fastest_mps);
  const auto fastest = std::max_element(log.truth.begin(), log.truth.end(),
                                        [](const TruthLine& one, const TruthLine& other) {
                                          return std::abs(one.vx_mps) < std::abs(other.vx_mps);
                                        });
  const double mean_mps2 = after.fastest_mps / to_s(after.rest - fastest->time);
  figure("mean braking", mean_mps2, "m/s/s");
  EXPECT_LT(mean_mps2, 1.1 * kBrakes_mps2);
  // Over a tenth of a second, while the wheels' controllers take over and the slope ends.
  EXPECT_LT(hardest, 1.6 * kBrakes_mps2) << "it is jerked to rest";
  EXPECT_GT(end - after.rest, 1s) << "it is not held";
}

TEST(LongDipOnRamp, TakesTheWheelsThatItCatchesForNoRunaway) {
  const Record& log = record("long_dip_on_ramp");
  const Time dipped = log.event("event dipped#1");
  for (const auto& status : log.statuses) {
    if (status.time < dipped) continue;
    for (const char* claim : {"runs away", "ran away", "by itself", "did not stop"})
      EXPECT_EQ(status.why.find(claim), std::string::npos) << seconds(status.time) << status.why;
  }
  EXPECT_EQ(log.statuses.back().nav, "NAV_FREE");
}

// The way that it rolls is the way that it was driven, and no drive runs: there is nothing to cut.
TEST(DipDownOnRamp, IsCaughtAndNotCutOnItsWayDown) {
  const Record& log = record("dip_down_on_ramp");
  const Time dipped = log.event("event dipped#1");
  const Time end = log.truth.back().time;
  const Roll rolled = roll(log, dipped, end);
  figure("rolled until it was held", rolled.way_m, "m");
  figure("fastest", rolled.fastest_mps, "m/s");
  EXPECT_GT(rolled.fastest_mps, 1.0) << "it does not roll fast enough to show anything";
  EXPECT_LT(rolled.way_m, 8);
  EXPECT_GT(end - rolled.rest, 1s) << "it is not held";
  EXPECT_THAT(log.changes("enable_relay", dipped, end), testing::IsEmpty());
  for (const auto& status : log.statuses) {
    if (status.time < dipped) continue;
    EXPECT_EQ(status.why.find("did not stop"), std::string::npos) << status.why;
  }
}

// The guard's last word was that it has the bus.
TEST(GuardDiesOnRamp, LeavesARobotThatRollsToTheProgramThatIsBack) {
  const Record& log = record("guard_dies_on_ramp");
  const Time back = log.event("event goes_on#1");
  const Time end = log.truth.back().time;
  const Roll after = roll(log, back, end);
  const double hardest = hardest_mps2(log, back, end);
  figure("rolled until it was held", after.way_m, "m");
  figure("fastest", after.fastest_mps, "m/s");
  figure("hardest braking", hardest, "m/s/s");
  EXPECT_GT(after.fastest_mps, 0.5) << "it does not roll fast enough to show anything";
  EXPECT_LT(hardest, 2 * kBrakes_mps2) << "it is jerked to rest";
  EXPECT_LT(after.way_m, braking_way_m(after.fastest_mps) + 0.3);
  EXPECT_GT(end - after.rest, 1s) << "it is not held";
}

TEST(StopAndKill, RefusesAStartUntilTheStopIsReset) {
  const Record& log = record("stop_and_kill");
  const Time stopped = log.event("start drover stop");
  const Time reset = log.event("start drover reset");
  const auto moving = log.moving(stopped, reset);
  tell_way_to_rest(log, stopped, reset);
  figure("last motion after the stop", moving.empty() ? Duration{} : moving.back().time - stopped);
  EXPECT_THAT(log.moving(stopped + 100ms, reset), testing::IsEmpty());
  auto words = kStarted;
  words.insert(words.end(), {"start_task_failse", "start_task_success", "start_nav_success"});
  EXPECT_EQ(log.feedback_words(), words);
  EXPECT_NE(log.feedback.at(3).reason.find("reset the stop first"), std::string::npos)
      << log.feedback.at(3).reason;
  EXPECT_LT(log.feedback.at(3).time, reset);
}

// Their watchdogs would let go of the robot, and it rolled 7.5 m.
TEST(UnheardOnRamp, IsHeldOnByADroverdThatNeverHeardItsDrives) {
  const Record& log = record("unheard_on_ramp");
  const Time mute = log.event("event mute#1");
  const Time end = log.event("event looked_at#1");
  ASSERT_GT(log.truth_at(mute).z_m - log.truth.front().z_m, 0.1) << "it is not on the ramp";
  const double way_m = roll(log, mute, end).way_m;
  figure("way", way_m, "m");
  EXPECT_LT(way_m, 0.01);
  const Time restarted = log.event("event restarted#1");
  const Time heard = log.event("event heard#1");
  EXPECT_THAT(log.moving(mute, end), testing::IsEmpty());
  for (auto node = kFirstNode; node <= kLastNode; ++node) {
    Time before = restarted;
    Duration longest{};
    for (const CanLine& line : log.can) {
      if (line.time <= restarted || line.time > heard) continue;
      const auto wheel = wheel_command(line.frame);
      if (!wheel || wheel->node != node) continue;
      longest = std::max(longest, line.time - before);
      before = line.time;
    }
    EXPECT_LE(std::max(longest, heard - before), 50ms) << "node " << static_cast<int>(node);
  }
}

TEST(UnheardOnRamp, StartsAnewWhenTheyAreHeard) {
  const Record& log = record("unheard_on_ramp");
  EXPECT_LT(next_start(log, log.event("event looked_at#1")), Time::max());
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
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
