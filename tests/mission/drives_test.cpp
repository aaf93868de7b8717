// Missions without a fault: the track is driven, and told in the right order.
#include "drover/angle.h"
#include "mission/support.h"

namespace drover::mission {
namespace {

void expect_plain_mission(const char* name) {
  const Record& log = record(name);
  EXPECT_EQ(log.feedback_words(), kStarted);
  expect_nav_stays(log, "NAV_RUN", log.answered("start_nav_success"),
                   log.first_status("NAV_SUCCESS").time - 1ms);
  expect_good_drive(log);
}

TEST(StraightAndUturn, IsDrivenToSuccessCloseToTheTrack) {
  expect_plain_mission("straight_and_uturn");
}

TEST(Figure8, IsDrivenToSuccessCloseToTheTrack) {
  expect_plain_mission("figure8");
}

TEST(Long, IsDrivenToSuccessCloseToTheTrack) {
  expect_plain_mission("long");
}

/// Recorded by who backed it up: ahead, back, ahead, each with 60 degrees of turn to the left.
TEST(ThreePointTurn, IsDrivenAsItWasRecorded) {
  expect_plain_mission("three_point_turn");
  double turned_rad = 0;
  double back_m = 0;
  double fastest_back_mps = 0;
  const auto& truth = record("three_point_turn").truth;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const double dt_s = to_s(truth[i].time - truth[i - 1].time);
    turned_rad += std::abs(wrap_rad(truth[i].yaw_rad - truth[i - 1].yaw_rad));
    if (truth[i].vx_mps < 0) back_m -= truth[i].vx_mps * dt_s;
    fastest_back_mps = std::max(fastest_back_mps, -truth[i].vx_mps);
  }
  std::printf("  backs up %.2f m at up to %.2f m/s, turns by %.0f degrees in all\n", back_m,
              fastest_back_mps, to_deg(turned_rad));
  EXPECT_GT(back_m, 3.5);
  EXPECT_LT(fastest_back_mps, 0.25);
  EXPECT_LT(turned_rad, kPi + 1);
}

// A robot with the least that one needs: no inertial sensor, no bumper, no battery.
TEST(TwoWheels, AreDrivenToSuccessCloseToTheTrack) {
  expect_plain_mission("two_wheels");
}

// Both wheels behind one node.
TEST(Zlac8015d, IsDrivenToSuccessCloseToTheTrack) {
  expect_plain_mission("zlac8015d");
}

TEST(Long, LastsTenMinutes) {
  const Record& log = record("long");
  EXPECT_GE(to_s(log.truth.back().time - log.truth.front().time), 600.0);
}

}  // namespace
}  // namespace drover::mission
