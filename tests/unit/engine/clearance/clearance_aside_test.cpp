// A base that goes sideways, and somebody who looks there.
#include "tests/unit/engine/clearance/clearance_fixture.h"

namespace drover::engine {
namespace {

class AClearanceToTheSides : public AClearance {
 protected:
  AClearanceToTheSides() {
    watch = ClearanceWatch(ClearanceConfig{}, limits, true, true, true);
    found.aside_left_m = found.aside_right_m = 5;
  }
};

TEST_F(AClearanceToTheSides, PermitsWhatCanStopBeforeTheFirstThingEachSide) {
  found.aside_left_m = stop_way(0.3, gentle);
  found.aside_right_m = stop_way(0.5, gentle);
  tick(30);
  EXPECT_EQ(why(), "");
  EXPECT_NEAR(watch.caps().aside_left_mps, 0.3, 0.01);
  EXPECT_NEAR(watch.caps().aside_right_mps, 0.5, 0.01);
  EXPECT_NEAR(watch.limit({0, 0, 0.6}).vy_mps, 0.3, 0.01);
  EXPECT_NEAR(watch.limit({0, 0, -0.6}).vy_mps, -0.5, 0.01);
  EXPECT_EQ(watch.limit({0, 0, 0.1}).vy_mps, 0.1);
  EXPECT_NEAR(watch.rim_cap_mps({0, 0, 0.6}, 0.3), 0.3, 0.01);
  EXPECT_NEAR(watch.rim_cap_mps({0, 0, -0.6}, 0.3), 0.5, 0.01);
}

TEST_F(AClearanceToTheSides, ClosesTheSideThatSomethingIsInAndLeavesTheOthersOpen) {
  found.aside_left_m = 0;
  found.first = "box1 is in the way, 0.00 m to the left";
  input.asked = {0, 0, 0.3};
  tick(30);
  EXPECT_THAT(why(), HasSubstr("box1"));
  EXPECT_TRUE(is_zero(watch.limit({0, 0, 0.3})));
  EXPECT_LT(watch.limit({0, 0, -0.3}).vy_mps, -0.2);
  EXPECT_GT(watch.limit({0.3, 0}).vx_mps, 0.2);
  input.asked = {0, 0, -0.3};
  tick(30);
  EXPECT_EQ(why(), "") << "who leaves it is hindered by nothing";
}

TEST_F(AClearanceToTheSides, OpensASideWhenItWasFreeForASecond) {
  found.aside_right_m = 0;
  input.asked = {0, 0, -0.3};
  tick(30);
  ASSERT_TRUE(blocked());
  found.aside_right_m = 2;
  tick(180);
  EXPECT_EQ(watch.caps().aside_right_mps, 0);
  tick(60);
  EXPECT_GT(watch.caps().aside_right_mps, 0.3);
  EXPECT_FALSE(blocked());
}

TEST_F(AClearanceToTheSides, StopsWithoutARampBeforeWhatComesTooNear) {
  input.commanded = input.asked = {0, 0, 0.4};
  tick(30);
  ASSERT_FALSE(watch.too_near());
  found.aside_left_m = found.bare.aside_left_m = 0.05;
  tick(11);
  EXPECT_TRUE(watch.too_near());
}

TEST_F(AClearanceToTheSides, TakesOffWhatWasDrivenSince) {
  found.aside_left_m = 1;
  input.commanded = {0, 0, 0.5};
  tick(31);
  answers = false;
  const double before_mps = watch.caps().aside_left_mps;
  tick(8);
  EXPECT_LT(watch.caps().aside_left_mps, before_mps - 0.005);
  EXPECT_EQ(why(), "");
}

TEST_F(AClearanceToTheSides, PermitsNothingAslant) {
  tick(30);
  EXPECT_TRUE(is_zero(watch.limit({0.3, 0, 0.1})));
  EXPECT_TRUE(is_zero(watch.limit({0, 0.3, 0.1})));
  EXPECT_EQ(watch.rim_cap_mps({0.3, 0, 0.1}, 0.3), 0);
  EXPECT_EQ(watch.rim_cap_mps({0, 0.3, 0.1}, 0.3), 0);
}

/// On the gates' ramps from one to the other it would go aslant.
TEST_F(AClearanceToTheSides, EndsOneWayBeforeItPermitsTheOther) {
  input.commanded = {0.3, 0};
  tick(30);
  EXPECT_TRUE(is_zero(watch.limit({0, 0, 0.3})));
  EXPECT_EQ(watch.rim_cap_mps({0, 0, 0.3}, 0.3), 0);
  input.commanded = {0, 0, 0.3};
  tick(30);
  EXPECT_TRUE(is_zero(watch.limit({0.3, 0})));
  EXPECT_TRUE(is_zero(watch.limit({0, 0.3})));
  EXPECT_EQ(watch.rim_cap_mps({0.3, 0}, 0.3), 0);
  EXPECT_GT(watch.limit({0, 0, 0.3}).vy_mps, 0.2);
  input.commanded = {};
  tick(30);
  EXPECT_GT(watch.limit({0.3, 0}).vx_mps, 0.2);
}

TEST_F(AClearanceToTheSides, HoldsForTheHeadingThatItWasLookedAtWith) {
  tick(31);
  answers = false;
  ASSERT_GT(watch.caps().aside_left_mps, 0.3);
  input.commanded = {0, 1.5};  // turned by more than its corners have room for
  tick(15);
  EXPECT_EQ(watch.caps().aside_left_mps, 0);
}

TEST_F(AClearanceToTheSides, PermitsNothingWithAnAnswerThatIsOldOrNoNumber) {
  found.aside_left_m = NAN;
  tick(30);
  EXPECT_EQ(watch.caps().aside_left_mps, 0);
  EXPECT_GT(watch.caps().aside_right_mps, 0.3);
  answers = false;
  tick(40);
  EXPECT_EQ(watch.caps().aside_right_mps, 0);
}

TEST_F(AClearanceToTheSides, IsNotBlockedWhereOnlyTheSidesAreFree) {
  found.ahead_m = found.back_m = found.left_rad = found.right_rad = 0;
  tick(30);
  EXPECT_FALSE(blocked());
  found.aside_left_m = found.aside_right_m = 0;
  tick(30);
  EXPECT_TRUE(blocked());
}

}  // namespace
}  // namespace drover::engine
