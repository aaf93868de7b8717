// Drives of several joints and drives on a serial line, between their wires and the wheels.
#include "unit/robot/robot_rig.h"

namespace drover::sim {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::StartsWith;

/// Two wheels behind one address: a frame holds a torque for each.
class FakePair final : public CanTwin {
 public:
  void on_frame(const CanFrame& frame, Time, TwinFrames&) override {
    if (frame.id == 7) torque_Nm_ = {double(frame.data[0]), double(frame.data[1])}, armed_ = true;
  }
  void on_tick(Time, std::span<Shaft> shafts, TwinFrames& out) override {
    shafts_seen = shafts.size();
    ++ticks;
    turned_rad = {shafts.front().position_rad, shafts.back().position_rad};
    for (std::size_t i = 0; i < shafts.size(); ++i) {
      shafts[i].torque_Nm = torque_Nm_[i];
      shafts[i].energized = armed_;
    }
    (void)out.push_back(make_frame(0x707));
  }
  void set_power(bool on, Time) override { armed_ = armed_ && on; }
  bool set_fault(std::string_view name, Time) override {
    fault = name;
    return name == "hot";
  }
  std::size_t shafts_seen = 0;
  int ticks = 0;
  std::array<double, 2> turned_rad{};
  std::string fault;

 private:
  std::array<double, 2> torque_Nm_{};
  bool armed_ = false;
};

/// A chassis on a serial line: each byte is a torque for all its wheels, and is echoed.
class FakeChassis final : public ByteDriveTwin {
 public:
  void on_bytes(std::span<const std::uint8_t> bytes, Time) override {
    heard.insert(heard.end(), bytes.begin(), bytes.end());
    waiting_.append(bytes.begin(), bytes.end());
  }
  std::size_t on_tick(Time, std::span<Shaft> shafts, std::span<char> out) override {
    for (Shaft& shaft : shafts) {
      shaft.torque_Nm = heard.empty() ? 0 : heard.back();
      shaft.energized = !heard.empty();
    }
    const auto size = waiting_.copy(out.data(), out.size());
    waiting_.clear();
    return size;
  }
  void set_power(bool, Time) override {}
  bool set_fault(std::string_view name, Time) override { return name.empty(); }
  std::vector<std::uint8_t> heard;

