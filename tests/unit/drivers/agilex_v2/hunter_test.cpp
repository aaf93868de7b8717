// What a Hunter has that a Scout has not: an angle, and a brake.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <variant>
#include <vector>

#include "drivers/agilex_v2/driver.h"
#include "drivers/agilex_v2/entry.h"
#include "drivers/agilex_v2/hunter/entry.h"
#include "drivers/agilex_v2/hunter/twin.h"

namespace drover::agilex_v2 {
namespace {

using std::chrono::milliseconds;
constexpr auto kDrive = AxisRequest::run;
constexpr auto kStand = AxisRequest::rest;

/// 10 ms cycles; its shafts turn as they are pushed.
struct HunterBench {
  void run(Duration time, AxisRequest request, const Twist& twist = {}) {
    for (const Time end = now + time; now < end;) cycle({request, 0, twist});
  }
  void cycle(const Setpoint& setpoint) {
    DriverOut out;
    for (int i = 0; i < 4; ++i) {
      now += std::chrono::microseconds(2500);
      TwinFrames frames;
      twin.on_tick(now, shafts, frames);
      for (Shaft& shaft : shafts) {
        shaft.velocity_radps += 0.0025 / 0.4 * (shaft.torque_Nm - 0.2 * shaft.velocity_radps);
        shaft.position_rad += 0.0025 * shaft.velocity_radps;
      }
      for (const CanFrame& frame : frames) driver.on_frame(frame, now, out);
    }
    driver.on_setpoints({&setpoint, 1}, now, out);
    driver.on_tick(now, out);
    for (const Measurement& each : out.measurements) {
      if (const auto* value = std::get_if<AxisStatus>(&each.value))
        status = {*value, driver.words(each)};
      if (const auto* value = std::get_if<BodyMotion>(&each.value)) motion = *value;
    }
    TwinFrames frames;
    for (const CanFrame& frame : out.frames) {
      sent.push_back(frame);
      twin.on_frame(frame, now, frames);
    }
  }
  /// Index of the first frame of that id and first byte since `from`; the size: none.
  std::size_t first(std::uint32_t id, std::uint8_t byte, std::size_t from = 0) const {
    for (std::size_t i = from; i < sent.size(); ++i)
      if (sent[i].id == id && sent[i].data[0] == byte) return i;
    return sent.size();
  }
  std::size_t first_motion(std::size_t from = 0) const {
    for (std::size_t i = from; i < sent.size(); ++i)
      if (driver.effect(sent[i], now).kind == FrameEffect::motion) return i;
    return sent.size();
  }
  double told_rad() const { return read_steered_command(sent.back())->inner_rad; }

