// Two hub motors behind one ZLAC8015D: what stops them when the gateway dies, when one motor fails,
// when their supply dips.
#include "mission/support.h"
#include "mission/wire_zlac8015d.h"

namespace drover::mission {
namespace {

constexpr Duration kGuard = 100ms;

// A target of zero each 20 ms, and between two of them one for a wheel by the service channel.
TEST(Zlac8015dKillOnRamp, IsStoppedByTheGuardWithin100Milliseconds) {
  const Record& log = record("zlac8015d_kill_on_ramp");
  const Time gone = log.event("signal 9 to droverd");
  const Time end = log.event("start droverd", 2);
  ASSERT_TRUE(moved_until(log, gone)) << "it did not drive when the gateway went";
  tell_way_to_rest(log, gone, end);
  EXPECT_THAT(log.moving(gone + kGuard, end), testing::IsEmpty());
  Time before = gone;
  std::size_t zeros = 0;
  std::size_t by_service = 0;
  for (const auto& line : log.can) {
    if (line.time <= gone || line.time > end) continue;
    const auto targets = zlac8015d::targets_turnps(line.frame);
    const bool zero = targets && (*targets)[0] == 0 && (*targets)[1] == 0;
    by_service += zlac8015d::is_zero_by_service(line.frame) ? 1 : 0;
    if (!zero && !zlac8015d::is_zero_by_service(line.frame)) continue;
    if (++zeros == 1) figure("the guard's first zero after it went", line.time - gone);
    EXPECT_LE(line.time - before, zeros == 1 ? kGuard : 15ms) << "at " << seconds(line.time);
    before = line.time;
  }
  EXPECT_LE(end - before, 15ms) << "the guard gave up";
  EXPECT_GT(by_service, zeros / 3);
}

TEST(Zlac8015dKillOnRamp, HoldsTheRobotOnTheSlope) {
  expect_held_on_the_ramp(record("zlac8015d_kill_on_ramp"));
}

// Its set-up takes longer than its time-out.
TEST(Zlac8015dKillOnRamp, IsHeldWhileTheNextProgramSetsItUp) {
  const Record& log = record("zlac8015d_kill_on_ramp");
  const Time back = log.event("start droverd", 2);
  const Roll held = roll(log, back, next_start(log, back) - kEstop);
  figure("way while it is set up", held.way_m, "m");
  EXPECT_LT(held.way_m, 0.01);
}

TEST(Zlac8015dKillOnRamp, StaysStoppedUntilANewStartReachesTheGoal) {
  const Record& log = record("zlac8015d_kill_on_ramp");
  const Time back = log.event("start droverd", 2);
  expect_rest_until_started(log, back);
  expect_new_start_succeeds(log, back);
}

// The motor that is well would turn the robot around the other.
TEST(Zlac8015dOverCurrent, OfOneMotorStopsBothAtOnce) {
  const Record& log = record("zlac8015d_over_current");
  const Time faulted = log.event("event faulted#1");
  ASSERT_TRUE(moved_until(log, faulted));
  const auto last = log.moving(faulted, Time::max());
  figure("last motion after the fault", last.empty() ? Duration{} : last.back().time - faulted);
  EXPECT_THAT(log.moving(faulted + 50ms, Time::max()), testing::IsEmpty());
  const double turned_rad =
      std::abs(std::remainder(log.truth.back().yaw_rad - log.truth_at(faulted).yaw_rad, 2 * M_PI));
  figure("turned around the wheel that holds", turned_rad * 180 / M_PI, "degrees");
  // README of the driver: by 135 degrees, for 2.8 s, from 0.6 m/s.
  EXPECT_LT(turned_rad * 180 / M_PI, 160);
  const Time end = log.truth.back().time - 10ms;
  tell_way_to_rest(log, faulted, end);
  EXPECT_LT(roll(log, faulted, end).rest - faulted, 3500ms);
  // Around the wheel that holds, whose distance from the middle is half a track.
  EXPECT_LT(roll(log, faulted, end).way_m, 0.5);
  EXPECT_NEAR(log.truth.back().vx_mps, 0, 0.01);
}

TEST(Zlac8015dOverCurrent, IsToldInWordsAndEndsTheTask) {
  const Record& log = record("zlac8015d_over_current");
  const auto& error = log.first_status("NAV_ERROR", log.event("event faulted#1"));
  EXPECT_LT(error.time - log.event("event faulted#1"), 200ms);
  EXPECT_EQ(error.why.find("wheel left: "), 0U) << error.why;
  EXPECT_NE(error.why.find("over-current, of the left or the right motor"), std::string::npos)
      << error.why;
}

// It coasts slowly enough to look as if it followed; the other wheel waits for it on the track.
TEST(Zlac8015dTornMotor, OfWhichTheDriveSaysNothingIsToldAndLeavesTheRobotOnItsTrack) {
  const Record& log = record("zlac8015d_torn_motor");
  const Time torn = log.event("event faulted#1");
  ASSERT_TRUE(moved_until(log, torn));
  const auto& error = log.first_status("NAV_ERROR", torn);
  EXPECT_NE(error.why.find("wheel right does not follow its command"), std::string::npos)
      << error.why;
  figure("told after", error.time - torn);
  EXPECT_LT(error.time - torn, 4s);
  double turned_rad = 0;
  for (const auto& line : log.truth)
    if (line.time > torn)
      turned_rad =
          std::max(turned_rad,
                   std::abs(std::remainder(line.yaw_rad - log.truth_at(torn).yaw_rad, 2 * M_PI)));
  figure("turned", turned_rad * 180 / M_PI, "degrees");
  EXPECT_LT(turned_rad * 180 / M_PI, 30);
  const double beside_m = drive_figures(log, torn, log.truth.back().time).max_m;
  figure("beside its track", beside_m, "m");
  EXPECT_LT(beside_m, 0.2);
  EXPECT_NEAR(log.truth.back().vx_mps, 0, 0.01);
}

// Its own time-out would let go of it.
TEST(Zlac8015dMuteOnRamp, HoldsTheRobotThoughItsAnswersAreLost) {
  const Record& log = record("zlac8015d_mute_on_ramp");
  const Time mute = log.event("event mute#1");
  const Time heard = log.event("event heard#1");
  const Time end = log.event("event looked_at#1");
  ASSERT_GT(log.truth_at(mute).z_m - log.truth.front().z_m, 0.1) << "it is not on the ramp";
  const double way_m = roll(log, mute, end).way_m;
  figure("way while it is not heard and set up anew", way_m, "m");
  EXPECT_LT(way_m, 0.01);
  Time before = mute;
  Duration longest{};
  for (const auto& line : log.can) {
    if (line.time <= mute || line.time > heard) continue;
    const auto targets = zlac8015d::targets_turnps(line.frame);
    if (!targets) continue;
    EXPECT_TRUE((*targets)[0] == 0 && (*targets)[1] == 0) << "at " << seconds(line.time);
    longest = std::max(longest, line.time - before);
    before = line.time;
  }
  EXPECT_LE(std::max(longest, heard - before), 15ms);
}

TEST(Zlac8015dMuteOnRamp, IsToldAsSilentAndStartsAnewWhenItIsHeard) {
  const Record& log = record("zlac8015d_mute_on_ramp");
  const Time mute = log.event("event mute#1");
  const auto silent = std::find_if(log.statuses.begin(), log.statuses.end(), [&](const auto& each) {
    return each.time > mute && each.why.find("no drive answers") != std::string::npos;
  });
  ASSERT_NE(silent, log.statuses.end());
  EXPECT_LT(silent->time - mute, 1s);
  EXPECT_LT(next_start(log, log.event("event looked_at#1")), Time::max());
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
}

TEST(Zlac8015dDipOnRamp, SetsTheDriveUpAnewAndHoldsTheRobotAgain) {
  const Record& log = record("zlac8015d_dip_on_ramp");
  const Time dipped = log.event("event dipped#1");
  const Time end = log.event("event looked_at#1");
  ASSERT_GT(log.truth_at(dipped).z_m - log.truth.front().z_m, 0.1) << "it is not on the ramp";
  const Roll rolled = roll(log, dipped, end);
  figure("rolled until it was held", rolled.way_m, "m");
  figure("fastest", rolled.fastest_mps, "m/s");
  figure("held after", rolled.rest - dipped);
  EXPECT_LT(rolled.rest - dipped, 3s);
  EXPECT_LT(roll(log, rolled.rest + 100ms, end).way_m, 0.01) << "it is not held";
  expect_new_start_succeeds(log, end);
}

// Neither ends the catch of the other: both slow down together.
TEST(Zlac8015dDipOnRamp, CatchesBothWheelsByOneRamp) {
  const Record& log = record("zlac8015d_dip_on_ramp");
  const Time dipped = log.event("event dipped#1");
  const Time end = log.event("event looked_at#1");
  const auto ramp = log.moving(dipped + 500ms, end);
  ASSERT_FALSE(ramp.empty()) << "no set point of the ramp came to the wire";
  figure("set points of the ramp", static_cast<double>(ramp.size()) / 2, "frames");
  double hardest_mps2 = 0;
  for (Time t = dipped; t + 100ms <= end; t += 10ms)
    hardest_mps2 = std::max(
        hardest_mps2,
        (std::abs(log.truth_at(t).vx_mps) - std::abs(log.truth_at(t + 100ms).vx_mps)) / 0.1);
  figure("hardest braking", hardest_mps2, "m/s/s");
  EXPECT_LT(hardest_mps2, 2.0) << "it is jerked to rest";
  double turned_rad = 0;
  for (const auto& line : log.truth)
    if (line.time > dipped && line.time < end)
      turned_rad =
          std::max(turned_rad,
                   std::abs(std::remainder(line.yaw_rad - log.truth_at(dipped).yaw_rad, 2 * M_PI)));
  figure("turned", turned_rad * 180 / M_PI, "degrees");
  EXPECT_LT(turned_rad, 0.1);
}

}  // namespace
}  // namespace drover::mission
