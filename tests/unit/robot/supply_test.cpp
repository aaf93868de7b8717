// What feeds the drives and what holds the wheels: relay, dips, brakes, worm gears; and what
// somebody does to the robot by hand.
#include "unit/robot/robot_rig.h"

namespace drover::sim {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::StartsWith;

class SupplyTest : public RobotTest {
 protected:
  void on_the_ramp() {
    scenario.start_x_m = 9.5;
    scenario.start_y_m = -8;
  }
  void arm(Robot& robot, std::uint8_t torque_Nm = 0) {
    for (std::uint32_t i = 1; i <= 4; ++i) robot.on_frame(0, make_frame(i, {torque_Nm}), now);
  }
  /// The way that it rolls down the ramp meanwhile.
  double rolls_m(Robot& robot, Duration time) {
    robot.step(now);
    now += kTick;
    const double before_m = robot.truth().pose.x_m;
    run(robot, time);
    return before_m - robot.truth().pose.x_m;
  }
};

TEST_F(SupplyTest, IsThereWithoutTheGatewayUnlessTheRelayIsWired) {
  auto robot = make();
  robot.step(now);
  EXPECT_TRUE(robot.truth().supply);
  EXPECT_EQ(robot.frames(0).size(), 4U);
}

TEST_F(SupplyTest, ComesAndGoesWithTheRelay) {
  scenario.relay_feeds_drives = true;
  auto robot = make();
  run(robot, milliseconds(50));
  EXPECT_TRUE(robot.frames(0).empty()) << "nobody has closed the relay";
  EXPECT_FALSE(robot.truth().supply);
  robot.set_relay(true);
  run(robot, milliseconds(50));
  EXPECT_TRUE(robot.truth().supply);
  EXPECT_FALSE(robot.frames(0).empty());
  arm(robot, 3);
  run(robot, seconds(1));
  EXPECT_EQ(robot.truth().wheels[0].torque_Nm, 3);
  robot.set_relay(false);
  run(robot, milliseconds(10));
  EXPECT_EQ(robot.truth().wheels[0].torque_Nm, 0) << "a power stage without supply drives nothing";
  EXPECT_TRUE(robot.frames(0).empty());
  EXPECT_GT(robot.truth().velocity.vx_mps, 0.1) << "and it brakes nothing";
}

TEST_F(SupplyTest, IsNotGivenByARelayBehindAPressedButton) {
  scenario.relay_feeds_drives = true;
  scenario.estop_cuts_power = true;
  auto robot = make();
  robot.set_relay(true);
  robot.command("estop press");
  robot.step(now);
  EXPECT_FALSE(robot.truth().supply);
  robot.command("estop release");
  robot.step(now + kTick);
  EXPECT_TRUE(robot.truth().supply);
}

TEST_F(SupplyTest, DipsForAsLongAsItIsSaid) {
  auto robot = make();
  arm(robot, 3);
  run(robot, milliseconds(100));
  EXPECT_EQ(robot.command("supply dip 0.3"), "ok");
  run(robot, milliseconds(295));
  EXPECT_FALSE(robot.truth().supply);
  EXPECT_TRUE(robot.frames(0).empty());
  run(robot, milliseconds(20));
  EXPECT_TRUE(robot.truth().supply);
  EXPECT_FALSE(robot.frames(0).empty());
  EXPECT_EQ(robot.truth().wheels[0].torque_Nm, 0) << "it was armed by nobody since";
}

TEST_F(SupplyTest, LeavesADriveOffThatIsSwitchedOff) {
  auto robot = make();
  EXPECT_EQ(robot.command("drive rear_left power off"), "ok");
  EXPECT_EQ(robot.command("supply dip 0.1"), "ok");
  run(robot, milliseconds(200));
  EXPECT_EQ(robot.frames(0).size(), 3U + 3U);
}

TEST_F(SupplyTest, OfARobotThatNothingHoldsLetsItRollDownASlope) {
  on_the_ramp();
  auto robot = make();
  const double way_m = rolls_m(robot, seconds(4));
  std::printf("  rolled %.2f m, %.2f m/s\n", way_m, robot.truth().velocity.vx_mps);
  EXPECT_GT(way_m, 2);
}

TEST_F(SupplyTest, IsNotNeededByABrakeToHoldOnASlope) {
  on_the_ramp();
  scenario.brake = true;
  auto robot = make();
  const double way_m = rolls_m(robot, seconds(20));
  std::printf("  gave way by %.4f m\n", way_m);
  EXPECT_LT(std::abs(way_m), 0.01);
}

TEST_F(SupplyTest, IsNotNeededByAWormGearToHoldOnASlope) {
  on_the_ramp();
  scenario.worm_gear = true;
  auto robot = make();
  EXPECT_LT(std::abs(rolls_m(robot, seconds(20))), 0.01);
}

TEST_F(SupplyTest, ABrakeIsReleasedByADriveThatHolds) {
  on_the_ramp();
  scenario.brake = true;
  auto robot = make();
  run(robot, milliseconds(100));
  arm(robot);
  EXPECT_GT(rolls_m(robot, seconds(2)), 0.5) << "this drive holds with no torque";
}

TEST_F(SupplyTest, ABrakeEngagesFiftyMillisecondsAfterItsDriveLetGo) {
  scenario.brake = true;
  auto robot = make();
  arm(robot, 3);
  run(robot, seconds(2));
  const double speed_mps = robot.truth().velocity.vx_mps;
  EXPECT_GT(speed_mps, 0.5);
  robot.command("supply dip 1");
  run(robot, milliseconds(45));
  EXPECT_NEAR(robot.truth().velocity.vx_mps, speed_mps, 0.1);
  run(robot, milliseconds(500));
  EXPECT_NEAR(robot.truth().velocity.vx_mps, 0, 0.01);
  EXPECT_NEAR(robot.truth().wheels[0].velocity_radps, 0, 0.01);
}

TEST_F(SupplyTest, AWormGearLocksWhenItsDriveLetsGo) {
  scenario.worm_gear = true;
  auto robot = make();
  arm(robot, 3);
  run(robot, seconds(2));
  EXPECT_GT(robot.truth().velocity.vx_mps, 0.5);
  robot.command("supply dip 1");
  run(robot, milliseconds(150));
  EXPECT_NEAR(robot.truth().wheels[0].velocity_radps, 0, 0.05);
}

TEST_F(SupplyTest, APushByHandMovesARobotWhoseWheelsAreFreeForItsTime) {
  auto robot = make();
  run(robot, milliseconds(500));
  EXPECT_EQ(robot.command("push 60 0 1"), "ok");
  run(robot, seconds(1));
  const double speed_mps = robot.truth().velocity.vx_mps;
  std::printf("  pushed to %.2f m/s\n", speed_mps);
  EXPECT_GT(speed_mps, 0.3);
  run(robot, seconds(1));
  EXPECT_LT(robot.truth().velocity.vx_mps, speed_mps);
}

TEST_F(SupplyTest, APushByHandDoesNotMoveARobotOnItsBrakes) {
  scenario.brake = true;
  auto robot = make();
  run(robot, milliseconds(500));
  const double before_m = robot.truth().pose.x_m;
  robot.command("push 60 0 2");
  run(robot, seconds(3));
  EXPECT_NEAR(robot.truth().pose.x_m, before_m, 0.01);
}

TEST_F(SupplyTest, OnATrailerItMovesAndNoWheelTurns) {
  scenario.imu.emplace();
  auto robot = make();
  run(robot, milliseconds(500));
  const double turned_rad = robot.truth().wheels[0].position_rad;
  EXPECT_EQ(robot.command("carry 4 1 90 8"), "ok");
  double fastest_mps = 0;
  double turn_rad = 0;
  for (int i = 0; i < 1600; ++i) {
    run(robot, kTick);
    fastest_mps = std::max(fastest_mps, seen.speed_mps);
    turn_rad += felt.angular_velocity_radps.z * to_s(kTick);
    ASSERT_NEAR(robot.truth().wheels[0].velocity_radps, 0, 1e-6);
  }
  run(robot, seconds(1));
  EXPECT_NEAR(robot.truth().pose.yaw_rad, 1.5708, 0.01);
  EXPECT_NEAR(turn_rad, 1.5708, 0.02) << "the inertial sensor feels it";
  EXPECT_GT(fastest_mps, 0.5) << "the receiver sees it";
  EXPECT_GT(std::hypot(robot.truth().pose.x_m, robot.truth().pose.y_m), 3);
  EXPECT_NEAR(robot.truth().wheels[0].position_rad, turned_rad, 0.01);
  EXPECT_NEAR(robot.truth().pose.z_m, 0.165, 0.002);
}

TEST_F(SupplyTest, RefusesWhatItCannotDo) {
  auto robot = make();
  for (const auto* text :
       {"supply", "supply dip", "supply dip 0", "supply dip soon", "push 1 2", "push 1 2 0",
        "push a 2 1", "carry 1 2 3", "carry 1 2 3 0", "drive front_left,tail power off"})
    EXPECT_THAT(robot.command(text), StartsWith("error: ")) << text;
}

TEST_F(SupplyTest, AFaultCanBeGivenToSeveralDrives) {
  auto robot = make();
  EXPECT_EQ(robot.command("drive front_left,rear_right power off"), "ok");
  run(robot, milliseconds(50));
  EXPECT_EQ(robot.frames(0).size(), 2U + 2U);
}

}  // namespace
}  // namespace drover::sim
