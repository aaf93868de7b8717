// The anchor frees arrival times from delays and notices clocks that step.
#include "drivers/nmea0183/time_anchor.h"

#include <gtest/gtest.h>

namespace drover::nmea0183 {
namespace {

using namespace std::chrono_literals;

Time at(Duration since_start) {
  return Time{100s + since_start};
}

TEST(NmeaTimeAnchor, IsNeverLaterThanTheArrival) {
  TimeAnchor anchor;
  EXPECT_EQ(anchor.due(10h, at(0ms)), at(0ms));
  EXPECT_EQ(anchor.due(10h + 100ms, at(70ms)), at(70ms));
  EXPECT_EQ(anchor.due(11h, at(200ms)), at(200ms));
}

TEST(NmeaTimeAnchor, PlacesALateEpochWhereItWasDue) {
  TimeAnchor anchor;
  anchor.due(10h, at(0ms));
  const Time due = anchor.due(10h + 100ms, at(160ms));
  EXPECT_GE(due, at(100ms));
  EXPECT_LE(due, at(100ms) + 80us);
  EXPECT_EQ(anchor.due(10h + 200ms, at(200ms)), at(200ms));
}

TEST(NmeaTimeAnchor, FollowsAReceiverClockThatRunsSlow) {
  TimeAnchor anchor;
  Time due = at(0ms);
  Time arrival = at(0ms);
  for (int i = 0; i < 600; ++i) {
    arrival = at(i * 100ms + i * 10us);  // 100 ppm
    due = anchor.due(10h + i * 100ms, arrival);
  }
  EXPECT_EQ(due, arrival);
}

TEST(NmeaTimeAnchor, ShowsAReceiverThatLags) {
  TimeAnchor anchor;
  anchor.due(10h, at(0ms));
  Time due = kNever;
  for (int i = 1; i <= 20; ++i) due = anchor.due(10h + i * 100ms, at(i * 100ms + 1s));
  EXPECT_LE(due, at(2s + 5ms));
}

TEST(NmeaTimeAnchor, StartsAnewWhenUtcRunsBackwards) {
  TimeAnchor anchor;
  anchor.due(23h + 59min + 60s + 900ms, at(0ms));  // the leap second's end
  EXPECT_EQ(anchor.due(0h, at(130ms)), at(130ms));
  EXPECT_EQ(anchor.due(100ms, at(200ms)), at(200ms));
}

TEST(NmeaTimeAnchor, StartsAnewWhenUtcLeapsForward) {
  TimeAnchor anchor;
  anchor.due(10h, at(0ms));
  EXPECT_EQ(anchor.due(10h + 3s, at(100ms)), at(100ms));
}

TEST(NmeaTimeAnchor, StartsAnewAfterALongSilence) {
  TimeAnchor anchor;
  anchor.due(10h, at(0ms));
  EXPECT_EQ(anchor.due(10h + 11s, at(11s + 500ms)), at(11s + 500ms));
}

TEST(NmeaTimeAnchor, CrossesMidnight) {
  TimeAnchor anchor;
  anchor.due(24h - 100ms, at(0ms));
  const Time due = anchor.due(0h, at(150ms));
  EXPECT_LE(due, at(100ms) + 80us);
  EXPECT_GE(due, at(100ms));
  EXPECT_EQ(step_of_day(24h - 100ms, 0h), 100ms);
  EXPECT_EQ(step_of_day(0h, 24h - 100ms), -100ms);
}

TEST(NmeaTimeAnchor, ForgetsOnReset) {
  TimeAnchor anchor;
  anchor.due(10h, at(0ms));
  anchor.reset();
  EXPECT_EQ(anchor.due(10h + 100ms, at(1s)), at(1s));
}

}  // namespace
}  // namespace drover::nmea0183
