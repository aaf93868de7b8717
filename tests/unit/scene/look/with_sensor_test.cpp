#include "scene/look/with_sensor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace drover::scene {
namespace {

using testing::HasSubstr;

constexpr double kFree = std::numeric_limits<double>::infinity();

Clearance free_clearance() {
  Clearance found;
  found.path = 3;
  found.along_m = kFree;
  found.ahead_m = found.back_m = 3;
  found.left_rad = found.right_rad = kFree;
  return found;
}

sensor::FieldView seen(bool blocked, bool unknown, double free_m) {
  sensor::FieldView view;
  view.field.blocked = blocked;
  view.field.unknown = unknown;
  view.field.free_m = free_m;
  return view;
}

const SensorTerms kAhead{0.1, true};
const SensorTerms kTurnsFirst{0.1, false};

TEST(WithSensor, AFieldThatIsFreeChangesNothing) {
  const Clearance found = with_sensor(free_clearance(), seen(false, false, 2), kAhead);
  EXPECT_EQ(found.along_m, kFree);
  EXPECT_EQ(found.ahead_m, 3) << "beyond the field other things are looked at";
  EXPECT_EQ(found.first.view(), "");
  EXPECT_EQ(found.unknown.view(), "");
}

TEST(WithSensor, WhatIsSeenEndsTheWayAheadAndAlongTheTrack) {
  const Clearance found = with_sensor(free_clearance(), seen(true, false, 1.5), kAhead);
  EXPECT_DOUBLE_EQ(found.ahead_m, 1.4);
  EXPECT_DOUBLE_EQ(found.along_m, 1.4);
  EXPECT_EQ(found.back_m, 3);
  EXPECT_EQ(found.left_rad, kFree);
  EXPECT_EQ(found.right_rad, kFree);
  EXPECT_EQ(found.first.view(), "a scanner sees something, 1.40 m ahead");
}

TEST(WithSensor, WhatIsSeenDoesNotEndATrackThatTurnsAwayFirst) {
  const Clearance found = with_sensor(free_clearance(), seen(true, false, 1.5), kTurnsFirst);
  EXPECT_DOUBLE_EQ(found.ahead_m, 1.4);
  EXPECT_EQ(found.along_m, kFree);
  EXPECT_EQ(found.first.view(), "") << "it is not in the way of the track";
}

TEST(WithSensor, WhatIsNearerAlreadyStaysTheFirst) {
  Clearance found = free_clearance();
  found.along_m = found.ahead_m = 0.5;
  found.first = "box1 is in the way, 0.50 m along the track";
  found = with_sensor(found, seen(true, false, 1.5), kAhead);
  EXPECT_EQ(found.along_m, 0.5);
  EXPECT_THAT(std::string(found.first.view()), HasSubstr("box1"));
}

TEST(WithSensor, WhatIsSeenAheadIsNotFirstForOneThatReverses) {
  Clearance found = free_clearance();
  found.path = 0;
  found.twist = {-0.3, 0};
  found = with_sensor(found, seen(true, false, 0.5), kAhead);
  EXPECT_DOUBLE_EQ(found.ahead_m, 0.4);
  EXPECT_EQ(found.first.view(), "");
}

TEST(WithSensor, NothingIsFreeWhereItDoesNotSee) {
  for (const bool blocked : {false, true}) {
    const Clearance found = with_sensor(free_clearance(), seen(blocked, true, 1.5), kAhead);
    EXPECT_THAT(std::string(found.unknown.view()), HasSubstr("does not see"));
    EXPECT_EQ(found.along_m + found.ahead_m + found.back_m + found.left_rad + found.right_rad, 0);
  }
  Clearance other = free_clearance();
  other.unknown = "the zones were not read yet";
  EXPECT_EQ(with_sensor(other, seen(false, true, 2), kAhead).unknown.view(), other.unknown.view());
}

TEST(WithSensor, SaysWhichScannerSeesAndWhichDoesNot) {
  auto view = seen(true, true, 1.5);
  view.scanner = "front";
  view.unknown = "rear: the scanner is silent for 1.0 s";
  const Clearance found = with_sensor(free_clearance(), view, kAhead);
  EXPECT_EQ(found.first.view(), "front sees something, 1.40 m ahead");
  EXPECT_EQ(found.unknown.view(), "rear: the scanner is silent for 1.0 s");
}

TEST(WithSensor, WhatWasDrivenSinceItWasSeenIsTakenOff) {
  const Clearance found =
      with_sensor(free_clearance(), seen(true, false, 1.5), {0.1, true, /*driven_m=*/0.25});
  EXPECT_DOUBLE_EQ(found.ahead_m, 1.15);
  EXPECT_DOUBLE_EQ(found.along_m, 1.15);
}

TEST(WithSensor, AFieldWithoutANumberIsBlockedAtOnce) {
  for (const double free_m : {double{NAN}, -1.0, 0.05}) {
    const Clearance found = with_sensor(free_clearance(), seen(true, false, free_m), kAhead);
    EXPECT_EQ(found.ahead_m, 0) << free_m;
    EXPECT_EQ(found.along_m, 0) << free_m;
  }
}

TEST(WithSensor, BoundsWhatTheMarginAloneLeavesToo) {
  Clearance found = free_clearance();
  found.bare = {kFree, 3, 3, kFree, kFree};
  const Clearance some = with_sensor(found, seen(true, false, 0.6), kAhead);
  EXPECT_DOUBLE_EQ(some.bare.ahead_m, 0.5);
  EXPECT_DOUBLE_EQ(some.bare.along_m, 0.5);
  const Clearance none = with_sensor(found, seen(false, true, 2), kAhead);
  EXPECT_EQ(none.bare.ahead_m + none.bare.back_m + none.bare.along_m + none.bare.left_rad, 0);
}

TEST(WithSensor, WhatIsSeenAheadIsNotFirstForOneThatTurnsOnTheSpot) {
  Clearance found = free_clearance();
  found.path = 0;
  found.twist = {0, 0.5};
  found = with_sensor(found, seen(true, false, 0.5), kAhead);
  EXPECT_DOUBLE_EQ(found.ahead_m, 0.4);
  EXPECT_EQ(found.first.view(), "");
}

}  // namespace
}  // namespace drover::scene
