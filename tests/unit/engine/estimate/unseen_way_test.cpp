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
}

}  // namespace
}  // namespace drover::engine::estimate
