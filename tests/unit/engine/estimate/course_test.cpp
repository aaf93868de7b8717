// A base with one antenna finds its heading from its course.
#include "engine/estimate/course.h"

#include <gtest/gtest.h>

#include "unit/engine/estimate/rig.h"

namespace drover::engine::estimate {
namespace {

EngineConfig one_antenna() {
  EngineConfig config = rig_config();
  config.estimate.antenna_x_m = 0.3;
  config.estimate.antenna_y_m = -0.2;
  return config;
}

class CourseHeadingFound : public testing::TestWithParam<double> {};

TEST_P(CourseHeadingFound, AfterAMetreStraightAhead) {
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rig rig(seed, one_antenna());
    rig.world.heading = false;
    rig.world.imu = seed % 2 == 0;
    rig.yaw_rad = 0.4 * static_cast<double>(seed);
    rig.stand(3);
    rig.drive(GetParam(), GetParam(), 0.8 / std::abs(GetParam()));
    EXPECT_FALSE(rig.last.has_heading);
    rig.drive(GetParam(), GetParam(), 0.6 / std::abs(GetParam()));
    ASSERT_TRUE(rig.last.has_heading);
    worst = std::max(worst, rig.yaw_error_rad() / rig.last.yaw_error_rad);
    EXPECT_LT(to_deg(rig.last.yaw_error_rad), 4.0);  // inside bound_yaw_deg to start with
    EXPECT_LT(rig.position_error_m(), 0.06);
    EXPECT_FALSE(rig.last.disagrees);
  }
  EXPECT_LT(worst, 2.0);  // four sigma
}

INSTANTIATE_TEST_SUITE_P(BothWays, CourseHeadingFound, testing::Values(0.3, -0.3));

TEST(CourseHeading, IsNotFoundWithoutAFix) {
  Rig rig(1, one_antenna());
  rig.world.heading = false;
  rig.world.quality = FixQuality::rtk_float;
  rig.stand(2);
  rig.drive(0.3, 0.3, 10);
  EXPECT_FALSE(rig.last.has_heading);
}

TEST(CourseHeading, IsNotFoundOnTheSpotNorFromWheelsThatSpin) {
  Rig rig(1, one_antenna());
  rig.world.heading = false;
  rig.stand(2);
  rig.drive(-0.3, 0.3, 10);
  EXPECT_FALSE(rig.last.has_heading);
  rig.world.grip = 0;
  rig.drive(0.3, 0.3, 10);
  EXPECT_FALSE(rig.last.has_heading);
}

TEST(CourseHeading, StaysWithTheGyroThroughARest) {
  Rig rig(5, one_antenna());
  rig.world.heading = false;
  rig.world.imu = true;
  rig.stand(3);
  rig.drive(0.3, 0.3, 6);
  rig.stand(60);
  rig.drive(0.3, 0.3, 3);
  rig.circle(0.5, 3, 20);
  EXPECT_TRUE(rig.last.has_heading);
  EXPECT_LT(to_deg(rig.yaw_error_rad()), 1.5);
  EXPECT_LT(rig.position_error_m(), 0.05);
}

}  // namespace
}  // namespace drover::engine::estimate
