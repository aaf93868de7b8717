#include "scene/sensor/seen.h"

#include <gtest/gtest.h>

namespace drover::scene::sensor {
namespace {

using namespace std::chrono_literals;

constexpr Time kNow{100s};

ScanSeen free_field(const char* device) {
  ScanSeen seen;
  seen.device = device;
  seen.state = SourceState::fresh;
  seen.begin = kNow - 150ms;
  seen.end = kNow - 50ms;
  seen.field.free_m = 2;
  seen.field.unknown = false;
  return seen;
}

ScanSeen with_a_thing_at(double free_m, const char* device) {
  ScanSeen seen = free_field(device);
  seen.field = {
      .blocked = true, .points = 3, .nearest = {free_m, 0}, .free_m = free_m, .unknown = false};
  return seen;
}

TEST(ScannersView, IsFreeWhenTheScannerSeesTheFieldAndNothingIsThere) {
  const ScanSeen scanners[] = {free_field("lidar")};
  const FieldView all = view(scanners, kNow);
  EXPECT_FALSE(all.field.blocked);
  EXPECT_FALSE(all.field.unknown);
  EXPECT_TRUE(all.unknown.empty());
  EXPECT_EQ(all.field.free_m, 2);
  EXPECT_EQ(all.since, kNow - 150ms);
}

TEST(ScannersView, IsUnknownWithoutOne) {
  const FieldView all = view({}, kNow);
  EXPECT_TRUE(all.field.unknown);
  EXPECT_EQ(all.unknown, "there is no scanner");
}

TEST(ScannersView, IsUnknownWhenTheTurnIsOldAndSaysWhose) {
  ScanSeen seen = free_field("lidar");
  seen.end = kNow - kOldestTurn;
  EXPECT_FALSE(view({&seen, 1}, kNow).field.unknown);
  const FieldView all = view({&seen, 1}, kNow + 200ms);
  EXPECT_TRUE(all.field.unknown);
  EXPECT_EQ(all.unknown, "lidar: no turn of the scanner for 0.5 s");
  seen.end = seen.begin = kNever;
  EXPECT_EQ(view({&seen, 1}, kNow).unknown, "lidar: no turn of the scanner yet");
}

TEST(ScannersView, IsUnknownWhenTheScannerIsNotWellAndSaysWhatItsDriverSays) {
  for (const SourceState state : {SourceState::never_heard, SourceState::stale}) {
    ScanSeen seen = free_field("lidar");
    seen.state = state;
    EXPECT_EQ(view({&seen, 1}, kNow).unknown, "lidar: the scanner is not heard");
    seen.reason = "the scanner is silent for 1.0 s";
    EXPECT_TRUE(view({&seen, 1}, kNow).field.unknown);
    EXPECT_EQ(view({&seen, 1}, kNow).unknown, "lidar: the scanner is silent for 1.0 s");
  }
}

TEST(ScannersView, IsUnknownWhenPartOfTheFieldIsAndSaysWhy) {
  ScanSeen seen = free_field("lidar");
  seen.field.unknown = true;
  EXPECT_EQ(view({&seen, 1}, kNow).unknown, "lidar: part of the field ahead is hidden from it");
  seen.reason = "the scanner is blind in 2 of 24 sectors, one at 8 deg from ahead";
  const FieldView all = view({&seen, 1}, kNow);
  EXPECT_TRUE(all.field.unknown);
  EXPECT_EQ(all.unknown, "lidar: the scanner is blind in 2 of 24 sectors, one at 8 deg from ahead");
}

TEST(ScannersView, TellsTheNearestThingOfAll) {
  const ScanSeen scanners[] = {with_a_thing_at(1.5, "left"), with_a_thing_at(0.7, "right"),
                               free_field("high")};
  const FieldView all = view(scanners, kNow);
  EXPECT_TRUE(all.field.blocked);
  EXPECT_EQ(all.field.points, 6U);
  EXPECT_EQ(all.field.free_m, 0.7);
  EXPECT_EQ(all.field.nearest.x_m, 0.7);
  EXPECT_EQ(all.scanner, "right");
  EXPECT_FALSE(all.field.unknown);
}

TEST(ScannersView, NeedsEveryScannerWellAndOneThatSeesAll) {
  ScanSeen rear = free_field("rear");
  rear.field.unknown = true;  // it looks the other way
  const ScanSeen both[] = {rear, free_field("front")};
  EXPECT_FALSE(view(both, kNow).field.unknown);
  const ScanSeen neither[] = {rear, rear};
  EXPECT_TRUE(view(neither, kNow).field.unknown);
  ScanSeen dead = free_field("low");
  dead.state = SourceState::stale;
  const ScanSeen one_dead[] = {free_field("front"), dead};
  EXPECT_TRUE(view(one_dead, kNow).field.unknown);
  EXPECT_EQ(view(one_dead, kNow).unknown, "low: the scanner is not heard");
}

TEST(ScannersView, DoesNotForgetAThingBecauseAnotherScannerIsSilent) {
  ScanSeen dead = free_field("low");
  dead.state = SourceState::stale;
  const ScanSeen scanners[] = {dead, with_a_thing_at(0.7, "front")};
  const FieldView all = view(scanners, kNow);
  EXPECT_TRUE(all.field.blocked);
  EXPECT_TRUE(all.field.unknown);
  EXPECT_EQ(all.field.free_m, 0.7);
}

TEST(ScannersView, OfATurnOfTheFutureIsOfThePresent) {
  ScanSeen seen = free_field("lidar");
  seen.end = kNow + 10ms;
  EXPECT_FALSE(view({&seen, 1}, kNow).field.unknown);
}

}  // namespace
}  // namespace drover::scene::sensor
