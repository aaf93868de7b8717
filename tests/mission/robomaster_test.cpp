// Four motors that are told currents: the speed loop is the gateway's, and the guard's only stop is
// no current.
#include "mission/support.h"
#include "mission/wire_robomaster.h"

namespace drover::mission {
namespace {

TEST(Robomaster, IsDrivenToSuccessCloseToTheTrack) {
  const Record& log = record("robomaster");
  EXPECT_EQ(log.feedback_words(), kStarted);
  expect_nav_stays(log, "NAV_RUN", log.answered("start_nav_success"),
                   log.first_status("NAV_SUCCESS").time - 1ms);
  expect_good_drive(log);
}

/// What does not leave lets the last current stand: they are told in every cycle.
TEST(Robomaster, IsToldItsCurrentsInEveryCycle) {
  const Record& log = record("robomaster");
  Time before = kNever;
  Duration longest{};
  for (const CanLine& line : log.can) {
    if (line.frame.id != 0x200) continue;
    if (before != kNever) longest = std::max(longest, line.time - before);
    before = line.time;
  }
  figure("longest between two commands", longest);
  EXPECT_LE(longest, 15ms);
}

double turned_deg(const Record& log, Time begin) {
  double most_rad = 0;
  for (const auto& line : log.truth)
    if (line.time > begin)
      most_rad = std::max(
          most_rad, std::abs(std::remainder(line.yaw_rad - log.truth_at(begin).yaw_rad, 2 * M_PI)));
  return most_rad * 180 / M_PI;
}

/// A wheel that is kept where it stands is pulled back by less than friction, 0.13 Nm.
std::vector<Sent> driven(const Record& log, Time begin) {
  std::vector<Sent> found = log.moving(begin, Time::max());
  std::erase_if(found, [](const Sent& one) { return std::abs(one.wheel.torque_Nm) < 0.1F; });
  return found;
}

// The wheel that tells nothing gets no current, and the three others brake.
TEST(RobomasterSilent, OfOneMotorBringsTheRobotToRest) {
  const Record& log = record("robomaster_silent");
  const Time silenced = log.event("event silenced#1");
  ASSERT_TRUE(moved_until(log, silenced));
  const auto last = driven(log, silenced);
  figure("last motion after it", last.empty() ? Duration{} : last.back().time - silenced);
  EXPECT_THAT(driven(log, silenced + 150ms), testing::IsEmpty());
  tell_way_to_rest(log, silenced, log.truth.back().time - 10ms);
  figure("turned", turned_deg(log, silenced), "degrees");
  const Roll rolled = roll(log, silenced, log.truth.back().time - 10ms);
  // The driver's README has half of these.
  EXPECT_LT(rolled.way_m, 0.35);
  EXPECT_LT(rolled.rest - silenced, 1000ms);
  EXPECT_LT(turned_deg(log, silenced), 15);
}

TEST(RobomasterSilent, IsToldInWordsAndEndsTheTask) {
  const Record& log = record("robomaster_silent");
  const Time silenced = log.event("event silenced#1");
  const auto& error = log.first_status("NAV_ERROR", silenced);
  figure("told after", error.time - silenced);
  EXPECT_LT(error.time - silenced, 400ms);
  EXPECT_THAT(error.why, testing::HasSubstr("wheel rear_left: motor 3 (203) is silent"));
}

TEST(RobomasterSilent, GetsNoCurrentForTheWheelThatNobodySees) {
  const Record& log = record("robomaster_silent");
  const Time silenced = log.event("event silenced#1");
  std::size_t looked = 0;
  for (const CanLine& line : log.can) {
    if (line.frame.id != 0x200 || line.time < silenced + 60ms) continue;
    ++looked;
    EXPECT_EQ(line.frame.data[4] * 256 + line.frame.data[5], 0) << "at " << seconds(line.time);
  }
  EXPECT_GT(looked, 0U);
}

/// The speed loop is the gateway's: a wheel that seems to stand is asked for ever more.
TEST(RobomasterStuck, IsFoundBeforeTheWheelThatSeemsToStandTurnsTheRobotFar) {
  const Record& log = record("robomaster_stuck");
  const Time stuck = log.event("event stuck#1");
  ASSERT_TRUE(moved_until(log, stuck));
  const auto& error = log.first_status("NAV_ERROR", stuck);
  figure("told after", error.time - stuck);
  EXPECT_THAT(
      error.why,
      testing::HasSubstr("wheel rear_left: motor 3 (203) tells the same angle however hard it"));
  EXPECT_LT(error.time - stuck, 400ms);
  const Time end = log.truth.back().time - 10ms;
  tell_way_to_rest(log, stuck, end);
  EXPECT_LT(roll(log, stuck, end).way_m, 0.45);
  EXPECT_LT(roll(log, stuck, end).rest - stuck, 1s);
  EXPECT_LT(roll(log, stuck, end).fastest_mps, 0.88) << "of 0.6";
  const double beside_m = drive_figures(log, log.answered("start_nav_success"), end).max_m;
  figure("beside its track, at most", beside_m, "m");
  EXPECT_LT(beside_m, 0.08);
}

/// Nobody sees what they do: no current, and all four coast.
TEST(RobomasterMute, CoastsToRestAndNeedsAPersonBeforeItIsStartedAgain) {
  const Record& log = record("robomaster_mute");
  const Time mute = log.event("event mute#1");
  const Time heard = log.event("event heard#1");
  ASSERT_TRUE(moved_until(log, mute));
  EXPECT_THAT(log.first_status("NAV_ERROR", mute).why,
              testing::HasSubstr("nothing heard of any motor"));
  for (const CanLine& line : log.can) {
    if (line.frame.id != 0x200 || line.time < mute + 100ms || line.time > heard) continue;
    EXPECT_TRUE(robomaster::is_zero(line.frame)) << "at " << seconds(line.time);
  }
  tell_way_to_rest(log, mute, heard);
  EXPECT_LT(roll(log, mute, heard).way_m, 0.9);
  EXPECT_LT(roll(log, mute, heard).rest - mute, 2600ms);
  EXPECT_THAT(driven(log, heard),
              testing::Each(testing::Field(&Sent::time, testing::Gt(log.event("event again#1")))));
}

/// The guard's zeros do not arrive, and the motors keep the current that they were told last.
TEST(MecanumUnplugKill, IsStoppedByTheRelayThatTheGuardOpens) {
  const Record& log = record("mecanum_unplug_kill");
  const Time killed = log.event("signal 9 to droverd");
  ASSERT_TRUE(moved_until(log, killed));
  const Time end = log.truth.back().time - 10ms;
  tell_way_to_rest(log, killed, end);
  const Roll rolled = roll(log, killed, end);
  EXPECT_FALSE(log.changes("enable_relay", killed, end).empty());
  // A droverd that lives opens it no sooner: 1.2 to 1.3 m.
  EXPECT_LT(rolled.way_m, 1.2);
  EXPECT_LT(rolled.rest - killed, 3200ms);
}

/// It is rolled by the three others, and tells that it has none.
TEST(RobomasterMute, StopsOnItsTrackWhenAMotorGetsNoCurrent) {
  const Record& log = record("robomaster_mute");
  const Time torn = log.event("event torn#1");
  const auto& error = log.first_status("NAV_ERROR", torn);
  figure("told after", error.time - torn);
  EXPECT_THAT(error.why, testing::HasSubstr("wheel rear_left: motor 3 (203) has no current"));
  EXPECT_LT(error.time - torn, 800ms);
  const double beside_m = drive_figures(log, log.event("event again#1"), Time::max()).max_m;
  figure("beside its track, at most", beside_m, "m");
  EXPECT_LT(beside_m, 0.1);
  EXPECT_LT(std::abs(log.truth.back().vx_mps), 0.01);
}

/// On tyres, and on mecanum wheels, ahead and to the side.
class RobomasterKill : public testing::TestWithParam<const char*> {};

TEST_P(RobomasterKill, IsLetCoastByTheGuardsZerosWithin100Milliseconds) {
  const Record& log = record(GetParam());
  const Time killed = log.event("signal 9 to droverd");
  const Time back = log.event("start droverd", 2);
  ASSERT_TRUE(moved_until(log, killed)) << "it did not drive when the gateway went";
  Time before = killed;
  std::size_t zeros = 0;
  for (const CanLine& line : log.can) {
    // What lay in the queue when it died may still leave.
    if (line.frame.id != 0x200 || line.time < killed + 10ms || line.time > back) continue;
    EXPECT_TRUE(robomaster::is_zero(line.frame)) << "at " << seconds(line.time);
    if (++zeros == 1) figure("the guard's first zero after it went", line.time - killed);
    EXPECT_LE(line.time - before, zeros == 1 ? 100ms : 15ms) << "at " << seconds(line.time);
    before = line.time;
  }
  EXPECT_LE(back - before, 15ms) << "the guard gave up";
  // On level ground by friction alone: what a person who stands before it must reckon with.
  const Roll rolled = roll(log, killed, back);
  figure("way coasted", rolled.way_m, "m");
  if (rolled.rest > killed) figure("time coasted ahead", rolled.rest - killed);
  // The driver's README has 0.43 m in 1.7 s.
  EXPECT_LT(rolled.way_m, 0.65);
  EXPECT_LT(rolled.rest - killed, 2500ms);
}

TEST_P(RobomasterKill, StaysStoppedUntilItIsStarted) {
  const Record& log = record(GetParam());
  expect_rest_until_started(log, log.event("start droverd", 2));
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
}

INSTANTIATE_TEST_SUITE_P(Each, RobomasterKill,
                         testing::Values("robomaster_kill", "mecanum_kill",
                                         "mecanum_sideways_kill"),
                         [](const auto& one) { return std::string(one.param); });

class RobomasterKillInATask : public testing::TestWithParam<const char*> {};

TEST_P(RobomasterKillInATask, IsFollowedByANewStartThatReachesTheGoal) {
  const Record& log = record(GetParam());
  expect_new_start_succeeds(log, log.event("start droverd", 2));
}

INSTANTIATE_TEST_SUITE_P(Each, RobomasterKillInATask,
                         testing::Values("robomaster_kill", "mecanum_kill"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace drover::mission
