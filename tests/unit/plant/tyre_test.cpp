// The tyre's grip: a spring at rest, limited and equal in all directions when it slides.
#include "sim/plant/tyre.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace drover::sim {
namespace {

constexpr double kDt_s = 0.0025;

Tyre::Force settle(Tyre& tyre, double ahead_mps, double left_mps, double roll_mps, double load_N) {
  Tyre::Force force;
  for (int i = 0; i < 4000; ++i) force = tyre.step(ahead_mps, left_mps, roll_mps, load_N, kDt_s);
  return force;
}

TEST(Tyre, HasNoGripWithoutLoad) {
  Tyre tyre;
  const auto force = tyre.step(1, 1, 1, 0, kDt_s);
  EXPECT_EQ(force.ahead_N, 0);
  EXPECT_EQ(force.left_N, 0);
}

TEST(Roller, GripsAlongItsAxisAndRollsAwayAcross) {
  const double axis_rad = -std::numbers::pi / 4;
  Tyre gripping;
  Tyre rolling;
  Tyre::Force along;
  Tyre::Force across;
  for (int i = 0; i < 4000; ++i) {
    along = gripping.step_roller(axis_rad, 0.2, -0.2, 0, 100, kDt_s);
    across = rolling.step_roller(axis_rad, 0.2, 0.2, 0, 100, kDt_s);
  }
  EXPECT_NEAR(along.ahead_N, -80 * std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(along.left_N, 80 * std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(across.ahead_N, -3 * std::sqrt(0.5), 1e-6) << "its drag, against the motion";
  EXPECT_NEAR(across.left_N, -3 * std::sqrt(0.5), 1e-6);
  const auto lifted = rolling.step_roller(axis_rad, 0.2, 0.2, 0, 0, kDt_s);
  EXPECT_EQ(lifted.ahead_N, 0);
  EXPECT_EQ(lifted.left_N, 0);
}

TEST(Tyre, NeverExceedsTheFrictionCircle) {
  Tyre tyre;
  for (int i = 0; i < 1000; ++i) {
    const double phase = 0.1 * i;
    const auto force = tyre.step(2 * std::cos(phase), 3 * std::sin(1.7 * phase), 1, 150, kDt_s);
    EXPECT_LE(std::hypot(force.ahead_N, force.left_N), 0.8 * 150 * (1 + 1e-12));
  }
}

TEST(Tyre, SlidesAgainstTheDirectionOfTheSlip) {
  Tyre tyre;
  const auto force = settle(tyre, 0.3, -0.4, 0, 100);
  EXPECT_NEAR(force.ahead_N, -0.8 * 100 * 0.6, 1e-6);
  EXPECT_NEAR(force.left_N, 0.8 * 100 * 0.8, 1e-6);
}

TEST(Tyre, HoldsASmallBendWhileItStands) {
  Tyre tyre;
  for (int i = 0; i < 4; ++i) tyre.step(0.1, 0, 0, 150, kDt_s);  // a millimetre
  const auto force = settle(tyre, 0, 0, 0, 150);
  EXPECT_NEAR(force.ahead_N, -30, 1e-9);
}

TEST(Tyre, LetsABendFadeWhileItRolls) {
  Tyre tyre;
  for (int i = 0; i < 4; ++i) tyre.step(0.1, 0, 0, 150, kDt_s);
  const auto force = settle(tyre, 0, 0, 0.5, 150);
  EXPECT_NEAR(force.ahead_N, 0, 1e-6);
}

TEST(Tyre, PullsInProportionToASmallSlipWhileItRolls) {
  Tyre one;
  Tyre two;
  const double weak_N = settle(one, 0.005, 0, 1, 150).ahead_N;
  const double strong_N = settle(two, 0.010, 0, 1, 150).ahead_N;
  EXPECT_LT(strong_N, weak_N);
  EXPECT_NEAR(strong_N / weak_N, 2, 1e-6);
}

}  // namespace
}  // namespace drover::sim
