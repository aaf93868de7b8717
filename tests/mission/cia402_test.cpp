// Two CANopen drives of CiA 402: what stops both when one of them dies, and when the gateway does.
#include "mission/support.h"
#include "mission/wire_cia402.h"

namespace drover::mission {
namespace {

TEST(Cia402, IsDrivenToSuccessCloseToTheTrack) {
  const Record& log = record("cia402");
  EXPECT_EQ(log.feedback_words(), kStarted);
  expect_nav_stays(log, "NAV_RUN", log.answered("start_nav_success"),
                   log.first_status("NAV_SUCCESS").time - 1ms);
  expect_good_drive(log);
}

TEST(Cia402KillOnRamp, IsStoppedByTheGuardsZerosToBothWithin100Milliseconds) {
  const Record& log = record("cia402_kill_on_ramp");
  const Time gone = log.event("signal 9 to droverd");
  const Time end = log.event("start droverd", 2);
  ASSERT_TRUE(moved_until(log, gone)) << "it did not drive when the gateway went";
  tell_way_to_rest(log, gone, end);
  EXPECT_THAT(log.moving(gone + 100ms, end), testing::IsEmpty());
  for (const std::uint8_t node : {1, 2}) {
    Time before = gone;
    std::size_t zeros = 0;
    std::size_t by_service = 0;
    for (const CanLine& line : log.can) {
      if (line.time <= gone || line.time > end) continue;
      const auto wheel = cia402::wheel_command(line.frame);
      by_service += cia402::is_zero_by_service(line.frame) && line.frame.id == 0x600U + node;
      if (!wheel || wheel->node != node || wheel->moves()) continue;
      if (++zeros == 1) figure("the guard's first zero after it went", line.time - gone);
      EXPECT_LE(line.time - before, zeros == 1 ? 100ms : 25ms) << "at " << seconds(line.time);
      before = line.time;
    }
    EXPECT_LE(end - before, 25ms) << "the guard gave up";
    EXPECT_GT(by_service, zeros / 3);
  }
}

// The drives make their quick stop in between, and are held in closed loop again.
TEST(Cia402KillOnRamp, HoldsTheRobotOnTheSlope) {
  expect_held_on_the_ramp(record("cia402_kill_on_ramp"));
}

TEST(Cia402KillOnRamp, StaysStoppedUntilANewStartReachesTheGoal) {
  const Record& log = record("cia402_kill_on_ramp");
  const Time back = log.event("start droverd", 2);
  expect_rest_until_started(log, back);
  expect_new_start_succeeds(log, back);
}

// The gateway's heartbeat goes on, and so would the last target.
TEST(Cia402MuteOnRamp, StopsAndHoldsTheRobotThoughTheAnswersOfBothAreLost) {
  const Record& log = record("cia402_mute_on_ramp");
  const Time mute = log.event("event mute#1");
  const Time end = log.event("event looked_at#1");
  ASSERT_TRUE(moved_until(log, mute)) << "it did not drive";
  ASSERT_GT(log.truth_at(mute).z_m - log.truth.front().z_m, 0.1) << "it is not on the ramp";
  tell_way_to_rest(log, mute, end);
  const Roll rolled = roll(log, mute, end);
  EXPECT_LT(rolled.rest - mute, 2s);
  EXPECT_LT(rolled.way_m, 0.3);
  const double held_m = roll(log, log.event("event killed#1"), end).way_m;
  figure("way beside a droverd that never heard them", held_m, "m");
  EXPECT_LT(held_m, 0.01);
  const Time heard = log.event("event heard#1");
  for (const std::uint8_t node : {1, 2}) {
    Time before = log.event("event killed#1");
    Duration longest{};
    for (const CanLine& line : log.can) {
      if (line.time <= before || line.time > heard) continue;
      const auto wheel = cia402::wheel_command(line.frame);
      if (!wheel || wheel->node != node) continue;
      EXPECT_FALSE(wheel->moves()) << "at " << seconds(line.time);
      longest = std::max(longest, line.time - before);
      before = line.time;
    }
    EXPECT_LE(std::max(longest, heard - before), 100ms);
  }
}

TEST(Cia402MuteOnRamp, StartsAnewWhenTheyAreHeard) {
  const Record& log = record("cia402_mute_on_ramp");
  EXPECT_LT(next_start(log, log.event("event looked_at#1")), Time::max());
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
}

// Without power its wheel rolls on, and the robot turns about the one that brakes: no motor can
// help.
TEST(Cia402Dead, OfOneNodeStopsTheOtherAndIsToldInWords) {
  const Record& log = record("cia402_dead");
  const Time died = log.event("event died#1");
  ASSERT_TRUE(moved_until(log, died));
  const auto& error = log.first_status("NAV_ERROR", died);
  figure("told after", error.time - died);
  EXPECT_LT(error.time - died, 400ms);
  EXPECT_EQ(error.why.find("wheel right: "), 0U) << error.why;
  EXPECT_THAT(log.moving(error.time + 1s, Time::max()), testing::IsEmpty());
  const Time end = log.event("event looked_at#1");
  tell_way_to_rest(log, died, end);
  const Roll rolled = roll(log, died, end);
  EXPECT_LT(rolled.rest - died, 3500ms);
  EXPECT_LT(rolled.way_m, 0.6);
  const double turned_rad =
      std::abs(std::remainder(log.truth_at(end).yaw_rad - log.truth_at(died).yaw_rad, 2 * M_PI));
  figure("turned about the wheel that holds", turned_rad * 180 / M_PI, "degrees");
  EXPECT_LT(turned_rad * 180 / M_PI, 130);
}

// It came to rest later than a ramp does, so its power was cut: a person resets that at the robot.
TEST(Cia402Dead, IsNotStartedAgainBeforeAReset) {
  const Record& log = record("cia402_dead");
  ASSERT_EQ(log.feedback.back().cmd, "start_task_failse");
  EXPECT_THAT(log.feedback.back().reason, testing::HasSubstr("reset the stop first"));
}

}  // namespace
}  // namespace drover::mission
