// Where a track is too tight for a robot that steers.
#include "track/tight.h"

#include <gtest/gtest.h>

#include <random>

#include "drover/angle.h"
#include "unit/track/tracks.h"

namespace drover::track {
namespace {

using Kind = Tight::Kind;
const double kSharp_rad = to_rad(60.0);

Tight tight(const Points& points, double radius_m, std::size_t first = 0) {
  return find_tight(forwards_along(points), first, kSharp_rad, radius_m);
}

/// Straight on for 4 m, then round to the left.
Points bend(double radius_m, double angle_rad) {
  Points points;
  for (double x_m = -4; x_m < -0.25; x_m += 0.5) points.push_back({x_m, 0});
  for (const PathPoint& point : arc(radius_m, angle_rad)) points.push_back(point);
  return points;
}

TEST(TightPlaces, AreFoundWhereACurveIsTighterThanTheRadius) {
  const Points points = bend(1.5, kPi);
  EXPECT_EQ(tight(points, 1.45).kind, Kind::none);
  const Tight found = tight(points, 1.9);
  EXPECT_EQ(found.kind, Kind::curve);
  EXPECT_NEAR(found.radius_m, 1.5, 0.05);
  EXPECT_GE(found.point, 8U);
  EXPECT_LT(found.point, points.size());
}

TEST(TightPlaces, AreNoneOnStraightsAndWideCurves) {
  EXPECT_EQ(tight(bend(3, 2 * kPi), 1.9).kind, Kind::none);
  EXPECT_EQ(tight({{0, 0}, {50, 0}}, 1.9).kind, Kind::none);
}

TEST(TightPlaces, AreNoneByTheNoiseOfARecording) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise_m(0, 0.01);
  Points points = bend(2.2, kPi);
  for (PathPoint& point : points) {
    point.x_m += noise_m(random);
    point.y_m += noise_m(random);
  }
  EXPECT_EQ(tight(points, 1.9).kind, Kind::none);
}

/// By little enough that an arc of that radius stays within centimetres of it.
TEST(TightPlaces, AreNoneWhereATrackTurnsByLittleAtOnce) {
  const auto turn = [](double deg) {
    return Points{{-4, 0}, {0, 0}, {4 * std::cos(to_rad(deg)), 4 * std::sin(to_rad(deg))}};
  };
  EXPECT_EQ(tight(turn(20), 1.9).kind, Kind::none);
  EXPECT_EQ(tight(turn(45), 1.9).kind, Kind::curve);
  EXPECT_EQ(tight(turn(45), 1.9).point, 1U);
}

TEST(TightPlaces, AreCornersWithTheirPoint) {
  const Points points{{0, 0}, {4, 0}, {4, 4}, {8, 4}};
  const Tight found = tight(points, 0.5);
  EXPECT_EQ(found.kind, Kind::corner);
  EXPECT_EQ(found.point, 1U);
  EXPECT_NEAR(found.turn_rad, kPi / 2, 0.01);
}

TEST(TightPlaces, BehindTheRobotDoNotCount) {
  const Points points{{0, 0}, {0, 4}, {4, 4}, {8, 4}};
  EXPECT_EQ(tight(points, 1.0).kind, Kind::corner);
  EXPECT_EQ(tight(points, 1.0, 1).kind, Kind::none);
}

TEST(TightPlaces, AreNoneWhereTheRobotGoesOnTheOtherWay) {
  const Points points{{0, 0}, {2, 0}, {4, 0}, {2, 0.2}, {0, 0.8}};
  const std::vector<std::uint8_t> backwards{0, 0, 1, 1};
  const Route route(points, points.size() - 1, true, backwards);
  EXPECT_EQ(find_tight(route, 0, kSharp_rad, 1.9).kind, Kind::none);
  const Tight ahead_only = tight(points, 1.9);
  EXPECT_EQ(ahead_only.kind, Kind::corner);
  EXPECT_EQ(ahead_only.point, 2U);
}

TEST(TightPlaces, AreFoundByTheirNumberWhicheverWayTheListIsDriven) {
  const Points points{{0, 0}, {4, 0}, {4, 4}, {8, 4}, {12, 4}};
  const Route back(points, 0, false);
  const Tight found = find_tight(back, 0, kSharp_rad, 0.5);
  EXPECT_EQ(found.kind, Kind::corner);
  EXPECT_EQ(found.point, 2U);
}

TEST(TightPlaces, AreLookedForToTheEndOfALongTrack) {
  Points points;
  for (int i = 0; i < 100000; ++i) points.push_back({0.5 * i, std::sin(0.02 * i)});
  EXPECT_EQ(tight(points, 1.9).kind, Kind::none);
  points.push_back({points.back().x_m, points.back().y_m + 1});
  EXPECT_EQ(tight(points, 1.9).kind, Kind::corner);
}

}  // namespace
}  // namespace drover::track
