#include "scene/sensor/own_way.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drover/angle.h"

namespace drover::scene::sensor {
namespace {

using namespace std::chrono_literals;

constexpr Time kBegin{100s};

/// For so long, a note each 25 ms.
Time go(OwnWay& way, Time from, Duration time, const Twist& twist, double fastest_mps = 0) {
  for (Time t = from; t <= from + time; t += 25ms) way.note(t, twist, fastest_mps);
  return from + time;
}

TEST(OwnWay, IsDrivenOnArcs) {
  OwnWay way;
  EXPECT_FALSE(way.pose().has_value());
  // A quarter of a circle of 1 m.
  const double turn_radps = kPi / 2;
  const Time end = go(way, kBegin, 1s, {turn_radps, turn_radps});
  const auto there = way.pose(end);
  ASSERT_TRUE(there.has_value());
  EXPECT_NEAR(there->x_m, 1, 1e-3);
  EXPECT_NEAR(there->y_m, 1, 1e-3);
  EXPECT_NEAR(there->yaw_rad, kPi / 2, 1e-9);
  EXPECT_NEAR(way.pose(kBegin + 512ms)->yaw_rad, turn_radps * 0.512, 1e-9) << "between two notes";
}

TEST(OwnWay, LeadsAside) {
  OwnWay way;
  const Time end = go(way, kBegin, 1s, {0, 0, 0.4});
  EXPECT_NEAR(way.pose(end)->x_m, 0, 1e-9);
  EXPECT_NEAR(way.pose(end)->y_m, 0.4, 1e-9);
}

TEST(OwnWay, IsKnownForTwoSecondsAndAMomentAhead) {
  OwnWay way;
  const Time end = go(way, kBegin, 4s, {0.5, 0});
  EXPECT_FALSE(way.pose(end - 2100ms).has_value());
  EXPECT_NEAR(way.pose(end - 1900ms)->x_m, 1.05, 1e-9);
  EXPECT_NEAR(way.pose(end + 90ms)->x_m, 2, 1e-9);
  EXPECT_FALSE(way.pose(end + 110ms).has_value());
}

TEST(OwnWay, IsAnotherOneAfterWhatNobodyKnows) {
  for (const bool pause : {false, true}) {
    OwnWay way;
    const Time end = go(way, kBegin, 1s, {0.5, 0});
    const auto before = way.frame();
    if (pause)
      way.note(end + 600ms, {0.5, 0}, 0);
    else
      way.note(end + 25ms, {NAN, 0}, 0);
    EXPECT_NE(way.frame(), before);
    EXPECT_FALSE(way.pose(end).has_value());
  }
}

TEST(OwnWay, CountsWhatWasDrivenAheadAndNotWhatIsDrivenNow) {
  OwnWay way;
  Time end = go(way, kBegin, 1s, {0.8, 0});
  end = go(way, end + 25ms, 100ms, {0.1, 0});
  const double driven_m = way.ahead_m(end - 300ms);
  EXPECT_GE(driven_m, 0.175 * 0.8 + 0.1 * 0.1);
  EXPECT_LE(driven_m, 0.2 * 0.8 + 0.1 * 0.1 + 1e-9);
}

TEST(OwnWay, CountsTheLargerSpeedOfWhatIsDrivenAndTold) {
  OwnWay way;
  const Time end = go(way, kBegin, 1s, {0.2, 0}, 0.5);
  EXPECT_NEAR(way.ahead_m(end - 200ms), 0.1, 1e-9);
  EXPECT_NEAR(way.ahead_m(end - 210ms), 0.105, 1e-9) << "between two notes";
  EXPECT_EQ(way.ahead_m(end), 0);
  EXPECT_EQ(way.ahead_m(kNever), 0);
}

TEST(OwnWay, CountsNothingForWhoDrivesBack) {
  OwnWay way;
  const Time end = go(way, kBegin, 1s, {-0.5, 0});
  EXPECT_EQ(way.ahead_m(end - 300ms), 0);
}

TEST(OwnWay, TakesForWhatWasBeforeItsFirstNoteTheFastestThatItKnows) {
  OwnWay way;
  way.note(kBegin, {0.5, 0}, 0);
  way.note(kBegin + 25ms, {0.3, 0}, 0);
  EXPECT_NEAR(way.ahead_m(kBegin - 100ms), 0.05 + 0.0125, 1e-9);
}

}  // namespace
}  // namespace drover::scene::sensor
