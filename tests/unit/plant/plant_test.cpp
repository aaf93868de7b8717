// The robot in its field: drives, skids, climbs, holds, touches and sees, the same way every time.
#include "sim/plant/plant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include "drover/angle.h"
#include "support/temp_folder.h"

namespace drover::sim {
namespace {

constexpr double kRadius_m = 0.165;
constexpr double kTrack_m = 0.60;

TEST(AWorld, IsNamedWhenThereIsNone) {
  try {
    const Plant plant("/nowhere/yard.xml");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "/nowhere/yard.xml: there is no such world");
  }
}

/// A plant with a plain velocity PI on each wheel, limited to 40 Nm.
class Driven {
 public:
  Plant plant{std::string(DROVER_SOURCE_DIR) + "/sim/worlds/field.xml"};

  void place(double x_m, double y_m, double yaw_rad) {
    plant.place(x_m, y_m, yaw_rad);
    sum_.fill(0);
  }
  void drive(double left_mps, double right_mps, double time_s) {
    const auto steps = static_cast<int>(std::lround(time_s / plant.timestep_s()));
    for (int i = 0; i < steps; ++i) {
      for (std::size_t joint = 0; joint < 4; ++joint) {
        const bool left = plant.joints()[joint].find("left") != std::string::npos;
        const double error =
            (left ? left_mps : right_mps) / kRadius_m - plant.wheel(joint).velocity_radps;
        sum_[joint] += error * plant.timestep_s();
        plant.set_torque(joint, std::clamp(8 * error + 60 * sum_[joint], -40.0, 40.0));
      }
      plant.step();
      turned_rad += wrap_rad(plant.pose().yaw_rad - yaw_rad_);
      yaw_rad_ = plant.pose().yaw_rad;
    }
  }
  /// Effective track over track, from wheel speeds and the true yaw rate.
  double slip_factor(double speed_mps, double difference_mps) {
    place(0, 0, 0);
    const double left_mps = speed_mps - difference_mps / 2;
    const double right_mps = speed_mps + difference_mps / 2;
    drive(left_mps, right_mps, 2);
    const double before_rad = turned_rad;
    const double rolled_left_rad = plant.wheel(plant.joint("front_left")).position_rad;
    const double rolled_right_rad = plant.wheel(plant.joint("front_right")).position_rad;
    drive(left_mps, right_mps, 4);
    const double rolled_rad =
        (plant.wheel(plant.joint("front_right")).position_rad - rolled_right_rad) -
        (plant.wheel(plant.joint("front_left")).position_rad - rolled_left_rad);
    return rolled_rad * kRadius_m / (turned_rad - before_rad) / kTrack_m;
  }
  double turned_rad = 0;

 private:
  std::array<double, 4> sum_{};
  double yaw_rad_ = 0;
};

TEST(Plant, RefusesAWorldThatIsNotThere) {
  EXPECT_THROW(Plant("no/such/world.xml"), std::runtime_error);
}

TEST(Plant, NamesTheJointsWhenOneIsUnknown) {
  Driven robot;
  try {
    (void)robot.plant.joint("left");
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(),
                 "no joint 'left' in the world; it has front_left, front_right, rear_left, "
                 "rear_right");
  }
}

TEST(Plant, RefusesAnUnknownObstacle) {
  Driven robot;
  EXPECT_FALSE(robot.plant.set_obstacle("cow", 1, 1));
  EXPECT_FALSE(robot.plant.remove_obstacle("cow"));
  EXPECT_FALSE(robot.plant.remove_obstacle("base"));
}

TEST(Plant, TakesATorqueThatIsNotANumberAsNone) {
  Driven robot;
  robot.plant.set_torque(0, std::nan(""));
  for (int i = 0; i < 100; ++i) robot.plant.step();
  EXPECT_NEAR(robot.plant.pose().x_m, 0, 1e-3);
}

