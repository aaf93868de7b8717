#include "scene/sensor/near_things.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/scene/sensor/turns.h"

namespace drover::scene::sensor {
namespace {

using namespace std::chrono_literals;

/// A robot of 1.0 by 0.7 m with a scanner at its front drives about; ten turns a second.
class NearARobot : public testing::Test {
 protected:
  NearARobot() { run(500ms, {}); }
  void run(Duration time, const Twist& twist) {
    for (const Time end = now + time; now < end;) {
      now += 25ms;
      const double turn_rad = twist.wz_radps * 0.025;
      const Point2 ahead = direction(pose.yaw_rad + turn_rad / 2);
      pose = {pose.x_m + 0.025 * twist.vx_mps * ahead.x_m,
              pose.y_m + 0.025 * twist.vx_mps * ahead.y_m, pose.yaw_rad + turn_rad};
      way.note(now, twist, 0);
      if (++count % 4 == 0 && sees) things.see(0, world.turn(pose, now, twist), way);
    }
  }
  /// How far from base_link the nearest one is that is kept.
  double nearest_m() const {
    double least_m = std::numeric_limits<double>::infinity();
    for (const SeenPoint& point : things.all(way)) least_m = std::min(least_m, length_m(point.at));
    return least_m;
  }
  /// The farthest that a point is from the surface of the only box, as the world has it.
  double farthest_off_m() const {
    double most_m = 0;
    const Box& box = world.boxes.front();
    for (const SeenPoint& point : things.all(way)) {
      const Point2 x = direction(pose.yaw_rad);
      const Point2 at{pose.x_m + x.x_m * point.at.x_m - x.y_m * point.at.y_m,
                      pose.y_m + x.y_m * point.at.x_m + x.x_m * point.at.y_m};
      const Point2 d = at - box.centre;
      most_m = std::max(most_m, std::abs(std::max(std::abs(d.x_m), std::abs(d.y_m)) - box.half_m));
    }
    return most_m;
  }

  World world;
  NearThings things{{{{0.5, 0.35}, {-0.5, 0.35}, {-0.5, -0.35}, {0.5, -0.35}}, 1.7, 20s}};
  OwnWay way;
  Pose2 pose;
  Time now{100s};
  bool sees = true;
  int count = 0;
};

TEST_F(NearARobot, NothingIsWhereNothingIsSeen) {
  EXPECT_TRUE(things.all(way).empty());
}

TEST_F(NearARobot, WhatIsSeenIsThereAndWhereItIs) {
  world.boxes = {{{0, 1}}};
  run(200ms, {});
  EXPECT_NEAR(nearest_m(), 0.75, 0.01);
  EXPECT_LT(farthest_off_m(), 1e-6);
  EXPECT_EQ(things.all(way).front().scanner, 0);
  EXPECT_LE(now - things.all(way).front().seen, 100ms);
}

TEST_F(NearARobot, WhatWasSeenIsThereWhenItIsInTheBlindPartBehind) {
  world.blind_rad = kPi / 2;
  world.boxes = {{{1.2, 0.8}}};
  run(2s, {0.6, 0});
  ASSERT_LT(length_m(world.boxes[0].centre - place_of(pose)), 0.9);
  EXPECT_NEAR(nearest_m(), 0.55, 0.05);
  EXPECT_LT(farthest_off_m(), 0.03);
}

TEST_F(NearARobot, TheMotionDuringATurnIsTakenOut) {
  world.boxes = {{{0.1, 1.1}}};
  run(4s, {0, 0.8});
  EXPECT_LT(farthest_off_m(), 0.01);
  EXPECT_FALSE(things.all(way).empty());
}

TEST_F(NearARobot, WhatWentIsGoneWhenItsPlaceIsSeen) {
  world.boxes = {{{0, 1}}};
  run(500ms, {});
  world.boxes.clear();
  run(200ms, {});
  EXPECT_TRUE(things.all(way).empty());
}

TEST_F(NearARobot, WhatWentUnseenStaysUntilItsPlaceIsSeenAgain) {
  world.blind_rad = kPi / 2;
  world.boxes = {{{1.2, 0.8}}};
  run(2s, {0.6, 0});
  world.boxes.clear();
  run(2s, {});
  EXPECT_LT(nearest_m(), 0.7);
  run(2100ms, {0, 0.8});  // and looks there
  run(200ms, {});
  EXPECT_TRUE(things.all(way).empty());
}

TEST_F(NearARobot, WhatIsHiddenByAnotherThingStays) {
  world.boxes = {{{1.4, 0.6}, 0.1}};
  run(200ms, {});
  ASSERT_FALSE(things.all(way).empty());
  world.boxes = {{{1.0, 0.35}, 0.1}};
  run(300ms, {});
  const auto all = things.all(way);
  EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                          [](const SeenPoint& point) { return point.at.x_m > 1.25; }));
}

