// How the antenna line is mounted, from straight legs; and what a base does before it knows.
#include "engine/estimate/mounting.h"

#include <gtest/gtest.h>

#include <string>

#include "unit/engine/estimate/rig.h"

namespace drover::engine::estimate {
namespace {

constexpr double kEast_rad = 0;
constexpr double kLeg_m = 5;

/// Legs of a line whose crab is this, over ground that takes it aside to the north by this share.
void legs(Mounting& mounting, double course_rad, double crab_deg, int count, double north = 0,
          const EstimateConfig& config = {}) {
  for (int i = 0; i < count; ++i) {
    const double across = to_rad(crab_deg) + north * std::cos(course_rad) - mounting.applied_rad;
    learn(mounting,
          {.way_m = kLeg_m,
           .course_rad = course_rad,
           .across_m = across * kLeg_m,
           .variance_m2 = square(0.036)},
          config);
  }
}

TEST(Mounting, IsNotLearnedFromOneDirection) {
  const EstimateConfig config;
  Mounting mounting;
  legs(mounting, kEast_rad, 3, 200);
  EXPECT_FALSE(mounting.known(config));
  EXPECT_GT(to_deg(mounting.sigma_rad(config)), 0.9 * config.heading_mount_sigma_deg);
  EXPECT_EQ(mounting.catch_up(config), 0);
}

TEST(Mounting, IsLearnedFromOppositeDirections) {
  const EstimateConfig config;
  for (const double crab_deg : {-4.5, -1.0, 0.0, 2.0, 4.5}) {
    for (const double course_rad : {0.0, 1.0, kPi / 2, 2.5}) {
      Mounting mounting;
      legs(mounting, course_rad, crab_deg, 5);
      legs(mounting, wrap_rad(course_rad + kPi), crab_deg, 5);
      EXPECT_TRUE(mounting.known(config)) << crab_deg;
      EXPECT_NEAR(to_deg(mounting.catch_up(config)), crab_deg, 0.15) << course_rad;
    }
  }
}

TEST(Mounting, IsNotTheGroundThatFallsToOneSide) {
  const EstimateConfig config;
  Mounting mounting;
  legs(mounting, kEast_rad, 0, 5, 0.05);
  legs(mounting, kPi, 0, 5, 0.05);
  EXPECT_TRUE(mounting.known(config));
  EXPECT_NEAR(to_deg(mounting.mean[0]), 0, 0.15);
}

TEST(Mounting, IsHardlyBentByADriftThatComesLater) {
  const EstimateConfig config;
  for (const double course_rad : {0.0, kPi}) {
    Mounting mounting;
    legs(mounting, kEast_rad, 1, 6);
    legs(mounting, kPi, 1, 6);
    mounting.catch_up(config);
    legs(mounting, course_rad, 1, 3, 0.04);
    EXPECT_NEAR(to_deg(mounting.mean[0]), 1, 0.1) << course_rad;
  }
}

TEST(Mounting, IsTakenForFiveDegreesAtMost) {
  const EstimateConfig config;
  Mounting mounting;
  legs(mounting, kEast_rad, 8, 10);
  legs(mounting, kPi, 8, 10);
  ASSERT_TRUE(mounting.known(config));
  EXPECT_DOUBLE_EQ(to_deg(mounting.catch_up(config)), 5);
}

TEST(Mounting, ThatWasCalibratedIsLeftAsItIs) {
  EstimateConfig config;
  config.heading_mount_sigma_deg = 0;
  Mounting mounting;
  EXPECT_TRUE(mounting.known(config));
  legs(mounting, kEast_rad, 3, 5, 0, config);
  legs(mounting, kPi, 3, 5, 0, config);
  EXPECT_EQ(mounting.catch_up(config), 0);
}

class MountedAskew : public ::testing::Test {
 protected:
  static void settle(Rig& rig) {
    rig.yaw_rad = 0;
    rig.world.imu = true;
    rig.stand(5);
  }
  /// Stands when it is asked to. Returns how often it was.
  static int drive(Rig& rig, double seconds) {
    int looks = 0;
    bool looked = false;
    for (double driven_s = 0; driven_s < seconds && !rig.last.disagrees;) {
      const bool looks_now = !rig.last.looks.empty();
      looks += looks_now && !looked ? 1 : 0;
      looked = looks_now;
      if (looks_now) {
        rig.stand(0.1);
      } else {
        rig.drive(0.5, 0.5, 0.1);
        driven_s += 0.1;
      }
    }
    return looks;
  }
  static void turn_round(Rig& rig) { rig.circle(0.5, 1.5, kPi * 1.5 / 0.5); }
};

TEST_F(MountedAskew, IsLookedAtAndIsNoDrift) {
  for (const double off_deg : {-4.0, -2.0, 2.0, 4.0}) {
    Rig rig(3);
    rig.world.heading_off_deg = off_deg;
    settle(rig);
    rig.forget();
    EXPECT_EQ(drive(rig, 60), 1) << off_deg;
    EXPECT_FALSE(rig.last.disagrees) << off_deg << ' ' << rig.last.reason.view();
    EXPECT_FALSE(rig.last.mounting_known);
    EXPECT_EQ(rig.share_bound(), 1) << off_deg;
  }
}

TEST_F(MountedAskew, IsLearnedThereAndBack) {
  for (const double off_deg : {-4.0, 0.0, 3.0}) {
    Rig rig(4);
    rig.world.heading_off_deg = off_deg;
    settle(rig);
    drive(rig, 50);
    turn_round(rig);
    drive(rig, 50);
    EXPECT_TRUE(rig.last.mounting_known) << to_deg(rig.last.mounting_sigma_rad);
    EXPECT_NEAR(to_deg(rig.last.mounting_rad), -off_deg, 0.3);
    EXPECT_LT(to_deg(rig.yaw_error_rad()), 0.5);
    rig.world.position = rig.world.heading = false;
    rig.forget();
    rig.drive(0.5, 0.5, 30);
    EXPECT_LT(rig.position_error_m(), 0.012 * 15);
    EXPECT_EQ(rig.share_bound(), 1);
  }
}

TEST_F(MountedAskew, DrivesLessFarWithoutReceiver) {
  for (const double off_deg : {-1.5, 1.5, 2.0}) {
    Rig rig(5);
    rig.world.heading_off_deg = off_deg;
    settle(rig);
    drive(rig, 10);
    rig.world.position = rig.world.heading = false;
    rig.drive(0.5, 0.5, 2);
    const double told_m = rig.last.metres_left;
    const double begin_m = rig.way_m;
    rig.forget();
    const EstimateConfig bounds;
    while (rig.last.predicted_error_m < bounds.bound_run_m && rig.way_m - begin_m < 20)
      rig.drive(0.5, 0.5, 0.1);
    EXPECT_NEAR(rig.way_m - begin_m, told_m, 0.15 * told_m);
    EXPECT_LT(told_m, 6);
    EXPECT_EQ(rig.share_bound(), 1) << off_deg;
  }
}

TEST_F(MountedAskew, StaysDoubtedUntilAFixHasSettled) {
  Rig rig(6);
  rig.world.heading_off_deg = 2;
  settle(rig);
  drive(rig, 10);
  rig.world.position = rig.world.heading = false;
  rig.drive(0.5, 0.5, 20);
  rig.forget();
  rig.world.position = rig.world.heading = true;
  rig.world.fade_s = 1;
  rig.world.quality = FixQuality::rtk_float;
  rig.stand(1);
  rig.world.quality = FixQuality::rtk_fixed;
  rig.stand(0.3);
  EXPECT_GT(rig.last.predicted_error_m, 0.2);
  rig.stand(10);
  EXPECT_LT(rig.last.predicted_error_m, 0.06);
  EXPECT_EQ(rig.share_bound(), 1);
}

TEST_F(MountedAskew, ADriftFromTheFirstMetresOnIsNoMounting) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rig rig(seed);
    settle(rig);
    drive(rig, 6);
    rig.world.drift_mps = 0.02;
    rig.forget();
    drive(rig, 60);
    EXPECT_NE(std::string(rig.last.reason.view()).find("drifts away"), std::string::npos) << seed;
    EXPECT_LT(rig.position_error_m(), 0.45) << seed;
    EXPECT_EQ(rig.share_bound(), 1) << seed;
  }
}

TEST_F(MountedAskew, IsForgottenWithAnotherReceiver) {
  Rig rig(4);
  rig.world.heading_off_deg = 3;
  settle(rig);
  drive(rig, 50);
  turn_round(rig);
  drive(rig, 50);
  ASSERT_TRUE(rig.last.mounting_known);
  rig.estimator.accept_position();
  rig.stand(1);
  EXPECT_TRUE(rig.last.mounting_known);
  Measurement other = Rig::heading_at(rig.yaw_rad, rig.now);
  other.source = 1;
  rig.estimator.on_measurement(other);
  rig.world.heading = false;
  rig.stand(0.3);
  EXPECT_FALSE(rig.last.mounting_known);
}

}  // namespace
}  // namespace drover::engine::estimate
