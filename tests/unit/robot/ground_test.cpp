// Slip, slopes, shoves and what sensors feel of them; and what was built otherwise than it is told.
#include "unit/robot/robot_rig.h"

#include <algorithm>
#include <cmath>

namespace drover::sim {
namespace {

using testing::StartsWith;

constexpr double kRadius_m = 0.165;

class MovedRobot : public RobotTest {
 protected:
  MovedRobot() { scenario.imu.emplace(); }
  void set_off(Robot& robot) {
    for (std::uint32_t i = 1; i <= 4; ++i) robot.on_frame(0, make_frame(i, {1}), now);
    run(robot, std::chrono::seconds(4));
  }
  struct Way {
    double rolled_m = 0;
    double ahead_m = 0;
    double left_m = 0;
    double felt_most_mps2 = 0;  ///< along the ground
  };
  Way watch(Robot& robot, Duration time) {
    const auto from = robot.truth();
    Way way;
    for (const Time end = now + time; now < end; now += kTick) {
      robot.step(now);
      const auto& force = felt.specific_force_mps2;
      way.felt_most_mps2 = std::max(way.felt_most_mps2, std::hypot(force.x, force.y));
    }
    const auto& to = robot.truth();
    const double c = std::cos(from.pose.yaw_rad);
    const double s = std::sin(from.pose.yaw_rad);
    const double dx = to.pose.x_m - from.pose.x_m;
    const double dy = to.pose.y_m - from.pose.y_m;
    way.ahead_m = c * dx + s * dy;
    way.left_m = c * dy - s * dx;
    way.rolled_m = (to.wheels[0].position_rad - from.wheels[0].position_rad) * kRadius_m;
    return way;
  }
};

TEST_F(MovedRobot, RefusesWhatTheGroundCannotDo) {
  auto robot = make();
  for (const auto* text :
       {"slip", "slip 0.3", "slip 1 2", "slip -0.1 2", "slip 0.3 0", "slip 0.3 2 middle",
        "sideslip", "sideslip 2", "sideslip 0.02 north", "shove 0 0.2", "shove 0 0.2 0",
        "shove 0 0.2 1 x", "slope", "slope 16", "slope 2"})  // the field has no side slope
    EXPECT_THAT(robot.command(text), StartsWith("error: ")) << text;
  const auto way = watch(robot, std::chrono::seconds(1));
  EXPECT_NEAR(std::hypot(way.ahead_m, way.left_m), 0, 1e-3);
}

TEST_F(MovedRobot, MakesSoMuchLessWayAsLongAsItSlipsAndNoLonger) {
  auto robot = make();
  set_off(robot);
  ASSERT_EQ(robot.command("slip 0.3 2"), "ok");
  const auto slipping = watch(robot, std::chrono::milliseconds(2100));
  EXPECT_NEAR(slipping.rolled_m - slipping.ahead_m, 0.3 * slipping.rolled_m,
              0.02 * slipping.rolled_m);
  EXPECT_LT(slipping.felt_most_mps2, 6);  // soft ground is no blow
  run(robot, std::chrono::seconds(1));
  const auto firm = watch(robot, std::chrono::seconds(1));
  EXPECT_NEAR(firm.ahead_m, firm.rolled_m, 0.01 * firm.rolled_m);
}

// These drives hold a torque, not a speed: the wheels of the side that slips turn faster.
TEST_F(MovedRobot, SlipsOnTheSideThatItIsTold) {
  auto robot = make();
  set_off(robot);
  ASSERT_EQ(robot.command("slip 0.2 2 right"), "ok");
  const auto before = robot.truth().wheels;
  run(robot, std::chrono::seconds(2));
  const auto& after = robot.truth().wheels;
  const double left_rad = after[0].position_rad - before[0].position_rad;
  const double right_rad = after[1].position_rad - before[1].position_rad;
  EXPECT_NEAR(left_rad / right_rad, 0.8, 0.02);
}

TEST_F(MovedRobot, SlidesToTheLeftItHadThenOrWhereItIsTold) {
  auto robot = make();
  set_off(robot);
  ASSERT_EQ(robot.command("sideslip 0.05"), "ok");
  const auto left = watch(robot, std::chrono::seconds(3));
  EXPECT_NEAR(left.left_m, 0.05 * left.ahead_m, 0.003 * left.ahead_m);
  ASSERT_EQ(robot.command("sideslip 0.05 -90"), "ok");
  run(robot, std::chrono::seconds(1));
  EXPECT_LT(watch(robot, std::chrono::seconds(3)).left_m, -0.05);
  ASSERT_EQ(robot.command("sideslip 0"), "ok");
  run(robot, std::chrono::seconds(1));
  EXPECT_NEAR(watch(robot, std::chrono::seconds(3)).left_m, 0, 0.01);
}

TEST_F(MovedRobot, FeelsAShoveWithItsInertialSensorAndRollsOn) {
  auto robot = make();
  set_off(robot);
  ASSERT_EQ(robot.command("shove 0 0.25 0.4"), "ok");
  const auto way = watch(robot, std::chrono::milliseconds(600));
  EXPECT_NEAR(way.left_m, 0.25, 0.01);
  EXPECT_GT(way.felt_most_mps2, 6);
  EXPECT_LT(way.felt_most_mps2, 20);
  EXPECT_NEAR(way.ahead_m, way.rolled_m, 0.03);
}

TEST_F(MovedRobot, FeelsHowItIsCarriedThoughNoWheelTurns) {
  auto robot = make();
  run(robot, std::chrono::seconds(1));
  ASSERT_EQ(robot.command("carry 0 1 0 1"), "ok");
  const auto way = watch(robot, std::chrono::milliseconds(1200));
  EXPECT_NEAR(way.left_m, 1, 0.01);
  EXPECT_NEAR(way.rolled_m, 0, 1e-3);
  EXPECT_GT(way.felt_most_mps2, 3);
  EXPECT_LT(way.felt_most_mps2, 20);
}

TEST_F(MovedRobot, TellsTheReceiverWhereItPointsHoweverItsAntennasAreMounted) {
  scenario.start_yaw_deg = 30;
  scenario.gnss->heading_offset_deg = 3;
  auto robot = make();
  robot.step(now);
  EXPECT_NEAR(seen.ahead_deg, 60, 1e-6);
  EXPECT_NEAR(seen.heading_deg, 63, 1e-6);
}

TEST_F(MovedRobot, TakesTheNumbersOfAStateAsWords) {
  auto robot = make();
  EXPECT_EQ(robot.command("gnss float"), "ok");
  EXPECT_THAT(robot.command("gnss float 1"), StartsWith("error: no receiver state 'float:1'"));
  EXPECT_THAT(robot.command("gnss drift 20 90"),
              StartsWith("error: no receiver state 'drift:20:90'"));
}

}  // namespace
}  // namespace drover::sim
