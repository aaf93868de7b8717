// What a person reads beside the map.
#include "sim/scenario/view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drover::sim {
namespace {

TEST(AView, TellsTheWayThatIsLeftAndHowLongItTakes) {
  EXPECT_EQ(way_left(7.31, 0.5), "7.3 m left, about 15 s");
}

TEST(AView, TellsNoTimeOfARobotThatStands) {
  EXPECT_EQ(way_left(7.31, 0), "7.3 m left");
  EXPECT_EQ(way_left(7.31, -0.01), "7.3 m left");
}

TEST(AView, TellsNoWayThatNobodyKnows) {
  EXPECT_EQ(way_left(NAN, 0.5), "-");
}

}  // namespace
}  // namespace drover::sim
