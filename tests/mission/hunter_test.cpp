// A chassis that steers, as an AgileX Hunter speaks.
#include <algorithm>
#include <cmath>

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
  EXPECT_TRUE(locked == kNever || locked > last_motion || locked < first_motion);
}

/// `vz` is the angle of its wheels: to the left on the U-turn.
TEST(Hunter, TellsItsSteeringAngle) {
  const Record& log = record("hunter");
  double most_rad = 0;
  for (const auto& status : log.statuses)
    most_rad = std::max(most_rad, status.document.at("robot").at("vz").get<double>());
  EXPECT_NEAR(most_rad, std::atan(0.65 / 1.5), 0.12);
}

TEST(HunterStuck, EndsItsTaskInsideOfItsCorridorAndSaysWhy) {
  const Record& log = record("hunter_stuck");
  const Time stuck = log.event("sim drive chassis fault steering_stuck");
  const auto& error = log.first_status("NAV_ERROR", stuck);
  EXPECT_THAT(error.why, testing::HasSubstr("the steering does not follow"));
  const Time again = next_start(log, error.time);
  tell_way_to_rest(log, error.time - 200ms, again);
  EXPECT_LT(pose_figures(log, kNever, Time::max()).max_m, 0.5);
  const auto& success = log.first_status("NAV_SUCCESS", again);
  EXPECT_LT(drive_figures(log, again, success.time).goal_m, 0.10);
}

}  // namespace
}  // namespace drover::mission
