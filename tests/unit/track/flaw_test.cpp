#include "track/flaw.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/track/tracks.h"

namespace drover::track {
namespace {

using Kind = Flaw::Kind;

TEST(AFlaw, IsNoneWhereATrackTurnsAndCrossesItself) {
  std::mt19937 random(3);
  for (int round = 0; round < 500; ++round)
    ASSERT_EQ(find_flaw(any_walk(random)).kind, Kind::none) << round;
}

TEST(AFlaw, IsThatThereIsNoWay) {
  EXPECT_EQ(find_flaw(Points{}).kind, Kind::too_few);
  EXPECT_EQ(find_flaw(Points{{1, 2}}).kind, Kind::too_few);
  EXPECT_EQ(find_flaw(Points{{1, 2}, {1, 2}, {1, 2.0009}}).kind, Kind::one_place);
  EXPECT_EQ(find_flaw(Points(100, {1, 2})).kind, Kind::one_place) << "worse than a crowd";
}

TEST(AFlaw, NamesThePointThatIsNoPlaceOrFarFromTheOneBeforeIt) {
  const Flaw none = find_flaw(Points{{0, 0}, {1, 0}, {1, NAN}});
  EXPECT_EQ(none.kind, Kind::not_finite);
  EXPECT_EQ(none.point, 2U);
  const Flaw far = find_flaw(Points{{0, 0}, {0, 1000}, {NAN, 0}});
  EXPECT_EQ(far.kind, Kind::far_apart);
  EXPECT_EQ(far.point, 1U);
  EXPECT_DOUBLE_EQ(far.gap_m, 1000);
  EXPECT_EQ(find_flaw(Points{{0, 0}, {0, 999}}).kind, Kind::none);
}

TEST(AFlaw, IsTheFirstPlaceWithMoreThan64Points) {
  Points points{{0, 0}};
  points.insert(points.end(), 64, {1, 0});
  EXPECT_EQ(find_flaw(points).kind, Kind::none);
  points.insert(points.end(), 3, {1, 0.0005});
  points.insert(points.end(), 100, {2, 0});
  const Flaw crowd = find_flaw(points);
  EXPECT_EQ(crowd.kind, Kind::crowd);
  EXPECT_EQ(crowd.point, 1U);
  EXPECT_EQ(crowd.last, 67U);
}

}  // namespace
}  // namespace drover::track
