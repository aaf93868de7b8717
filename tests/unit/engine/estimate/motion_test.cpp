// How well the estimate follows a moving base: accuracy, latency, lever arm, slip, outages.
#include <gtest/gtest.h>

#include "unit/engine/estimate/rig.h"

namespace drover::engine::estimate {
namespace {

// The receiver's error is 1 cm on each axis: 1.4 cm in the plane, the limit of what can be reached.
constexpr double kFixRms_m = 0.018;

TEST(EstimateMotion, FollowsAStraightWithAFix) {
  Rig rig;
  rig.stand(2);
  rig.forget();
  rig.drive(0.5, 0.5, 60);
  RecordProperty("rms_mm", static_cast<int>(rig.rms_m() * 1000));
  EXPECT_LT(rig.rms_m(), kFixRms_m);
  EXPECT_LT(to_deg(rig.rms_yaw_rad()), 0.4);
  EXPECT_NEAR(rig.last.pose.vx_mps, 0.5, 0.01);
}

TEST(EstimateMotion, FollowsACircleWithAFix) {
  Rig rig;
  rig.stand(2);
  rig.forget();
  rig.circle(0.8, 2, 60);
  EXPECT_LT(rig.rms_m(), kFixRms_m);
  EXPECT_LT(to_deg(rig.rms_yaw_rad()), 0.8);
  EXPECT_NEAR(rig.last.pose.wz_radps, 0.4, 0.02);
}

TEST(EstimateMotion, LearnsTheSlipOfATurnOnTheSpot) {
  Rig rig;
  rig.world.slip = 1.6;
  rig.stand(2);
  rig.forget();
  rig.drive(-0.3, 0.3, 20);
  EXPECT_NEAR(rig.last.yaw_slip_factor, 1.6, 0.08);
  EXPECT_LT(to_deg(rig.rms_yaw_rad()), 1.5);
  EXPECT_EQ(rig.estimator.counters().refused, 0U);
}

TEST(EstimateMotion, LearnsTheWheelSizeOnTheWay) {
  Rig rig;
  rig.world.scale = 0.97;
  rig.stand(2);
  rig.drive(0.5, 0.5, 120);
  EXPECT_NEAR(rig.last.pose.vx_mps, 0.5 * 0.97, 0.004);
}

TEST(EstimateMotion, StaysWhereItStands) {
  Rig rig;
  rig.drive(0.5, 0.5, 10);
  rig.stand(5);
  const double yaw_rad = rig.last.pose.yaw_rad;
  rig.stand(300);
  EXPECT_LT(to_deg(std::abs(wrap_rad(rig.last.pose.yaw_rad - yaw_rad))), 0.3);
  EXPECT_LT(rig.yaw_error_rad(), rig.last.yaw_error_rad);
  EXPECT_LT(rig.position_error_m(), 0.03);
  // 3000 positions with one wandering error are not 3000 measurements.
  EXPECT_GE(rig.last.predicted_error_m, 0.015);
  EXPECT_GE(to_deg(rig.last.yaw_error_rad), 0.19);
}

TEST(EstimateMotion, TurnsThePositionByTheLeverArm) {
  EngineConfig config = rig_config();
  config.estimate.antenna_x_m = 0.5;
  config.estimate.antenna_y_m = 0.1;
  Rig rig(3, config);
  rig.stand(2);
  rig.forget();
  rig.circle(0.8, 2, 40);
  rig.drive(-0.3, 0.3, 20);
  EXPECT_LT(rig.rms_m(), 0.025);
  config.estimate.antenna_x_m = 0.0;  // the same antenna, taken for the middle
  Estimator wrong(config.estimate, config.base);
  wrong.set_origin(kField);
  wrong.on_measurement(rig.position_at(0.5, 0, FixQuality::rtk_fixed, rig.now));
  wrong.on_measurement(Rig::heading_at(0, rig.now));
  EXPECT_NEAR(wrong.step(rig.now).pose.x_m, 0.5, 1e-6);
}

struct Latency {
  double error_m = 0;
};
Latency circle_with_stamp_error(double stamp_error_s, double late_sigma_s = 0) {
  EngineConfig config = rig_config();
  config.estimate.gnss_late_sigma_s = late_sigma_s;
  Rig rig(1, config);
  rig.world.noise = rig.world.disturbance = 0;
  rig.world.stamp_error_s = stamp_error_s;
  rig.stand(2);
  rig.circle(0.8, 2, 20);
  rig.forget();
  rig.circle(0.8, 2, 20);
  return {.error_m = rig.rms_m()};
}

TEST(EstimateMotion, AppliesALatePositionAtItsOwnTime) {
  EXPECT_LT(circle_with_stamp_error(0).error_m, 0.02);
}

TEST(EstimateMotion, WouldBeWrongIfTheLatencyWereForgotten) {
  EXPECT_GT(circle_with_stamp_error(0.08).error_m, 0.05);
}

TEST(EstimateMotion, LearnsALatencyThatNobodyTold) {
  EXPECT_LT(circle_with_stamp_error(0.08, 0.1).error_m, 0.035);
}

TEST(EstimateMotion, HonestlyLosesItselfInAnOutage) {
  double worst_m = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rig rig(seed);
    rig.stand(5);
    rig.circle(0.5, 5, 60);
    rig.world.position = rig.world.heading = false;
    rig.forget();
    rig.circle(0.5, 5, 20);  // 10 m
    worst_m = std::max(worst_m, rig.max_m());
    EXPECT_GT(rig.share_inside(), 0.95) << seed;
    EXPECT_GT(rig.last.predicted_error_m, 0.2);
    EXPECT_LT(rig.last.predicted_error_m, 1.5);
    EXPECT_TRUE(rig.last.has_position);
    rig.world.position = rig.world.heading = true;
    rig.circle(0.5, 5, 2);
    EXPECT_LT(rig.position_error_m(), 0.05) << seed;
    EXPECT_FALSE(rig.last.disagrees);
  }
  EXPECT_LT(worst_m, 1.0);
}

TEST(EstimateMotion, RidesThroughAFloatOnTheWheels) {
  for (const double fade_s : {0.0, 0.5, 1.0}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Rig rig(seed);
      rig.world.fade_s = fade_s;
      rig.stand(5);
      rig.circle(0.5, 3, 20);
      rig.forget();
      rig.world.quality = FixQuality::rtk_float;
      rig.circle(0.5, 3, 30);
      EXPECT_LT(rig.max_m(), 0.3);  // not the receiver's 30 cm on each axis
      EXPECT_GT(rig.share_inside(), 0.9);
      rig.world.quality = FixQuality::rtk_fixed;
      rig.circle(0.5, 3, 5);
      EXPECT_LT(rig.position_error_m(), 0.05) << fade_s << ' ' << seed;
      EXPECT_LT(rig.last.predicted_error_m, 0.06);
      EXPECT_EQ(rig.estimator.counters().refused, 0U);
    }
  }
}

TEST(EstimateMotion, TakesAFixWithOldCorrectionsForAFloat) {
  EngineConfig config = rig_config();
  config.estimate.max_correction_age_s = 0.5;  // the rig's are 1 s old
  Rig rig(1, config);
  rig.stand(5);
  EXPECT_GT(rig.last.predicted_error_m, 0.3);
}

TEST(EstimateMotion, StartsFromAnyQuality) {
  Rig rig;
  rig.world.quality = FixQuality::single;
  rig.stand(1);
  EXPECT_TRUE(rig.last.has_position);
  EXPECT_GT(rig.last.predicted_error_m, 2.0);
  EXPECT_LT(rig.position_error_m(), rig.last.predicted_error_m * 1.5);
}

}  // namespace
}  // namespace drover::engine::estimate
