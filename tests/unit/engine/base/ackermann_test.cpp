// What the engine asks of a base that steers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/kinematics.h"

namespace drover::engine {
namespace {

BaseConfig steered() {
  BaseConfig config;
  config.kind = BaseKind::ackermann;
  config.track_m = 0.6;
  config.wheelbase_m = 0.65;
  config.max_steering_rad = 0.5;
  config.steering_rate_radps = 0.4;
  return config;
}

class ABaseThatSteers : public ::testing::Test {
 protected:
  Twist driven(const Twist& twist, double gain = 1) const {
    return twist_of_edges(base, setpoints(base, twist, {gain}, 10));
  }
  Kinematics base = kinematics_of(steered());
  BodyLimits body = limits(base);
};

TEST_F(ABaseThatSteers, TakesATwistAndHasNoJoints) {
  EXPECT_TRUE(takes_twist(base));
  EXPECT_EQ(joints_needed(steered()), 0U);
  EXPECT_FALSE(body.pivots);
}

TEST_F(ABaseThatSteers, HasASmallestRadiusByItsInnerWheel) {
  EXPECT_NEAR(body.smallest_radius_m, 0.3 + 0.65 / std::tan(0.5), 1e-9);
  BaseConfig other;
  EXPECT_TRUE(limits(kinematics_of(other)).pivots);
  EXPECT_EQ(limits(kinematics_of(other)).smallest_radius_m, 0);
}

/// Of the wheel that is steered furthest and fastest, whose own curve is narrower by half the
/// track.
double inner_rad(const BaseConfig& base, double curvature_radpm) {
  return std::atan(base.wheelbase_m * curvature_radpm / (1 - base.track_m / 2 * curvature_radpm));
}

TEST_F(ABaseThatSteers, ChangesItsCurveNoFasterThanItsInnerWheelIsSteered) {
  for (const double track_m : {0.1, 0.6, 1.2}) {
    BaseConfig config = steered();
    config.track_m = track_m;
    const BodyLimits of_it = limits(kinematics_of(config));
    constexpr double kStep_s = 1e-4;
    double fastest_radps = 0;
    for (double radpm = 0; radpm < of_it.most_radpm(); radpm += 1e-3) {
      const double next_radpm = radpm + kStep_s * of_it.curvature_rate_radpms;
      const double turned_rad = inner_rad(config, next_radpm) - inner_rad(config, radpm);
      fastest_radps = std::max(fastest_radps, turned_rad / kStep_s);
    }
    EXPECT_LE(fastest_radps, config.steering_rate_radps * (1 + 1e-6)) << track_m;
    EXPECT_GT(fastest_radps, config.steering_rate_radps * 0.9) << "slower than it could";
  }
}

TEST_F(ABaseThatSteers, IsAskedForNoTighterCurveWhateverTheGateLetPass) {
  const Twist twist = driven({0.4, 2.0});
  EXPECT_NEAR(twist.vx_mps, 0.4, 1e-9);
  EXPECT_NEAR(twist.wz_radps, 0.4 / body.smallest_radius_m, 1e-9);
  EXPECT_NEAR(driven({-0.4, 2.0}).wz_radps, 0.4 / body.smallest_radius_m, 1e-9);
  EXPECT_NEAR(driven({0.4, -0.1}).wz_radps, -0.1, 1e-9);
  const Twist learned = driven({0.4, 2.0}, 1.1);
  EXPECT_NEAR(learned.wz_radps, 0.4 / body.smallest_radius_m, 1e-9);
}

TEST_F(ABaseThatSteers, IsNeverAskedToTurnOnTheSpot) {
  EXPECT_TRUE(is_zero(driven({0, 0.5})));
  EXPECT_TRUE(is_zero(driven({0, NAN})));
}

TEST_F(ABaseThatSteers, TellsItsMotionAsItIs) {
  const JointVelocities mps = edges_of(base, {0.1, 0.5});  // somebody pushed it round
  ASSERT_EQ(mps.size(), 2U);
  EXPECT_NEAR(twist_of_edges(base, mps).wz_radps, 0.5, 1e-12);
}

TEST(Steering, IsTheCurveOfTheMiddleWheel) {
  EXPECT_NEAR(steering_rad(0.65, 0.5), std::atan(0.325), 1e-12);
  for (const double angle_rad : {-0.5, -0.01, 0.0, 0.2})
    EXPECT_NEAR(steering_rad(0.65, curvature_radpm(0.65, angle_rad)), angle_rad, 1e-12);
}

}  // namespace
}  // namespace drover::engine
