// A chassis that steers, as an AgileX Hunter speaks.
#include <algorithm>
#include <cmath>
#include <deque>
#include <string>
#include <utility>

#include "mission/support.h"
#include "mission/wire_twist.h"

namespace drover::mission {
namespace {

TEST(Hunter, IsDrivenToSuccessCloseToTheTrack) {
  expect_drive_on_a_chassis("hunter");
}

TEST(Hunter, IsToldItsAngleWithinItsRangeAndItsBrakeAtTheRightTimes) {
  const Record& log = record("hunter");
  Time released = kNever;
  Time first_motion = kNever;
  Time last_motion = kNever;
  Time locked = kNever;
  for (const CanLine& line : log.can) {
    if (line.frame.id == 0x131 && line.frame.data[0] == 0) released = line.time;
    if (line.frame.id == 0x131 && line.frame.data[0] == 1) locked = line.time;
    const auto twist = hunter::twist_command(line.frame);
    if (!twist || !twist->moves()) continue;
    if (first_motion == kNever) first_motion = line.time;
    last_motion = line.time;
  }
  ASSERT_NE(released, kNever);
  EXPECT_LT(released, first_motion);
  ASSERT_NE(locked, kNever) << "it stands with its brake open";
  EXPECT_TRUE(locked > last_motion || locked < first_motion);
}

/// The least and the most `vz` that was told between two instants: the angle of its wheels.
std::pair<double, double> told_angles_rad(const Record& log, Time begin, Time end) {
  std::pair<double, double> angles{0, 0};
  for (const auto& status : log.statuses) {
    if (status.time < begin || status.time > end) continue;
    const double angle_rad = status.document.at("robot").at("vz").get<double>();
    angles.first = std::min(angles.first, angle_rad);
    angles.second = std::max(angles.second, angle_rad);
  }
  return angles;
}

/// When the way is over on which it swings to both sides, to see whether it is wired as told.
Time past_first_way(const Record& log) {
  for (const auto& line : log.truth)
    if (distance_m({line.x_m, line.y_m}, {log.truth[0].x_m, log.truth[0].y_m}) > 1.5)
      return line.time;
  return Time::max();
}

/// To the left on the U-turn, and hardly to the right at all.
TEST(Hunter, TellsItsSteeringAngle) {
  const Record& log = record("hunter");
  const auto [right_rad, left_rad] = told_angles_rad(log, past_first_way(log), Time::max());
  EXPECT_NEAR(left_rad, std::atan(0.65 / 1.5), 0.12);
  EXPECT_GT(right_rad, -0.12);
}

/// To the right on its first bend, of 2.5 m; and what is told is what its wheels do, also at rest.
TEST(HunterBacks, TellsItsSteeringAngleToBothSidesAndAtRest) {
  const Record& log = record("hunter_backs");
  const Time begin = past_first_way(log);
  const auto [right_rad, left_rad] = told_angles_rad(log, begin, begin + 10s);
  figure("to the right", right_rad, "rad");
  EXPECT_NEAR(right_rad, -std::atan(0.65 / 2.5), 0.1);
  EXPECT_LT(left_rad, 0.1);
  const Time rest = log.first_status("NAV_SUCCESS").time;
  const double there_rad = log.statuses.back().document.at("robot").at("vz").get<double>();
  const auto last = std::find_if(log.can.rbegin(), log.can.rend(),
                                 [](const CanLine& line) { return line.frame.id == 0x221; });
  ASSERT_NE(last, log.can.rend());
  const double by_the_chassis_rad =
      static_cast<std::int16_t>(last->frame.data[6] * 256 + last->frame.data[7]) * 0.001;
  EXPECT_NEAR(there_rad, by_the_chassis_rad, 0.02);
  EXPECT_GT(log.statuses.back().time, rest);
}

TEST(HunterBacks, IsDrivenAsItWasRecordedWithTwoMetresBackedUp) {
  const Record& log = record("hunter_backs");
  const Time begin = log.answered("start_nav_success");
  const Time end = log.first_status("NAV_SUCCESS", begin).time;
  double back_m = 0;
  double fastest_back_mps = 0;
  for (std::size_t i = 1; i < log.truth.size(); ++i) {
    const TruthLine& line = log.truth[i];
    if (line.time < begin || line.time > end || !(line.vx_mps < -0.01)) continue;
    back_m -= line.vx_mps * to_s(line.time - log.truth[i - 1].time);
    fastest_back_mps = std::max(fastest_back_mps, -line.vx_mps);
  }
  const DriveFigures drive = drive_figures(log, begin, end);
  figure("backwards", back_m, "m");
  figure("backwards at most", fastest_back_mps, "m/s");
  figure("cross-track RMS", drive.rms_m, "m");
  EXPECT_NEAR(back_m, 3.1, 0.2) << "its points are half a metre apart";
  EXPECT_LT(fastest_back_mps, 0.22);
  EXPECT_LT(drive.rms_m, 0.015);
  EXPECT_LT(drive.goal_m, 0.05);
}

/// What its inner wheel is told, against what was configured of it: 0.5 rad/s.
void expect_steered_within_its_rate(const std::string& mission) {
  constexpr Duration kWindow = 200ms;
  constexpr double kConfigured_radps = 0.5;
  constexpr double kLastDigit_rad = 0.001;
  const Record& log = record(mission);
  std::deque<std::pair<Time, double>> window;
  double most_rad = 0;
  for (const CanLine& line : log.can) {
    const auto told_rad = hunter::steering_rad(line.frame);
    if (!told_rad) continue;
    window.emplace_back(line.time, *told_rad);
    while (line.time - window.front().first > kWindow + 1ms) window.pop_front();
    most_rad = std::max(most_rad, std::abs(*told_rad - window.front().second));
  }
  figure("steered at most", most_rad / to_s(kWindow), "rad/s");
  EXPECT_GT(most_rad, 0.5 * kConfigured_radps * to_s(kWindow)) << "it was hardly steered";
  EXPECT_LT(most_rad, kConfigured_radps * to_s(kWindow + 1ms) + 2 * kLastDigit_rad);
}

TEST(Hunter, IsNotToldToSteerFasterThanItCan) {
  expect_steered_within_its_rate("hunter");
}

TEST(HunterBacks, IsNotToldToSteerFasterThanItCan) {
  expect_steered_within_its_rate("hunter_backs");
}

/// The guard's frames say straight ahead and no speed: its wheels turn as it stops.
TEST(HunterKillInBend, LeavesItsCurveByCentimetresOnly) {
  const Record& log = record("hunter_kill_in_bend");
  const Time killed = log.event("signal 9 to droverd");
  const Time back = log.event("start droverd", 2);
  ASSERT_TRUE(moved_until(log, killed)) << "it did not drive when the gateway went";
  EXPECT_GT(std::abs(log.truth_at(killed).wz_radps), 0.2) << "it was not in its bend";
  tell_way_to_rest(log, killed, back);
  EXPECT_LT(roll(log, killed, back).way_m, 0.15);
  const double beside_m = drive_figures(log, log.answered("start_nav_success"), back).max_m;
  figure("beside its track, at most", beside_m, "m");
  EXPECT_LT(beside_m, 0.08);
  expect_new_start_succeeds(log, back);
}

/// The chassis would go on with the next command: its time-out is over then.
TEST(HunterUnfed, StopsByItselfAndStaysAtRestUntilItIsStarted) {
  const Record& log = record("hunter_unfed");
  const Time hung = log.event("signal 19 to droverd");
  const Time started = next_start(log, hung);
  ASSERT_TRUE(moved_until(log, hung));
  tell_way_to_rest(log, hung, started);
  // Half a second until its time-out, and its stop.
  EXPECT_LT(roll(log, hung, started).way_m, 0.45);
  EXPECT_LT(roll(log, hung, started).rest - hung, 1300ms);
  std::size_t looked = 0;
  for (const CanLine& line : log.can) {
    if (line.time < hung + 100ms || line.time > started) continue;
    const auto twist = hunter::twist_command(line.frame);
    if (!twist) continue;
    ++looked;
    EXPECT_FALSE(twist->moves()) << "at " << seconds(line.time);
  }
  EXPECT_GT(looked, 100U) << "nobody told it anything after that";
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
}

/// The angle of its inner wheel, as it is told and as it says.
double angle_rad(const CanLine& line) {
  return static_cast<std::int16_t>(line.frame.data[6] * 256 + line.frame.data[7]) * 0.001;
}

/// Its speeds while it is caught are no curve.
TEST(HunterRemote, KeepsItsWheelsAsTheyAreWhenItIsGivenBackInABend) {
  const Record& log = record("hunter_remote");
  const Time taken = log.event("event taken#1");
  const Time back = log.event("event given_back#1");
  const Time again = next_start(log, back);
  ASSERT_TRUE(moved_until(log, taken));
  double left_rad = 0;
  double most_beside_rad = 0;
  std::size_t told = 0;
  for (const CanLine& line : log.can) {
    if (line.time < taken || line.time > again - 50ms) continue;
    if (line.frame.id == 0x221 && line.time < back) left_rad = angle_rad(line);
    if (line.time < back || (line.frame.id != 0x111 && line.frame.id != 0x221)) continue;
    told += line.frame.id == 0x111 ? 1 : 0;
    most_beside_rad = std::max(most_beside_rad, std::abs(angle_rad(line) - left_rad));
  }
  figure("turned its wheels by", most_beside_rad, "rad");
  EXPECT_GT(std::abs(left_rad), 0.15) << "it was not in its bend";
  EXPECT_GT(told, 400U) << "nobody told it anything after that";
  EXPECT_LT(most_beside_rad, 0.03);
  expect_rest_until_started(log, log.first_status("NAV_ERROR", taken).time + 1s);
  expect_new_start_succeeds(log, back);
}

TEST(HunterStuck, EndsItsTaskInsideOfItsCorridorAndSaysWhy) {
  const Record& log = record("hunter_stuck");
  const Time stuck = log.event("sim drive chassis fault steering_stuck");
  const auto& error = log.first_status("NAV_ERROR", stuck);
  EXPECT_THAT(error.why, testing::HasSubstr("the steering does not follow"));
  const Time again = next_start(log, error.time);
  tell_way_to_rest(log, error.time - 200ms, again);
  const double beside_m = drive_figures(log, log.answered("start_nav_success"), again - 10ms).max_m;
  figure("beside its track, at most", beside_m, "m");
  EXPECT_LT(beside_m, 0.5);
  const auto& success = log.first_status("NAV_SUCCESS", again);
  EXPECT_LT(drive_figures(log, again, success.time).goal_m, 0.10);
}

}  // namespace
}  // namespace drover::mission
