// What the estimate makes of a base that tells its motion, and of a receiver that ceases: as of
// wheels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_twist_fixture.h"

namespace drover::engine {
namespace {

class TheEstimateOfATwistBase : public ABaseThatTakesATwist {
 protected:
  void start(const Path& track) {
    rig.imu = true;
    rig.settle();
    rig.start(track, static_cast<std::uint32_t>(track.points.size() - 1), 0.5);
    rig.run_s(5);
    ASSERT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
  }
  double error_m() const {
    const Pose& truth = rig.plant.truth();
    const Pose& told = rig.snapshot().pose;
    return std::hypot(told.x_m - truth.x_m, told.y_m - truth.y_m);
  }
  const NavSnapshot& nav() const { return rig.snapshot().nav; }

  Path far = straight_path(80);
};

TEST_F(TheEstimateOfATwistBase, HasItsHeadingByAStraightWay) {
  rig.no_heading = true;
  rig.settle();
  ASSERT_EQ(nav().locate, LocateState::uninit);
  rig.command(FindHeading{});
  rig.run_s(3);
  EXPECT_GT(rig.out.base.twist.vx_mps, 0.1) << rig.why();
  rig.run_s(12);
  EXPECT_EQ(nav().locate, LocateState::good) << rig.why();
  EXPECT_TRUE(at_rest());
  EXPECT_LT(to_deg(std::abs(rig.snapshot().pose.yaw_rad - rig.plant.truth().yaw_rad)), 5);
}

TEST_F(TheEstimateOfATwistBase, GoesByItsMotionWhileTheReceiverIsSilent) {
  start(path);
  rig.receiver_silent = true;
  rig.run_s(4);
  EXPECT_EQ(nav().status, NavStatus::run) << rig.why();
  EXPECT_GT(rig.snapshot().pose.vx_mps, 0.4);
  EXPECT_LT(error_m(), 0.1);
  rig.receiver_silent = false;
  rig.run_s(20);
  EXPECT_EQ(nav().status, NavStatus::success) << rig.why();
}

TEST_F(TheEstimateOfATwistBase, SaysHowManyMetresAreLeftAndRestsBeforeTheyAreDriven) {
  start(far);
  EXPECT_TRUE(std::isnan(nav().metres_left));
  rig.receiver_silent = true;
  rig.run_s(2);
  const double told_m = nav().metres_left;
  const double begin_m = rig.plant.truth().x_m;
  ASSERT_GT(told_m, 3);
  rig.run_s(4);
  const double driven_m = rig.plant.truth().x_m - begin_m;
  EXPECT_NEAR(nav().metres_left, told_m - driven_m, 0.25 * told_m);
  for (int i = 0; i < 150 && !at_rest(); ++i) rig.run_s(1);
  EXPECT_TRUE(at_rest());
  EXPECT_LT(rig.plant.truth().x_m, 79);
  EXPECT_NEAR(rig.plant.truth().x_m - begin_m, told_m, 0.3 * told_m);
  EXPECT_LT(error_m(), nav().error_bound_m);
}

TEST_F(TheEstimateOfATwistBase, LearnsItsScale) {
  rig.tells_share = 0.95;
  start(far);
  rig.run_s(120);
  const LearnedValue& scale = rig.snapshot().learned.wheel_scale;
  ASSERT_TRUE(scale.known());
  EXPECT_NEAR(scale.value, 1 / 0.95, 0.01);
}

TEST_F(TheEstimateOfATwistBase, LearnsItsTurn) {
  rig.tells_turn_share = 0.8;
  Path circles;
  circles.name = "circles";
  for (int i = 0; i <= 4 * 36; ++i) {
    const double rad = to_rad(10 * i);
    circles.points.push_back({3 * std::sin(rad), 3 - 3 * std::cos(rad)});
  }
  start(circles);
  rig.run_s(120);
  const LearnedValue& gain = rig.snapshot().learned.turn_gain;
  ASSERT_TRUE(gain.known());
  // It turns less than its own wheels say, as any base that skids.
  EXPECT_NEAR(gain.value, (1 - test::PlantConfig{}.yaw_scrub) / 0.8, 0.02);
}

}  // namespace
}  // namespace drover::engine