  static Options options() {
    const auto own = kAgilexHunterEntry.options;
    const auto twins = kAgilexHunterEntry.twin_options;
    std::vector<OptionSpec> all(own.begin(), own.end());
    all.insert(all.end(), twins.begin(), twins.end());
    return Options(all);
  }
  AgilexV2Driver driver{0, Steering{}};
  HunterTwin twin{options(), Steering{}};
  std::array<Shaft, 4> shafts{};
  Time now{std::chrono::seconds(1)};
  StatusInWords status;
  BodyMotion motion;
  std::vector<CanFrame> sent;
};

TEST(HunterSteering, IsThatOfTheInnerWheel) {
  const Steering steering;
  for (const double radpm : {-0.6, -0.1, 0.0, 0.3, 0.7})
    EXPECT_NEAR(steering.radpm(steering.inner_rad(radpm)), radpm, 1e-12);
  EXPECT_NEAR(1 / steering.radpm(0.576), 0.3025 + 0.65 / std::tan(0.576), 1e-9);
  EXPECT_EQ(steering.inner_rad(5), 0.576);
  EXPECT_EQ(steering.inner_rad(-5), -0.576);
  EXPECT_GT(std::abs(steering.inner_rad(0.5)), std::atan(0.65 * 0.5)) << "the middle one's";
}

/// As a motor turns it: what is told in a bend changes no faster than near straight ahead.
TEST(HunterTwin, SteersItsInnerWheelAtItsRate) {
  HunterBench bench;
  bench.run(milliseconds(1000), kStand);
  bench.run(milliseconds(1500), kDrive, {0.1, 0});
  std::vector<double> told_rad;
  for (int i = 0; i < 85; ++i) {
    bench.run(milliseconds(10), kDrive, {0.1, 0.1 / 1.2});
    told_rad.push_back(Steering().inner_rad(std::tan(bench.motion.steering_rad) / 0.65));
  }
  EXPECT_NEAR(told_rad.back(), 0.6 * 0.85, 0.05);
  for (std::size_t i = 20; i < told_rad.size(); ++i)
    ASSERT_LT(told_rad[i] - told_rad[i - 20], 0.6 * 0.2 + 0.004) << i;
}

std::unique_ptr<CanTwin> twin_of(const DriverEntry& entry, const Options& options) {
  return std::get<std::unique_ptr<CanTwin> (*)(const Options&)>(entry.make_twin)(options);
}

/// Without the configuration's reader, too: the curve divides by them.
TEST(HunterEntry, RefusesOptionsOutsideTheirTable) {
  for (const char* name : {"wheelbase_m", "track_m", "max_steering_rad"})
    for (const double bad : {0.0, -0.5, double{NAN}}) {
      const Options options = Options(kAgilexHunterEntry.options).set(name, bad);
      EXPECT_THROW((void)kAgilexHunterEntry.make(options, MakeContext{}), std::runtime_error)
          << name << " " << bad;
    }
  for (const char* name : {"wheel_radius_m", "max_torque_Nm", "steering_rate_radps"})
    for (const double bad : {0.0, double{NAN}}) {
      Options options = HunterBench::options();
      EXPECT_THROW((void)twin_of(kAgilexHunterEntry, options.set(name, bad)), std::runtime_error)
          << name << " " << bad;
    }
}

TEST(ScoutEntry, RefusesOptionsOfItsTwinOutsideTheirTable) {
  std::vector<OptionSpec> all(kAgilexV2Entry.options.begin(), kAgilexV2Entry.options.end());
  all.insert(all.end(), kAgilexV2Entry.twin_options.begin(), kAgilexV2Entry.twin_options.end());
  EXPECT_NO_THROW((void)twin_of(kAgilexV2Entry, Options(all)));
  for (const char* name : {"wheel_radius_m", "track_m", "max_torque_Nm"})
    for (const double bad : {0.0, double{NAN}})
      EXPECT_THROW((void)twin_of(kAgilexV2Entry, Options(all).set(name, bad)), std::runtime_error)
          << name << " " << bad;
}

/// What a configuration that stands on default values says.
TEST(HunterEntry, MakesADriverOfItsDefaults) {
  EXPECT_NO_THROW((void)kAgilexHunterEntry.make(HunterBench::options(), MakeContext{}));
  EXPECT_NO_THROW((void)twin_of(kAgilexHunterEntry, HunterBench::options()));
}

TEST(HunterCodec, ReadsTheMakersExamples) {
  const auto steered = read_steered_command(make_frame(0x111, {0, 0, 0, 0, 0, 0, 0, 0xC8}));
  ASSERT_TRUE(steered);
  EXPECT_NEAR(steered->inner_rad, 0.2, 1e-9);
  EXPECT_EQ(steered_command({-0.8, 0.3}), make_frame(0x111, {0xFC, 0xE0, 0, 0, 0, 0, 0x01, 0x2C}));
  EXPECT_FALSE(read_steered_command(make_frame(0x111, {0, 0, 0, 1, 0, 0, 0, 0})));
}

TEST(Hunter, IsReleasedBeforeItMovesAndLockedBeforeItIsLetGo) {
  HunterBench bench;
  bench.run(milliseconds(1000), kStand);
  bench.run(milliseconds(2500), kDrive, {0.5, 0});
  EXPECT_NEAR(bench.motion.twist.vx_mps, 0.5, 0.03);
  const std::size_t released = bench.first(kBrakeCommandId, 0);
  EXPECT_LT(released, bench.first_motion());
  EXPECT_EQ(bench.first(kBrakeCommandId, 1), bench.sent.size()) << "locked while it drives";
  bench.sent.clear();
  bench.run(milliseconds(2000), kStand);
  EXPECT_LT(bench.first(kBrakeCommandId, 1), bench.sent.size()) << "locked at rest";
  bench.run(milliseconds(1000), AxisRequest::idle);
  EXPECT_LT(bench.first(kBrakeCommandId, 1), bench.first(kModeCommandId, 0));
  EXPECT_EQ(bench.status.state, AxisState::idle);
}

TEST(Hunter, TellsItsEmergencyStopAsOneOfAllOfTheRobot) {
  HunterBench bench;
  bench.run(milliseconds(1000), kStand);
  bench.run(milliseconds(2500), kDrive, {0.5, 0});
  ASSERT_TRUE(bench.twin.set_fault("exception", bench.now));
  bench.run(milliseconds(500), kDrive, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_FALSE(bench.status.stops_all);
  ASSERT_TRUE(bench.twin.set_fault("estop", bench.now));
  bench.run(milliseconds(500), kDrive, {0.5, 0});
  EXPECT_TRUE(bench.status.stops_all);
}

TEST(Hunter, IsNotLockedWhileItStillRolls) {
  HunterBench bench;
  bench.run(milliseconds(1000), kStand);
  bench.run(milliseconds(2500), kDrive, {0.5, 0});
  bench.sent.clear();
  for (int i = 0; i < 300; ++i) {
    bench.cycle({kStand, 0, {}});
    if (bench.sent.back().id != kBrakeCommandId) continue;
    EXPECT_LT(std::abs(bench.motion.twist.vx_mps), 0.003);
    return;
  }
  FAIL() << "never locked";
}

TEST(Hunter, TellsItsCurveByItsSpeedAndItsAngle) {
  HunterBench bench;
  bench.run(milliseconds(1000), kStand);
  bench.run(milliseconds(4000), kDrive, {0.4, -0.2});
  EXPECT_NEAR(bench.motion.twist.wz_radps, -0.2, 0.01);
  EXPECT_NEAR(bench.motion.steering_rad, -std::atan(0.65 * 0.5), 0.01);
  EXPECT_LT(bench.told_rad(), bench.motion.steering_rad) << "the inner wheel's is more";
}

TEST(Hunter, KeepsItsAngleAtRest) {
  HunterBench bench;
  bench.run(milliseconds(1000), kStand);
  bench.run(milliseconds(4000), kDrive, {0.4, 0.2});
  const double angle_rad = bench.told_rad();
  EXPECT_GT(angle_rad, 0.3);
  for (const AxisRequest request : {kDrive, kStand, AxisRequest::hold}) {
    bench.run(milliseconds(1500), request);
    EXPECT_NEAR(bench.motion.steering_rad, Steering().middle_rad(angle_rad), 0.01);
  }
}

/// Nobody tells it an angle of before: a person steered it.
TEST(Hunter, LeavesTheAngleThatItIsFoundAt) {
  AgilexV2Driver driver(0, Steering{});
  const Time now{std::chrono::seconds(1)};
  const Setpoint rest;
  DriverOut out;
  driver.on_frame(steered_motion_frame({0, 0.25}), now, out);
  driver.on_setpoints({&rest, 1}, now, out);
  ASSERT_FALSE(out.frames.empty());
  EXPECT_NEAR(read_steered_command(out.frames[0])->inner_rad, 0.25, 0.0011);
}

/// A chassis as it says it is, and the angle that it is told.
struct SaidBench {
  /// Each with a motion; the mode comes with the state.
  void cycle(const Setpoint& wanted) {
    now += milliseconds(10);
    DriverOut out;
    driver.on_frame(make_frame(kSystemStateId, {0, mode, 1, 9, 0, 0, 0, 0}), now, out);
    driver.on_frame(steered_motion_frame(said), now, out);
    driver.on_setpoints({&wanted, 1}, now, out);
    for (const CanFrame& frame : out.frames)
      if (const auto command = read_steered_command(frame)) told = *command;
  }
  void run(int cycles, AxisRequest request, const Twist& twist = {}) {
    for (int i = 0; i < cycles; ++i) cycle({request, 0, twist});
  }
  AgilexV2Driver driver{0, Steering{}};
  Time now{std::chrono::seconds(1)};
  std::uint8_t mode = 1;
  Steered said{0, 0.235};
  Steered told{};
};

/// It was left by a remote control in a bend, and is caught while it still rolls: the speeds of a
/// catch fall one by one, and are no curve.
TEST(Hunter, LeavesItsWheelsAsTheyAreWhileItIsCaught) {
  SaidBench bench;
  bench.run(30, kDrive, {0.5, 0.25});
  bench.mode = 2;
  bench.run(30, kDrive, {0.5, 0.25});
  bench.said = {-0.018, 0.241};
  bench.run(10, kStand);
  bench.mode = 1;
  for (const Twist& twist : {Twist{-0.015, -0.02}, Twist{-0.012, -0.02}, Twist{-0.002, -0.02}}) {
    bench.cycle({AxisRequest::hold, 0, twist});
    EXPECT_NEAR(bench.told.speed_mps, twist.vx_mps, 0.0011);
    EXPECT_NEAR(bench.told.inner_rad, 0.241, 0.0011);
  }
  bench.run(30, kStand);
  EXPECT_EQ(bench.told.speed_mps, 0);
  EXPECT_NEAR(bench.told.inner_rad, 0.241, 0.0011);
}

TEST(Hunter, MakesNoAngleFromATwistThatIsNearlyZero) {
  SaidBench bench;
  bench.run(30, kDrive, {0.5, 0.25});
  const double bend_rad = Steering().inner_rad(0.5);
  ASSERT_NEAR(bench.told.inner_rad, bend_rad, 0.0011);
  bench.said = {0.01, bend_rad};
  for (const Twist& twist : {Twist{0.004, 0.02}, Twist{0.002, -0.02}, Twist{-0.003, 0.02}}) {
    bench.cycle({kDrive, 0, twist});
    EXPECT_NEAR(bench.told.inner_rad, bend_rad, 0.0011) << twist.vx_mps;
  }
}

/// The engine refuses what may not leave; at rest its angle would leave after it.
TEST(Hunter, ForgetsAnAngleThatItsWheelsWereNotTold) {
  SaidBench bench;
  bench.run(30, kDrive, {0.5, 0.11});
  bench.run(10, kDrive, {0.1, 0.06});  // nothing of this is followed
  bench.run(20, kStand);
  EXPECT_NEAR(bench.told.inner_rad, 0.235, 0.0011);
  bench.said.inner_rad = 0.234;  // of its last digit nothing is made
  bench.run(20, kStand);
  EXPECT_NEAR(bench.told.inner_rad, 0.235, 0.0011);
}

/// A Hunter SE goes on by itself with the first command after a silence.
TEST(Hunter, DoesNotGoOnAfterASilence) {
  HunterBench bench;
  bench.run(milliseconds(1000), kStand);
  bench.run(milliseconds(2500), kDrive, {0.5, 0});
  for (int i = 0; i < 480; ++i) {  // nobody speaks for 1.2 s
    bench.now += std::chrono::microseconds(2500);
    TwinFrames frames;
    bench.twin.on_tick(bench.now, bench.shafts, frames);
    DriverOut out;
    for (const CanFrame& frame : frames) bench.driver.on_frame(frame, bench.now, out);
    for (Shaft& shaft : bench.shafts) shaft.velocity_radps += 0.0025 / 0.4 * shaft.torque_Nm;
  }
  bench.sent.clear();
  bench.run(milliseconds(3000), kDrive, {0.5, 0});
  EXPECT_EQ(bench.first_motion(), bench.sent.size());
  EXPECT_LT(std::abs(bench.motion.twist.vx_mps), 0.01);
}

TEST(Hunter, IsNotSentMotionWhileItsBrakeIsStuck) {
  HunterBench bench;
  bench.twin.set_fault("brake_stuck", bench.now);
  bench.run(milliseconds(1000), kStand);
  bench.run(milliseconds(3000), kDrive, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::arming);
  EXPECT_EQ(bench.status.reason, "its brake is locked, and does not come free");
  EXPECT_EQ(bench.first_motion(), bench.sent.size());
  bench.twin.set_fault("", bench.now);
  bench.run(milliseconds(500), kDrive, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::running);
  EXPECT_EQ(bench.status.reason, "");
}

/// Beside a state in which it is well, and drives on: in words, and what has none as it is. Where
/// its two documents tell a bit otherwise both are named.
TEST(Hunter, TellsItsErrorBitsInWords) {
  AgilexV2Driver driver(0, Steering{});
  const Time now{std::chrono::seconds(1)};
  const auto told = [&](unsigned error) {
    DriverOut out;
    SystemState state{.vehicle = Vehicle::well, .mode = Mode::can, .battery_V = 26};
    state.error = static_cast<std::uint16_t>(error);
    driver.on_frame(system_state_frame(state, 0, Model::hunter), now, out);
    driver.on_frame(steered_motion_frame({0, 0}), now, out);
    return std::string(driver.health(now).reason.view());
  };
  EXPECT_EQ(told(0), "");
  EXPECT_EQ(told(0x0001), "battery voltage low");
  EXPECT_EQ(told(0x0009), "battery voltage low, one of its motors is not heard");
  EXPECT_EQ(told(0x0038), "one of its motors is not heard");
  EXPECT_EQ(told(0x0044), "its remote control is lost, too hot");
  EXPECT_EQ(told(0x0400), "its remote control is lost");
  EXPECT_EQ(told(0x1000), "it lost its commands");
  EXPECT_EQ(told(0x0200), "it lost its commands, or its steering's encoder");
  EXPECT_EQ(told(0x0080), "over-current, or its steering's encoder");
  EXPECT_EQ(told(0x4100), "a fault of its motor drives");
  EXPECT_EQ(told(0x0002), "its error word is 0002");
  EXPECT_EQ(told(0x8001), "battery voltage low (its error word is 8001)");
  for (unsigned bit = 0; bit < 16; ++bit) EXPECT_NE(told(1U << bit), "") << bit;
}

/// It asks for the lock, and goes without it: nobody is kept in command by a brake.
TEST(Hunter, IsLetGoAfterAMomentThoughItsBrakeNeverTellsThatItIsLocked) {
  AgilexV2Driver driver(0, Steering{});
  Time now{std::chrono::seconds(1)};
  const auto hear_released = [&](DriverOut& out) {
    driver.on_frame(steered_motion_frame({0, 0}), now, out);
    SystemState state;
    state.mode = Mode::can;
    driver.on_frame(system_state_frame(state, 0, Model::hunter), now, out);
  };
  const auto cycle = [&](AxisRequest request) {
    now += milliseconds(10);
    DriverOut out;
    hear_released(out);
    const Setpoint setpoint{request, 0, {}};
    driver.on_setpoints({&setpoint, 1}, now, out);
    driver.on_tick(now, out);
    return out;
  };
  for (int i = 0; i < 100; ++i) (void)cycle(kDrive);
  const Time asked = now;
  Time locked = kNever;
  Time left = kNever;
  while (now - asked < milliseconds(2000)) {
    for (const CanFrame& frame : cycle(AxisRequest::idle).frames) {
      if (locked == kNever && read_brake_command(frame) == true) locked = now;
      if (left == kNever && read_mode_command(frame) == Mode::standby) left = now;
    }
  }
  ASSERT_NE(locked, kNever);
  ASSERT_NE(left, kNever) << "for ever";
  EXPECT_LT(locked, left);
  EXPECT_GT(left - asked, milliseconds(590));
  EXPECT_LT(left - asked, milliseconds(650));
}

TEST(Hunter, NamesTheRemoteControlByItsOwnNumber) {
  HunterBench bench;
  bench.run(milliseconds(1000), kStand);
  bench.twin.set_fault("remote", bench.now);
  bench.run(milliseconds(300), kDrive);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_NE(std::string(bench.status.reason.view()).find("remote control"), std::string::npos);
}

}  // namespace
}  // namespace drover::agilex_v2
