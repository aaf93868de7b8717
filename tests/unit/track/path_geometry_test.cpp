#include "track/path_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "drover/angle.h"
#include "unit/track/tracks.h"

namespace drover::track {
namespace {

/// The place's own segment, found anew.
Station station_at(const Route& route, const Leg& leg, double s_m) {
  return seek(route, leg, {leg.first, leg.first_m}, s_m);
}

TEST(ARoute, EndsAtItsTargetWhicheverWayTheListIsDriven) {
  const Points points{{0, 0}, {1, 0}, {3, 0}, {7, 0}};
  const Route forwards(points, 2, true);
  EXPECT_EQ(forwards.size(), 3U);
  EXPECT_EQ(forwards.point(0).x, 0);
  EXPECT_EQ(forwards.point(2).x, 3);
  EXPECT_EQ(forwards.index(2), 2U);
  const Route backwards(points, 1, false);
  EXPECT_EQ(backwards.size(), 3U);
  EXPECT_EQ(backwards.point(0).x, 7);
  EXPECT_EQ(backwards.point(2).x, 1);
  EXPECT_EQ(backwards.index(2), 1U);
  EXPECT_EQ(backwards.segment_m(0), 4);
}

TEST(AStation, IsWhereItsArcLengthIsWhereverItComesFrom) {
  const Points points{{0, 0}, {1, 0}, {1, 0}, {3, 0}, {3, 4}};
  const Route route = forwards_along(points);
  const Leg leg = whole_leg(route);
  for (const Station from : {Station{0, 0}, Station{1, 1}, Station{3, 3}}) {
    const Station there = seek(route, leg, from, 2);
    EXPECT_EQ(there.segment, 2U);
    EXPECT_EQ(there.start_m, 1);
    EXPECT_EQ(seek(route, leg, from, -5).segment, 0U);
    EXPECT_EQ(seek(route, leg, from, 50).segment, 3U);
  }
}

TEST(APosition, GoesOnStraightBeyondTheEndsOfItsLeg) {
  const Points points{{0, 0}, {2, 0}, {2, 3}};
  const Route route = forwards_along(points);
  const Leg leg = whole_leg(route);
  Station station;
  const Vector before = position(route, leg, station, -1);
  EXPECT_EQ(before.x, -1);
  EXPECT_EQ(before.y, 0);
  const Vector on = position(route, leg, station, 3);
  EXPECT_EQ(on.x, 2);
  EXPECT_EQ(on.y, 1);
  const Vector beyond = position(route, leg, station, 6);
  EXPECT_EQ(beyond.x, 2);
  EXPECT_EQ(beyond.y, 4);
}

TEST(Chords, TellNoDirectionOfLessThanTenCentimetres) {
  const Points points{{0, 0}, {0.09, 0}, {1, 0}};
  const Route route = forwards_along(points);
  EXPECT_EQ(length(chord_before(route, 1, 0, 0.25)), 0);
  EXPECT_EQ(chord_after(route, 1, 2, 0.25).x, 1);
  EXPECT_EQ(corner_rad(route, 1, 0), 0);
}

TEST(Corners, AreAsSharpAsTheRouteTurns) {
  for (const double turn_rad : {-2.0, -kPi / 2, 0.3, 1.0, 3.0}) {
    const Points points{{-2, 0}, {0, 0}, {2 * std::cos(turn_rad), 2 * std::sin(turn_rad)}};
    EXPECT_NEAR(corner_rad(forwards_along(points), 1, 0), std::abs(turn_rad), 1e-12);
  }
}

TEST(TheSmoothLine, OfAStraightOneIsThatItself) {
  const Points points{{0, 0}, {0.3, 0.4}, {0.3, 0.4}, {3, 4}, {6, 8}};
  const Route route = forwards_along(points);
  const Leg leg = whole_leg(route);
  for (double s_m = -1; s_m < 11; s_m += 0.13) {
    const Reference there = smooth(route, leg, station_at(route, leg, s_m), s_m);
    EXPECT_NEAR(there.point.x, 0.6 * s_m, 1e-12);
    EXPECT_NEAR(there.point.y, 0.8 * s_m, 1e-12);
    EXPECT_NEAR(there.ahead.x, 0.6, 1e-12);
    EXPECT_NEAR(there.curvature_radpm, 0, 1e-12);
  }
}

TEST(TheSmoothLine, OfAnArcInChordsOfHalfAMetreIsAnArcOfOneCurvature) {
  for (const double radius_m : {1.5, 3.0, 10.0}) {
    const Points points = arc(radius_m, 6 / radius_m);
    const double sagitta_m = 0.5 * 0.5 / (8 * radius_m);
    const Route route = forwards_along(points);
    const Leg leg = whole_leg(route);
    for (double s_m = 1; s_m < leg.last_m - 1; s_m += 0.07) {
      const Reference there = smooth(route, leg, station_at(route, leg, s_m), s_m);
      EXPECT_NEAR(length(there.point - Vector{0, radius_m}), radius_m, sagitta_m) << radius_m;
      EXPECT_NEAR(there.curvature_radpm * radius_m, 1, 0.03) << radius_m;
      EXPECT_NEAR(dot(there.ahead, unit(there.point - Vector{0, radius_m}, {})), 0, 0.02);
    }
  }
}

TEST(TheSmoothLine, IsTheSameBackwards) {
  const Points points = arc(2, 2);
  const Route there = forwards_along(points);
  const Route back(points, 0, false);
  const Leg leg_there = whole_leg(there);
  const Leg leg_back = whole_leg(back);
  for (double s_m = 0.7; s_m < leg_there.last_m - 0.7; s_m += 0.11) {
    const double t_m = leg_there.last_m - s_m;
    const Reference a = smooth(there, leg_there, station_at(there, leg_there, s_m), s_m);
    const Reference b = smooth(back, leg_back, station_at(back, leg_back, t_m), t_m);
    EXPECT_NEAR(length(a.point - b.point), 0, 1e-12);
    EXPECT_NEAR(dot(a.ahead, b.ahead), -1, 1e-12);
    EXPECT_NEAR(a.curvature_radpm, -b.curvature_radpm, 1e-9);
  }
}

TEST(TheSmoothLine, IsTheSameWhereverItIsLookedForFrom) {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    const Points points = any_walk(random);
    const Route route = forwards_along(points);
    const Leg leg = whole_leg(route);
    const double s_m = std::uniform_real_distribution<>(-1, leg.last_m + 1)(random);
    const Reference a = smooth(route, leg, {leg.first, leg.first_m}, s_m);
    const Station last = seek(route, leg, {leg.first, leg.first_m}, leg.last_m);
    const Reference b = smooth(route, leg, last, s_m);
    EXPECT_NEAR(length(a.point - b.point), 0, 1e-9);
    EXPECT_NEAR(length(a.ahead - b.ahead), 0, 1e-9);
  }
}

TEST(AFoot, IsOnTheSmoothLineSquareToThePoint) {
  const Points points = arc(3, 2);
  const Route route = forwards_along(points);
  const Leg leg = whole_leg(route);
  for (double s_m = 1; s_m < leg.last_m - 1; s_m += 0.23) {
    const Station station = station_at(route, leg, s_m);
    const Reference there = smooth(route, leg, station, s_m);
    const Vector beside = there.point + 0.4 * Vector{-there.ahead.y, there.ahead.x};
    EXPECT_NEAR(find_foot(route, leg, station, s_m + 0.3, beside, 16).s_m, s_m, 2e-3);
    EXPECT_NEAR(offset_m(route, leg, station, {s_m, there}, beside), 0.4, 0.03);
  }
}

TEST(AFoot, StaysOnItsPassWhereTheLineCrossesItself) {
  const Points points{{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, -5}};
  const Route route = forwards_along(points);
  const Leg leg = whole_leg(route);
  EXPECT_NEAR(find_foot(route, leg, {0, 0}, 4.9, {5, 0.2}, 16).s_m, 5, 1e-3);
  EXPECT_NEAR(find_foot(route, leg, {3, 20}, 24.9, {5, 0.2}, 16).s_m, 24.8, 1e-3);
}

TEST(AnOffset, IsPositiveToTheLeft) {
  const Points points{{0, 0}, {10, 0}};
  const Route route = forwards_along(points);
  const Leg leg = whole_leg(route);
  const auto offset = [&](double s_m, Vector point) {
    return offset_m(route, leg, {}, {s_m, smooth(route, leg, {}, s_m)}, point);
  };
  EXPECT_NEAR(offset(5, {5, 0.3}), 0.3, 1e-12);
  EXPECT_NEAR(offset(5, {5, -0.3}), -0.3, 1e-12);
  EXPECT_NEAR(offset(-1, {-1, -0.3}), -0.3, 1e-12) << "before its beginning";
}

}  // namespace
}  // namespace drover::track
