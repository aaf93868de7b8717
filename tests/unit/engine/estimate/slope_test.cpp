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

}  // namespace
}  // namespace drover::engine::estimate