TEST(Plant, StandsStill) {
  Driven robot;
  robot.drive(0, 0, 10);
  EXPECT_NEAR(robot.plant.pose().x_m, 0, 1e-4);
  EXPECT_NEAR(robot.plant.pose().y_m, 0, 1e-4);
  EXPECT_NEAR(robot.plant.pose().yaw_rad, 0, 1e-4);
}

TEST(Plant, DrivesStraightWithEqualTorques) {
  Driven robot;
  for (int i = 0; i < 1200; ++i) {
    for (std::size_t joint = 0; joint < 4; ++joint) robot.plant.set_torque(joint, 2.0);
    robot.plant.step();
  }
  EXPECT_GT(robot.plant.pose().x_m, 1);
  EXPECT_NEAR(robot.plant.pose().y_m, 0, 0.01);
  EXPECT_NEAR(robot.plant.pose().yaw_rad, 0, 0.01);
}

TEST(Plant, GoesAsFarAsItsWheelsRoll) {
  Driven robot;
  robot.drive(0.5, 0.5, 10);
  const double rolled_m = robot.plant.wheel(0).position_rad * kRadius_m;
  EXPECT_NEAR(rolled_m, 5.0, 0.05);
  EXPECT_NEAR(robot.plant.pose().x_m, rolled_m, 0.02);
}

TEST(Plant, TurnsWithAWiderTrackBecauseItsWheelsSkid) {
  // Four equal contacts at half wheelbase and half track: 1 + (wheelbase / track)^2 = 1.694.
  Driven robot;
  for (const double speed_mps : {0.0, 0.2, 0.5, 0.8}) {
    for (const double difference_mps : {0.1, 0.3, 0.6}) {
      const double factor = robot.slip_factor(speed_mps, difference_mps);
      std::printf("yaw_slip_factor at %.1f m/s, %.1f m/s between the sides: %.3f\n", speed_mps,
                  difference_mps, factor);
      EXPECT_NEAR(factor, 1.69, 0.05);
    }
  }
}

TEST(Plant, DoesNotHopWhileItTurnsOnTheSpot) {
  Driven robot;
  robot.drive(-0.3, 0.3, 1);
  double lowest_m = 1, highest_m = 0;
  for (int i = 0; i < 400; ++i) {
    robot.drive(-0.3, 0.3, robot.plant.timestep_s());
    lowest_m = std::min(lowest_m, robot.plant.pose().z_m);
    highest_m = std::max(highest_m, robot.plant.pose().z_m);
  }
  EXPECT_LT(highest_m - lowest_m, 0.001);
}

TEST(Plant, IsPutDownLevelWithTheSlope) {
  Driven robot;
  robot.place(8.5, -8, 0);
  EXPECT_NEAR(robot.plant.pose().pitch_rad, -std::atan(0.15), 1e-3);
  robot.place(8.5, -8, kPi / 2);
  EXPECT_NEAR(robot.plant.pose().roll_rad, std::atan(-0.15), 2e-3);
}

TEST(Plant, HoldsOnTheRampWithItsWheelsHeld) {
  Driven robot;
  robot.place(8.5, -8, 0);
  robot.drive(0, 0, 20);
  const double rolled_back_m = 8.5 - robot.plant.pose().x_m;
  std::printf("rolled back %.3f m\n", rolled_back_m);
  EXPECT_LE(std::abs(rolled_back_m), 0.05);
}

TEST(Plant, RollsDownTheRampWithItsWheelsFree) {
  Driven robot;
  robot.place(9.5, -8, 0);
  for (int i = 0; i < 400; ++i) robot.plant.step();
  EXPECT_LT(robot.plant.pose().x_m, 9.2);
}

