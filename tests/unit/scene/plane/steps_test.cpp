#include "scene/plane/steps.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/scene/plane/shapes.h"

namespace drover::scene {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kStride_m = 0.1;

double apart_m(const Pose2& a, const Pose2& b) {
  return length_m(place_of(a) - place_of(b));
}

/// Whatever the way: it begins at the robot, grows, and no step is longer than is asked.
void expect_sound(const std::vector<Step>& steps, const Pose2& from, double stride = kStride_m) {
  ASSERT_FALSE(steps.empty());
  EXPECT_EQ(steps.front().pose, from);
  EXPECT_EQ(steps.front().driven_m, 0);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    EXPECT_LE(std::abs(wrap_rad(steps[i].pose.yaw_rad - steps[i - 1].pose.yaw_rad)),
              kStepTurn_rad + 1e-9);
    EXPECT_LE(apart_m(steps[i].pose, steps[i - 1].pose), 1.6 * stride);
    EXPECT_GE(steps[i].driven_m, steps[i - 1].driven_m);
    EXPECT_GE(steps[i].turned_rad, steps[i - 1].turned_rad);
  }
}

TEST(Steps, StridesFitTheFootprint) {
  EXPECT_NEAR(stride_m(footprint()), 0.25 * std::hypot(0.45, 0.35), 1e-9);
  EXPECT_EQ(stride_m(disc({0, 0}, 0.01)), 0.02);
  EXPECT_EQ(stride_m(disc({0, 0}, 40)), 0.25);
}

TEST(Steps, OfAnArcLieOnItAndEndAtItsEnd) {
  const auto steps = arc_steps({1, 2, 0}, kPi / 2 * 1.5, kPi / 2, kStride_m);
  expect_sound(steps, {1, 2, 0});
  for (const Step& step : steps)
    EXPECT_NEAR(length_m(place_of(step.pose) - Point2{1, 3.5}), 1.5, 1e-9);
  EXPECT_NEAR(apart_m(steps.back().pose, {2.5, 3.5, 0}), 0, 1e-9);
  EXPECT_NEAR(steps.back().pose.yaw_rad, kPi / 2, 1e-12);
  EXPECT_NEAR(steps.back().driven_m, kPi / 2 * 1.5, 1e-9);
}

TEST(Steps, OfATwistBackwardsTurnTheOtherWayRound) {
  // Backwards and to the left at once: the back goes to the right.
  const auto steps = twist_steps({0, 0, 0}, -0.5, 0.5, kPi / 2, kStride_m);
  expect_sound(steps, {0, 0, 0});
  EXPECT_NEAR(apart_m(steps.back().pose, {-1, -1, 0}), 0, 1e-9);
  EXPECT_NEAR(steps.back().pose.yaw_rad, kPi / 2, 1e-9);
  EXPECT_NEAR(steps.back().driven_m, kPi / 2, 1e-9);
}

TEST(Steps, OfATwistWithoutSpeedAreThePoseAlone) {
  EXPECT_EQ(twist_steps({1, 2, 3}, 0, 1, 5, kStride_m).size(), 1U);
}

TEST(Steps, OfATwistThatHardlyMovesAreOneTurn) {
  const auto steps = twist_steps({0, 0, 0}, 1e-12, 1, 1, kStride_m);
  expect_sound(steps, {0, 0, 0});
  EXPECT_NEAR(steps.back().turned_rad, 2 * kPi, 1e-9);
}

TEST(Steps, OfAPivotStandStill) {
  const auto steps = pivot_steps({1, 2, 3}, -to_rad(90.0));
  expect_sound(steps, {1, 2, 3});
  EXPECT_EQ(steps.size(), 31U);
  EXPECT_EQ(apart_m(steps.back().pose, {1, 2, 0}), 0);
  EXPECT_NEAR(steps.back().pose.yaw_rad, 3 - kPi / 2, 1e-12);
  EXPECT_NEAR(steps.back().turned_rad, kPi / 2, 1e-12);
}