 private:
  std::string waiting_;
};

class DrivesTest : public RobotTest {
 protected:
  /// The wheels of each side behind one address.
  Robot make_pairs() {
    scenario.drives.clear();
    Twins twins;
    for (const std::string side : {"left", "right"}) {
      DriveSpec& drive = scenario.drives.emplace_back();
      drive.name = side;
      drive.joints = {"front_" + side, "rear_" + side};
      auto twin = std::make_unique<FakePair>();
      pairs.push_back(twin.get());
      twins.drives.push_back(std::move(twin));
    }
    scenario.drives[1].bus = 1;
    twins.gnss = std::make_unique<FakeReceiver>(&seen);
    return {scenario, std::move(twins)};
  }
  Robot make_chassis() {
    scenario.drives = {DriveSpec{}};
    scenario.drives[0].joints = {"front_left", "front_right", "rear_left", "rear_right"};
    scenario.drives[0].serial.emplace();
    Twins twins;
    auto twin = std::make_unique<FakeChassis>();
    chassis = twin.get();
    twins.drives.push_back(std::move(twin));
    twins.gnss = std::make_unique<FakeReceiver>(&seen);
    return {scenario, std::move(twins)};
  }
  std::vector<FakePair*> pairs;
  FakeChassis* chassis = nullptr;
};

TEST_F(DrivesTest, OfTwoJointsTurnsEachByItsOwnTorque) {
  auto robot = make_pairs();
  robot.on_frame(0, make_frame(7, {9, 8}), now);
  run(robot, seconds(2));
  const auto& wheels = robot.truth().wheels;
  ASSERT_EQ(wheels.size(), 4U);
  EXPECT_EQ(wheels[0].torque_Nm, 9) << "front_left";
  EXPECT_EQ(wheels[1].torque_Nm, 8) << "rear_left";
  EXPECT_EQ(wheels[2].torque_Nm, 0) << "the other drive hangs on another bus";
  EXPECT_LT(robot.truth().pose.yaw_rad, -0.02) << "only the left wheels drive";
}

TEST_F(DrivesTest, OfTwoJointsIsToldBothShaftsOnceAStep) {
  auto robot = make_pairs();
  robot.on_frame(0, make_frame(7, {3, 0}), now);
  run(robot, milliseconds(500));
  EXPECT_EQ(pairs[0]->shafts_seen, 2U);
  EXPECT_EQ(pairs[0]->ticks, pairs[1]->ticks);
  EXPECT_NEAR(pairs[0]->turned_rad[0], robot.truth().wheels[0].position_rad, 0.05);
  EXPECT_NEAR(pairs[0]->turned_rad[1], robot.truth().wheels[1].position_rad, 0.05);
  EXPECT_GT(pairs[0]->turned_rad[0], 0.1);
  const auto& frames = robot.frames(0);
  EXPECT_EQ(frames.size(), static_cast<std::size_t>(pairs[0]->ticks) / 100)
      << "one for each step of a tick";
}

TEST_F(DrivesTest, IsCalledByItsNameOrByAnyOfItsJoints) {
  auto robot = make_pairs();
  EXPECT_EQ(robot.command("drive rear_left fault hot"), "ok");
  EXPECT_EQ(pairs[0]->fault, "hot");
  EXPECT_EQ(pairs[1]->fault, "");
  EXPECT_EQ(robot.command("drive right fault hot"), "ok");
  EXPECT_EQ(pairs[1]->fault, "hot");
  EXPECT_THAT(robot.command("drive left,tail power off"), StartsWith("error: no drive 'tail'"));
  run(robot, kTick);
  EXPECT_FALSE(robot.frames(0).empty()) << "a refused command changes nothing";
  EXPECT_EQ(robot.command("drive front_left,rear_left power off"), "ok");
  run(robot, 2 * kTick);
  EXPECT_TRUE(robot.frames(0).empty());
  EXPECT_FALSE(robot.frames(1).empty());
}

TEST_F(DrivesTest, WithoutSupplyDrivesNoneOfItsWheelsAndItsBrakesHoldThemAll) {
  scenario.brake = true;
  auto robot = make_pairs();
  robot.on_frame(0, make_frame(7, {3, 3}), now);
  robot.on_frame(1, make_frame(7, {3, 3}), now);
  run(robot, seconds(2));
  EXPECT_GT(robot.truth().velocity.vx_mps, 0.5);
  robot.command("supply dip 1");
  run(robot, milliseconds(800));
  for (const Shaft& wheel : robot.truth().wheels) {
    EXPECT_EQ(wheel.torque_Nm, 0);
    EXPECT_NEAR(wheel.velocity_radps, 0, 0.01);
  }
}

TEST_F(DrivesTest, OnASerialLineHearsWhatIsWrittenAndSaysWhatIsDue) {
  auto robot = make_chassis();
  const std::uint8_t bytes[] = {1, 2};
  robot.on_drive_bytes(0, bytes, now);
  robot.step(now);
  EXPECT_EQ(robot.drive_bytes(0), "\x01\x02");
  robot.step(now + kTick);
  EXPECT_EQ(robot.drive_bytes(0), "");
  now += 2 * kTick;
  run(robot, seconds(1));
  EXPECT_EQ(robot.truth().wheels[3].torque_Nm, 2);
  EXPECT_GT(robot.truth().pose.x_m, 0.1);
}

TEST_F(DrivesTest, OnASerialLineWithoutSupplyIsDeafAndDumb) {
  auto robot = make_chassis();
  EXPECT_EQ(robot.command("drive all power off"), "ok");
  const std::uint8_t bytes[] = {3};
  robot.on_drive_bytes(0, bytes, now);
  robot.step(now);
  EXPECT_EQ(robot.drive_bytes(0), "");
  EXPECT_TRUE(chassis->heard.empty());
}

}  // namespace
}  // namespace drover::sim
