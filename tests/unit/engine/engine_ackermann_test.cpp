// The engine with a base that steers: curves as it can drive them, and no turn on the spot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine_twist_fixture.h"
#include "support/tracks.h"

namespace drover::engine {
namespace {

using test::Pen;
using test::record;
using ::testing::HasSubstr;

EngineConfig steered_config() {
  EngineConfig config = twist_config();
  config.base.kind = BaseKind::ackermann;
  config.base.track_m = 0.6;
  config.base.wheelbase_m = 0.65;
  config.base.max_steering_rad = 0.5;  // 1.49 m
  config.base.steering_rate_radps = 0.5;
  return config;
}

class ARobotThatSteers : public ::testing::Test {
 protected:
  explicit ARobotThatSteers(double x_m = 0, double y_m = 0, double yaw_rad = 0)
      : rig(steered_config(), x_m, y_m, yaw_rad) {
    rig.settle();
  }
  void start(const Path& given) {
    path = given;
    rig.start(path, static_cast<std::uint32_t>(path.points.size() - 1), 0.5);
    rig.tick();
  }
  std::string refused() const {
    const auto all = rig.said<CommandRefused>();
    return all.empty() ? "" : std::string(all.back().reason.view());
  }
  struct Driven {
    double rms_m = 0;
    double most_m = 0;
    double tightest_radpm = 0;
    double back_m = 0;
  };
  /// To the end; what it was told on the way is always a curve that it can drive.
  Driven drive_to_the_end() {
    Driven driven;
    double sum_m2 = 0;
    int count = 0;
    for (int i = 0; i < 200 * 200 && rig.snapshot().nav.status == NavStatus::run; ++i) {
      rig.tick();
      const Twist told = rig.out.base.twist;
      EXPECT_LE(std::abs(told.wz_radps), std::abs(told.vx_mps) / radius_m * 1.001 + 1e-9);
      if (std::abs(told.vx_mps) > 0.01)
        driven.tightest_radpm =
            std::max(driven.tightest_radpm, std::abs(told.wz_radps / told.vx_mps));
      driven.back_m += std::max(-rig.plant.truth().vx_mps, 0.0) * to_s(kRigTick);
      const double off_m =
          test::distance_m(path.points, rig.plant.truth().x_m, rig.plant.truth().y_m);
      driven.most_m = std::max(driven.most_m, off_m);
      sum_m2 += off_m * off_m;
      ++count;
    }
    driven.rms_m = std::sqrt(sum_m2 / std::max(count, 1));
    return driven;
  }

  const double radius_m = limits(kinematics_of(steered_config().base)).smallest_radius_m;
  Path path;
  EngineRig rig;
};

TEST_F(ARobotThatSteers, DrivesATrackWithAUTurnToItsEnd) {
  start(record(Pen().line(6).arc(2.2, kPi).line(6).points()));
  const Driven driven = drive_to_the_end();
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why() << refused();
  EXPECT_LT(driven.rms_m, 0.05);
  EXPECT_LT(driven.most_m, 0.15);
}

TEST_F(ARobotThatSteers, DrivesAtItsSmallestRadius) {
  start(record(Pen().line(4).arc(1.6, kPi).line(2).arc(1.6, -kPi).line(4).points()));
  const Driven driven = drive_to_the_end();
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why() << refused();
  EXPECT_LT(driven.most_m, 0.3);
}

TEST_F(ARobotThatSteers, RefusesATrackThatIsTooTightWithThePoint) {
  start(record(Pen().line(4).arc(1.0, kPi).line(4).points()));
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::free);
  EXPECT_THAT(refused(), ::testing::ContainsRegex("the track's radius is (0.9|1.0)[0-9] m"));
  EXPECT_THAT(refused(), HasSubstr("this base needs 1.49 m"));
  EXPECT_THAT(refused(), ::testing::ContainsRegex("at point 1[0-9] "));
}

TEST_F(ARobotThatSteers, RefusesACornerWithThePoint) {
  start(record(Pen().line(4).turn(kPi / 2).line(4).points()));
  EXPECT_THAT(refused(), HasSubstr("at point 9 the track turns by 90 degrees at once"));
}

TEST_F(ARobotThatSteers, DrivesBackFromACuspWithoutTurning) {
  start(test::with_gears(record(Pen().line(5).turn(kPi).arc(4, kPi / 4).points())));
  const Driven driven = drive_to_the_end();
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why() << refused();
  EXPECT_GT(driven.back_m, 2.5);
  EXPECT_LT(driven.rms_m, 0.08);
}

TEST_F(ARobotThatSteers, TurnsRoundInThree) {
  start(test::with_gears(record(test::three_point_turn())));
  drive_to_the_end();
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why() << refused();
}

class ARobotThatSteersBesideItsTrack : public ARobotThatSteers {
 protected:
  ARobotThatSteersBesideItsTrack() : ARobotThatSteers(0, 1.2, to_rad(15)) {}
};

TEST_F(ARobotThatSteersBesideItsTrack, JoinsItWhereThereIsWayEnough) {
  start(straight_path(10));
  drive_to_the_end();
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why() << refused();
  EXPECT_NEAR(rig.plant.truth().y_m, 0, 0.05);
}

TEST_F(ARobotThatSteersBesideItsTrack, IsRefusedWhereThereIsNot) {
  start(straight_path(2));
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::free);
  EXPECT_THAT(refused(), HasSubstr("to be on it takes"));
  EXPECT_THAT(refused(), HasSubstr("point 5 is 2.0 m away"));
}