TEST_F(NearARobot, WhatIsNotSeenAgainIsForgottenAfterAWhile) {
  world.blind_rad = kPi / 2;
  world.boxes = {{{1.2, 0.8}}};
  run(2s, {0.6, 0});
  ASSERT_LT(nearest_m(), 1);
  run(19s, {});
  EXPECT_LT(nearest_m(), 1);
  world.boxes.clear();
  run(2s, {});
  EXPECT_TRUE(things.all(way).empty());
}

TEST_F(NearARobot, WhatIsFarBehindIsForgotten) {
  world.blind_rad = kPi / 2;
  world.boxes = {{{1.2, 0.8}}};
  run(8s, {0.6, 0});
  EXPECT_TRUE(things.all(way).empty());
}

TEST_F(NearARobot, WhatTheRobotDroveOverIsGone) {
  world.blind_rad = kPi / 2;
  world.boxes = {{{1.0, 0}, 0.1}};
  run(200ms, {});
  ASSERT_FALSE(things.all(way).empty());
  sees = false;
  world.boxes.clear();
  run(1500ms, {0.6, 0});
  sees = true;
  run(300ms, {});
  EXPECT_TRUE(things.all(way).empty());
}

TEST_F(NearARobot, ItsOwnPartsAreNothing) {
  world.boxes = {{{-0.1, 0.2}, 0.1}};
  run(500ms, {});
  EXPECT_TRUE(things.all(way).empty());
}

TEST_F(NearARobot, NothingIsKnownOfThePastWhenNobodyKnowsHowItMoved) {
  world.boxes = {{{0, 1}}};
  run(500ms, {});
  ASSERT_FALSE(things.all(way).empty());
  way.note(now + 10ms, {NAN, 0}, 0);
  EXPECT_TRUE(things.all(way).empty());
  run(500ms, {});
  EXPECT_FALSE(things.all(way).empty()) << "it is seen";
}

TEST_F(NearARobot, AnotherScannerDoesNotSeeThroughWhatOneSaw) {
  world.blind_rad = kPi / 2;
  world.boxes = {{{1.2, 0.8}}};
  run(2s, {0.6, 0});
  ASSERT_LT(nearest_m(), 1);
  World higher;  // over the box
  for (int i = 0; i < 5; ++i) {
    run(100ms, {});
    things.see(1, higher.turn(pose, now), way);
  }
  EXPECT_LT(nearest_m(), 1);
}

TEST_F(NearARobot, ATurnThatWasTakenIsNotTakenAgain) {
  world.boxes = {{{0, 1}}};
  const SeenTurn turn = world.turn(pose, now);
  things.see(0, turn, way);
  const auto seen = things.newest(0);
  EXPECT_EQ(seen, turn.scan.begin);
  run(25ms, {});
  things.see(0, turn, way);
  EXPECT_EQ(things.newest(0), seen);
  things.see(0, SeenTurn{}, way);
  EXPECT_EQ(things.newest(0), seen);
}

TEST(DepthM, IsTheWayToTheNearestSide) {
  const Piece body = piece_of({{0.5, 0.35}, {-0.5, 0.35}, {-0.5, -0.35}, {0.5, -0.35}});
  EXPECT_NEAR(depth_m(body, {0, 0}), 0.35, 1e-12);
  EXPECT_NEAR(depth_m(body, {0.45, 0}), 0.05, 1e-12);
  EXPECT_NEAR(depth_m(body, {0.6, 0}), -0.1, 1e-12);
  EXPECT_LT(depth_m(disc({0, 0}, 1), {0, 0}), -1e9) << "no outline";
}

}  // namespace
}  // namespace drover::scene::sensor
