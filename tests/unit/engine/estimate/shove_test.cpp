// A base that is pushed aside, by an inertial sensor alone.
#include "engine/estimate/shove.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drover/angle.h"

namespace drover::engine::estimate {
namespace {

constexpr double kStep_s = 0.01;

class AShove : public testing::TestWithParam<double> {
 protected:
  AShove() { belief.mean[kYaw] = kPi / 2; }  // facing north: left is west
  void feel(double left_mps2, double for_s, bool may_begin = true) {
    for (double s = 0; s < for_s - kStep_s / 2; s += kStep_s) {
      now += from_s(kStep_s);
      follow(shove, belief, left_mps2, kStep_s, may_begin, now);
    }
  }
  /// Half a cosine of speed, in `for_s`.
  void push(double left_m, double for_s, bool may_begin = true) {
    const double peak_mps = left_m * kPi / 2 / for_s;
    for (double s = 0; s < for_s - kStep_s / 2; s += kStep_s)
      feel(peak_mps * kPi / for_s * std::cos(kPi * (s + kStep_s / 2) / for_s), kStep_s, may_begin);
  }
  double left_m() const { return -belief.mean[kX]; }
  double sigma_m() const { return std::sqrt(belief.covariance[kX][kX]); }

  Belief belief;
  Shove shove;
  Time now{std::chrono::seconds(100)};
};

TEST_P(AShove, MovesTheBelief) {
  feel(0.02, 5);
  push(GetParam(), 0.4);
  feel(0.02, 1);
  EXPECT_FALSE(shove.holds());
  EXPECT_NE(shove.ended, kNever);
  EXPECT_NEAR(left_m(), GetParam(), 0.15 * std::abs(GetParam()) + 0.01);
  EXPECT_NEAR(belief.mean[kY], 0, 1e-9);
  EXPECT_LE(std::abs(left_m() - GetParam()), 2 * sigma_m());
}

INSTANTIATE_TEST_SUITE_P(OfSomeCentimetres, AShove, testing::Values(0.14, -0.14, 0.25, -0.25, 0.4));

/// It turns back to its line at once: what it feels of that undid the shove.
TEST_F(AShove, IsOverWhenTheBaseRestsSidewaysWhateverItDoesThen) {
  push(0.14, 0.55);
  feel(-0.4, 0.8);
  feel(0, 1);
  EXPECT_NEAR(left_m(), 0.14, 0.05) << "its slow begin is not felt";
  EXPECT_LE(std::abs(left_m() - 0.14), 2 * sigma_m());
}

TEST_F(AShove, IsNoneThatLastsBecauseTheSensorTilts) {
  // 5 degrees of roll, reached within a second, that nobody tells.
  for (int i = 0; i < 100; ++i) feel(0.85 * i / 100, kStep_s);
  feel(0.85, 6);
  EXPECT_NEAR(left_m(), 0, 0.005);
}

TEST_F(AShove, IsNoneOnGroundThatShakes) {
  for (int i = 0; i < 1000; ++i) feel(3 * std::sin(2 * kPi * 8 * i * kStep_s), kStep_s);
  EXPECT_NEAR(left_m(), 0, 0.01);
}

TEST_F(AShove, DoesNotBeginWhileTheBaseStandsOrRocks) {
  push(0.25, 0.4, false);
  feel(0, 1, false);
  EXPECT_EQ(left_m(), 0);
  EXPECT_EQ(shove.ended, kNever);
}

TEST_F(AShove, AddsUpToTheSameWithTheNextOne) {
  push(0.2, 0.4);
  feel(0, 3);
  push(-0.2, 0.4);
  feel(0, 1);
  EXPECT_NEAR(left_m(), 0, 0.05);
  EXPECT_NEAR(shove.left_m, -0.2, 0.04);
}

}  // namespace
}  // namespace drover::engine::estimate
