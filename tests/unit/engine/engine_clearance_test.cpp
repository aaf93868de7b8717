// The whole engine in front of a wall, by what somebody says who looks around.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/clearance/stop_chain.h"
#include "engine_wall.h"

namespace drover::engine {
namespace {

using testing::HasSubstr;

TEST_F(InFrontOfAWall, DrivesToItsGoalWhereNothingIsInTheWay) {
  start();
  run_s(14);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
}

TEST_F(InFrontOfAWall, StandsBeforeItAndGoesOnWhenItIsAway) {
  wall_m = 3;
  start();
  run_s(14);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
  EXPECT_TRUE(rig.snapshot().nav.obstacle);
  EXPECT_TRUE(told("box1")) << rig.why();
  EXPECT_LT(speed_mps(), 0.005);
  EXPECT_GE(gap_m(), 0);
  EXPECT_LE(gap_m(), 0.3);
  wall_m = 100;
  run_s(0.9);
  EXPECT_LT(speed_mps(), 0.005) << "it left less than a second ago";
  run_s(10);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
}

TEST_F(InFrontOfAWall, StopsWithoutARampBeforeWhatNoRampEndsBefore) {
  start();
  run_s(5);
  ASSERT_GT(speed_mps(), 0.7) << rig.why();
  wall_m = rig.plant.truth().x_m + 0.4;
  run_s(0.1);
  EXPECT_TRUE(is_zero(rig.engine->viewpoint().commanded));
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
  wall_m = 100;
  run_s(12);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
}

TEST_F(InFrontOfAWall, StaysWhereItWasStoppedWithoutARamp) {
  start();
  run_s(5);
  wall_m = rig.plant.truth().x_m + 0.4;
  run_s(3);
  EXPECT_GT(gap_m(), 0.06) << "it would have come nearer with a ramp";
  EXPECT_LE(gap_m(), 0.4);
  const double stood_m = gap_m();
  run_s(5);
  EXPECT_NEAR(gap_m(), stood_m, 0.001);
  EXPECT_TRUE(rig.snapshot().nav.obstacle);
}

TEST_F(InFrontOfAWall, StopsAStreamWithoutARampLikewise) {
  stream_s(0, 0.6);
  stream_s(4, 5);
  ASSERT_GT(speed_mps(), 0.5) << rig.why();
  wall_m = rig.plant.truth().x_m + 0.2;
  stream_s(4, 0.1);
  EXPECT_TRUE(is_zero(rig.engine->viewpoint().commanded));
  EXPECT_TRUE(announced("box1"));
}

/// The outer wheels brake with all that is permitted, the middle of the base with less.
TEST_F(InFrontOfAWall, StopsAStreamInACurveBeforeWhatAppears) {
  for (const double left_m : {0.45, 0.5, 0.55, 0.6, 0.7, 0.9}) {
    stream_s(0, 0.6);
    wall_m = 1000;
    curve_s(3, 0.6, 0.6);
    ASSERT_GT(speed_mps(), 0.5) << rig.why();
    double way_m = 0;
    for (int i = 0; i < 1000; ++i) {
      ahead_m = std::max(0.0, left_m - way_m);
      curve_s(0.005, 0.6, 0.6);
      way_m += 0.005 * speed_mps();
    }
    EXPECT_LT(speed_mps(), 0.005);
    EXPECT_LT(way_m, left_m);
    ahead_m = 100;
    run_s(3);
  }
}

TEST_F(InFrontOfAWall, HasArrivedWhereItsGoalIsReachedThoughItMayNotGoOn) {
  start();
  run_s(2);
  wall_m = 5.95;
  run_s(20);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
}

TEST_F(InFrontOfAWall, KeepsItsRampBeforeWhatItSawInTime) {
  wall_m = 3;
  start();
  double last_mps = 0;
  for (int i = 0; i < 14 * 200; ++i) {
    tick();
    const double mps = rig.engine->viewpoint().commanded.vx_mps;
    EXPECT_GT(mps, last_mps - 0.0041) << i;  // 0.8 m/s^2 in 5 ms
    last_mps = mps;
  }
}

TEST_F(InFrontOfAWall, IsNeverFasterThanWhatCanStopBeforeIt) {
  wall_m = 3;
  start();
  for (int i = 0; i < 14 * 200; ++i) {
    tick();
    // As a ramp to zero brakes, without a time to react.
    const double brakes_m = speed_mps() * speed_mps() / (2 * rig.config.limits.deceleration_mps2);
    ASSERT_LE(brakes_m, std::max(gap_m(), 0.0) + 1e-6) << "at " << gap_m() << " m";
  }
}

TEST_F(InFrontOfAWall, StopsForOneThatAppearsBeyondItsStoppingWay) {
  start();
  run_s(5);
  ASSERT_GT(speed_mps(), 0.7);
  wall_m = rig.plant.truth().x_m + stop_way(0.8, {0.28, 0.8}) + 0.05;
  run_s(4);
  EXPECT_LT(speed_mps(), 0.005);
  EXPECT_GE(gap_m(), 0);
}

TEST_F(InFrontOfAWall, WaitsForAnAnswerAboutItsTrackAndGivesUp) {
  start();
  task_path = 4;  // the answers are about the one before
  run_s(2);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
  EXPECT_LT(std::abs(rig.plant.truth().x_m), 0.001);
  run_s(2);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  EXPECT_TRUE(told("this track was not looked at")) << rig.why();
}

TEST_F(InFrontOfAWall, StopsWhenNobodyLooksAnyMore) {
  start();
  run_s(5);
  ASSERT_GT(speed_mps(), 0.7);
  answers = false;
  run_s(2);
  EXPECT_LT(speed_mps(), 0.005);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
  EXPECT_TRUE(told("was looked at")) << rig.why();
  answers = true;
  run_s(12);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
}

TEST_F(InFrontOfAWall, SaysThatItGoesOnSoonWhenItIsSeenAgain) {
  start();
  run_s(5);
  answers = false;
  run_s(2);
  EXPECT_FALSE(told("goes on when")) << rig.why();
  answers = true;
  run_s(0.3);
  ASSERT_TRUE(rig.snapshot().nav.obstacle);
  EXPECT_TRUE(told("goes on when nothing has held it up for")) << rig.why();
  run_s(3);
  EXPECT_FALSE(rig.snapshot().nav.obstacle);
  EXPECT_TRUE(rig.snapshot().why.empty()) << rig.why();
}

TEST_F(InFrontOfAWall, StartsNothingWhileNobodyLooks) {
  answers = false;
  run_s(0.5);
  start();
  run_s(0.1);
  ASSERT_FALSE(rig.said<CommandRefused>().empty());
  EXPECT_THAT(std::string(rig.said<CommandRefused>().back().reason.view()), HasSubstr("looked at"));
}

TEST_F(InFrontOfAWall, FollowsNoJointCommandsIntoIt) {
  wall_m = 1;
  stream_s(0, 0.6);
  stream_s(4, 7.4);  // 0.66 m/s
  EXPECT_GT(rig.plant.truth().x_m, 0.3) << "it never moved: this proves nothing";
  EXPECT_LT(speed_mps(), 0.005);
  EXPECT_GE(gap_m(), 0);
}

/// Nobody asks for motion any more once the stream has ended; its sender is told all the same.
TEST_F(InFrontOfAWall, TellsWhatEndedJointCommandsWhileSomebodySendsThem) {
  wall_m = 1;
  stream_s(0, 0.6);
  EXPECT_TRUE(rig.snapshot().why.empty()) << rig.why();
  stream_s(4, 6);
  ASSERT_TRUE(announced("joint commands ended: box1"));
  for (int i = 0; i < 100; ++i) {
    stream_s(4, 0.02);
    EXPECT_TRUE(rig.snapshot().nav.obstacle) << i;
    EXPECT_TRUE(told("box1 is in the way")) << rig.why();
  }
  EXPECT_TRUE(told("begins with velocity 0")) << rig.why();
  EXPECT_LT(rig.snapshot().why.size(), 4U) << rig.why();
  run_s(0.9);
  EXPECT_TRUE(rig.snapshot().nav.obstacle);
  run_s(0.2);
  EXPECT_FALSE(rig.snapshot().nav.obstacle) << "nobody sends any more";
  EXPECT_TRUE(rig.snapshot().why.empty()) << rig.why();
}

TEST_F(InFrontOfAWall, TellsWhatEndedJointCommandsUntilOthersBegin) {
  wall_m = 1;
  stream_s(0, 0.6);
  stream_s(4, 8);
  ASSERT_TRUE(rig.snapshot().nav.obstacle);
  stream_s(0, 0.1);
  EXPECT_FALSE(rig.snapshot().nav.obstacle);
  EXPECT_TRUE(rig.snapshot().why.empty()) << rig.why();
  stream_s(0, 0.6);
  run_s(2);
  stream_s(4, 0.1);
  EXPECT_FALSE(rig.snapshot().nav.obstacle) << "this one met nothing";
  EXPECT_TRUE(told("begins with velocity 0")) << rig.why();
}

/// It was driven to the wall, and its driver lets go, then reverses.
TEST_F(InFrontOfAWall, LetsJointCommandsDriveAwayFromIt) {
  wall_m = 1;
  stream_s(0, 0.6);
  stream_s(4, 8);
  ASSERT_LT(gap_m(), 0.05);
  EXPECT_TRUE(announced("joint commands ended: box1"));
  stream_s(0, 0.6);
  EXPECT_FALSE(rig.snapshot().nav.obstacle);
  const double before_m = rig.plant.truth().x_m;
  stream_s(-2, 2);
  EXPECT_LT(rig.plant.truth().x_m, before_m - 0.3);
  stream_s(0, 1);
  const double stood_m = rig.plant.truth().x_m;
  wall_m = stood_m + 0.01;
  stream_s(0, 0.6);
  stream_s(2, 1);
  EXPECT_NEAR(rig.plant.truth().x_m, stood_m, 0.001) << "towards it is not away from it";
}

TEST_F(InFrontOfAWall, DrivesToAGoalWithAWallHalfAMetreBehindItAsWithoutOne) {
  const auto seconds = [&] {
    for (int i = 0; i < 20 * 200; ++i) {
      tick();
      EXPECT_FALSE(rig.snapshot().nav.obstacle) << "at " << gap_m() << " m";
      if (rig.snapshot().nav.status != NavStatus::run) return i / 200.0;
    }
    return 20.0;
  };
  wall_m = 6.5;
  start();
  const double with_wall_s = seconds();
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
  EXPECT_LT(with_wall_s, 12);
}

TEST_F(InFrontOfAWall, DrivesOnAfterALateAnswer) {
  start();
  run_s(5);
  ASSERT_GT(speed_mps(), 0.7);
  answers = false;
  run_s(0.15);
  answers = true;
  count = 0;
  run_s(0.2);
  EXPECT_GT(speed_mps(), 0.6);
  run_s(0.5);
  EXPECT_GT(speed_mps(), 0.7);
  EXPECT_FALSE(rig.snapshot().nav.paused);
}

TEST_F(InFrontOfAWall, GoesOnASecondAfterItLeft) {
  wall_m = 3;
  start();
  run_s(14);
  ASSERT_LT(speed_mps(), 0.005);
  wall_m = 100;
  run_s(1.5);
  EXPECT_GT(speed_mps(), 0.05);
}

/// Each answer names it anew, with its distance.
TEST_F(InFrontOfAWall, TellsWhatIsFreeAndWhatIsInItsWay) {
  wall_m = 3;
  start();
  run_s(14);
  const ClearanceSnapshot& free = rig.snapshot().clearance;
  EXPECT_TRUE(free.configured);
  EXPECT_LT(rig.now - free.time, std::chrono::milliseconds(100));
  EXPECT_NEAR(free.ahead_m, gap_m(), 0.01);
  EXPECT_NEAR(free.along_m, gap_m(), 0.01);
  EXPECT_EQ(free.back_m, 3);
  EXPECT_DOUBLE_EQ(free.left_rad, kPi);
  EXPECT_TRUE(free.unknown.empty());
  EXPECT_TRUE(told(std::string(free.first.view()).c_str())) << rig.why();
  answers = false;
  run_s(1);
  EXPECT_FALSE(std::isfinite(free.ahead_m));
  EXPECT_FALSE(free.unknown.empty());
}

/// While the heading is not known nobody can tell where its corners are: what is free is so all
/// around, and turning is told as nothing.
class ThatLooksForItsHeading : public InFrontOfAWall {
 protected:
  ThatLooksForItsHeading() { turns = false; }
  void look_for_heading() {
    rig.no_heading = true;
    rig.engine = std::make_unique<Engine>(rig.config);
    tick();
    rig.set_origin();
    run_s(3);
    ASSERT_FALSE(std::isfinite(rig.engine->viewpoint().pose.yaw_sigma_rad));
    rig.command(FindHeading{});
  }
};

TEST_F(ThatLooksForItsHeading, DrivesWhereItsSurroundingsAreFree) {
  look_for_heading();
  run_s(6);
  EXPECT_GT(rig.plant.truth().x_m, 0.3) << rig.why();
}

TEST_F(ThatLooksForItsHeading, StopsBeforeWhatIsInItsWay) {
  wall_m = 0.4;
  look_for_heading();
  run_s(10);
  EXPECT_GT(rig.plant.truth().x_m, 0.1) << rig.why();
  EXPECT_GE(gap_m(), 0);
  EXPECT_LT(speed_mps(), 0.005);
  EXPECT_TRUE(announced("no heading: box1"));
}

TEST(WithoutSomebodyWhoLooks, ARobotThatNeedsNoneDrives) {
  EngineRig rig;
  Path path = straight_path(6);
  rig.settle();
  rig.start(path, 12, 0.5);
  rig.run_s(4);
  EXPECT_GT(rig.plant.truth().x_m, 0.5);
}

/// It has no zones, and its journal speaks of none.
TEST_F(InFrontOfAWall, SaysThatNothingIsInTheWayAnyMore) {
  start();
  wall_m = 2;
  run_s(8);
  ASSERT_TRUE(rig.snapshot().nav.obstacle) << rig.why();
  wall_m = 100;
  run_s(2);
  EXPECT_TRUE(announced("nothing is in the way any more"));
  EXPECT_FALSE(announced("near zone"));
}

}  // namespace
}  // namespace drover::engine
