// What ordinary ground does to the robot: it gives way, slides and tilts; and somebody shoves it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "drover/angle.h"
#include "sim/plant/plant.h"

namespace drover::sim {
namespace {

constexpr double kRadius_m = 0.165;

/// A plain velocity PI on each wheel.
class OnGround : public testing::Test {
 protected:
  explicit OnGround(const char* world = "field")
      : plant(std::string(DROVER_SOURCE_DIR) + "/sim/worlds/" + world + ".xml") {}

  void drive(double speed_mps, double time_s) { drive(speed_mps, speed_mps, time_s); }
  void drive(double left_mps, double right_mps, double time_s) {
    const auto steps = static_cast<int>(std::lround(time_s / plant.timestep_s()));
    for (int i = 0; i < steps; ++i) {
      for (std::size_t joint = 0; joint < 4; ++joint) {
        const double asked = (plant.is_left(joint) ? left_mps : right_mps) / kRadius_m;
        const double error = asked - plant.wheel(joint).velocity_radps;
        sum_[joint] += error * plant.timestep_s();
        plant.set_torque(joint, std::clamp(8 * error + 60 * sum_[joint], -40.0, 40.0));
      }
      const auto before = plant.point_velocity_mps({});
      plant.step();
      const auto after = plant.point_velocity_mps({});
      fastest_change_mps2 =
          std::max(fastest_change_mps2,
                   std::hypot(after.x - before.x, after.y - before.y) / plant.timestep_s());
    }
  }
  void slip(double share) {
    for (std::size_t joint = 0; joint < 4; ++joint) plant.set_slip(joint, share);
  }
  double rolled_m() const { return plant.wheel(0).position_rad * kRadius_m; }

  Plant plant;
  double fastest_change_mps2 = 0;

