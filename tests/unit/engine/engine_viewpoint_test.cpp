// What the engine tells those who look around: where it is, where it would go, what is left.
#include "engine_fixture.h"

namespace drover::engine {
namespace {

class AViewpoint : public AnEngine {
 protected:
  const Viewpoint& view() const { return rig.engine->viewpoint(); }
  void turn_wheels(double left_radps, double right_radps) {
    JointTargets targets;
    for (AxisId id = 0; id < 4; ++id)
      (void)targets.joints.push_back({id, id % 2 == 0 ? left_radps : right_radps});
    rig.command(targets);
  }
  void begin_stream() {
    for (int i = 0; i < 160; ++i) {
      if (i % 4 == 0) turn_wheels(0, 0);
      rig.tick();
    }
  }
};

TEST_F(AViewpoint, IsOfTheCyclesPose) {
  rig.settle();
  EXPECT_EQ(view().t, rig.now);
  EXPECT_EQ(view().t, view().pose.time);
  EXPECT_NEAR(view().pose.x_m, 0, 0.05);
  EXPECT_LT(view().pose.position_sigma_m, 0.05);
  EXPECT_LT(view().pose.yaw_sigma_rad, 0.05);
  EXPECT_TRUE(view().origin_set);
  EXPECT_EQ(view().origin.latitude_deg, kRigOrigin.latitude_deg);
  ASSERT_EQ(view().joint_rad.size(), 4U);
  EXPECT_TRUE(std::isfinite(view().joint_rad[3]));
}

TEST_F(AViewpoint, TellsThatItIsNotLocated) {
  rig.receiver_silent = true;
  rig.run_s(1);
  EXPECT_FALSE(std::isfinite(view().pose.position_sigma_m));
  EXPECT_FALSE(std::isfinite(view().pose.yaw_sigma_rad));
  EXPECT_FALSE(view().origin_set);
}

/// Nobody is stopped by things around a place that stands still while the robot does not.
TEST_F(AViewpoint, ItsPlaceIsWorseByWhatItSlippedAndNoneOnceTheReceiverIsStuck) {
  rig.settle();
  begin_stream();
  const auto drive_on = [this](double seconds, bool stuck) {
    const double from_m = rig.driven_m;
    const double jump_m = rig.jump_m;
    for (int i = 0; i < static_cast<int>(seconds * 200); ++i) {
      if (i % 4 == 0) turn_wheels(3, 3);
      if (stuck) rig.jump_m = jump_m - (rig.driven_m - from_m);
      rig.tick();
    }
    return rig.driven_m - from_m;
  };
  ASSERT_GT(drive_on(3, false), 0.5);
  EXPECT_LT(view().pose.position_sigma_m, 0.05);
  double away_m = drive_on(0.7, true);  // as long as slip is looked for
  for (int i = 0; i < 15; ++i) {
    away_m += drive_on(0.1, true);
    EXPECT_FALSE(view().pose.position_sigma_m < away_m / 4) << away_m << " m away";
  }
  EXPECT_FALSE(std::isfinite(view().pose.position_sigma_m)) << rig.why();
}

TEST_F(AViewpoint, TellsTheTiltOfAnInertialSensorOnly) {
  rig.settle();
  EXPECT_FALSE(std::isfinite(view().roll_rad));
  rig.imu = true;
  rig.run_s(2);
  EXPECT_NEAR(view().roll_rad, 0, 0.02);
  EXPECT_NEAR(view().pitch_rad, 0, 0.02);
}

/// The base may coast: that it stands is not said of one that nobody hears.
TEST_F(AViewpoint, TellsNoMotionWhileNobodyKnowsHowTheRobotMoves) {
  drive();
  EXPECT_GT(view().pose.vx_mps, 0.1);
  for (auto& drive : rig.drives) drive.silent = true;
  rig.run_s(1);
  EXPECT_FALSE(std::isfinite(view().pose.vx_mps));
  EXPECT_FALSE(std::isfinite(view().pose.wz_radps));
  for (auto& drive : rig.drives) drive.silent = false;
  rig.run_s(1);
  EXPECT_TRUE(std::isfinite(view().pose.vx_mps));
  EXPECT_TRUE(std::isfinite(view().pose.wz_radps));
}

TEST_F(AViewpoint, HasAnotherPlaceWithEachOriginAndWhenItIsFound) {
  rig.tick();
  const auto at_first = view().place;
  rig.set_origin();
  rig.run_s(3);
  const auto found = view().place;
  EXPECT_GT(found, at_first);
  rig.run_s(3);
  EXPECT_EQ(view().place, found) << "nothing changed";
  rig.set_origin();
  rig.tick();
  EXPECT_GT(view().place, found);
}

TEST_F(AViewpoint, HasOnePlaceWhileItDrives) {
  drive();
  const auto place = view().place;
  rig.run_s(10);
  EXPECT_EQ(view().place, place);
}

TEST_F(AViewpoint, HasAnotherPlaceAfterAJump) {
  rig.settle();
  const auto place = view().place;
  rig.jump_m = 2;
  rig.run_s(4);
  EXPECT_NEAR(view().pose.x_m, 2, 0.2) << "it did not believe it: this proves nothing";
  EXPECT_GT(view().place, place);
}

TEST_F(AViewpoint, TellsWhatATaskAsksAndWhatOfItsTrackIsLeft) {
  path.number = 9;
  rig.settle();
  EXPECT_EQ(view().way.path, 0U);
  rig.start(path, 30, 0.5);
  rig.run_s(5);
  EXPECT_EQ(view().way.path, 9U);
  EXPECT_TRUE(view().way.forwards);
  EXPECT_EQ(view().way.target, 30U);
  EXPECT_NEAR(0.5 * view().way.segment + view().way.along_m, view().pose.x_m, 0.05);
  EXPECT_NEAR(view().asked.vx_mps, 0.5, 0.01);
  EXPECT_NEAR(view().commanded.vx_mps, 0.5, 0.01);
  rig.command(CancelTask{});
  rig.run_s(2);
  EXPECT_EQ(view().way.path, 0U);
  EXPECT_TRUE(is_zero(view().asked));
}

/// Points are numbered as in the list, whichever way it is driven.
TEST_F(AViewpoint, CountsATrackThatIsDrivenBackwardsFromItsEnd) {
  path = straight_path(20);
  for (PathPoint& point : path.points) point.x_m = 20 - point.x_m;  // it stands at the last one
  path.number = 2;
  rig.settle();
  rig.start(path, 4, 0.5);
  rig.run_s(5);
  ASSERT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
  EXPECT_FALSE(view().way.forwards);
  EXPECT_EQ(view().way.target, 4U);
  const double from_end_m = 0.5 * (40 - static_cast<double>(view().way.segment));
  EXPECT_NEAR(from_end_m + view().way.along_m, view().pose.x_m, 0.05);
}

TEST_F(AViewpoint, TellsWhereATaskWouldGoWhileItWaits) {
  drive();
  rig.lines[static_cast<std::size_t>(Line::zone_near)] = true;
  rig.run_s(4);
  ASSERT_TRUE(rig.snapshot().nav.paused);
  EXPECT_TRUE(is_zero(view().commanded));
  EXPECT_GT(view().asked.vx_mps, 0.05);
}

TEST_F(AViewpoint, TellsTheTwistThatAStreamOfJointCommandsAsks) {
  rig.settle();
  begin_stream();
  for (int i = 0; i < 4; ++i) {
    turn_wheels(-2, -1);
    rig.tick();
  }
  const double r_m = rig.config.base.wheel_radius_m;
  EXPECT_NEAR(view().asked.vx_mps, -1.5 * r_m, 1e-6);
  EXPECT_NEAR(view().asked.wz_radps, 1 * r_m / rig.config.base.track_m, 0.02);
  EXPECT_GT(view().commanded.vx_mps, -0.1) << "its ramp has hardly begun";
  EXPECT_LT(view().commanded.vx_mps, 0);
}

TEST_F(AViewpoint, TellsWhereASearchForTheHeadingGoes) {
  rig.no_heading = true;
  rig.tick();
  rig.set_origin();
  rig.run_s(3);
  EXPECT_FALSE(std::isfinite(view().pose.yaw_sigma_rad));
  rig.command(FindHeading{});
  rig.run_s(1);
  EXPECT_EQ(view().asked.vx_mps, rig.config.navigate.find_heading_speed_mps);
}

}  // namespace
}  // namespace drover::engine
