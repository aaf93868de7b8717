// How a recorded line ends: in which direction, and how it bends there.
#include "track/line_end.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drover/angle.h"
#include "support/tracks.h"
#include "track/legs.h"

namespace drover::track {
namespace {

constexpr double kSharp_rad = 0.6;

Route route_of(const Path& path) {
  return {path.points, path.points.size() - 1, true};
}

double between_deg(Vector a, Vector b) {
  return std::atan2(cross(a, b), dot(a, b)) * 180 / kPi;
}

Vector last_direction(const test::Points& drawn) {
  const PathPoint& a = drawn[drawn.size() - 2];
  const PathPoint& b = drawn.back();
  return unit({b.x_m - a.x_m, b.y_m - a.y_m}, {1, 0});
}

TEST(ALineEnd, OfAnArcIsItsTangentAndItsBend) {
  const auto drawn = test::Pen().arc(2, -kPi).points();
  const Path path = test::record(drawn, 0.5);
  const auto end = line_end(route_of(path), 0);
  ASSERT_TRUE(end);
  EXPECT_NEAR(between_deg(last_direction(drawn), end->ahead), 0, 1);
  EXPECT_NEAR(end->curvature_radpm, -0.5, 0.02);
  EXPECT_NEAR(end->point.x, drawn.back().x_m, 0.01);
  EXPECT_NEAR(end->point.y, drawn.back().y_m, 0.01);
}

TEST(ALineEnd, OfAStraightLineDoesNotBend) {
  const Path path = test::record(test::Pen().turn(1).line(6).points(), 0.02);
  const auto end = line_end(route_of(path), 0);
  ASSERT_TRUE(end);
  EXPECT_NEAR(between_deg({std::cos(1), std::sin(1)}, end->ahead), 0, 1e-6);
  EXPECT_NEAR(end->curvature_radpm, 0, 1e-9);
}

/// Points each half metre with a centimetre of noise; a chord of a quarter of a metre is 11 degrees
/// beside at the end of the figure of eight. The loop bends until 3 m before its end.
TEST(ALineEnd, IsTheLegsWithinTwoDegreesThroughTheNoiseOfRecording) {
  struct Way {
    const char* name;
    test::Points drawn;
    double most_deg = 2;
  };
  for (const Way& way : {Way{"rows", test::rows()}, Way{"figure8", test::figure_eight()},
                         Way{"square", test::square()}, Way{"loop", test::loop(), 3}}) {
    double worst_deg = 0;
    for (unsigned seed = 1; seed <= 200; ++seed) {
      const Path path = test::record(way.drawn, 0.5, 0.01, seed);
      const Route route = route_of(path);
      double end_m = 0;
      for (std::size_t k = 0; k + 1 < route.size(); ++k) end_m += route.segment_m(k);
      Leg leg;
      each_leg(route, kSharp_rad, end_m, [&](const Leg& next) { leg = next; });
      const Reference there = smooth(route, leg, {leg.first, leg.first_m}, end_m);
      worst_deg =
          std::max(worst_deg, std::abs(between_deg(last_direction(way.drawn), there.ahead)));
    }
    std::printf("%-8s %.1f degrees at the most\n", way.name, worst_deg);
    EXPECT_LT(worst_deg, way.most_deg) << way.name;
  }
}

TEST(ALineEnd, IsNotThatOfWhatLiesBeforeABend) {
  // A metre of a narrow bend at the end of a straight line: a chord is 7 degrees behind.
  const auto drawn = test::Pen().line(5).arc(1, 1).points();
  const Path path = test::record(drawn, 0.1);
  const auto end = line_end(route_of(path), 0);
  ASSERT_TRUE(end);
  EXPECT_NEAR(between_deg(last_direction(drawn), end->ahead), 0, 5);
}

TEST(ALineEnd, IsNoneWhereThereIsLittleLineOrNoArc) {
  EXPECT_FALSE(line_end(route_of(test::record(test::Pen().line(0.9).points(), 0.1)), 0));
  const Path long_chords{.points = {{0, 0}, {3, 0}, {6, 0.1}}};
  EXPECT_FALSE(line_end(route_of(long_chords), 0));
  Path zigzag;
  for (int i = 0; i < 40; ++i) zigzag.points.push_back({0.1 * i, i % 2 == 0 ? 0.0 : 0.1});
  EXPECT_FALSE(line_end(route_of(zigzag), 0));
  // Nothing before the point where the leg begins.
  const Path bent = test::record(test::Pen().line(4).turn(kPi / 2).line(0.8).points(), 0.1);
  EXPECT_FALSE(line_end(route_of(bent), bent.points.size() - 9));
}

TEST(ALineEnd, IsOfTheTargetAndOfNoCorner) {
  const Path path = test::record(test::square(), 0.5);
  const Route route = route_of(path);
  std::vector<Leg> legs;
  each_leg(route, kSharp_rad, 16, [&](const Leg& leg) { legs.push_back(leg); });
  ASSERT_EQ(legs.size(), 4U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(legs[i].arc_from_m, INFINITY);
  EXPECT_NEAR(legs[3].arc_from_m, 16 - kSmoothing_m, 1e-9);
}

TEST(ALineEnd, GoesOnFromTheLineBeforeIt) {
  const Path path = test::record(test::figure_eight(), 0.5, 0.01, 3);
  const Route route = route_of(path);
  double end_m = 0;
  for (std::size_t k = 0; k + 1 < route.size(); ++k) end_m += route.segment_m(k);
  const Leg leg = leg_to_target(route, 0, 0, end_m);
  ASSERT_LT(leg.arc_from_m, end_m);
  Station station{leg.first, leg.first_m};
  Vector before = position(route, leg, station, end_m - 1);
  for (double s_m = end_m - 0.99; s_m < end_m + 1; s_m += 0.01) {
    const Vector here = position(route, leg, station, s_m);
    EXPECT_LT(length(here - before), 0.035) << s_m - end_m;
    before = here;
  }
  EXPECT_LT(length(position(route, leg, station, end_m) - route.point(route.size() - 1)), 0.02);
}

}  // namespace
}  // namespace drover::track
