// Ways that something is in: closed at once, open again after a while, each by itself.
#include "tests/unit/engine/clearance/clearance_fixture.h"

namespace drover::engine {
namespace {

TEST_F(AClearance, IsBlockedAtOnceAndFreeOnlyAfterASecondAndFiveCentimetres) {
  input.path = 7;
  tick(30);
  found.along_m = 0.005;
  found.first = "box1 is 0.3 m ahead";
  tick(11);
  EXPECT_TRUE(blocked());
  EXPECT_EQ(watch.caps().along_mps, 0);
  EXPECT_EQ(watch.caps().back_mps, 0);
  EXPECT_EQ(why(), "box1 is 0.3 m ahead");
  found.along_m = 0.04;  // hardly away
  tick(400);
  EXPECT_TRUE(blocked());
  found.along_m = 5;
  tick(180);
  EXPECT_TRUE(blocked()) << "it left less than a second ago";
  tick(40);
  EXPECT_FALSE(blocked());
  EXPECT_GT(watch.caps().along_mps, 0.8);
}

TEST_F(AClearance, WaitsASecondAnewWhenItIsBlockedOnceMore) {
  input.path = 7;
  found.along_m = 0;
  tick(30);
  found.along_m = 5;
  tick(150);
  found.along_m = 0;
  tick(11);
  found.along_m = 5;
  tick(180);
  EXPECT_TRUE(blocked());
}

/// What nobody looked at was not free.
TEST_F(AClearance, DoesNotCountATimeWithoutAnswersAsFree) {
  input.path = 7;
  found.along_m = 0;
  tick(30);
  found.along_m = 5;
  tick(100);
  answers = false;
  tick(150);
  answers = true;
  tick(60);
  EXPECT_TRUE(blocked());
}

TEST_F(AClearance, JudgesATurnOnTheSpotByItsAngle) {
  input.commanded = {0, 0.5};
  found.ahead_m = 0;  // a wall ahead hinders no turn
  tick(30);
  EXPECT_FALSE(blocked());
  EXPECT_GT(watch.caps().left_radps, 0.5);
  found.left_rad = 0;
  tick(11);
  EXPECT_TRUE(blocked());
  EXPECT_EQ(watch.caps().left_radps, 0);
}

/// A robot that came to stand before a wall has to be able to leave it.
TEST_F(AClearance, PermitsAtOnceToLeaveWhatItStandsBefore) {
  found.ahead_m = 0.01;
  tick(30);
  EXPECT_FALSE(blocked()) << "nobody asks to go there";
  input.asked = {0.3, 0};
  tick(1);
  EXPECT_TRUE(blocked());
  EXPECT_EQ(watch.rim_cap_mps({0.3, 0}, 0.3), 0);
  EXPECT_TRUE(is_zero(watch.limit({0.3, 0})));
  input.asked = {-0.3, 0.1};
  tick(1);
  EXPECT_FALSE(blocked());
  EXPECT_GT(watch.rim_cap_mps({-0.3, 0.1}, 0.3), 0.3);
  EXPECT_EQ(watch.limit({-0.3, 0.1}).vx_mps, -0.3);
  input.asked = {0, 0.5};
  tick(1);
  EXPECT_FALSE(blocked());
  EXPECT_GT(watch.rim_cap_mps({0, 0.5}, 0.3), 0.15);
}

TEST_F(AClearance, KeepsOnlyTheWayClosedThatSomethingWasIn) {
  input.asked = {0.3, 0};
  found.ahead_m = 0;
  tick(30);
  EXPECT_TRUE(blocked());
  found.ahead_m = 5;
  tick(150);
  EXPECT_EQ(watch.caps().ahead_mps, 0) << "it left less than a second ago";
  EXPECT_GT(watch.caps().back_mps, 0.5);
  EXPECT_GT(watch.caps().left_radps, 0.5);
  tick(60);
  EXPECT_GT(watch.caps().ahead_mps, 0.5);
}

TEST_F(AClearance, JudgesATurnOfJointsByItsOwnSide) {
  found.left_rad = 0.01;
  found.ahead_m = 0;
  input.asked = {0, 0.5};
  tick(30);
  EXPECT_TRUE(blocked());
  EXPECT_EQ(watch.rim_cap_mps({0, 0.5}, 0.3), 0);
  input.asked = {0, -0.5};
  tick(1);
  EXPECT_FALSE(blocked());
  EXPECT_GT(watch.rim_cap_mps({0, -0.5}, 0.3), 0.15);
}

/// Wheels against each other ask for no way: they get the least of all.
TEST_F(AClearance, PermitsWheelsThatAskForNoWayOnlyWhatIsFreeEachWay) {
  found.back_m = 0;
  tick(30);
  EXPECT_EQ(watch.rim_cap_mps({0, 0}, 0.3), 0);
}

TEST_F(AClearance, TellsThatItStandsInSomethingThoughNobodyAsks) {
  found.ahead_m = found.back_m = found.left_rad = found.right_rad = 0;
  found.first = "box1 is where the robot is";
  tick(30);
  EXPECT_EQ(why(), "box1 is where the robot is");
}

TEST_F(AClearance, NamesWhatWasInTheWayUntilItIsOpenAgain) {
  input.asked = {0.3, 0};
  found.ahead_m = 0;
  found.first = "box1 is in the way, 0.00 m ahead";
  tick(30);
  found.ahead_m = 5;
  found.first.clear();
  tick(100);
  EXPECT_EQ(why(), "box1 is in the way, 0.00 m ahead");
}

TEST_F(AClearance, NamesNothingElseThatIsFartherAwayUntilItIsOpenAgain) {
  for (const std::uint64_t path : {0U, 7U}) {
    input.path = path;
    input.asked = {0.3, 0};
    found.ahead_m = found.along_m = 0;
    found.first = "box1 is in the way, 0.00 m ahead";
    tick(30);
    found.ahead_m = found.along_m = 1.9;
    found.first = "box2 is in the way, 1.90 m ahead";
    tick(100);
    EXPECT_EQ(why(), "box1 is in the way, 0.00 m ahead");
    tick(120);
    EXPECT_EQ(why(), "");
  }
}

TEST_F(AClearance, StaysBlockedWhileAnAnswerIsLate) {
  input.asked = {0.3, 0};
  found.ahead_m = 0;
  tick(31);
  ASSERT_TRUE(blocked());
  answers = false;
  tick(15);
  EXPECT_TRUE(blocked());
}

/// What was in the way of the last one was perhaps beside this one.
TEST_F(AClearance, JudgesAnotherTaskAnew) {
  input.path = 7;
  found.along_m = 0;
  tick(30);
  ASSERT_TRUE(blocked());
  input.path = 0;
  found.along_m = 5;
  tick(11);
  input.path = 7;
  tick(1);
  EXPECT_FALSE(blocked());
}

TEST_F(AClearance, JudgesAWayBackByWhatIsBehind) {
  input.commanded = {-0.2, 0};
  found.ahead_m = 0;
  tick(30);
  EXPECT_FALSE(blocked());
  found.back_m = 0;
  tick(11);
  EXPECT_TRUE(blocked());
}

TEST_F(AClearance, IsBlockedByWhatAppearsTooNearForItsSpeed) {
  input.commanded = {0.8, 0};
  tick(30);
  ASSERT_FALSE(blocked());
  found.ahead_m = stop_way(0.8, {0.28, limits.deceleration_mps2}) + 0.06;
  tick(5);
  EXPECT_FALSE(blocked()) << "a ramp to zero is early enough";
  found.ahead_m -= 0.1;
  tick(10);
  EXPECT_TRUE(blocked());
}

/// What is ahead does not hinder a turn: that is told by what does.
TEST_F(AClearance, GainsNoWayBySwayingBackAfterAStop) {
  input.asked = input.commanded = {0.7, 0};
  tick(20);
  found.ahead_m = found.bare.ahead_m = 0.11;
  tick(20);
  ASSERT_TRUE(blocked());
  input.commanded = {};
  found.ahead_m = found.bare.ahead_m = 0.17;  // 6 cm more than in the moment of the stop
  tick(600);
  EXPECT_TRUE(blocked());
  found.ahead_m = found.bare.ahead_m = 0.23;  // than where it stands
  tick(300);
  EXPECT_FALSE(blocked());
}

TEST_F(AClearance, NamesWhatHindersTheTurnThatIsAskedFor) {
  found.first = "box1 is in the way, 0.30 m ahead";
  found.turn = "box2 is in the way of the turn to the left, after 0 deg";
  found.left_rad = 0;
  for (const std::uint64_t path : {0U, 7U}) {
    input.path = path;
    input.asked = {0, 0.5};
    tick(30);
    EXPECT_THAT(why(), HasSubstr("box2"));
    // It stands, and is not asked for a moment.
    input.asked = {0, -0.5};
    tick(30);
    EXPECT_EQ(why(), "");
  }
  input.path = 0;
  input.asked = {0.3, 0};
  found.ahead_m = 0;
  tick(30);
  EXPECT_THAT(why(), HasSubstr("box1"));
}

TEST_F(AClearance, NamesOfATrackThatEndsInATurnWhatEndsIt) {
  input.path = 7;
  input.asked = {0, 0.5};
  found.along_m = 0;
  found.first = "wall is in the way of the turn to the left, after 40 deg";
  found.turn = "post is in the way of the turn to the left, after 120 deg";
  tick(30);
  EXPECT_THAT(why(), HasSubstr("wall")) << "the turn is free so far as it is to go";
}

/// The position was known to 2 cm and is to 20: the free way is shorter at once, and nothing came.
TEST_F(AClearance, StopsOnARampWhenOnlyThePositionIsNotKnownAsWell) {
  input.commanded = {0.5, 0};
  found.ahead_m = found.bare.ahead_m = 1.2;
  tick(30);
  ASSERT_FALSE(blocked());
  found.ahead_m = 0;
  tick(10);
  EXPECT_TRUE(blocked());
  EXPECT_EQ(watch.caps().ahead_mps, 0);
  EXPECT_FALSE(watch.too_near());
}

TEST_F(AClearance, StopsWithoutARampBeforeWhatIsTrulyNearer) {
  input.commanded = {0.5, 0};
  found.ahead_m = found.bare.ahead_m = 1.2;
  tick(30);
  found.ahead_m = 0;
  found.bare.ahead_m = 0.15;
  tick(10);
  EXPECT_TRUE(blocked());
  EXPECT_TRUE(watch.too_near());
}

TEST_F(AClearance, TakesTheWayItselfWhereNobodySaidWhatTheMarginAloneLeaves) {
  input.commanded = {0.5, 0};
  tick(30);
  found.ahead_m = 0.15;
  tick(10);
  EXPECT_TRUE(watch.too_near());
  found.bare = {NAN, NAN, NAN, NAN, NAN};
  tick(10);
  EXPECT_TRUE(watch.too_near());
}

TEST_F(AClearance, JudgesATrackAndATurnByWhatIsTrulyNearToo) {
  input.path = 7;
  input.commanded = input.asked = {0.5, 0};
  tick(30);
  found.along_m = 0;
  found.bare.along_m = 1;
  tick(10);
  EXPECT_TRUE(blocked());
  EXPECT_FALSE(watch.too_near());
  found.bare.along_m = 0.1;
  tick(10);
  EXPECT_TRUE(watch.too_near());
  found.along_m = 5;
  input.path = 0;
  input.commanded = input.asked = {0, 0.6};
  tick(10);
  found.left_rad = 0;
  found.bare.left_rad = 1;
  tick(10);
  EXPECT_TRUE(blocked());
  EXPECT_FALSE(watch.too_near());
  found.bare.left_rad = 0.05;
  tick(10);
  EXPECT_TRUE(watch.too_near());
}

}  // namespace
}  // namespace drover::engine
