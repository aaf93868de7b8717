#include "scene/look/with_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace drover::scene {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr double kFree = std::numeric_limits<double>::infinity();
constexpr Time kNow{100s};

/// A robot of 1.0 by 0.7 m; its corners go round on a circle of 0.61 m.
class WithPoints : public testing::Test {
 protected:
  WithPoints() {
    settings.footprint = {{0.5, 0.35}, {-0.5, 0.35}, {-0.5, -0.35}, {0.5, -0.35}};
    found.ahead_m = found.back_m = 3;
    found.along_m = found.left_rad = found.right_rad = kFree;
    found.bare = {kFree, 3, 3, kFree, kFree};
  }
  void see(double x_m, double y_m, Duration age = 0ms) {
    points.push_back({{x_m, y_m}, kNow - age, 0});
  }
  Clearance result() const { return with_points(found, points, names, settings, kNow, track); }
  static std::string text(const Reason& reason) { return std::string(reason.view()); }

  LookSettings settings;
  Clearance found;
  std::vector<sensor::SeenPoint> points;
  std::vector<Step> track;
  std::array<Name, 1> names{"lidar"};
};

TEST_F(WithPoints, NothingIsBoundByNothing) {
  found.twist = {0.5, 0.5};
  const Clearance all = result();
  EXPECT_EQ(all.left_rad, kFree);
  EXPECT_EQ(all.ahead_m, 3);
  EXPECT_EQ(all.back_m, 3);
  EXPECT_EQ(text(all.first), "");
}

TEST_F(WithPoints, WhatIsInTheTurningCircleEndsTheTurnThatReachesIt) {
  // On the left side's middle: the corner ahead comes there by a turn to the left, the one behind
  // by one to the right.
  see(0, 0.55);
  Clearance all = result();
  // A corner 0.61 m away at 35 degrees touches, with 0.1 m around it, at 0.55 m.
  EXPECT_GT(all.left_rad, to_rad(5));
  EXPECT_LT(all.left_rad, to_rad(55));
  EXPECT_NEAR(all.left_rad, all.right_rad, 1e-6) << "it is the same on both sides";
  EXPECT_EQ(all.bare.left_rad, all.left_rad);
  EXPECT_EQ(all.ahead_m, 3) << "straight on it is the field's business";
  EXPECT_EQ(all.along_m, kFree);
  EXPECT_EQ(text(all.first), "") << "nobody asks for a turn";
  points.clear();
  see(0.4, 0.55);
  all = result();
  EXPECT_LT(all.left_rad, to_rad(15));
  EXPECT_GT(all.right_rad, all.left_rad + to_rad(45));
}

TEST_F(WithPoints, WhatIsOutsideOfTheTurningCircleHindersNoTurn) {
  EXPECT_NEAR(turning_circle_m(settings), std::hypot(0.5, 0.35) + 0.1, 1e-12);
  see(0, turning_circle_m(settings) + 0.02);
  const Clearance all = result();
  EXPECT_EQ(all.left_rad, kFree);
  EXPECT_EQ(all.right_rad, kFree);
}

TEST_F(WithPoints, ATurnThatIsAskedForIsToldWhatHindersIt) {
  see(0.4, 0.55);
  found.twist = {0, 0.5};
  found.first = "box1 is in the way, 2.00 m ahead";
  Clearance all = result();
  EXPECT_THAT(text(all.turn), HasSubstr("lidar sees something in the way of the turn to the left"));
  EXPECT_THAT(text(all.turn), HasSubstr(" deg"));
  EXPECT_EQ(text(all.first), text(all.turn));
  found.twist = {0, -0.5};
  all = result();
  EXPECT_THAT(text(all.turn), HasSubstr("to the right"));
}

TEST_F(WithPoints, WhatKnownThingsLeaveLessFreeStaysToBeTold) {
  see(0, 0.55);
  found.twist = {0, 0.5};
  found.left_rad = 0.01;
  found.turn = found.first = "box1 is in the way of the turn to the left, after 1 deg";
  const Clearance all = result();
  EXPECT_EQ(all.left_rad, 0.01);
  EXPECT_THAT(text(all.turn), HasSubstr("box1"));
}

TEST_F(WithPoints, WhatWasSeenIsToldAsThat) {
  see(0.4, 0.55, 5s);
  found.twist = {0, 0.5};
  EXPECT_THAT(text(result().turn), HasSubstr("lidar saw something in the way of the turn"));
}

TEST_F(WithPoints, WhatIsInTheMarginLeavesNoTurn) {
  see(-0.2, -0.4);
  found.twist = {0, 0.5};
  const Clearance all = result();
  EXPECT_EQ(all.left_rad, 0);
  EXPECT_EQ(all.right_rad, 0);
  EXPECT_EQ(all.back_m, 0);
  EXPECT_EQ(all.ahead_m, 3);
  EXPECT_EQ(text(all.turn), "lidar sees something beside the robot, which has no room to turn");
}

TEST_F(WithPoints, ATightCurveEndsWhereTheCornersSwingIntoSomething) {
  // To the left about a point 0.3 m beside it: its right rear corner swings out.
  see(-0.15, -0.5);
  found.twist = {0.15, 0.5};
  Clearance all = result();
  EXPECT_GT(all.ahead_m, 0.01);
  EXPECT_LT(all.ahead_m, 0.4);
  EXPECT_EQ(all.bare.ahead_m, all.ahead_m);
  EXPECT_THAT(text(all.first), HasSubstr("lidar sees something, "));
  EXPECT_THAT(text(all.first), HasSubstr("m ahead"));
  found.twist = {0.5, 0};
  all = result();
  EXPECT_EQ(all.ahead_m, 3);
  found.twist = {0.15, -0.5};
  EXPECT_GT(result().ahead_m, 0.4) << "it swings away from there";
}

