// Missions without a fault: the track is driven, and told in the right order.
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
