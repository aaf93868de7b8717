// Tracks that are driven backwards, all of them or from one cusp to the next, in closed loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/engine/navigate/tracker_rig.h"

namespace drover::engine {
namespace {

using test::three_point_turn;
using test::with_gears;

std::uint32_t end_of(const Path& path) {
  return static_cast<std::uint32_t>(path.points.size() - 1);
}

/// What the base did, of its poses.
struct Way {
  double turned_rad = 0;  ///< all its turns together
  double fastest_mps = 0;
  double fastest_back_mps = 0;
  double ahead_m = 0;
  double back_m = 0;
};
Way way_of(const Drive& d) {
  Way way;
  for (std::size_t i = 1; i < d.poses.size(); ++i) {
    const Pose& a = d.poses[i - 1];
    const Pose& b = d.poses[i];
    way.turned_rad += std::abs(wrap_rad(b.yaw_rad - a.yaw_rad));
    way.fastest_mps = std::max(way.fastest_mps, b.vx_mps);
    way.fastest_back_mps = std::max(way.fastest_back_mps, -b.vx_mps);
    const double along_m =
        (b.x_m - a.x_m) * std::cos(a.yaw_rad) + (b.y_m - a.y_m) * std::sin(a.yaw_rad);
    (along_m < 0 ? way.back_m : way.ahead_m) += std::abs(along_m);
  }
  return way;
}

DriveSetup quiet(double speed_mps = 0.5) {
  DriveSetup setup;
  setup.speed_mps = speed_mps;
  setup.keep_poses = true;
  setup.plant.position_noise_m = setup.plant.yaw_noise_rad = 0;
  return setup;
}

void expect_near_the_line(const Drive& d) {
  EXPECT_TRUE(d.arrived);
  EXPECT_LT(d.rms_m, 0.02);
  EXPECT_LT(d.max_m, 0.06);
  EXPECT_LT(d.final_m, 0.05);
}

TEST(TrackerBackwards, HoldsAThreePointTurnWithoutTurningRound) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Path path = with_gears(record(three_point_turn(), 0.5, 0.01, seed));
    DriveSetup setup = quiet();
    setup.plant.seed = seed;
    const Drive d = drive(path, end_of(path), setup);
    expect_near_the_line(d);
    const Way way = way_of(d);
    EXPECT_GT(way.back_m, 3.5);
    EXPECT_GT(way.ahead_m, 9.0);
    EXPECT_LT(way.turned_rad, 3 * kPi / 3 + 1.0) << "three bends, and no half turn at a cusp";
    EXPECT_GT(way.fastest_mps, 0.4);
    EXPECT_LT(way.fastest_back_mps, 0.22) << "nobody looks behind it";
  }
}

TEST(TrackerBackwards, WithoutGearsTurnsRoundAtTheCusps) {
  const Path path = record(three_point_turn(), 0.5, 0);
  const Drive d = drive(path, end_of(path), quiet());
  EXPECT_TRUE(d.arrived);
  const Way way = way_of(d);
  EXPECT_GT(way.turned_rad, 2 * kPi);
  EXPECT_LT(way.back_m, 0.1);
}

TEST(TrackerBackwards, DrivesAllOfATrackSoFromItsBeginning) {
  for (const Points& drawn : {test::rows(), test::figure_eight()}) {
    const Path path = with_gears(record(drawn, 0.5, 0), true);
    DriveSetup setup = quiet();
    setup.yaw_rad = kPi;  // its back to the way
    const Drive d = drive(path, end_of(path), setup);
    expect_near_the_line(d);
    EXPECT_LT(way_of(d).ahead_m, 0.1);
  }
}

TEST(TrackerBackwards, IsAsFastAsItIsConfigured) {
  const Path path = with_gears(record(test::rows(), 0.5, 0), true);
  DriveSetup setup = quiet(0.5);
  setup.yaw_rad = kPi;
  setup.navigate.backwards_speed_mps = 0.5;
  const Drive d = drive(path, end_of(path), setup);
  expect_near_the_line(d);
  EXPECT_GT(way_of(d).fastest_back_mps, 0.45);
}

TEST(TrackerBackwards, EitherWayGoesAsTheRobotStands) {
  const Path path = with_gears(record(three_point_turn(), 0.5, 0), false, true);
  for (const double yaw_rad : {0.0, kPi}) {
    DriveSetup setup = quiet();
    setup.yaw_rad = yaw_rad;
    const Drive d = drive(path, end_of(path), setup);
    expect_near_the_line(d);
    const Way way = way_of(d);
    EXPECT_LT(way.turned_rad, 3 * kPi / 3 + 1.0);
    if (yaw_rad == 0) {
      EXPECT_GT(way.ahead_m, way.back_m);
    } else {
      EXPECT_GT(way.back_m, way.ahead_m);
    }
  }
}

TEST(TrackerBackwards, TheListIsDrivenFromItsEndTheSameWayRound) {
  const Path path = with_gears(record(three_point_turn(), 0.5, 0));
  DriveSetup setup = quiet();
  setup.x_m = path.points.back().x_m;
  setup.y_m = path.points.back().y_m;
  setup.yaw_rad = wrap_rad(kPi / 3 * 3 + kPi);  // towards the list's beginning
  const Drive d = drive(path, 0, setup);
  expect_near_the_line(d);
  EXPECT_GT(way_of(d).back_m, 3.5);
  EXPECT_LT(way_of(d).turned_rad, 3 * kPi / 3 + 1.0);
}

TEST(TrackerBackwards, ComesBackToTheLineFromBeside) {
  Pen pen;
  pen.line(12);
  const Path path = with_gears(record(pen.points(), 0.5, 0), true);
  for (const double y_m : {-0.5, 0.5}) {
    DriveSetup setup = quiet();
    setup.y_m = y_m;
    setup.yaw_rad = wrap_rad(kPi + 0.3);
    const Drive d = drive(path, end_of(path), setup);
    EXPECT_TRUE(d.arrived);
    EXPECT_LT(d.final_m, 0.05);
    EXPECT_LT(way_of(d).ahead_m, 0.1);
  }
}

TEST(TrackerBackwards, TellsHowItIsTurnedAgainstHowItIsToLook) {
  const Path path = with_gears(record(test::rows(), 0.5, 0), true);
  Tracker tracker(NavigateConfig{}, LimitsConfig{});
  Pose pose;
  pose.x_m = 1;
  pose.y_m = 0.1;
  pose.yaw_rad = kPi - 0.1;
  tracker.begin(path, end_of(path), 0.5, pose);
  const TrackProgress progress = tracker.locate(pose);
  EXPECT_TRUE(progress.backwards);
  EXPECT_NEAR(progress.heading_error_rad, -0.1, 0.02);
  EXPECT_NEAR(progress.cross_track_m, 0.1, 0.01) << "left of the travel";
}

}  // namespace
}  // namespace drover::engine
