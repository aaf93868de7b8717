// A stream of joint commands that drives at a box: the shipped limits hold for it as for a task.

#include "mission/robot.h"
#include "mission/support.h"

namespace drover::mission {
namespace {

// limits.max_speed_mps and navigate.far_zone_speed_mps, both defaults.
constexpr double kMaxSpeed_mps = 0.8;
constexpr double kFarZoneSpeed_mps = 0.25;
// From the simulated robot's zones.
constexpr double kFarZone_m = 2.0;
constexpr double kNearZone_m = 0.6;
// A contact's debounce, a cycle, and what the drives need to follow.
constexpr Duration kToFollow = 150ms;

struct JointObstacle : testing::Test {
  const Record& log = record("joint_obstacle");
  const Time drive = log.event("event drive#1");
  const Time over = log.event("event commands_end#2");

  /// The first instant with less than this before the bumper.
  Time reached(double free_m) const {
    for (const auto& line : log.truth)
      if (line.time > drive && line.free_ahead_m < free_m) return line.time;
    ADD_FAILURE() << "it never comes to " << free_m << " m before the box";
    return over;
  }
  double fastest_mps(Time begin, Time end) const {
    double fastest = 0;
    for (const auto& line : log.truth)
      if (line.time >= begin && line.time <= end) fastest = std::max(fastest, line.vx_mps);
    return fastest;
  }
  double fastest_set_point_mps(Time begin, Time end) const {
    double fastest = 0;
    for (const auto& one : log.moving(begin, end)) fastest = std::max(fastest, log.rim_mps(one));
    return fastest;
  }
};

TEST_F(JointObstacle, TheStreamAsksForMuchMoreThanTheRobotMayAndGetsItsMaximum) {
  const Time far = reached(kFarZone_m);
  figure("fastest before the far zone", fastest_mps(drive, far), "m/s");
  EXPECT_GT(fastest_mps(drive, far), kMaxSpeed_mps - 0.05) << "the cap is not what slows it";
  EXPECT_LT(fastest_mps(drive, far), kMaxSpeed_mps + 0.05);
  EXPECT_LT(fastest_set_point_mps(drive, Time::max()), kMaxSpeed_mps + 0.001);
}

TEST_F(JointObstacle, InTheFarZoneItIsSlowedToThatZonesSpeedByARamp) {
  const Time far = reached(kFarZone_m);
  const Time near = reached(kNearZone_m);
  const Time slow = far + kToFollow + from_s((kMaxSpeed_mps - kFarZoneSpeed_mps) / kBrakes_mps2);
  ASSERT_LT(slow, near) << "the far zone is too small to see it slowly";
  figure("fastest in the far zone", fastest_mps(slow, near), "m/s");
  EXPECT_LT(fastest_mps(slow, near), kFarZoneSpeed_mps + 0.03);
  EXPECT_LT(fastest_set_point_mps(slow, near), kFarZoneSpeed_mps + 0.001);
  EXPECT_GT(log.truth_at(near).vx_mps, kFarZoneSpeed_mps - 0.05) << "it goes on, slowly";
}

TEST_F(JointObstacle, InTheNearZoneItStopsAndTheBumperNeverTouches) {
  const Time near = reached(kNearZone_m);
  const Time still = near + kToFollow + from_s(kFarZoneSpeed_mps / kBrakes_mps2);
  ASSERT_GT(over - still, 1s) << "nobody asks for motion any more";
  EXPECT_THAT(log.moving(still, Time::max()), testing::IsEmpty()) << "the stream goes on asking";
  double least_m = kFarZone_m;
  for (const auto& line : log.truth)
    if (line.time > drive) least_m = std::min(least_m, line.free_ahead_m);
  figure("left before the bumper", least_m, "m");
  EXPECT_GT(least_m, kNearZone_m - 0.1);
  EXPECT_NEAR(log.truth_at(over).vx_mps, 0, 0.01);
}

TEST_F(JointObstacle, TheOperatorIsToldWhy) {
  const std::string told = said(log, "droverd.log");
  EXPECT_THAT(told, testing::HasSubstr("joint commands ended: obstacle in the near zone"));
  EXPECT_TRUE(log.statuses.back().obstacle);
  for (const auto& status : log.statuses)
    EXPECT_EQ(status.why.find("bumper"), std::string::npos) << status.why;
}

}  // namespace
}  // namespace drover::mission
