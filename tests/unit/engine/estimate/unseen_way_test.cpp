// The way that nobody has seen, and where the robot may be when wheels slipped on it.
#include "engine/estimate/unseen_way.h"

#include <gtest/gtest.h>

namespace drover::engine::estimate {
namespace {

TEST(UnseenWay, MayBeAsideOfATurnAndNotOfAStraight) {
  UnseenWay way;
  for (int i = 0; i < 100; ++i) way.advance(0.1, 0);
  EXPECT_NEAR(way.way_m, 10, 1e-9);
  EXPECT_NEAR(way.aside_m(0), 0, 1e-6);
  EXPECT_NEAR(way.aside_m(kPi / 2), 10, 1e-6);
}

TEST(UnseenWay, IsKnownByTheDirectionInWhichItLed) {
  UnseenWay way;
  for (int i = 0; i < 100; ++i) way.advance(0.1, 0);
  EXPECT_NEAR(way.in_m(0), 10, 1e-6) << "it is behind of where it is told";
  EXPECT_NEAR(way.against_m(0), 0, 1e-6);
  EXPECT_NEAR(way.against_m(kPi), 10, 1e-6) << "and on the way back ahead";
  for (int i = 0; i < 40; ++i) way.advance(-0.1, 0);
  EXPECT_NEAR(way.in_m(0), 10, 1e-6);
  EXPECT_NEAR(way.against_m(0), 4, 1e-6);
}

TEST(UnseenWay, KeepsAShareOfWhatCameSince) {
  UnseenWay way;
  way.advance(2, 0);
  const UnseenWay before = way;
  way.advance(0, 4);
  way.keep_since(before, 0.5);
  EXPECT_NEAR(way.way_m, 4, 1e-9);
  EXPECT_NEAR(way.in_m(kPi / 2), 2, 0.5);
  way.keep(0);
  EXPECT_EQ(way.way_m, 0);
  EXPECT_EQ(way.in_m(0), 0);
  EXPECT_FALSE(way.slips_to(-0.1, 0, 1, 0.01));
}

/// Ten metres and the beginning of a turn to the left: it is behind on either of both, or on both,
/// and not ahead of where it turned to.
TEST(UnseenWay, TellsWhereWhoSlippedMayBe) {
  UnseenWay way;
  for (int i = 0; i < 100; ++i) way.advance(0.1, 0);
  for (int i = 0; i < 13; ++i) way.advance(0.1 * std::cos(0.07 * i), 0.1 * std::sin(0.07 * i));
  const auto slips_to = [&](double east_m, double north_m) {
    return way.slips_to(east_m, north_m, 0.4, 0.1);
  };
  EXPECT_TRUE(slips_to(0, 0));
  EXPECT_TRUE(slips_to(-3, 0));
  EXPECT_TRUE(slips_to(-3, -0.2));
  EXPECT_FALSE(slips_to(-6, 0));
  EXPECT_FALSE(slips_to(0, 0.5));
  EXPECT_FALSE(slips_to(-0.5, 0.5));
  EXPECT_FALSE(slips_to(0.5, 0));
  EXPECT_FALSE(slips_to(0, -0.5));
}

}  // namespace
}  // namespace drover::engine::estimate
