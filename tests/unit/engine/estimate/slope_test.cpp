// Driving on ground that is even and not level: what the base turns about its own z, the map sees
// from above.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "rig.h"

namespace drover::engine::estimate {
namespace {

EngineConfig on_the_ground() {
  EngineConfig config = rig_config();
  config.estimate.antenna_z_m = 0;
  return config;
}

TEST(EstimateOnASlope, ACircleTeachesTheWheelsNothingFalse) {
  Rig rig(31, on_the_ground());
  rig.world.imu = true;
  rig.world.disturbance = 0.2;
  rig.world.slope_rad = to_rad(20);
  rig.stand(5);
  rig.circle(0.5, 2, 30);
  double worst = 0;
  for (int i = 0; i < 120; ++i) {
    rig.circle(0.5, 2, 0.5);
    worst = std::max(worst, std::abs(rig.last.yaw_slip_factor - 1));
    EXPECT_FALSE(rig.last.slipping) << rig.last.notice.view();
  }
  std::printf("  the yaw slip factor is off by %.3f at most\n", worst);
  EXPECT_LT(worst, 0.02);
}

TEST(EstimateOnASlope, ACircleIsDrivenToTheEndWithoutReceiver) {
  Rig rig(32, on_the_ground());
  rig.world.imu = true;
  rig.world.disturbance = 0.2;
  rig.world.slope_rad = to_rad(20);
  rig.stand(5);
  rig.circle(0.5, 2, 30);
  rig.world.position = rig.world.heading = false;
  rig.circle(0.5, 2, 25);
  EXPECT_LT(to_deg(rig.yaw_error_rad()), 3);
  EXPECT_LT(rig.position_error_m(), 0.3);
}

/// A gateway that hung reads what the bus and the receiver said meanwhile with its times, but not
/// the inertial sensor: how the base is tilted is not known for so long.
class EstimateHangsOnASlope : public testing::TestWithParam<double> {
 protected:
  static EngineConfig with_mast() {
    EngineConfig config = rig_config();
    config.estimate.antenna_z_m = GetParam();
    return config;
  }
  /// Ten metres up a ramp, with all that there is to hear.
  static void climb(Rig& rig) {
    rig.yaw_rad = 0;
    rig.world.imu = true;
    rig.world.slope_rad = std::atan(0.15);
    rig.stand(5);
    rig.drive(0.5, 0.5, 20);
  }
};

TEST_P(EstimateHangsOnASlope, AndDisputesNothing) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rig rig(seed, with_mast());
    climb(rig);
    rig.world.imu = false;
    rig.drive(0.5, 0.5, 0.2 + 0.03 * static_cast<double>(seed));
    rig.world.imu = true;
    rig.drive(0.2, 0.2, 0.3);
    rig.forget();
    for (int i = 0; i < 50; ++i) {
      rig.stand(0.1);
      EXPECT_FALSE(rig.last.disagrees) << "seed " << seed << ": " << rig.last.reason.view();
    }
    EXPECT_LT(rig.max_m(), 0.05) << "seed " << seed;
    EXPECT_EQ(rig.share_bound(), 1) << "seed " << seed;
  }
}

/// The ramp begins while nobody hears the sensor.
TEST_P(EstimateHangsOnASlope, ThatBeginsMeanwhileAndDisputesNothing) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rig rig(seed, with_mast());
    rig.yaw_rad = 0;
    rig.world.imu = true;
    rig.stand(5);
    rig.drive(0.5, 0.5, 10);
    rig.forget();
    rig.world.imu = false;
    rig.drive(0.5, 0.5, 0.15);
    for (int i = 1; i <= 10; ++i) {
      rig.world.slope_rad = std::atan(0.15) * i / 10;
      rig.drive(0.5, 0.5, 0.1);
    }
    rig.world.imu = true;
    rig.drive(0.5, 0.5, 1);
    for (int i = 0; i < 50; ++i) {
      rig.drive(0.5, 0.5, 0.1);
      EXPECT_FALSE(rig.last.disagrees) << "seed " << seed << ": " << rig.last.reason.view();
    }
    EXPECT_EQ(rig.share_bound(), 1) << "seed " << seed;
  }
}

/// The sensor is gone for good, and the ground becomes level again.
TEST_P(EstimateHangsOnASlope, AndCarriesWhatItDoesNotKnowInItsBound) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rig rig(seed, with_mast());
    climb(rig);
    rig.world.imu = false;
    rig.forget();
    rig.drive(0.5, 0.5, 20);
    for (int i = 9; i >= 0; --i) {
      rig.world.slope_rad = std::atan(0.15) * i / 10;
      rig.drive(0.5, 0.5, 0.1);
    }
    rig.drive(0.5, 0.5, 20);
    EXPECT_EQ(rig.share_bound(), 1) << "seed " << seed;
    EXPECT_GT(rig.share_inside(), 0.95) << "seed " << seed;
    EXPECT_FALSE(rig.last.disagrees) << "seed " << seed << ": " << rig.last.reason.view();
  }
}

/// What the mast explains hides no other integer solution.
TEST_P(EstimateHangsOnASlope, AndStillSeesAPlaceThatJumpsMeanwhile) {
  for (const double jump_m : {-0.5, -0.1, 0.1, 0.5}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Rig rig(seed, with_mast());
      climb(rig);
      rig.world.imu = false;
      rig.drive(0.5, 0.5, 0.5);
      rig.world.imu = true;
      rig.world.jump_x_m = jump_m;
      rig.drive(0.5, 0.5, 1.5);
      EXPECT_TRUE(rig.last.disputed) << jump_m << " m, seed " << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(MastsOf, EstimateHangsOnASlope, testing::Values(0.6, 1.5));

}  // namespace
}  // namespace drover::engine::estimate