TEST_F(ARobotThatSteers, BeginsSlowlyWithItsWheelsTurned) {
  rig.steering_rad = -0.4;
  rig.run_s(0.1);
  start(straight_path(8));
  const Driven driven = drive_to_the_end();
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why() << refused();
  EXPECT_LT(driven.most_m, 0.12);
}

TEST_F(ARobotThatSteers, KeepsItsAngleAtRest) {
  start(record(Pen().line(2).arc(2.2, kPi).line(4).points()));
  rig.run_s(9);
  ASSERT_GT(rig.steering_rad, 0.15);
  rig.command(CancelTask{});
  rig.run_s(3);
  const double angle_rad = rig.steering_rad;
  EXPECT_GT(angle_rad, 0.15);
  EXPECT_TRUE(is_zero(rig.out.base.twist));
  rig.run_s(2);
  EXPECT_EQ(rig.steering_rad, angle_rad);
  EXPECT_NEAR(rig.snapshot().base.steering_rad, angle_rad, 1e-9);
}

TEST_F(ARobotThatSteers, IsFoundNotToSteer) {
  start(record(Pen().line(3).arc(2.0, kPi).line(4).points()));
  rig.run_s(3);
  ASSERT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why() << refused();
  rig.steering_stuck = true;
  rig.run_s(5);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  EXPECT_TRUE(is_zero(rig.out.base.twist));
  const auto ends = rig.said<TaskEnded>();
  ASSERT_FALSE(ends.empty());
  EXPECT_THAT(std::string(ends[0].reason.view()), HasSubstr("the steering does not follow"));
}

TEST_F(ARobotThatSteers, IsNotTurnedOnTheSpotByHand) {
  rig.command(DriveByHand{7, {0, 0.3}});
  rig.tick();
  EXPECT_THAT(refused(), HasSubstr("cannot turn on the spot"));
  EXPECT_TRUE(is_zero(rig.out.base.twist));
}

TEST_F(ARobotThatSteers, FollowsCmdVelOnNoTighterCurveThanItCan) {
  const auto say_s = [this](Twist twist, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 20); ++i) {
      rig.command(FollowTwist{twist});
      rig.run_s(0.05);
    }
  };
  const double most_radpm = limits(kinematics_of(rig.config.base)).most_radpm();
  say_s({}, 0.5);
  say_s({0.4, 2}, 4);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::cmd_vel) << rig.snapshot().cmd_vel.reason.view();
  const Twist twist = rig.out.base.twist;
  EXPECT_GT(twist.vx_mps, 0.1);
  EXPECT_NEAR(twist.wz_radps / twist.vx_mps, most_radpm, 1e-6);
  say_s({0, 0.3}, 1);
  EXPECT_TRUE(is_zero(rig.out.base.twist));
  EXPECT_THAT(std::string(rig.snapshot().cmd_vel.reason.view()),
              HasSubstr("cannot turn on the spot"));
}

/// The first way after a start, on which wheels, gyro and receiver have to agree.
class ARobotThatSteersOnItsFirstWay : public ::testing::Test {
 protected:
  static EngineConfig unproved() {
    EngineConfig config = steered_config();
    config.navigate.first_way_m = 0.3;
    return config;
  }
  ARobotThatSteersOnItsFirstWay() {
    rig.imu = true;
    rig.settle();
    rig.start(path, 24, 0.5);
  }
  Path path = straight_path(12);
  EngineRig rig{unproved()};
};

TEST_F(ARobotThatSteersOnItsFirstWay, TurnsToBothSidesOnACurve) {
  double left_rad = 0;
  double right_rad = 0;
  while (rig.snapshot().nav.status != NavStatus::success &&
         rig.snapshot().nav.status != NavStatus::error &&
         rig.now < Time{std::chrono::seconds(90)}) {
    rig.tick();
    left_rad = std::max(left_rad, rig.plant.truth().yaw_rad);
    right_rad = std::min(right_rad, rig.plant.truth().yaw_rad);
  }
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
  EXPECT_GT(left_rad, to_rad(3.0));
  EXPECT_LT(right_rad, to_rad(-3.0));
  EXPECT_TRUE(rig.out.remembered.mechanics_proved);
}

TEST_F(ARobotThatSteersOnItsFirstWay, IsFoundNotToSteerAndSaysSo) {
  rig.steering_stuck = true;
  rig.run_s(10);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  const auto ends = rig.said<TaskEnded>();
  ASSERT_FALSE(ends.empty());
  EXPECT_THAT(std::string(ends[0].reason.view()),
              ::testing::StartsWith("the steering does not follow: told"));
  EXPECT_THAT(std::string(ends[0].reason.view()), ::testing::Not(HasSubstr("first way")));
}

}  // namespace
}  // namespace drover::engine
