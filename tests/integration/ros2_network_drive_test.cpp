// In "network" a ROS 2 program on another computer has another clock: what it says counts from when
// drover-ros2 was told of it. The network is a namespace's.
#include "integration/ros2_drive_rig.h"
#include "integration/two_computers.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr double kRamp_s = 1.5;  ///< from 0.4 m/s, and what is on its way
constexpr double kSilent_s = 0.3;

/// In `network` clocks differ: a message is as old as it is here.
class DrivenFromAComputerWithAnotherClock : public TwoComputers, public MovedFromRos2 {
 protected:
  explicit DrivenFromAComputerWithAnotherClock(
      const std::string& more = R"(, "mode": "network", "network_inputs": true)")
      : MovedFromRos2(R"("cmd_vel": "twist", "collision_object": true)", more) {
    add_section(R"("scene": {
      "footprint": [{"x_m": 0.45, "y_m": 0.35}, {"x_m": -0.415, "y_m": 0.35},
                    {"x_m": -0.415, "y_m": -0.35}, {"x_m": 0.45, "y_m": -0.35}],
      "ground_clearance_m": 0.05, "height_m": 1})");
  }
  /// Zeros first, each said an hour ago by that clock; true: it moves.
  bool moves_by_its_words() {
    const double begin_s = now_s();
    return repeat_until(
        [&] {
          const geometry_msgs_msg_dds__Twist_ message{{now_s() - begin_s < 2 ? 0 : 0.3, 0, 0}, {}};
          dds_write_ts(writer_, &message, dds_time() - DDS_SECS(3600));
        },
        50ms, [this] { return true_speed_mps() > 0.1; }, 20s);
  }
};

TEST_F(DrivenFromAComputerWithAnotherClock, MovesAsToldAndStopsWhenItIsSilent) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::cmd_vel_kind(false)));
  for (const char* said : {"whoever reaches", "may move this robot", "may put things around"})
    EXPECT_THAT(program_.output(), HasSubstr(said));
  ASSERT_TRUE(moves_by_its_words()) << status() << program_.output();
  const double last_s = now_s();
  ASSERT_TRUE(wait_until([this] { return at_rest(); }));
  (void)wait_until([] { return false; }, 2s);
  expect_rest_on_the_bus_from(last_s + kSilent_s + kRamp_s);
}

class DrivenByAWrongClock : public DrivenFromAComputerWithAnotherClock {
 protected:
  DrivenByAWrongClock() : DrivenFromAComputerWithAnotherClock("") {}
};

// Else the test above would show nothing.
TEST_F(DrivenByAWrongClock, DoesNotMoveInLocalhost) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::cmd_vel_kind(false)));
  EXPECT_FALSE(moves_by_its_words());
  EXPECT_THAT(status(), HasSubstr("too late"));
}

}  // namespace
}  // namespace drover::test
