// The closed filter: prediction and correction alone.
#include "engine/estimate/filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "drover/angle.h"

namespace drover::engine::estimate {
namespace {

Belief start() {
  Belief belief;
  belief.reset(kYaw, 0.4, 0.01);
  belief.reset(kGain, 0.8, 0.1);
  belief.reset(kScale, 1.0, 0.02);
  belief.reset(kX, 1, 0.05);
  belief.reset(kY, 2, 0.05);
  return belief;
}

BodyMotion moving_by(double vx_mps, double wz_radps) {
  return {.twist = {vx_mps, wz_radps}, .known = true};
}

TEST(Filter, NoticesThatItLostItsNumbers) {
  Belief belief = start();
  EXPECT_TRUE(belief.finite());
  belief.covariance[kX][kY] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(belief.finite());
  belief = start();
  belief.covariance[kBiasX][kBiasX] = -1e-9;
  EXPECT_FALSE(belief.finite());
}

TEST(Filter, DoesNotPredictBackwards) {
  Belief belief = start();
  predict(belief, moving_by(1, 0), -0.01, true, 0, 0, {});
  EXPECT_EQ(belief.mean[kX], 1);
}

TEST(Filter, GoesToTheLeftAndIsLessSureOfIt) {
  Belief belief = start();
  const BodyMotion aside{.twist = {0, 0, 0.5}, .vy_var = 0.0025, .known = true};
  for (int i = 0; i < 200; ++i) predict(belief, aside, 0.01, true, 0, 0, {});
  EXPECT_NEAR(belief.mean[kX], 1 - std::sin(0.4), 1e-9);
  EXPECT_NEAR(belief.mean[kY], 2 + std::cos(0.4), 1e-9);
  Belief ahead = start();
  for (int i = 0; i < 200; ++i) predict(ahead, moving_by(0.5, 0), 0.01, true, 0, 0, {});
  EXPECT_GT(two_sigma_position_m(belief), 1.2 * two_sigma_position_m(ahead));
  EXPECT_TRUE(belief.finite());
}

TEST(Filter, DrivesAnArcOfTheRightLength) {
  Belief belief = start();
  for (int i = 0; i < 1000; ++i) predict(belief, moving_by(0.5, 0.2 / 0.6), 0.01, true, 0, 0, {});
  const double turn = 0.8 * 0.2 / 0.6 * 10;
  const double radius = 5.0 / turn;
  EXPECT_NEAR(belief.mean[kYaw], wrap_rad(0.4 + turn), 1e-9);
  EXPECT_NEAR(belief.mean[kX], 1 + radius * (std::sin(0.4 + turn) - std::sin(0.4)), 1e-4);
  EXPECT_NEAR(belief.mean[kY], 2 - radius * (std::cos(0.4 + turn) - std::cos(0.4)), 1e-4);
}

TEST(Filter, CarriesUncertaintyAsTheNumbersWouldMove) {
  // Without noise the covariance must follow the derivative of the motion: compare with a shift.
  EstimateConfig quiet;
  quiet.odometry_along_m = quiet.odometry_across_m = quiet.odometry_yaw_rad = 0;
  quiet.turning_shift_m = quiet.turning_yaw_rad = quiet.yaw_slip_walk = quiet.wheel_scale_walk = 0;
  for (const std::size_t i : {std::size_t{kYaw}, std::size_t{kGain}, std::size_t{kScale}}) {
    constexpr double kShift = 1e-6;
    Belief belief;
    belief.mean = start().mean;
    belief.covariance[i][i] = 1;
    Belief shifted = belief;
    shifted.mean[i] += kShift;
    for (int n = 0; n < 100; ++n) {
      predict(belief, moving_by(0.45, 0.5), 0.01, true, 0, 0, quiet);
      predict(shifted, moving_by(0.45, 0.5), 0.01, true, 0, 0, quiet);
    }
    for (const std::size_t k : {std::size_t{kX}, std::size_t{kY}, std::size_t{kYaw}}) {
      const double moved = (shifted.mean[k] - belief.mean[k]) / kShift;
      EXPECT_NEAR(belief.covariance[i][k], moved, 2e-4) << i << ' ' << k;
    }
  }
}

TEST(Filter, GrowsWithTheWayAndNotWithTheTimeItStands) {
  Belief standing = start();
  Belief moving = start();
  BodyMotion rest = moving_by(0, 0);
  rest.standing = true;
  for (int i = 0; i < 6000; ++i) {
    predict(standing, rest, 0.01, true, 0, 0, {});
    predict(moving, moving_by(0.5, 0), 0.01, true, 0, 0, {});
  }
  EXPECT_LT(two_sigma_position_m(standing), 0.105);
  EXPECT_GT(two_sigma_position_m(moving), 0.5);
}

TEST(Filter, CorrectsByTheUsualGain) {
  Belief belief = start();
  Vector row{};
  row[kX] = 1;
  belief.correct(row, 0.1, 0.05 * 0.05);
  EXPECT_NEAR(belief.mean[kX], 1.05, 1e-12);
  EXPECT_NEAR(belief.covariance[kX][kX], 0.05 * 0.05 / 2, 1e-12);
  EXPECT_EQ(belief.mean[kY], 2);
}

TEST(Filter, WidensByWheelsThatContradictEachOther) {
  Belief agree = start();
  Belief differ = start();
  BodyMotion motion = moving_by(0.5, 0);
  predict(agree, motion, 0.02, true, 0, 0, {});
  motion.vx_var = 0.3 * 0.3;
  predict(differ, motion, 0.02, true, 0, 0, {});
  EXPECT_GT(differ.covariance[kX][kX], agree.covariance[kX][kX] + 1e-3);
}

TEST(Filter, GivesTheLargerAxis) {
  Belief belief;
  belief.covariance[kX][kX] = belief.covariance[kY][kY] = 1;
  belief.covariance[kX][kY] = belief.covariance[kY][kX] = 0.5;
  EXPECT_NEAR(two_sigma_position_m(belief), 2 * std::sqrt(1.5), 1e-12);
}

}  // namespace
}  // namespace drover::engine::estimate
