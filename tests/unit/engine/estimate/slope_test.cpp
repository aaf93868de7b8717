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

constexpr double kSteepest_deg = 15;
constexpr double kBase_m = 0.5;  ///< between its axles: so long it takes to be on a ramp

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
  /// Five metres over level ground, likewise.
  static void come_along(Rig& rig) {
    rig.yaw_rad = 0;
    rig.world.imu = true;
    rig.stand(5);
    rig.drive(0.5, 0.5, 10);
    rig.forget();
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
    come_along(rig);
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

/// Who comes to rest within a moment of that stands as steep as the ground became meanwhile: a step
/// onto a ramp, or down from it.
TEST_P(EstimateHangsOnASlope, ThatBeginsMeanwhileAndStandsOnItInsideItsBound) {
  for (const double speed_mps : {0.25, 0.5, 1.0}) {
    for (const double way_m : {0.3, 0.5, 1.0}) {
      for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        Rig rig(seed, with_mast());
        come_along(rig);
        rig.world.imu = false;
        for (int i = 1; i <= 20; ++i) {
          rig.world.slope_rad = to_rad(kSteepest_deg) * std::min(1.0, way_m * i / 20 / kBase_m);
          rig.drive(speed_mps, speed_mps, way_m / 20 / speed_mps);
        }
        rig.stand(20);
        EXPECT_EQ(rig.share_bound(), 1)
            << speed_mps << " m/s, " << way_m << " m, seed " << seed << ": " << rig.max_m()
            << " m at most, told " << rig.last.error_bound_m << " m";
      }
    }
  }
}

/// It stays on the same ground and turns on it: what fell to its left falls before it then.
TEST_P(EstimateHangsOnASlope, AndTurnsOnItInsideItsBound) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const double turn_deg : {-90.0, 90.0, 180.0}) {
      Rig rig(seed, with_mast());
      climb(rig);
      rig.world.imu = false;
      rig.forget();
      rig.stand(1);
      const double turns_s = to_rad(std::abs(turn_deg)) / 0.5;
      const double rim_mps = std::copysign(0.25 * rig_config().base.track_m, turn_deg);
      rig.drive(-rim_mps, rim_mps, turns_s);
      rig.stand(10);
      EXPECT_EQ(rig.share_bound(), 1)
          << turn_deg << " degrees, seed " << seed << ": " << rig.max_m() << " m at most";
      EXPECT_LT(rig.max_m(), 0.1) << turn_deg << " degrees, seed " << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(MastsOf, EstimateHangsOnASlope, testing::Values(0.6, 1.5));

/// Nobody ever measured how the ground is: a mast leans as far as it falls.
class EstimateWithoutAnImuOnASlope : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(EstimateWithoutAnImuOnASlope, HasItsMastInTheBound) {
  const auto [mast_m, slope_deg] = GetParam();
  EngineConfig config = rig_config();
  config.estimate.antenna_z_m = mast_m;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rig rig(seed, config);
    rig.yaw_rad = 0;
    rig.stand(3);
    rig.forget();
    rig.drive(0.5, 0.5, 10);
    for (int i = 1; i <= 10; ++i) {
      rig.world.slope_rad = to_rad(slope_deg) * i / 10;
      rig.drive(0.5, 0.5, 0.1);
    }
    rig.drive(0.5, 0.5, 10);
    rig.circle(0.5, 2, 10);
    rig.stand(10);
    EXPECT_EQ(rig.share_bound(), 1) << "seed " << seed << ": " << rig.max_m() << " m at most, told "
                                    << rig.last.error_bound_m << " m";
  }
}

INSTANTIATE_TEST_SUITE_P(MastsAndSlopes, EstimateWithoutAnImuOnASlope,
                         testing::Combine(testing::Values(0.6, 1.5),
                                          testing::Values(5.0, 8.5, 15.0)));

}  // namespace
}  // namespace drover::engine::estimate
