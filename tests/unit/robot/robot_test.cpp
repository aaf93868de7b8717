// The robot between its wires: frames reach the right drives, contacts follow the world, commands
// do what they say, and two runs are equal to the bit.
#include "unit/robot/robot_rig.h"

namespace drover::sim {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST_F(RobotTest, RefusesAJointThatTheWorldDoesNotHave) {
  scenario.drives[2].joints = {"tail"};
  EXPECT_THROW(make(), std::runtime_error);
}

TEST_F(RobotTest, RefusesUnknownCommandsAndChangesNothing) {
  auto robot = make();
  for (const auto* text : {"",
                           "  ",
                           "dance",
                           "estop",
                           "estop maybe",
                           "zone middle occupied",
                           "zone near",
                           "obstacle obstacle 1",
                           "obstacle cow 1 1",
                           "obstacle obstacle nan 0",
                           "kick 1",
                           "kick 1 x",
                           "gnss",
                           "gnss sunny",
                           "imu",
                           "imu frozen",
                           "drive front_left",
                           "drive front_left power",
                           "drive tail power on",
                           "drive all fault broken",
                           "drive all fault"})
    EXPECT_THAT(robot.command(text), StartsWith("error: ")) << text;
  run(robot, kTick);
  for (std::size_t i = 0; i < kLineNames; ++i)
    EXPECT_TRUE(robot.line_high(static_cast<LineName>(i)));
}

TEST_F(RobotTest, IgnoresFramesOfAnotherBus) {
  auto robot = make();
  robot.on_frame(1, make_frame(1, {9}), now);
  run(robot, std::chrono::seconds(1));
  EXPECT_NEAR(robot.truth().pose.x_m, 0, 1e-3);
  EXPECT_TRUE(robot.frames(1).empty());
}

TEST_F(RobotTest, IgnoresErrorFrames) {
  auto robot = make();
  auto frame = make_frame(1, {9});
  frame.error = true;
  robot.on_frame(0, frame, now);
  robot.step(now);
  EXPECT_EQ(robot.truth().wheels[0].torque_Nm, 0);
}

TEST_F(RobotTest, SendsAnswersAndTheTicksFramesAndKeepsLaterOnes) {
  auto robot = make();
  robot.on_frame(0, make_frame(1, {3}), now);
  robot.step(now);
  ASSERT_EQ(robot.frames(0).size(), 5U);
  EXPECT_EQ(robot.frames(0)[0], make_frame(0x101, {3}));
  EXPECT_EQ(robot.frames(0)[1].id, 0x201U);
  robot.step(now + kTick);
  ASSERT_EQ(robot.frames(0).size(), 8U);
  EXPECT_EQ(robot.frames(0)[0].id, 0x301U);  // fell due between the ticks
}

TEST_F(RobotTest, DrivesWhereItsDrivesTurn) {
  auto robot = make();
  for (std::uint32_t i = 1; i <= 4; ++i) robot.on_frame(0, make_frame(i, {3}), now);
  run(robot, std::chrono::seconds(3));
  EXPECT_GT(robot.truth().pose.x_m, 1);
  EXPECT_GT(robot.truth().wheels[0].velocity_radps, 1);
  EXPECT_EQ(robot.truth().wheels[0].torque_Nm, 3);
}

TEST_F(RobotTest, TellsTheReceiverWhereItsAntennaIs) {
  scenario.start_yaw_deg = 90;  // north
  scenario.gnss->heading_offset_deg = 30;
  auto robot = make();
  robot.step(now);
  // One metre of latitude is 1 / 111 267 degree at 52 degrees north.
  EXPECT_NEAR((seen.latitude_deg - 52) * 111267, 1, 1e-3);
  EXPECT_NEAR(seen.longitude_deg, 13, 1e-8);
  EXPECT_NEAR(seen.heading_deg, 30, 1e-6);
  EXPECT_EQ(robot.gnss_bytes(), "$");
}

TEST_F(RobotTest, TellsTheInertialSensorGravityAndTheMotionOfItsPlace) {
  scenario.imu.emplace();
  scenario.imu->y_m = 0.5;
  auto robot = make();
  run(robot, std::chrono::seconds(2));
  EXPECT_EQ(robot.imu_bytes(), "U");
  EXPECT_EQ(robot.imu_baud(), 9600);
  EXPECT_NEAR(felt.specific_force_mps2.x, 0, 0.02);
  EXPECT_NEAR(felt.specific_force_mps2.y, 0, 0.02);
  EXPECT_NEAR(felt.specific_force_mps2.z, 9.80665, 0.05);
  // Turning on the spot pulls the sensor towards the middle, from the left to the right.
  for (std::uint32_t i = 1; i <= 4; ++i)  // the drives of the right side are the even ones
    robot.on_frame(0, make_frame(i, {static_cast<std::uint8_t>(i % 2 == 0 ? 60 : 0)}), now);
  run(robot, std::chrono::milliseconds(400));
  double sum_force = 0;
  double sum_square = 0;
  double sum_rate = 0;
  double before_rad = robot.truth().pose.yaw_rad;
  for (int i = 0; i < 40; ++i) {
    run(robot, kTick);
    sum_force += felt.specific_force_mps2.y / 40;
    sum_square += felt.angular_velocity_radps.z * felt.angular_velocity_radps.z / 40;
    sum_rate += felt.angular_velocity_radps.z * to_s(kTick);
  }
  EXPECT_GT(sum_square, 0.1);
  EXPECT_NEAR(sum_rate, robot.truth().pose.yaw_rad - before_rad, 0.02);
  EXPECT_LT(sum_force, 0);
}

TEST_F(RobotTest, PassesStatesOfTheInertialSensorOn) {
  scenario.imu.emplace();
  auto robot = make();
  EXPECT_EQ(robot.command("imu frozen"), "ok");
  EXPECT_EQ(robot.command("imu well"), "ok");
  EXPECT_THAT(robot.command("imu"), StartsWith("error: "));
  EXPECT_THAT(robot.command("imu tired"), StartsWith("error: "));
}

/// The ids of what is sent on a bus.
std::vector<std::uint32_t> ids_of(const std::vector<CanFrame>& frames) {
  std::vector<std::uint32_t> ids;
  ids.reserve(frames.size());
  for (const CanFrame& frame : frames) ids.push_back(frame.id);
  return ids;
}

TEST_F(RobotTest, LetsAnInertialSensorSpeakAndHearOnItsBusAlone) {
  scenario.imu.emplace();
  scenario.imu->bus = 1;
  auto robot = make();
  robot.on_frame(1, make_frame(0x600), now);
  robot.on_frame(0, make_frame(0x600), now);
  robot.step(now);
  EXPECT_THAT(ids_of(robot.frames(1)), testing::ElementsAre(0x580, 0x188));
  EXPECT_EQ(robot.frames(0).size(), 4U) << "the drives";
  EXPECT_TRUE(robot.imu_bytes().empty());
  robot.step(now + kTick);
  EXPECT_THAT(ids_of(robot.frames(1)), testing::ElementsAre(0x188)) << "it answered once";
  EXPECT_EQ(robot.command("imu silent"), "ok");
  EXPECT_EQ(robot.command("imu well"), "ok");
  EXPECT_THAT(robot.command("imu tired"), StartsWith("error: "));
}

TEST_F(RobotTest, SharesABusBetweenDrivesAndAnInertialSensor) {
  scenario.imu.emplace();
  scenario.imu->bus = 0;
  auto robot = make();
  robot.step(now);
  EXPECT_EQ(robot.frames(0).size(), 5U);
  EXPECT_THAT(ids_of(robot.frames(0)), testing::Contains(0x188));
}

TEST_F(RobotTest, HearsNothingOfASensorThatIsUnpluggedFromItsBusAndRestartsItWhenItIsBack) {
  scenario.imu.emplace();
  scenario.imu->bus = 1;
  auto robot = make();
  robot.on_frame(1, make_frame(0x600), now);
  EXPECT_EQ(robot.command("imu unplug"), "ok");
  robot.on_frame(1, make_frame(0x600), now);
  robot.step(now);
  EXPECT_TRUE(robot.frames(1).empty());
  EXPECT_EQ(on_can->restarts, 0);
  EXPECT_EQ(robot.command("imu plug"), "ok");
  EXPECT_EQ(on_can->restarts, 1);
  robot.step(now + kTick);
  EXPECT_THAT(ids_of(robot.frames(1)), testing::ElementsAre(0x188));
}

TEST_F(RobotTest, PullsTheLineOfAPressedButtonLow) {
  auto robot = make();
  EXPECT_TRUE(robot.line_high(LineName::estop));
  EXPECT_EQ(robot.command("estop press"), "ok");
  EXPECT_FALSE(robot.line_high(LineName::estop));
  EXPECT_EQ(robot.command("estop release"), "ok");
  EXPECT_TRUE(robot.line_high(LineName::estop));
}

TEST_F(RobotTest, TurnsTheLevelsRoundWhereTheScenarioSaysSo) {
  scenario.lines[0].active_high = true;
  auto robot = make();
  EXPECT_FALSE(robot.line_high(LineName::estop));
  robot.command("estop press");
  EXPECT_TRUE(robot.line_high(LineName::estop));
}

TEST_F(RobotTest, SeesAnObstacleInItsZonesUntilItIsGone) {
  auto robot = make();
  EXPECT_EQ(robot.command("obstacle obstacle 2.0 0"), "ok");
  robot.step(now);
  EXPECT_FALSE(robot.line_high(LineName::zone_far));
  EXPECT_TRUE(robot.line_high(LineName::zone_near));
  EXPECT_EQ(robot.command("obstacle obstacle 1.2 0"), "ok");
  robot.step(now + kTick);
  EXPECT_FALSE(robot.line_high(LineName::zone_near));
  EXPECT_EQ(robot.command("obstacle obstacle remove"), "ok");
  robot.step(now + 2 * kTick);
  EXPECT_TRUE(robot.line_high(LineName::zone_far));
  EXPECT_TRUE(robot.line_high(LineName::zone_near));
}

TEST_F(RobotTest, ForcesAZoneUntilItIsLeftToTheWorldAgain) {
  auto robot = make();
  robot.command("zone near occupied");
  run(robot, 2 * kTick);
  EXPECT_FALSE(robot.line_high(LineName::zone_near));
  robot.command("zone near free");
  EXPECT_TRUE(robot.line_high(LineName::zone_near));
}

TEST_F(RobotTest, FeelsABoxWithItsBumper) {
  auto robot = make();
  robot.command("obstacle obstacle 1.0 0");
  for (std::uint32_t i = 1; i <= 4; ++i) robot.on_frame(0, make_frame(i, {4}), now);
  bool touched = false;
  for (int i = 0; i < 600; ++i, now += kTick) {
    robot.step(now);
    touched = touched || !robot.line_high(LineName::bumper);
  }
  EXPECT_TRUE(touched);
}

TEST_F(RobotTest, LosesADriveWithoutSupply) {
  auto robot = make();
  EXPECT_EQ(robot.command("drive front_left power off"), "ok");
  robot.on_frame(0, make_frame(1, {9}), now);
  robot.step(now);
  EXPECT_EQ(robot.frames(0).size(), 3U);
  EXPECT_EQ(robot.command("drive front_left power on"), "ok");
  robot.step(now + kTick);
  EXPECT_EQ(robot.truth().wheels[0].torque_Nm, 0);
  EXPECT_EQ(robot.frames(0).size(), 3U + 4U);
}

TEST_F(RobotTest, TakesTheDrivesSupplyAwayWithTheButtonWhereItIsWiredSo) {
  scenario.estop_cuts_power = true;
  auto robot = make();
  robot.command("estop press");
  robot.step(now);
  EXPECT_TRUE(robot.frames(0).empty());
  robot.command("estop release");
  robot.step(now + kTick);
  EXPECT_EQ(robot.frames(0).size(), 4U);
}

TEST_F(RobotTest, PassesFaultsAndReceiverStatesOn) {
  auto robot = make();
  EXPECT_EQ(robot.command("drive all fault hot"), "ok");
  EXPECT_EQ(robot.command("drive all fault none"), "ok");
  EXPECT_EQ(robot.command("gnss float"), "ok");
}

TEST_F(RobotTest, AnswersWithTheTruth) {
  auto robot = make();
  robot.step(now);
  EXPECT_THAT(robot.command("truth"), StartsWith("{\"time_s\":100.000000000,\"x_m\":"));
  EXPECT_THAT(robot.command("truth"), HasSubstr("\"yaw_rad\":"));
}

TEST_F(RobotTest, GivesTheSameBitsTwice) {
  const auto drive = [this] {
    auto robot = make();
    now = Time{std::chrono::seconds(100)};
    robot.on_frame(0, make_frame(1, {2}), now);
    robot.on_frame(0, make_frame(2, {5}), now);
    run(robot, std::chrono::seconds(2));
    robot.command("kick 0.3 -0.2");
    run(robot, std::chrono::seconds(2));
    const auto& truth = robot.truth();
    return std::array{truth.pose.x_m,     truth.pose.y_m,
                      truth.pose.yaw_rad, truth.wheels[3].position_rad,
                      seen.latitude_deg,  seen.longitude_deg};
  };
  EXPECT_EQ(drive(), drive());
}

}  // namespace
}  // namespace drover::sim