TEST_F(WithPoints, AWideCurveBesideAWallIsFree) {
  for (int i = -20; i <= 20; ++i) see(0.05 * i, -0.42);
  found.twist = {0.5, 0.06};  // away from it, by steering
  EXPECT_GT(result().ahead_m, 0.3);
}

TEST_F(WithPoints, NoiseNearRestIsNoCurve) {
  see(0.8, 0);
  found.twist = {0.005, 0.01};
  EXPECT_EQ(result().ahead_m, 3) << "straight on it is the field's business";
  EXPECT_EQ(text(result().first), "");
}

TEST_F(WithPoints, TheWayBackEndsAtWhatWasSeenBehind) {
  see(-0.9, 0.1, 3s);
  found.twist = {-0.3, 0};
  const Clearance all = result();
  EXPECT_NEAR(all.back_m, 0.3, 0.02);
  EXPECT_EQ(all.ahead_m, 3);
  EXPECT_THAT(text(all.first), HasSubstr("lidar saw something, 0.30 m back"));
}

TEST_F(WithPoints, WhatIsFarIsNotLookedAt) {
  see(-2, 0);
  found.twist = {-0.3, 0};
  EXPECT_EQ(result().back_m, 3) << "it will be, when it is near";
}

TEST_F(WithPoints, OnATrackWhatIsNearerThanItsEndIsToldFirst) {
  see(-0.15, -0.5);
  found.path = 3;
  found.twist = {0.15, 0.5};
  found.along_m = 1.5;
  found.first = "box1 is in the way, 1.50 m along the track";
  EXPECT_THAT(text(result().first), HasSubstr("lidar"));
  found.along_m = 0;
  EXPECT_THAT(text(result().first), HasSubstr("box1"));
}

/// The left rear corner comes to the point after 93 degrees of a turn to the right.
TEST_F(WithPoints, WhatIsBeyondTheEndOfTheCornerHindersNoTurnToIt) {
  see(0.69 * std::cos(to_rad(45)), 0.69 * std::sin(to_rad(45)));
  found.path = 3;
  found.twist = {0, -0.5};
  found.first = "box1 is in the way, 1.50 m along the track";
  EXPECT_NEAR(result().right_rad, to_rad(95), to_rad(3));
  track = pivot_steps({}, to_rad(-80));
  EXPECT_EQ(result().right_rad, kFree);
  EXPECT_EQ(text(result().turn), "");
  EXPECT_THAT(text(result().first), HasSubstr("box1"));
  track = pivot_steps({}, to_rad(-120));
  EXPECT_NEAR(result().right_rad, to_rad(95), to_rad(3));
  EXPECT_THAT(text(result().first), HasSubstr("lidar sees something in the way of the turn"));
}

TEST_F(WithPoints, WhatIsJustBeyondTheEndOfTheCornerIsNotToldFirst) {
  see(0.69 * std::cos(to_rad(45)), 0.69 * std::sin(to_rad(45)));
  found.path = 3;
  found.twist = {0, -0.5};
  found.first = "box1 is in the way, 0.50 m along the track";
  track = pivot_steps({}, to_rad(-92));
  EXPECT_LT(result().right_rad, to_rad(100));
  EXPECT_THAT(text(result().turn), HasSubstr("lidar sees something in the way of the turn"));
  EXPECT_THAT(text(result().first), HasSubstr("box1"));
}

TEST_F(WithPoints, ATrackThatTurnsIntoSomethingEndsInThatTurn) {
  see(0.4, 0.5);
  found.path = 3;
  found.twist = {0, 0.5};
  track = pivot_steps({}, to_rad(80));
  const Clearance all = result();
  EXPECT_EQ(all.along_m, 0);
  EXPECT_EQ(all.bare.along_m, 0);
  EXPECT_LT(all.left_rad, to_rad(15));
  EXPECT_THAT(text(all.first), HasSubstr("in the way of the turn to the left"));
}

/// A corner 3 cm ahead, to which the robot still creeps.
TEST_F(WithPoints, ATurnThatTheRobotComesToIsToldAsThatTurn) {
  see(0.43, 0.5);
  found.path = 3;
  found.twist = {0.05, 0};
  track = {{{0, 0, 0}, 0, 0}, {{0.03, 0, 0}, 0.03, 0}};
  for (Step step : pivot_steps({0.03, 0, 0}, to_rad(80))) {
    step.driven_m = 0.03;
    track.push_back(step);
  }
  const Clearance all = result();
  EXPECT_NEAR(all.along_m, 0.03, 1e-6);
  EXPECT_THAT(text(all.first), HasSubstr("in the way of the turn to the left"));
  // What stands right before it is ahead of the robot, corner or not.
  points.clear();
  see(0.57, 0);
  EXPECT_THAT(text(result().first), HasSubstr("m along the track"));
}

TEST_F(WithPoints, ATwistThatIsNoNumberIsLeftToOthers) {
  see(0, 0.55);
  found.twist = {NAN, 0};
  EXPECT_EQ(result().left_rad, kFree);
}

TEST_F(WithPoints, AScannerWithoutANameIsAScanner) {
  names[0] = "";
  see(0.4, 0.55);
  found.twist = {0, 0.5};
  EXPECT_THAT(text(result().turn), HasSubstr("a scanner sees something"));
}

}  // namespace
}  // namespace drover::scene
