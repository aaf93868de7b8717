#include "gateway/recording/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/recording/input_codec.h"

namespace drover::gateway {
namespace {

using testing::HasSubstr;

const Wiring kAnyWiring;

/// Whoever replays a stop sees each way that may have ended it, and of when the answer was.
TEST(ATextOfAClearance, TellsEachWayAndWhatTheMarginAloneLeavesOfIt) {
  Clearance found;
  found.t = Time{std::chrono::milliseconds(1500)};
  found.twist = {0.5, -0.1};
  found.along_m = 1;
  found.ahead_m = 2;
  found.back_m = 3;
  found.left_rad = 0.4;
  found.right_rad = 0.5;
  found.bare = {1.1, 2.1, 3.1, 0.41, 0.51};
  found.turn = "box2 is in the way of the turn to the left";
  const std::string text = text_of(Input{Time{}, ClearanceFound{found}}, kAnyWiring);
  EXPECT_THAT(text, HasSubstr("of 1.500000 s, at 0.500000 m/s and -0.100000 rad/s"));
  EXPECT_THAT(text, HasSubstr("along it 1.000000 (1.100000) m"));
  EXPECT_THAT(text, HasSubstr("ahead 2.000000 (2.100000) m"));
  EXPECT_THAT(text, HasSubstr("back 3.000000 (3.100000) m"));
  EXPECT_THAT(text, HasSubstr("left 0.400000 (0.410000) rad"));
  EXPECT_THAT(text, HasSubstr("right 0.500000 (0.510000) rad"));
  EXPECT_THAT(text, HasSubstr("turning box2"));
}

TEST(ATextOfAClearance, TellsTheSidesWhereSomebodyLookedThere) {
  Clearance found;
  EXPECT_THAT(text_of(Input{Time{}, ClearanceFound{found}}, kAnyWiring),
              testing::Not(HasSubstr("to the side")));
  found.aside_left_m = 1;
  found.aside_right_m = 2;
  found.bare.aside_left_m = 1.1;
  found.bare.aside_right_m = 2.1;
  EXPECT_THAT(text_of(Input{Time{}, ClearanceFound{found}}, kAnyWiring),
              HasSubstr("to the side: left 1.000000 (1.100000) m, right 2.000000 (2.100000) m"));
}

TEST(ATextOfAClearance, SaysThatNobodyLookedYet) {
  EXPECT_THAT(text_of(Input{Time{}, ClearanceFound{}}, kAnyWiring), HasSubstr("of no time"));
}

}  // namespace
}  // namespace drover::gateway
