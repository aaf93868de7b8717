// The gate of a base that steers: a speed and a curve.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/gate/target_gate.h"

namespace drover::engine {
namespace {

class ASteeredGate : public ::testing::Test {
 protected:
  static constexpr Duration kTick = std::chrono::milliseconds(5);
  static constexpr double kTick_s = 0.005;

  const Twist& drive(double vx_mps, double wz_radps, Stop stop = Stop::none) {
    now += kTick;
    const Offer one{Owner::task, {vx_mps, wz_radps}, now};
    return gate.step(now, kTick, {&one, 1}, stop);
  }
  static double radpm(const Twist& twist) { return twist.wz_radps / twist.vx_mps; }

  BodyLimits body{.pivots = false, .smallest_radius_m = 1.5, .curvature_rate_radpms = 0.6};
  LimitsConfig limits;
  TargetGate gate{limits, std::chrono::milliseconds(100), body};
  Time now{std::chrono::seconds(100)};
};

TEST_F(ASteeredGate, LetsNoTurnOnTheSpotPass) {
  for (int i = 0; i < 400; ++i) drive(0, 0.5);
  EXPECT_TRUE(gate.at_rest());
}

TEST_F(ASteeredGate, ClampsTheCurve) {
  for (int i = 0; i < 2000; ++i) drive(0.4, 0.8);
  EXPECT_NEAR(gate.twist().vx_mps, 0.4, 1e-9);
  EXPECT_NEAR(radpm(gate.twist()), 1 / 1.5, 1e-9);
}

TEST_F(ASteeredGate, KeepsAnyCurveAndItsRateWhateverIsAsked) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-2, 2);
  double before_radpm = NAN;
  Twist asked;
  for (int i = 0; i < 20000; ++i) {
    if (random() % 50 == 0) asked = {any(random), any(random)};
    const Twist twist = drive(asked.vx_mps, asked.wz_radps);
    ASSERT_LE(std::abs(twist.wz_radps), std::abs(twist.vx_mps) / 1.5 * (1 + 1e-9));
    ASSERT_LE(std::abs(twist.wz_radps), limits.max_yaw_rate_radps * (1 + 1e-9));
    const double now_radpm = std::abs(twist.vx_mps) < 1e-6 ? NAN : radpm(twist);
    if (std::isfinite(now_radpm - before_radpm)) {
      ASSERT_LE(std::abs(now_radpm - before_radpm), 0.6 * kTick_s * 1.001 + 1e-9);
    }
    before_radpm = now_radpm;
  }
}

TEST_F(ASteeredGate, GoesSlowlyUntilTheWheelsAreThere) {
  gate.find_wheels(-1 / 1.5);
  double turned_beside_rad = 0;
  double fastest_far_mps = 0;
  double x_m = 0;
  for (int i = 0; i < 3000; ++i) {
    const Twist twist = drive(0.8, 0);
    if (std::abs(twist.vx_mps) > 0 && radpm(twist) < -0.5)
      fastest_far_mps = std::max(fastest_far_mps, twist.vx_mps);
    turned_beside_rad += twist.wz_radps * kTick_s;
    x_m += twist.vx_mps * kTick_s;
  }
  EXPECT_LT(fastest_far_mps, 0.25);
  EXPECT_LT(std::abs(turned_beside_rad), 0.15);
  EXPECT_NEAR(gate.twist().vx_mps, 0.8, 1e-9);
  EXPECT_NEAR(gate.twist().wz_radps, 0, 1e-9);
}

TEST_F(ASteeredGate, StopsAlongItsCurveAndKeepsTheAngleAtRest) {
  for (int i = 0; i < 2000; ++i) drive(0.6, 0.3);
  const double radpm_before = radpm(gate.twist());
  EXPECT_NEAR(radpm_before, 0.5, 1e-9);
  while (!gate.at_rest()) {
    const Twist twist = drive(0, 0, Stop::controlled);
    if (twist.vx_mps > 0) {
      ASSERT_NEAR(radpm(twist), radpm_before, 1e-9);
    }
  }
  // It goes on from there.
  const Twist first = drive(0.6, 0);
  EXPECT_NEAR(radpm(first), radpm_before, 0.6 * kTick_s + 1e-9);
}

TEST_F(ASteeredGate, StopsAtOnce) {
  for (int i = 0; i < 2000; ++i) drive(0.6, 0.3);
  EXPECT_TRUE(is_zero(drive(0.6, 0.3, Stop::immediate)));
}

TEST_F(ASteeredGate, TakesNoAngleThatIsNoNumber) {
  gate.find_wheels(NAN);
  gate.find_wheels(50);
  const Twist twist = drive(0.5, 0);
  EXPECT_LE(std::abs(twist.wz_radps), std::abs(twist.vx_mps) / 1.5 * (1 + 1e-9));
}

TEST_F(ASteeredGate, DrivesBackOnTheSameCurve) {
  for (int i = 0; i < 3000; ++i) drive(-0.3, 0.15);
  EXPECT_NEAR(gate.twist().vx_mps, -0.3, 1e-9);
  EXPECT_NEAR(gate.twist().wz_radps, 0.15, 1e-9);
}

}  // namespace
}  // namespace drover::engine