 private:
  std::array<double, 4> sum_{};
};

TEST_F(OnGround, MakesAsMuchLessWayAsItSlips) {
  for (const double speed_mps : {0.2, 0.5, 1.0, -0.5})
    for (const double share : {0.1, 0.3, 0.35}) {
      plant.place(0, 0, 0);
      drive(speed_mps, 2);
      slip(share);
      drive(speed_mps, 0.5);
      const double x_m = plant.pose().x_m;
      const double from_m = rolled_m();
      drive(speed_mps, 2);
      EXPECT_NEAR((plant.pose().x_m - x_m) / (rolled_m() - from_m), 1 - share, 0.01)
          << share << " at " << speed_mps;
      EXPECT_NEAR(plant.pose().y_m, 0, 0.005);
      slip(0);
    }
}

TEST_F(OnGround, StandsWhereItStandsThoughTheGroundGivesWay) {
  slip(0.3);
  drive(0, 5);
  EXPECT_NEAR(plant.pose().x_m, 0, 1e-3);
}

TEST_F(OnGround, TurnsWhenOneSideSlips) {
  drive(0.5, 2);
  for (std::size_t joint = 0; joint < 4; ++joint)
    plant.set_slip(joint, plant.is_left(joint) ? 0.1 : 0);
  drive(0.5, 2);
  EXPECT_GT(plant.pose().yaw_rad, 0.03);
}

TEST_F(OnGround, SlidesAsideByAShareOfItsSpeed) {
  for (const double speed_mps : {0.25, 0.5, 1.0}) {
    plant.place(0, 0, 0);
    plant.set_sideslip(0.02, kPi / 2);
    drive(speed_mps, 2);
    const auto from = plant.pose();
    drive(speed_mps, 4);
    const auto to = plant.pose();
    EXPECT_NEAR((to.y_m - from.y_m) / (to.x_m - from.x_m), 0.02, 0.001) << speed_mps;
    EXPECT_NEAR(to.yaw_rad, 0, 0.01);
  }
  plant.set_sideslip(0.02, kPi / 2);
  drive(0, 2);
  const double y_m = plant.pose().y_m;
  drive(0, 5);
  EXPECT_NEAR(plant.pose().y_m, y_m, 1e-3);  // it stands
}

TEST_F(OnGround, IsShovedAsFarAsItIsSaidWhileItStandsAndWhileItRolls) {
  for (const double speed_mps : {0.0, 0.5, 1.0})
    for (const double aside_m : {0.14, -0.25, 0.40}) {
      plant.place(0, 0, 0);
      drive(speed_mps, 2);
      const auto from = plant.pose();
      const double from_m = rolled_m();
      fastest_change_mps2 = 0;
      plant.shove({0, aside_m, 0, 0.4});
      drive(speed_mps, 0.8);
      EXPECT_NEAR(plant.pose().y_m - from.y_m, aside_m, 0.01) << speed_mps;
      EXPECT_NEAR(plant.pose().x_m - from.x_m, 0.8 * speed_mps, 0.03) << aside_m;
      EXPECT_NEAR(rolled_m() - from_m, 0.8 * speed_mps, 0.01);
      EXPECT_NEAR(plant.pose().yaw_rad, from.yaw_rad, 0.01);
      EXPECT_LT(fastest_change_mps2, 20);
      EXPECT_GT(fastest_change_mps2, 3);
      EXPECT_NEAR(plant.velocity().vy_mps, 0, 0.02);
    }
}

/// Its wheels turn it against whoever shoves it; once that is over they do.
TEST_F(OnGround, IsFreeWhenAShoveIsOver) {
  plant.place(0, 0, 0);
  drive(0.5, 2);
  plant.shove({0, 0.14, 0, 0.4});
  drive(0.3, 0.7, 0.4);
  const double turned_rad = plant.pose().yaw_rad;
  drive(0.3, 0.7, 1);
  EXPECT_GT(plant.pose().yaw_rad - turned_rad, 0.2);
}

TEST_F(OnGround, IsShovedAlongItsOwnAxesAndTurned) {
  plant.place(1, 2, kPi / 2);
  // Braked: a drive would roll back what the shove has rolled.
  for (std::size_t joint = 0; joint < 4; ++joint) plant.set_holding_torque(joint, 40);
  drive(0, 1);
  plant.shove({0.1, 0.2, to_rad(10), 0.5});
  drive(0, 1.5);
  EXPECT_NEAR(plant.pose().x_m, 1 - 0.2, 0.015);
  EXPECT_NEAR(plant.pose().y_m, 2 + 0.1, 0.015);
  EXPECT_NEAR(to_deg(plant.pose().yaw_rad), 100, 1);
}

class OnSideSlope : public OnGround {
 protected:
  OnSideSlope() : OnGround("side_slope") {}
};

TEST_F(OnSideSlope, IsLevelUntilItIsTilted) {
  plant.place(2, 0, 0);
  drive(0.5, 20);
  EXPECT_NEAR(plant.pose().y_m, 0, 0.002);
  EXPECT_NEAR(plant.pose().roll_rad, 0, 1e-3);
}

TEST_F(OnSideSlope, SlipsDownhillInProportionToItsWayAndLeavesItLevel) {
  for (const double tilt_deg : {2.0, 5.0})
    for (const double speed_mps : {0.25, 0.5, 1.0}) {
      ASSERT_TRUE(plant.set_side_slope(to_rad(tilt_deg)));
      plant.place(3, 0, 0);
      drive(speed_mps, 7 / speed_mps);
      EXPECT_NEAR(to_deg(plant.pose().roll_rad), tilt_deg, 0.2);
      const auto from = plant.pose();
      drive(speed_mps, 10 / speed_mps);
      const auto to = plant.pose();
      // Along the slope, and without what it turns by.
      const double way_m = to.x_m - from.x_m;
      const double aside_m = (to.y_m - from.y_m) / std::cos(to_rad(tilt_deg)) -
                             way_m * (from.yaw_rad + to.yaw_rad) / 2;
      std::printf("side slope of %.0f degrees at %.2f m/s: slips %.2f %% of its way\n", tilt_deg,
                  speed_mps, -100 * aside_m / way_m);
      // Its weight's part down the slope over the tyres' stiffness to creep, 1500 N for each.
      const double creep = 60 * 9.81 * std::sin(to_rad(tilt_deg)) / (4 * 1500);
      EXPECT_NEAR(-aside_m / way_m, creep, 0.2 * creep);
      drive(speed_mps, 14 / speed_mps);
      EXPECT_GT(plant.pose().x_m, 32);
      EXPECT_NEAR(plant.pose().roll_rad, 0, 0.005);
    }
}

TEST(APlant, HasNoSideSlopeWhereTheWorldHasNone) {
  Plant plant(std::string(DROVER_SOURCE_DIR) + "/sim/worlds/field.xml");
  EXPECT_FALSE(plant.set_side_slope(0.05));
}

}  // namespace
}  // namespace drover::sim