TEST(Plant, ClimbsTheRampAndComesDownOnTheOtherSide) {
  Driven robot;
  robot.place(4, -8, 0);
  robot.drive(0.8, 0.8, 12);
  EXPECT_NEAR(robot.plant.pose().z_m, 0.9 + kRadius_m, 0.01);
  robot.drive(0.8, 0.8, 12);
  EXPECT_NEAR(robot.plant.pose().z_m, kRadius_m, 0.01);
  EXPECT_NEAR(robot.plant.pose().y_m, -8, 0.1);
}

TEST(Plant, RocksOnTheUnevenPatchAndGetsAcross) {
  Driven robot;
  robot.place(3, 8, 0);
  double most_rad = 0;
  for (int i = 0; i < 200; ++i) {
    robot.drive(0.5, 0.5, 0.1);
    most_rad = std::max(most_rad, std::abs(robot.plant.pose().pitch_rad));
  }
  EXPECT_GT(most_rad, 0.02);
  EXPECT_LT(most_rad, 0.2);
  EXPECT_GT(robot.plant.pose().x_m, 12);
}

TEST(Plant, TouchesAnObstacleWithItsBumperAndIsHeldByIt) {
  Driven robot;
  ASSERT_TRUE(robot.plant.set_obstacle("obstacle", 2, 0));
  robot.drive(0.5, 0.5, 2);
  EXPECT_FALSE(robot.plant.bumper_touched());
  int touched = 0;
  for (int i = 0; i < 800; ++i) {
    robot.drive(0.5, 0.5, robot.plant.timestep_s());
    touched += robot.plant.bumper_touched() ? 1 : 0;
  }
  EXPECT_GT(touched, 100);
  EXPECT_LT(robot.plant.pose().x_m, 2 - 0.25 - 0.45 + 0.02);
}

TEST(Plant, PutsARobotWithItsWheelsOnOneAxleDown) {
  Plant plant(std::string(DROVER_SOURCE_DIR) + "/sim/worlds/yard.xml");
  plant.place(1, 2, 0.5);
  for (int i = 0; i < 800; ++i) {
    for (std::size_t joint = 0; joint < 2; ++joint) plant.set_torque(joint, 0.5);
    plant.step();
  }
  const auto pose = plant.pose();
  EXPECT_GT(std::hypot(pose.x_m - 1, pose.y_m - 2), 0.2);
  EXPECT_NEAR(pose.yaw_rad, 0.5, 0.01);
  EXPECT_NEAR(pose.z_m, 0.12, 0.003);
  EXPECT_NEAR(pose.pitch_rad, 0, 0.01);
}

/// A world of this robot on a plane; parts may be left out.
std::string small_world(const std::string& wheels, const std::string& base_parts) {
  return R"(<mujoco><worldbody><geom type="plane" size="9 9 1" contype="1" conaffinity="1"/>
    <body name="base" pos="0 0 0.1"><freejoint name="base"/>
    <geom type="box" size="0.2 0.1 0.05" mass="10" contype="0" conaffinity="0"/>)" +
         base_parts + wheels + "</body></worldbody>" +
         R"(<actuator><motor name="wheel" joint="wheel"/></actuator></mujoco>)";
}
const std::string kWheel = R"(<body name="wheel" pos="0 0.2 0"><joint name="wheel" axis="0 1 0"/>
  <geom type="sphere" size="0.1" mass="1" contype="1" conaffinity="1" condim="1"/></body>)";

std::string refusal(const std::string& world) {
  const test::TempFolder folder;
  const std::string file = folder.path() + "/world.xml";
  std::ofstream(file) << world;
  try {
    const Plant plant(file);
    return "accepted";
  } catch (const std::runtime_error& error) {
    return std::string(error.what()).substr(file.size());
  }
}

TEST(Plant, NeedsNoBumperInItsWorld) {
  EXPECT_EQ(refusal(small_world(kWheel, "")), "accepted");
}

