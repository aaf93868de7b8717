// A robot on mecanum wheels goes to any side, as its wheels turn, and keeps its heading.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sim/plant/plant.h"

namespace drover::sim {
namespace {

constexpr double kRollerWheel_m = 0.076;

class OnRollers : public ::testing::Test {
 protected:
  /// Rim speeds: front left, front right, rear left, rear right.
  void drive(const std::array<double, 4>& rims_mps, double time_s) {
    const auto steps = static_cast<int>(std::lround(time_s / plant.timestep_s()));
    for (int i = 0; i < steps; ++i) {
      for (std::size_t k = 0; k < kNames.size(); ++k) {
        const std::size_t joint = plant.joint(kNames[k]);
        const double error = rims_mps[k] / kRollerWheel_m - plant.wheel(joint).velocity_radps;
        sums_[k] += error * plant.timestep_s();
        plant.set_torque(joint, std::clamp(0.5 * error + 3 * sums_[k], -5.0, 5.0));
      }
      plant.step();
    }
  }

  static constexpr std::array kNames{"front_left", "front_right", "rear_left", "rear_right"};
  Plant plant{std::string(DROVER_SOURCE_DIR) + "/sim/worlds/mecanum.xml"};

 private:
  std::array<double, 4> sums_{};
};

TEST_F(OnRollers, GoesToTheLeftWhereItsWheelsTurnAgainstEachOther) {
  drive({-0.3, 0.3, 0.3, -0.3}, 4);
  EXPECT_NEAR(plant.pose().y_m, 1.2, 0.12);
  EXPECT_NEAR(plant.pose().x_m, 0, 0.02);
  EXPECT_NEAR(plant.pose().yaw_rad, 0, 0.02);
  EXPECT_NEAR(plant.velocity().vy_mps, 0.3, 0.02);
}

TEST_F(OnRollers, GoesAheadWhereTheyTurnAlike) {
  drive({0.3, 0.3, 0.3, 0.3}, 4);
  EXPECT_NEAR(plant.pose().x_m, 1.2, 0.12);
  EXPECT_NEAR(plant.pose().y_m, 0, 0.02);
}

TEST_F(OnRollers, TurnsAsOneThatIsATrackAndAWheelbaseWide) {
  drive({-0.2, 0.2, -0.2, 0.2}, 3);
  EXPECT_NEAR(plant.velocity().wz_radps, 0.2 / ((0.44 + 0.30) / 2), 0.03);
  EXPECT_NEAR(std::hypot(plant.pose().x_m, plant.pose().y_m), 0, 0.02);
}

}  // namespace
}  // namespace drover::sim
