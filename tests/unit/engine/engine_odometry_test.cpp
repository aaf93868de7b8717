// The way by wheels and gyro alone (REP 105: odom).
#include "engine_fixture.h"

namespace drover::engine {
namespace {

class Odom : public AnEngine {
 protected:
  const Odometry& way() const { return rig.snapshot().odometry; }
};

TEST_F(Odom, BeginsAtItsOwnZeroWhateverTheReceiverSays) {
  rig.settle();
  EXPECT_TRUE(way().known);
  EXPECT_EQ(way().time, rig.snapshot().time);
  EXPECT_NEAR(way().x_m, 0, 1e-3);
  EXPECT_NEAR(way().y_m, 0, 1e-3);
  EXPECT_NEAR(way().yaw_rad, 0, 1e-3);
}

TEST_F(Odom, GoesAheadByTheWayDriven) {
  ASSERT_NO_FATAL_FAILURE(drive());
  EXPECT_GT(rig.driven_m, 1);
  EXPECT_NEAR(way().x_m, rig.driven_m, 0.05);
  EXPECT_NEAR(way().y_m, 0, 0.1);
  EXPECT_NEAR(way().vx_mps, 0.5, 0.05);
}

TEST_F(Odom, NeverJumpsWhereThePositionDoes) {
  ASSERT_NO_FATAL_FAILURE(drive());
  double farthest_m = 0;
  Odometry before = way();
  rig.jump_m = 3;
  for (int i = 0; i < 600; ++i) {
    rig.tick();
    farthest_m = std::max(farthest_m, std::hypot(way().x_m - before.x_m, way().y_m - before.y_m));
    before = way();
  }
  EXPECT_LT(farthest_m, 0.005) << "a cycle at 0.5 m/s is 2.5 mm";
}

TEST_F(Odom, TurnsLeftCounterClockwise) {
  rig.settle();
  rig.carried = WheelSpeeds{-2, 2};  // left back, right ahead
  rig.run_s(1);
  EXPECT_GT(way().wz_radps, 0.1);
  EXPECT_GT(way().yaw_rad, 0.1);
}

TEST_F(Odom, GrowsMoreUncertainByTheWayAndNotByStanding) {
  rig.settle();
  const double standing = way().x_var + way().y_var;
  ASSERT_NO_FATAL_FAILURE(drive());
  EXPECT_GT(way().x_var + way().y_var, standing + 1e-5);
  EXPECT_LT(std::sqrt(way().x_var), 0.3) << "of 2 m";
  EXPECT_GT(way().yaw_var, 0);
}

TEST_F(Odom, StandsWhereTheBaseIsSilent) {
  ASSERT_NO_FATAL_FAILURE(drive());
  for (auto& one : rig.drives) one.silent = true;
  rig.run_s(1);
  const Odometry there = way();
  EXPECT_FALSE(there.known);
  EXPECT_EQ(there.vx_mps, 0);
  rig.run_s(1);
  EXPECT_EQ(way().x_m, there.x_m);
  EXPECT_GT(way().x_var, there.x_var) << "it may do anything";
}

}  // namespace
}  // namespace drover::engine