TEST(Plant, NamesTheWheelThatTouchesNoGround) {
  EXPECT_EQ(refusal(small_world(R"(<body name="wheel" pos="0 0.2 0">
    <joint name="wheel" axis="0 1 0"/><geom type="sphere" size="0.1" mass="1" contype="0"
    conaffinity="0"/></body>)",
                                "")),
            ": the wheel of joint 'wheel' has no sphere with contype 1 that touches the ground; "
            "when it is a joint of an arm, its motor is of group 1");
}

TEST(Plant, SeesAnObstacleComeAndGo) {
  Driven robot;
  EXPECT_TRUE(std::isinf(robot.plant.free_distance_m(0.8)));
  ASSERT_TRUE(robot.plant.set_obstacle("obstacle", 2, 0.5));
  EXPECT_NEAR(robot.plant.free_distance_m(0.8), 2 - 0.25 - 0.45, 1e-9);
  ASSERT_TRUE(robot.plant.set_obstacle("obstacle", 2, 0.7));
  EXPECT_TRUE(std::isinf(robot.plant.free_distance_m(0.8)));
  ASSERT_TRUE(robot.plant.set_obstacle("obstacle", 2, 0));
  ASSERT_TRUE(robot.plant.remove_obstacle("obstacle"));
  EXPECT_TRUE(std::isinf(robot.plant.free_distance_m(0.8)));
}

TEST(Plant, SeesAnObstacleInItsOwnDirection) {
  Driven robot;
  robot.place(5, 3, kPi / 2);
  ASSERT_TRUE(robot.plant.set_obstacle("obstacle", 5, 5));
  EXPECT_NEAR(robot.plant.free_distance_m(0.8), 2 - 0.25 - 0.45, 1e-9);
}

TEST(Plant, MovesWhenItIsShoved) {
  Driven robot;
  robot.drive(0, 0, 1);
  robot.plant.kick(0, 1.0);
  EXPECT_NEAR(robot.plant.velocity().vy_mps, 1.0, 0.01);
  robot.drive(0, 0, 2);
  EXPECT_GT(robot.plant.pose().y_m, 0.02);
  EXPECT_NEAR(robot.plant.velocity().vy_mps, 0, 0.01);
}

TEST(Plant, GivesAPointOfTheBaseItsOwnVelocity) {
  Driven robot;
  robot.drive(-0.3, 0.3, 2);
  const double wz_radps = robot.plant.velocity().wz_radps;
  const auto at = robot.plant.point_m({0.5, 0, 0});
  const auto velocity = robot.plant.point_velocity_mps({0.5, 0, 0});
  const auto pose = robot.plant.pose();
  EXPECT_NEAR(at.x - pose.x_m, 0.5 * std::cos(pose.yaw_rad), 1e-3);
  EXPECT_NEAR(std::hypot(velocity.x, velocity.y), 0.5 * wz_radps, 0.02);
}

TEST(Plant, GivesTheSameBitsTwice) {
  const auto run = [] {
    Driven robot;
    robot.place(3, 8, 0.05);
    robot.drive(0.4, 0.6, 5);
    robot.plant.set_obstacle("obstacle", robot.plant.pose().x_m + 1, robot.plant.pose().y_m);
    robot.drive(0.6, 0.4, 5);
    const auto pose = robot.plant.pose();
    return std::array{pose.x_m,
                      pose.y_m,
                      pose.z_m,
                      pose.roll_rad,
                      pose.pitch_rad,
                      pose.yaw_rad,
                      robot.plant.wheel(2).position_rad};
  };
  EXPECT_EQ(run(), run());
}

TEST(Plant, GivesTheSameBitsAfterItIsPutBack) {
  Driven robot;
  robot.drive(0.3, 0.5, 3);
  const auto first = robot.plant.pose();
  robot.place(0, 0, 0);
  robot.drive(0.3, 0.5, 3);
  EXPECT_EQ(first.x_m, robot.plant.pose().x_m);
  EXPECT_EQ(first.yaw_rad, robot.plant.pose().yaw_rad);
}

}  // namespace
}  // namespace drover::sim