TEST(Steps, OfWhatIsNoNumberEndInNone) {
  for (const auto& steps :
       {arc_steps({0, 0, 0}, kNaN, 0, 1), arc_steps({kNaN, 0, 0}, 1, 0, 1),
        twist_steps({0, 0, 0}, kNaN, 0, 1, 1), twist_steps({0, 0, 0}, 1, kNaN, 1, 1),
        pivot_steps({0, 0, 0}, kNaN), track_steps({0, 0, 0}, std::vector<Point2>{{kNaN, 1}}, 1)})
    EXPECT_FALSE(is_finite(steps.back().pose));
}

TEST(Steps, OfAWayWithoutEndAreBounded) {
  EXPECT_LE(arc_steps({0, 0, 0}, 1e12, 0.1, kStride_m).size(), 100'001U);
  EXPECT_LE(track_steps({0, 0, 0}, std::vector<Point2>{{0, 0}, {1e12, 0}}, kStride_m).size(),
            2'000'001U);
}

TEST(Steps, BetweenTwoPosesAreOnTheirArc) {
  const Pose2 to{1, 1, kPi / 2};
  for (const double part : {0.0, 0.3, 0.5, 1.0}) {
    const Pose2 pose = between({0, 0, 0}, to, part);
    EXPECT_NEAR(length_m(place_of(pose) - Point2{0, 1}), 1, 1e-12) << part;
    EXPECT_NEAR(pose.yaw_rad, part * kPi / 2, 1e-12);
  }
  EXPECT_NEAR(between({0, 0, 3}, {0, 0, -3}, 0.5).yaw_rad, kPi, 1e-9) << "the shorter way round";
}

TEST(TrackSteps, EndAtTheGoalWithTheLineAsArcLength) {
  const std::vector<Point2> line{{0, 0}, {3, 0}, {7, 0}};
  const auto steps = track_steps({0, 0, 0}, line, kStride_m);
  expect_sound(steps, {0, 0, 0});
  EXPECT_EQ(apart_m(steps.back().pose, {7, 0, 0}), 0);
  EXPECT_NEAR(steps.back().driven_m, 7, 1e-12);
  EXPECT_NEAR(steps.back().turned_rad, 0, 1e-12);
}

TEST(TrackSteps, FaceAlongACurveOfChords) {
  // 1 m, a point each 0.5 m as tracks are recorded.
  std::vector<Point2> line;
  for (int i = 0; i <= 6; ++i) line.push_back({std::sin(0.5 * i), 1 - std::cos(0.5 * i)});
  const auto steps = track_steps({0, 0, 0.25}, line, kStride_m);
  expect_sound(steps, {0, 0, 0.25});
  for (const Step& step : steps) {
    if (step.driven_m < 1 || step.driven_m > 2) continue;
    const Point2 from_centre = place_of(step.pose) - Point2{0, 1};
    const double along_rad = std::atan2(from_centre.y_m, from_centre.x_m) + kPi / 2;
    EXPECT_NEAR(wrap_rad(step.pose.yaw_rad - along_rad), 0, to_rad(3.0)) << step.driven_m;
  }
}

TEST(TrackSteps, TurnOnTheSpotAtASharpCorner) {
  const std::vector<Point2> line{{0, 0}, {3, 0}, {3, 3}};
  const auto steps = track_steps({0, 0, 0}, line, kStride_m);
  expect_sound(steps, {0, 0, 0});
  int there = 0;
  for (const Step& step : steps) there += apart_m(step.pose, {3, 0, 0}) < 1e-9;
  EXPECT_EQ(there, 31);
  EXPECT_NEAR(steps.back().turned_rad, kPi / 2, 1e-9);
}

TEST(TrackSteps, TakePointsCloseTogetherForOneCorner) {
  const std::vector<Point2> line{{0, 0}, {2.9, 0}, {2.97, 0.03}, {3, 0.1}, {3, 3}};
  const auto steps = track_steps({0, 0, 0}, line, kStride_m);
  std::vector<double> pivots_m;
  for (std::size_t i = 1; i < steps.size(); ++i)
    if (steps[i].driven_m == steps[i - 1].driven_m &&
        (pivots_m.empty() || pivots_m.back() != steps[i].driven_m))
      pivots_m.push_back(steps[i].driven_m);
  EXPECT_EQ(pivots_m.size(), 1U);
}

TEST(TrackSteps, TurnOnTheSpotFirstWhenTheLineIsBehind) {
  const auto steps = track_steps({0, 0, kPi / 2}, std::vector<Point2>{{0, 0}, {0, -3}}, kStride_m);
  expect_sound(steps, {0, 0, kPi / 2});
  EXPECT_EQ(steps[60].driven_m, 0);
  EXPECT_NEAR(std::abs(wrap_rad(steps[60].pose.yaw_rad + kPi / 2)), 0, 1e-9);
}

/// As the tracker does: SweptTracks.CoverTheWayOntoTheTrack compares.
TEST(TrackSteps, GetOntoTheLineByTheLawOfSteering) {
  const Pose2 from{0, 0.2, 0.3};
  const auto steps = track_steps(from, std::vector<Point2>{{0, 0}, {5, 0}}, kStride_m);
  expect_sound(steps, from, 0.12);
  for (const Step& step : steps) {
    EXPECT_LE(step.pose.y_m, 0.25);
    EXPECT_GE(step.pose.y_m, -0.03);
    if (step.driven_m < 1.5) continue;
    EXPECT_NEAR(step.pose.y_m, 0, 0.02) << step.driven_m;
    if (step.driven_m < 3) continue;
    EXPECT_NEAR(step.pose.y_m, 0, 1e-3);
    EXPECT_NEAR(step.pose.yaw_rad, 0, 1e-3);
  }
  EXPECT_NEAR(steps.back().driven_m, 5, 1e-9);
}

TEST(TrackSteps, BeginWhereTheRobotIsOnALineThatBeginsBehindIt) {
  const auto steps = track_steps({0.7, 0, 0}, std::vector<Point2>{{0, 0}, {3, 0}}, kStride_m);
  expect_sound(steps, {0.7, 0, 0});
  EXPECT_NEAR(steps.back().driven_m, 2.3, 1e-9);
  EXPECT_NEAR(apart_m(steps.back().pose, {3, 0, 0}), 0, 1e-9);
  const std::vector<Point2> line{{-20, 0}, {20, 0}};
  const auto told = track_steps({0.7, 0, 0}, TrackPart{line, 20.3, 5}, {}, kStride_m);
  expect_sound(told, {0.7, 0, 0});
  EXPECT_NEAR(told.back().driven_m, 5, 1e-9);
  EXPECT_NEAR(told.back().pose.x_m, 5.7, 1e-9);
}

TEST(TrackSteps, OfARobotOnItsTurnAtACornerGoOnTurning) {
  const std::vector<Point2> line{{0, 0}, {3, 0}, {3, 3}};
  const Pose2 from{2.98, 0.01, to_rad(70.0)};
  const auto steps = track_steps(from, TrackPart{line, 3}, {}, kStride_m);
  for (const Step& step : steps) EXPECT_GT(step.pose.yaw_rad, to_rad(69.0));
  EXPECT_NEAR(steps.back().pose.y_m, 3, 1e-3);
}

TEST(TrackSteps, AtTheGoalAreThePoseAlone) {
  const std::vector<Point2> line{{0, 0}, {3, 0}};
  const auto steps = track_steps({3.01, 0, 0}, TrackPart{line, 3}, {}, kStride_m);
  EXPECT_EQ(steps.back().driven_m, 0);
}

TEST(TrackSteps, DriveToALineThatBeginsElsewhere) {
  const auto steps = track_steps({0, 0, 0}, std::vector<Point2>{{3, 0}, {5, 0}}, kStride_m);
  expect_sound(steps, {0, 0, 0});
  EXPECT_NEAR(steps.back().driven_m, 5, 1e-12);
  const auto goal = track_steps({0, 0, 0}, std::vector<Point2>{{0.2, 0}}, kStride_m);
  EXPECT_NEAR(goal.back().driven_m, 0.2, 1e-12);
}

TEST(TrackSteps, WithoutALineAreThePoseAlone) {
  EXPECT_EQ(track_steps({1, 2, 3}, {}, kStride_m).size(), 1U);
  EXPECT_EQ(track_steps({1, 2, 3}, std::vector<Point2>{{1, 2}}, kStride_m).size(), 1U);
}

}  // namespace
}  // namespace drover::scene
