// A robot on mecanum wheels that a ROS 2 user drives to the side by /cmd_vel.
#include <cmath>

#include "integration/ros2_drive_rig.h"
#include "json/located_json.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;

class DrivenToTheSide : public MovedFromRos2 {
 protected:
  DrivenToTheSide() : MovedFromRos2(R"("e_stop": true, "cmd_vel": "twist")") {
    edit("sim.json", "field.xml", "mecanum.xml");
    edit("drover.json",
         R"("kind": "skid_steer", "wheel_radius_m": 0.165, "track_m": 0.6,
      "yaw_slip_factor": 1.69,)",
         R"("kind": "mecanum", "wheel_radius_m": 0.076, "track_m": 0.44, "wheelbase_m": 0.3,)");
    edit("drover.json", R"("hold": "brake")", R"("hold": "level_ground_only")");
    // Its wheels are known to be right.
    add_section(R"("navigate": {"first_way_m": 0})");
  }

  struct Truth {
    double x_m = 0;
    double y_m = 0;
    double yaw_rad = 0;
    double vy_mps = 0;
  };
  Truth truth() {
    const auto told = json::parse(sim({"truth"}));
    const auto number = [&](const char* key) {
      const auto* node = told ? told->root.find(key) : nullptr;
      EXPECT_NE(node, nullptr) << key;
      return node != nullptr ? node->number().value_or(99) : 99;
    };
    return {number("x_m"), number("y_m"), number("yaw_rad"), number("vy_mps")};
  }
  bool say_until(double vy_mps, const std::function<bool()>& done) {
    const geometry_msgs_msg_dds__Twist_ message{{0, vy_mps, 0}, {0, 0, 0}};
    return repeat_until([&] { dds_write(writer_, &message); }, 50ms, done);
  }
};

TEST_F(DrivenToTheSide, GoesThereAndTellsIt) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::cmd_vel_kind(false)));
  const double zero_s = now_s();
  (void)say_until(0, [&] { return now_s() > zero_s + 0.8; });
  const Truth from = truth();
  double told_mps = 0;
  double true_mps = 0;
  ASSERT_TRUE(say_until(0.3, [&] {
    const Truth now = truth();
    if (now.y_m - from.y_m > 0.6 && told_mps == 0) {
      told_mps = status_number("robot", "vy");
      true_mps = now.vy_mps;
    }
    return now.y_m - from.y_m > 1;
  })) << status();
  ASSERT_TRUE(wait_until([this] { return std::abs(truth().vy_mps) < 0.01; }));
  const Truth to = truth();
  EXPECT_NEAR(to.x_m - from.x_m, 0, 0.1);
  EXPECT_NEAR(to.yaw_rad - from.yaw_rad, 0, 3 * M_PI / 180);
  EXPECT_NEAR(true_mps, 0.3, 0.03);
  EXPECT_NEAR(told_mps, true_mps, 0.03);
  // The gateway knows where it is, too.
  EXPECT_NEAR(status_number("robot", "vx"), 0, 0.05);
}

}  // namespace
}  // namespace drover::test
