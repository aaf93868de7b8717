// What the tracker refuses, where it begins, and what it says of a pose.
#include "engine/navigate/tracker.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "support/allocation_counter.h"
#include "unit/engine/navigate/tracker_rig.h"

namespace drover::engine {
namespace {

constexpr Duration kTick = std::chrono::milliseconds(5);

Path path_of(Points points) {
  Path path;
  path.points = std::move(points);
  return path;
}
std::uint32_t last(const Path& path) {
  return static_cast<std::uint32_t>(path.points.size() - 1);
}
Pose pose_at(double x_m, double y_m, double yaw_rad, double vx_mps = 0) {
  Pose pose;
  pose.x_m = x_m;
  pose.y_m = y_m;
  pose.yaw_rad = yaw_rad;
  pose.vx_mps = vx_mps;
  return pose;
}
Tracker tracker() {
  return Tracker(NavigateConfig{}, LimitsConfig{});
}
TrackProgress begin_and_locate(const Path& path, std::uint32_t target, const Pose& pose) {
  Tracker t = tracker();
  t.begin(path, target, 0.5, pose);
  return t.locate(pose);
}
/// Out for 10 m, a turn to the left of 1 m radius, and back.
Path hairpin() {
  Pen pen;
  return record(pen.line(10).arc(1, kPi).line(10).points());
}

TEST(CheckPath, RefusesAPathWithoutPoints) {
  EXPECT_EQ(check_path(path_of({}), 0).view(), "the track has no points");
}
TEST(CheckPath, RefusesASinglePoint) {
  EXPECT_EQ(check_path(path_of({{1, 2}}), 0).view(),
            "the track has only one point, two are needed");
}
TEST(CheckPath, RefusesATargetBeyondTheEndAndCountsFromOne) {
  const std::string reason{check_path(path_of({{0, 0}, {1, 0}}), 2).view()};
  EXPECT_EQ(reason, "the track has no point 3, only 1 to 2");
}
TEST(CheckPath, RefusesTheLargestTarget) {
  EXPECT_FALSE(check_path(path_of({{0, 0}, {1, 0}}), 0xFFFFFFFFU).empty());
}
TEST(CheckPath, RefusesWhatIsNotANumberAndNamesThePoint) {
  EXPECT_EQ(check_path(path_of({{0, 0}, {NAN, 0}, {2, 0}}), 2).view(),
            "point 2 of the track has no valid position");
  EXPECT_FALSE(check_path(path_of({{0, INFINITY}, {1, 0}}), 1).empty());
}
TEST(CheckPath, RefusesAGapOfAKilometreAndNamesThePoint) {
  EXPECT_EQ(check_path(path_of({{0, 0}, {1, 0}, {1, 1000}}), 2).view(),
            "point 3 of the track is 1000 m away from the one before it");
}
TEST(CheckPath, RefusesATrackOfOnePlaceOnly) {
  EXPECT_EQ(check_path(path_of({{1, 1}, {1, 1}, {1, 1}}), 1).view(),
            "all points of the track are the same");
}
TEST(CheckPath, RefusesMoreThan64PointsAtOnePlaceAndNamesThem) {
  Points points{{0, 0}, {1, 0}};
  for (int i = 0; i < 64; ++i) points.push_back({2, 0.0009 * (i % 2)});
  points.push_back({3, 0});
  EXPECT_EQ(check_path(path_of(points), 0).view(), "");
  points.insert(points.begin() + 3, {2, 0});
  EXPECT_EQ(check_path(path_of(points), 0).view(), "points 3 to 67 of the track are one place");
  points.insert(points.end(), 5000, {3, 0});
  EXPECT_EQ(check_path(path_of(points), 0).view(), "points 3 to 67 of the track are one place");
  points.erase(points.begin() + 3, points.begin() + 60);
  EXPECT_EQ(check_path(path_of(points), 0).view(), "points 11 to 5011 of the track are one place");
}
TEST(CheckPath, AcceptsEqualNeighboursAndLongSegments) {
  EXPECT_TRUE(check_path(path_of({{0, 0}, {0, 0}, {999, 0}, {999, 0}}), 0).empty());
}

/// Where the robot may be, too: its track is the same, and it is not moved along it by that.
TEST(Tracker, TellsHowFarAnotherPlaceIsBesideTheTrack) {
  const Path path = hairpin();
  Tracker t = tracker();
  EXPECT_EQ(t.beside_m(pose_at(5, 1, 0)), 0) << "there is none";
  t.begin(path, last(path), 0.5, pose_at(9.6, 0, 0));
  const double left_m = t.locate(pose_at(9.6, 0, 0)).distance_left_m;
  EXPECT_NEAR(t.beside_m(pose_at(9, 0, 0)), 0, 0.02);
  EXPECT_NEAR(t.beside_m(pose_at(9, -0.3, 0)), 0.3, 0.02);
  EXPECT_NEAR(t.beside_m(pose_at(7.5, 0.4, 0)), 0.4, 0.02);
  // The turn is about (10, 1).
  EXPECT_NEAR(t.beside_m(pose_at(11.6, 1, 0)), 0.6, 0.03);
  EXPECT_NEAR(t.beside_m(pose_at(10.6, 0.8, 0)), 1 - std::hypot(0.6, 0.2), 0.04);
  EXPECT_NEAR(t.locate(pose_at(9.6, 0, 0)).distance_left_m, left_m, 1e-9);
  t.begin(path, 20, 0.5, pose_at(8, 0, 0));
  (void)t.locate(pose_at(8, 0, 0));
  EXPECT_NEAR(t.beside_m(pose_at(10.5, 0.3, 0)), std::hypot(0.5, 0.3), 0.05) << "past its end";
}

TEST(Tracker, GivesNoMotionBeforeBeginAndAfterEnd) {
  const Path path = path_of({{0, 0}, {10, 0}});
  const Pose pose = pose_at(1, 0, 0);
  Tracker t = tracker();
  EXPECT_FALSE(t.active());
  EXPECT_EQ(t.follow(pose, t.locate(pose), 1, kTick).vx_mps, 0);
  t.begin(path, 1, 0.5, pose);
  EXPECT_TRUE(t.active());
  EXPECT_GT(t.follow(pose, t.locate(pose), 1, kTick).vx_mps, 0.4);
  t.end();
  EXPECT_FALSE(t.active());
  EXPECT_EQ(t.follow(pose, t.locate(pose), 1, kTick).vx_mps, 0);
}
TEST(Tracker, GivesNoMotionForAPoseThatIsNotANumber) {
  const Path path = path_of({{0, 0}, {10, 0}});
  Tracker t = tracker();
  t.begin(path, 1, 0.5, pose_at(1, 0, 0));
  for (double Pose::*const part :
       {&Pose::x_m, &Pose::y_m, &Pose::yaw_rad, &Pose::vx_mps, &Pose::vy_mps, &Pose::wz_radps}) {
    Pose bad = pose_at(1, 0, 0);
    bad.*part = NAN;
    EXPECT_TRUE(is_zero(t.follow(bad, t.locate(bad), 1, kTick)));
  }
}
TEST(Tracker, GivesNoMotionUnderACapOfZeroOrNoNumber) {
  const Path path = path_of({{0, 0}, {10, 0}});
  const Pose pose = pose_at(1, 0.3, 0);
  Tracker t = tracker();
  t.begin(path, 1, 0.5, pose);
  for (const double cap_mps : {0.0, -1.0, double{NAN}}) {
    const Twist twist = t.follow(pose, t.locate(pose), cap_mps, kTick);
    EXPECT_EQ(twist.vx_mps, 0);
    EXPECT_EQ(twist.wz_radps, 0);
  }
}

TEST(Tracker, BeginsAtTheNearestPointForwards) {
  const TrackProgress p =
      begin_and_locate(path_of({{0, 0}, {5, 0}, {10, 0}}), 2, pose_at(3, 0.4, 0.1));
  EXPECT_NEAR(p.cross_track_m, 0.4, 1e-9);
  EXPECT_NEAR(p.heading_error_rad, 0.1, 1e-9);
  EXPECT_NEAR(p.distance_left_m, 7, 1e-6);
  EXPECT_FALSE(p.arrived);
  EXPECT_FALSE(p.joined);
}
TEST(Tracker, GoesBackAlongTheListToALowerTarget) {
  const TrackProgress p =
      begin_and_locate(path_of({{0, 0}, {5, 0}, {10, 0}}), 0, pose_at(7, 0.4, -kPi));
  EXPECT_NEAR(p.cross_track_m, -0.4, 1e-9);
  EXPECT_NEAR(p.heading_error_rad, 0, 1e-9);
  EXPECT_NEAR(p.distance_left_m, 7, 1e-6);
}
TEST(Tracker, SaysHowBadlyTheRobotIsTurned) {
  const TrackProgress p = begin_and_locate(path_of({{0, 0}, {10, 0}}), 1, pose_at(3, 0, 2.0));
  EXPECT_NEAR(p.heading_error_rad, 2.0, 1e-9);
}
TEST(Tracker, StopsAtATargetInTheMiddle) {
  const TrackProgress p =
      begin_and_locate(path_of({{0, 0}, {4, 0}, {10, 0}, {20, 0}}), 2, pose_at(1, 0, 0));
  EXPECT_NEAR(p.distance_left_m, 9, 1e-6);
}
TEST(Tracker, BeginsBehindTheFirstPointOnTheLineBeforeIt) {
  const TrackProgress p = begin_and_locate(path_of({{0, 0}, {10, 0}}), 1, pose_at(-1.5, 0.5, 0));
  EXPECT_NEAR(p.distance_left_m, 11.5, 1e-6);
  EXPECT_NEAR(p.cross_track_m, 0.5, 1e-9);
}
TEST(Tracker, TakesTheLegThatFitsTheHeadingWhereTwoLegsAreEquallyNear) {
  const Path out_and_back = path_of({{0, 0}, {10, 0}, {20, 0}, {10, 0}, {0, 0}});
  EXPECT_NEAR(begin_and_locate(out_and_back, 4, pose_at(4, 0.05, 0)).distance_left_m, 36, 1e-6);
  EXPECT_NEAR(begin_and_locate(out_and_back, 4, pose_at(4, 0.05, kPi)).distance_left_m, 4, 1e-6);
}
TEST(Tracker, TakesTheLegAheadAtARightAngledCorner) {
  const Path corner = path_of({{0, 0}, {10, 0}, {10, 10}});
  EXPECT_NEAR(begin_and_locate(corner, 2, pose_at(10, 0, kPi / 2)).distance_left_m, 10, 1e-6);
  EXPECT_NEAR(begin_and_locate(corner, 2, pose_at(9.95, 0, kPi / 2)).heading_error_rad, 0, 1e-6);
  EXPECT_NEAR(begin_and_locate(corner, 2, pose_at(10, 0, 0)).heading_error_rad, 0, 1e-6);
}
TEST(Tracker, DrivesALoopInsteadOfBeingThereAlready) {
  Pen pen;
  const Path loop = record(pen.arc(5, 2 * kPi).points());
  const TrackProgress p = begin_and_locate(loop, last(loop), pose_at(0.02, 0.01, 0));
  EXPECT_NEAR(p.distance_left_m, 2 * kPi * 5, 0.2);
  EXPECT_FALSE(p.arrived);
}
TEST(Tracker, TakesTheFirstOfTwoEqualPasses) {
  Pen pen;
  const Path twice = record(pen.arc(5, 2 * kPi).arc(5, 2 * kPi).points());
  const TrackProgress p = begin_and_locate(twice, last(twice), pose_at(0, 10, kPi));
  EXPECT_NEAR(p.distance_left_m, 3 * kPi * 5, 0.3);
}
TEST(Tracker, IgnoresEqualNeighbours) {
  const Path path = path_of({{0, 0}, {0, 0}, {5, 0}, {5, 0}, {5, 0}, {10, 0}, {10, 0}});
  const TrackProgress p = begin_and_locate(path, 6, pose_at(5, 0.1, 0));
  EXPECT_NEAR(p.distance_left_m, 5, 1e-6);
  EXPECT_NEAR(p.cross_track_m, 0.1, 1e-9);
}

TEST(Tracker, StaysOnItsLegWhereTheTrackCrossesItself) {
  // The second leg crosses the first at (5, 0).
  const Path path = path_of({{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, -5}});
  Tracker t = tracker();
  t.begin(path, 4, 0.5, pose_at(1, 0, 0));
  double left_m = 30;
  for (double x_m = 1; x_m < 9.5; x_m += 0.01) {
    const TrackProgress p = t.locate(pose_at(x_m, 0, kPi / 2));
    EXPECT_LT(p.distance_left_m, left_m + 1e-9);
    left_m = p.distance_left_m;
  }
  EXPECT_NEAR(left_m, 0.5 + 5 + 5 + 10, 0.02);
}
TEST(Tracker, StaysOnItsRowBesideANearerRow) {
  const Path path = hairpin();
  Tracker t = tracker();
  t.begin(path, last(path), 0.5, pose_at(2, 0, 0));
  // Pushed over to 0.3 m from the way back: still on the way out.
  double y_m = 0;
  TrackProgress p;
  for (double x_m = 2; x_m < 6; x_m += 0.02) {
    y_m = std::min(y_m + 0.01, 1.7);
    p = t.locate(pose_at(x_m, y_m, 0));
  }
  EXPECT_NEAR(p.cross_track_m, 1.7, 1e-6);
  EXPECT_NEAR(p.distance_left_m, 4 + kPi + 10, 0.1);
}
TEST(Tracker, KnowsThatARobotRolledBack) {
  const Path path = path_of({{0, 0}, {20, 0}});
  Tracker t = tracker();
  t.begin(path, 1, 0.5, pose_at(5, 0, 0));
  TrackProgress p;
  for (double x_m = 5; x_m > 3; x_m -= 0.01) p = t.locate(pose_at(x_m, 0, 0));
  EXPECT_NEAR(p.distance_left_m, 17, 0.02);
}

TEST(Tracker, IsThereWhenItRestsInsideTheTolerance) {
  const Path path = path_of({{0, 0}, {10, 0}});
  EXPECT_TRUE(begin_and_locate(path, 1, pose_at(9.93, 0, 0)).arrived);
  EXPECT_FALSE(begin_and_locate(path, 1, pose_at(9.88, 0, 0)).arrived);
}
TEST(Tracker, IsNotThereYetWhileItRollsTowardsTheGoal) {
  const Path path = path_of({{0, 0}, {10, 0}});
  Tracker t = tracker();
  t.begin(path, 1, 0.5, pose_at(9.8, 0, 0, 0.1));
  EXPECT_FALSE(t.locate(pose_at(9.93, 0, 0, 0.1)).arrived);
  EXPECT_TRUE(t.locate(pose_at(9.98, 0, 0, 0.1)).arrived);
}
TEST(Tracker, IsThereJustBeyondTheGoalButNotFarBeyond) {
  const Path path = path_of({{0, 0}, {10, 0}});
  EXPECT_TRUE(begin_and_locate(path, 1, pose_at(10.15, 0, 0, 0.1)).arrived);
  const TrackProgress beyond = begin_and_locate(path, 1, pose_at(11, 0, 0));
  EXPECT_FALSE(beyond.arrived);
  EXPECT_TRUE(beyond.goal_passed);
  const TrackProgress beside = begin_and_locate(path, 1, pose_at(10.02, 0.6, 0));
  EXPECT_FALSE(beside.arrived);
  EXPECT_TRUE(beside.goal_passed);
}
TEST(Tracker, DoesNotDriveOnBeyondTheGoal) {
  const Path path = path_of({{0, 0}, {10, 0}});
  const Pose pose = pose_at(11, 0.5, 0);
  Tracker t = tracker();
  t.begin(path, 1, 0.5, pose);
  EXPECT_EQ(t.follow(pose, t.locate(pose), 1, kTick).vx_mps, 0);
}

TEST(Tracker, SteersTowardsTheLine) {
  const Path path = path_of({{0, 0}, {20, 0}});
  for (const double side_m : {0.2, -0.2}) {
    const Pose pose = pose_at(5, side_m, 0, 0.5);
    Tracker t = tracker();
    t.begin(path, 1, 0.5, pose);
    EXPECT_LT(t.follow(pose, t.locate(pose), 1, kTick).wz_radps * side_m, 0);
  }
}
TEST(Tracker, NeverAsksForMoreThanItsLimits) {
  const Path path = record(figure_eight(), 0.5, 0.05, 3);
  LimitsConfig limits;
  limits.max_speed_mps = 0.6;
  std::mt19937 random(7);
  const auto spread = [&](double size) {
    return size * (static_cast<double>(random()) / 2147483648.0 - 1);
  };
  Tracker t(NavigateConfig{}, limits);
  t.begin(path, last(path), 2.0, pose_at(0, 0, 0));
  for (int i = 0; i < 20000; ++i) {
    Pose pose = pose_at(spread(6), spread(6), spread(kPi), spread(1));
    pose.wz_radps = spread(2);
    const Twist twist = t.follow(pose, t.locate(pose), 10, kTick);
    ASSERT_GE(twist.vx_mps, 0);
    ASSERT_LE(twist.vx_mps, 0.6);
    ASSERT_LE(std::abs(twist.wz_radps), limits.max_yaw_rate_radps + 1e-12);
  }
}
TEST(Tracker, SurvivesAnyPathThatCheckPathAccepts) {
  std::mt19937 random(11);
  const auto pick = [&](unsigned n) { return static_cast<unsigned>(random()) % n; };
  const auto spread = [&](double size) {
    return size * (static_cast<double>(random()) / 2147483648.0 - 1);
  };
  for (int round = 0; round < 3000; ++round) {
    const double size_m = std::array{1e-4, 0.05, 0.7, 20.0}[pick(4)];
    Points points{{spread(5), spread(5)}};
    for (unsigned i = 1 + pick(12); i > 0; --i) {
      PathPoint p = points[pick(4) == 0 ? pick(static_cast<unsigned>(points.size()))
                                        : static_cast<unsigned>(points.size()) - 1];
      if (pick(4) != 0) p = {p.x_m + spread(size_m), p.y_m + spread(size_m)};
      points.push_back(p);
    }
    const Path path = path_of(points);
    const std::uint32_t target = pick(static_cast<unsigned>(points.size()));
    if (!check_path(path, target).empty()) continue;
    Pose pose = pose_at(points[0].x_m + spread(2), points[0].y_m + spread(2), spread(kPi));
    Tracker t = tracker();
    t.begin(path, target, 0.5, pose);
    for (int i = 0; i < 40; ++i) {
      const TrackProgress p = t.locate(pose);
      const Twist twist = t.follow(pose, p, 0.5, kTick);
      ASSERT_TRUE(std::isfinite(p.cross_track_m) && std::isfinite(p.distance_left_m));
      ASSERT_TRUE(std::isfinite(p.heading_error_rad));
      ASSERT_TRUE(twist.vx_mps >= 0 && twist.vx_mps <= 0.5);
      ASSERT_LE(std::abs(twist.wz_radps), 0.8 + 1e-12);
      pose.yaw_rad = wrap_rad(pose.yaw_rad + 0.1 * twist.wz_radps);
      pose.x_m += 0.1 * twist.vx_mps * std::cos(pose.yaw_rad);
      pose.y_m += 0.1 * twist.vx_mps * std::sin(pose.yaw_rad);
      pose.vx_mps = twist.vx_mps;
      pose.wz_radps = twist.wz_radps;
    }
  }
}
TEST(Tracker, IsNotConfusedForGoodByAnAbsurdPose) {
  const Path path = path_of({{0, 0}, {10, 0}});
  Tracker t = tracker();
  t.begin(path, 1, 0.5, pose_at(1, 0, 0));
  t.locate(pose_at(1e300, -1e300, 0));
  t.locate(pose_at(NAN, 0, 0));
  EXPECT_NEAR(t.locate(pose_at(1, 0, 0)).distance_left_m, 9, 1e-6);
}
TEST(Tracker, SlowsBeforeABendNotInIt) {
  Pen pen;
  const Path path = record(pen.line(10).arc(1, kPi).line(10).points());
  const auto speed_at = [&](double x_m) {
    const Pose pose = pose_at(x_m, 0, 0, 0.8);
    Tracker t = tracker();
    t.begin(path, last(path), 0.8, pose);
    return t.follow(pose, t.locate(pose), 10, kTick).vx_mps;
  };
  EXPECT_DOUBLE_EQ(speed_at(5), 0.8);
  EXPECT_LT(speed_at(9.9), 0.75);
  EXPECT_GT(speed_at(9.9), 0.5);
}

TEST(Tracker, AllocatesNothingAndIsTheSameToTheBitEachTime) {
  const Path path = record(rows(), 0.5, 0.01);
  double first = 0;
  for (int round = 0; round < 2; ++round) {
    Tracker t = tracker();
    const test::AllocationCounter counter;
    double sum = 0;
    t.begin(path, last(path), 0.5, pose_at(0, 0.5, 0));
    for (int i = 0; i < 1000; ++i) {
      const Pose pose = pose_at(0.008 * i, 0.1, 0.01, 0.5);
      sum += t.follow(pose, t.locate(pose), 1, kTick).wz_radps;
    }
    t.end();
    EXPECT_EQ(counter.count(), 0U);
    if (round == 0) first = sum;
    EXPECT_EQ(sum, first);
  }
}
TEST(Tracker, FindsItsPlaceAmongAHundredThousandPoints) {
  Path path;
  for (int i = 0; i < 100000; ++i) path.points.push_back({0.1 * i, std::sin(0.001 * i)});
  const TrackProgress p = begin_and_locate(path, 99999, pose_at(7000, std::sin(70.0) + 0.2, 0.006));
  EXPECT_NEAR(p.cross_track_m, 0.2, 0.01);
  EXPECT_NEAR(p.distance_left_m, 2999.9, 0.5);
}

}  // namespace
}  // namespace drover::engine
