// The field robot's arm on its own twins: its own bus and supply, a push on its tip, and what the
// truth tells of it.
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>

#include "drivers/damiao/codec.h"
#include "sim/robot/log.h"
#include "sim/robot/robot.h"
#include "support/temp_folder.h"

namespace drover::sim {
namespace {

using damiao::MitCommand;
using damiao::Special;

constexpr damiao::Ranges kDm4340{12.5, 10, 28};
constexpr damiao::Ranges kDm4310{12.5, 30, 10};

class Arm {
 public:
  Arm() : scenario(load_scenario(std::string(DROVER_SOURCE_DIR) + "/sim/robots/field_arm.json")) {
    robot = std::make_unique<Robot>(scenario, make_twins(scenario, 1));
  }
  void step() {
    now += kTick;
    robot->step(now);
  }
  void send(const CanFrame& frame) { robot->on_frame(1, frame, now); }
  void enable() {
    run(0.5, {});
    for (std::uint8_t id = 1; id <= 3; ++id) send(damiao::encode_special(id, Special::enable));
  }
  /// Each motor is told the same law about 0.
  void run(double time_s, const MitCommand& law) {
    for (const Time end = now + from_s(time_s); now < end;) {
      for (std::uint8_t id = 1; id <= 3; ++id)
        send(damiao::encode_mit(id, law, id == 3 ? kDm4310 : kDm4340));
      step();
    }
  }
  double rad(std::size_t joint) const { return robot->truth().arm[joint].position_rad; }

  Scenario scenario;
  std::unique_ptr<Robot> robot;
  Time now{std::chrono::seconds(1)};
};

const MitCommand kStiff{.stiffness_Nmprad = 80, .damping_Nmsprad = 4};

TEST(RobotArm, IsNamedAndToldBesideTheWheels) {
  Arm arm;
  arm.step();
  EXPECT_EQ(arm.robot->arm_joints(), (std::vector<std::string>{"base_yaw", "shoulder", "elbow"}));
  EXPECT_EQ(arm.robot->truth().wheels.size(), 4U);
  EXPECT_EQ(arm.robot->truth().arm.size(), 3U);
  const std::string truth = arm.robot->command("truth");
  EXPECT_NE(truth.find(R"("tip_m":[)"), std::string::npos) << truth;
  EXPECT_NE(truth.find(R"("arm_rad":{"base_yaw":)"), std::string::npos) << truth;
  EXPECT_TRUE(truth.ends_with("}}")) << truth;
}

/// The gateway's relay is open here all the time.
TEST(RobotArm, HasASupplyOfItsOwnAndFallsWithoutIt) {
  Arm arm;
  arm.enable();
  arm.run(2, kStiff);
  EXPECT_FALSE(arm.robot->truth().supply);
  EXPECT_NEAR(arm.rad(1), -3.83 / 80, 0.01) << "its weight on the spring";
  EXPECT_EQ(arm.robot->command("drive base_yaw,shoulder,elbow power off"), "ok");
  arm.run(2, kStiff);
  EXPECT_NEAR(arm.rad(1), -0.6, 0.05);
}

TEST(RobotArm, GivesUnderAPushOnItsTipForItsTime) {
  Arm arm;
  arm.enable();
  arm.run(2, kStiff);
  const double before_rad = arm.rad(0);
  EXPECT_EQ(arm.robot->command("push_tip 0 10 0 2"), "ok");
  arm.run(1.9, kStiff);
  EXPECT_NEAR(arm.rad(0) - before_rad, 10 * 0.6 / 80, 0.1 * 10 * 0.6 / 80);
  arm.run(2, kStiff);
  EXPECT_NEAR(arm.rad(0), before_rad, 0.005);
  EXPECT_EQ(arm.robot->command("push_tip 0 10 0"), "error: say: push_tip FX FY FZ SECONDS");
}

TEST(RobotArm, HasItsColumnsBehindThoseOfEveryRobot) {
  const test::TempFolder folder;
  const std::string file = folder.path() + "/truth.csv";
  Arm arm;
  arm.step();
  {
    TruthLog log(file, *arm.robot);
    log.write(arm.robot->truth());
  }
  std::ifstream in(file);
  std::string header, line;
  std::getline(in, header);
  std::getline(in, line);
  EXPECT_TRUE(
      header.ends_with(",supply,base_yaw_rad,base_yaw_radps,base_yaw_Nm,shoulder_rad,"
                       "shoulder_radps,shoulder_Nm,elbow_rad,elbow_radps,elbow_Nm"))
      << header;
  EXPECT_EQ(std::count(header.begin(), header.end(), ','),
            std::count(line.begin(), line.end(), ','));
}

}  // namespace
}  // namespace drover::sim
