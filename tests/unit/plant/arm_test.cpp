// The arm on the field robot: it falls limp onto its stops, stands under torque, and gives under a
// push on its tip as a spring does.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "sim/plant/plant.h"

namespace drover::sim {
namespace {

constexpr std::array kNames{"base_yaw", "shoulder", "elbow"};
using Joints = std::array<double, 3>;

class Armed {
 public:
  Armed() { plant.place(0, 0, 0); }
  std::size_t joint(std::size_t i) const { return plant.joint(kNames[i]); }
  WheelState at(std::size_t i) const { return plant.wheel(joint(i)); }
  /// Each joint a spring and a damper about `to_rad`, on top of `effort_Nm`.
  void spring(const Joints& to_rad, const Joints& effort_Nm, double stiffness, double damping,
              double time_s) {
    const auto steps = static_cast<int>(std::lround(time_s / plant.timestep_s()));
    for (int step = 0; step < steps; ++step) {
      for (std::size_t i = 0; i < 3; ++i)
        plant.set_torque(joint(i), stiffness * (to_rad[i] - at(i).position_rad) -
                                       damping * at(i).velocity_radps + effort_Nm[i]);
      plant.step();
    }
  }
  void limp(double time_s) { spring({}, {}, 0, 0, time_s); }

  Plant plant{std::string(DROVER_SOURCE_DIR) + "/sim/worlds/field_arm.xml"};
};

TEST(Arm, IsNoWheel) {
  const Armed robot;
  ASSERT_EQ(robot.plant.joints().size(), 7U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(robot.plant.is_wheel(robot.joint(i)));
  EXPECT_TRUE(robot.plant.is_wheel(robot.plant.joint("front_left")));
}

TEST(Arm, FallsLimpOntoItsStopsAndNotToTheGround) {
  Armed robot;
  const double before_m = robot.plant.tip_m().value().z;
  robot.limp(3);
  EXPECT_NEAR(robot.at(1).position_rad, -0.6, 0.05);
  EXPECT_NEAR(robot.at(2).position_rad, -0.6, 0.05);
  EXPECT_LT(robot.plant.tip_m()->z, before_m - 0.4);
  EXPECT_GT(robot.plant.tip_m()->z, 0);
}

TEST(Arm, StandsUnderTheTorqueOfItsWeight) {
  Armed robot;
  constexpr double kG = 9.81;
  // Forearm 0.4 kg, elbow 0.35 kg, upper arm 0.7 kg; links of 0.3 m.
  const Joints weight_Nm{0, kG * (0.7 * 0.15 + 0.35 * 0.3 + 0.4 * 0.45), kG * 0.4 * 0.15};
  const double before_m = robot.plant.tip_m()->z;
  robot.spring({}, weight_Nm, 0, 2, 3);
  EXPECT_NEAR(robot.plant.tip_m()->z, before_m, 0.02);
  EXPECT_LT(std::abs(robot.at(1).position_rad), 0.03);
}

TEST(Arm, GivesUnderAPushOnItsTipAsASpringDoes) {
  Armed robot;
  const Joints weight_Nm{0, 9.81 * 0.39, 9.81 * 0.06};
  robot.spring({}, weight_Nm, 60, 3, 2);
  const Joints before_rad{robot.at(0).position_rad, robot.at(1).position_rad,
                          robot.at(2).position_rad};
  ASSERT_TRUE(robot.plant.push_tip({0, 0, 10}));
  robot.spring({}, weight_Nm, 60, 3, 3);
  EXPECT_NEAR(robot.at(1).position_rad - before_rad[1], 10 * 0.6 / 60, 0.01);
  EXPECT_NEAR(robot.at(2).position_rad - before_rad[2], 10 * 0.3 / 60, 0.005);
  EXPECT_NEAR(robot.at(0).position_rad, before_rad[0], 0.005);
  ASSERT_TRUE(robot.plant.push_tip({0, 10, 0}));
  robot.spring({}, weight_Nm, 60, 3, 3);
  EXPECT_NEAR(robot.at(0).position_rad - before_rad[0], 10 * 0.6 / 60, 0.01);
  ASSERT_TRUE(robot.plant.push_tip({}));
  robot.spring({}, weight_Nm, 60, 3, 3);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(robot.at(i).position_rad, before_rad[i], 0.005);
}

TEST(Arm, HasNoTipWhereThereIsNoArm) {
  Plant plant(std::string(DROVER_SOURCE_DIR) + "/sim/worlds/field.xml");
  EXPECT_FALSE(plant.push_tip({0, 0, 1}));
  EXPECT_FALSE(plant.tip_m());
}

TEST(Arm, MovesNoWheelWhenItSwings) {
  Armed robot;
  robot.limp(0.5);
  const BasePose before = robot.plant.pose();
  robot.spring({1, 0.5, 0.5}, {}, 60, 5, 3);
  const BasePose after = robot.plant.pose();
  EXPECT_LT(std::hypot(after.x_m - before.x_m, after.y_m - before.y_m), 0.05);
}

}  // namespace
}  // namespace drover::sim
