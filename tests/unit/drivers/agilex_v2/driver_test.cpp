// What a Scout has that other bases have not: a mode that others may take away.
#include "drivers/agilex_v2/driver.h"

#include <gtest/gtest.h>

#include "drivers/agilex_v2/twin.h"

namespace drover::agilex_v2 {
namespace {

using std::chrono::milliseconds;
constexpr auto kRun = AxisRequest::run;
constexpr auto kRest = AxisRequest::rest;

/// 10 ms cycles; its shafts turn as they are pushed.
struct Bench {
  explicit Bench(bool zero_holds = false)
      : driver(0, {}, zero_holds),
        twin(Options(twin_option_table()).set("zero_holds", zero_holds)) {}
  void run(Duration time, AxisRequest request, const Twist& twist = {}) {
    for (const Time end = now + time; now < end;) cycle({request, 0, twist});
  }
  void cycle(const Setpoint& setpoint) {
    DriverOut out = hear();
    driver.on_setpoints({&setpoint, 1}, now, out);
    driver.on_tick(now, out);
    for (const Measurement& each : out.measurements) {
      if (const auto* value = std::get_if<AxisStatus>(&each.value))
        status = {*value, driver.words(each)};
      if (const auto* value = std::get_if<BodyMotion>(&each.value)) motion = *value;
      if (const auto* value = std::get_if<AxisSupply>(&each.value)) supply = *value;
    }
    TwinFrames frames;
    for (const CanFrame& frame : out.frames) {
      last = frame;
      moved += driver.effect(frame, now).kind == FrameEffect::motion ? 1 : 0;
      twin.on_frame(frame, now, frames);
    }
    sent += static_cast<int>(out.frames.size());
  }
  /// A cycle in which nothing is commanded.
  DriverOut hear() {
    now += milliseconds(10);
    TwinFrames frames;
    twin.on_tick(now, shafts, frames);
    for (Shaft& shaft : shafts) shaft.velocity_radps += 0.02 * (shaft.torque_Nm + load_Nm);
    DriverOut out;
    for (const CanFrame& frame : frames) driver.on_frame(frame, now, out);
    return out;
  }
  void drive() {
    run(milliseconds(1000), kRest);
    run(milliseconds(2000), kRun, {0.5, 0});
    ASSERT_EQ(status.state, AxisState::running) << status.reason.view();
    ASSERT_NEAR(motion.twist.vx_mps, 0.5, 0.02);
  }
  std::string_view reason() const { return status.reason.view(); }

  AgilexV2Driver driver;
  AgilexV2Twin twin;
  std::array<Shaft, 2> shafts{};
  double load_Nm = 0;  ///< on each, as of a slope
  Time now{std::chrono::seconds(1)};
  StatusInWords status;
  BodyMotion motion;
  AxisSupply supply;
  CanFrame last;
  int sent = 0;
  int moved = 0;
};

TEST(AgilexV2, IsLeftAloneInStandbyAndTellsItsBattery) {
  Bench bench;
  bench.run(milliseconds(1000), kRest);
  EXPECT_EQ(bench.status.state, AxisState::idle);
  EXPECT_EQ(bench.sent, 0);
  EXPECT_NEAR(bench.supply.bus_V, 26.5, 1e-9);
}

TEST(AgilexV2, IsToldZeroBeforeItIsSwitchedToCan) {
  Bench bench;
  bench.run(milliseconds(1000), kRest);
  bench.cycle({kRun, 0, {0.5, 0}});
  EXPECT_EQ(bench.sent, 2);
  EXPECT_EQ(bench.moved, 0);
  EXPECT_EQ(bench.last, make_frame(kModeCommandId, {1}));
  EXPECT_EQ(bench.status.state, AxisState::arming);
}

TEST(AgilexV2, DoesNotGoOnAfterARemoteControlHadIt) {
  Bench bench;
  bench.drive();
  bench.twin.set_fault("remote", bench.now);
  bench.run(milliseconds(300), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_NE(bench.reason().find("remote control"), std::string_view::npos) << bench.reason();
  bench.twin.set_fault("", bench.now);
  bench.moved = 0;
  bench.run(milliseconds(2000), kRun, {0.5, 0});
  EXPECT_EQ(bench.moved, 0);
  EXPECT_EQ(bench.status.state, AxisState::idle);
  EXPECT_FALSE(bench.reason().empty());
  bench.run(milliseconds(50), kRest);
  bench.run(milliseconds(2000), kRun, {0.5, 0});
  EXPECT_NEAR(bench.motion.twist.vx_mps, 0.5, 0.02);
}

TEST(AgilexV2, StopsAndNamesSomebodyElseWhoDrivesIt) {
  Bench it;
  it.drive();
  DriverOut out;
  it.driver.on_frame(motion_command({0.3, 0}), it.now, out);
  it.run(milliseconds(20), kRun, {0.5, 0});
  EXPECT_EQ(it.status.state, AxisState::fault);
  EXPECT_EQ(it.reason(), "somebody else commands it: id 0x111 on the bus");
  const int moved = it.moved;
  it.run(milliseconds(5000), kRun, {0.5, 0});
  EXPECT_EQ(it.moved, moved) << "it goes on by a new request only";
  EXPECT_NE(it.status.state, AxisState::fault);
}

/// The guard never sends it, though it stops: it may let go, and the robot rolls.
TEST(AgilexV2, StopsAndNamesSomebodyElseWhoSwitchesItToStandby) {
  Bench it;
  it.drive();
  DriverOut out;
  it.driver.on_frame(mode_command(Mode::standby), it.now, out);
  it.run(milliseconds(20), kRun, {0.5, 0});
  EXPECT_EQ(it.status.state, AxisState::fault);
  EXPECT_EQ(it.reason(), "somebody else commands it: id 0x421 on the bus");
}

TEST(AgilexV2, TakesTheGuardsZerosForNoStrangers) {
  Bench it;
  it.drive();
  DriverOut out;
  it.driver.on_frame(motion_command({}), it.now, out);
  it.run(milliseconds(20), kRun, {0.5, 0});
  EXPECT_EQ(it.status.state, AxisState::running);
}

TEST(AgilexV2, DoesNotGoOnWhenItsEmergencyStopIsReleased) {
  Bench bench;
  bench.drive();
  bench.twin.set_fault("estop", bench.now);
  bench.run(milliseconds(1000), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.reason(), "the chassis' emergency stop is pressed");
  EXPECT_TRUE(bench.status.stops_all);
  EXPECT_FALSE(bench.shafts[0].energized) << "it is taken to let go";
  bench.run(milliseconds(3000), kRun, {0.5, 0});
  EXPECT_TRUE(bench.motion.standing) << "it rolled out";
  bench.twin.set_fault("", bench.now);
  bench.moved = 0;
  bench.run(milliseconds(2000), kRun, {0.5, 0});
  EXPECT_EQ(bench.moved, 0) << "though it stayed in CAN mode";
  EXPECT_FALSE(bench.status.stops_all);
}

TEST(AgilexV2, IsAFaultWhenTheChassisReportsAnException) {
  Bench bench;
  bench.drive();
  bench.twin.set_fault("exception", bench.now);
  bench.run(milliseconds(200), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_FALSE(bench.status.powered);
  EXPECT_EQ(bench.reason(), "the chassis reports a fault, error 0000");
  bench.moved = 0;
  bench.run(milliseconds(1000), kRun, {0.5, 0});
  bench.twin.set_fault("", bench.now);
  bench.run(milliseconds(2000), kRun, {0.5, 0});
  EXPECT_EQ(bench.moved, 0) << "it goes on by a new request only";
  bench.run(milliseconds(50), kRest);
  bench.run(milliseconds(2000), kRun, {0.5, 0});
  EXPECT_NEAR(bench.motion.twist.vx_mps, 0.5, 0.02);
}

/// It may move, and it is given back to who asks anew.
TEST(AgilexV2, IsAFaultWhileSomebodyCommandsItsSerialLine) {
  Bench bench;
  bench.drive();
  ASSERT_TRUE(bench.twin.set_fault("serial", bench.now));
  bench.run(milliseconds(200), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_TRUE(bench.status.powered);
  EXPECT_EQ(bench.reason(), "the chassis is commanded over its serial line: unplug that");
  bench.moved = 0;
  bench.run(milliseconds(1000), kRun, {0.5, 0});
  bench.twin.set_fault("", bench.now);
  bench.run(milliseconds(2000), kRun, {0.5, 0});
  EXPECT_EQ(bench.moved, 0) << "it goes on by a new request only";
  bench.run(milliseconds(50), kRest);
  bench.run(milliseconds(2000), kRun, {0.5, 0});
  EXPECT_NEAR(bench.motion.twist.vx_mps, 0.5, 0.02);
}

/// In 0x211 the first byte is the vehicle's state, the second its mode: 2 is an exception, and the
/// serial line.
TEST(AgilexV2, ReadsAnExceptionAndTheModeOfTheSerialLine) {
  const auto state = read_system_state(make_frame(kSystemStateId, {2, 2, 1, 9, 0, 0, 0, 0}));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->vehicle, Vehicle::exception);
  EXPECT_EQ(state->mode, Mode::serial);
  EXPECT_FALSE(read_system_state(make_frame(kSystemStateId, {3, 1, 1, 9, 0, 0, 0, 0})));
  EXPECT_FALSE(read_system_state(make_frame(kSystemStateId, {0, 4, 1, 9, 0, 0, 0, 0})));
}

/// The maker does not say that its zero holds: the simulated one creeps, unless somebody tried it.
TEST(AgilexV2, CreepsAtZeroUnlessItIsSaidToHold) {
  for (const bool holds : {false, true}) {
    Bench bench(holds);
    EXPECT_EQ(bench.driver.stop_recipe().ends, holds ? StopEnds::holds : StopEnds::damps);
    EXPECT_EQ(bench.driver.silence().ends, holds ? StopEnds::holds : StopEnds::damps);
    bench.drive();
    bench.load_Nm = 3;
    bench.run(milliseconds(4000), kRun);
    EXPECT_EQ(bench.motion.standing, holds);
    for (int i = 0; i < 200; ++i) bench.hear();  // silence
    EXPECT_TRUE(bench.shafts[0].energized);
    EXPECT_NEAR(bench.shafts[0].velocity_radps, holds ? 0 : 0.48, 0.02);
  }
}

/// A base that stayed in its mode would follow the first command after the gap.
TEST(AgilexV2, GetsZerosFirstAfterAGapOfItsCommands) {
  Bench bench;
  bench.drive();
  for (int i = 0; i < 45; ++i) bench.hear();
  bench.moved = 0;
  bench.run(milliseconds(190), kRun, {0.5, 0});
  EXPECT_EQ(bench.moved, 0);
  bench.run(milliseconds(100), kRun, {0.5, 0});
  EXPECT_GT(bench.moved, 0);
}

TEST(AgilexV2, IsTakenBackToHoldAfterASupplyDip) {
  Bench bench;
  bench.drive();
  bench.run(milliseconds(500), kRest);
  bench.twin.set_power(false, bench.now);
  bench.run(milliseconds(300), AxisRequest::hold);
  bench.twin.set_power(true, bench.now);
  bench.run(milliseconds(1500), AxisRequest::hold);
  EXPECT_EQ(bench.status.state, AxisState::running) << bench.reason();
}

TEST(AgilexV2, LetsGoOnlyAtRest) {
  Bench bench;
  bench.drive();
  bench.cycle({AxisRequest::idle, 0, {}});
  EXPECT_EQ(bench.last, motion_command({})) << "zero while it moves";
  bench.run(milliseconds(2000), AxisRequest::idle);
  EXPECT_EQ(bench.status.state, AxisState::idle);
  EXPECT_FALSE(bench.shafts[0].energized);
}

TEST(AgilexV2, TellsALowBatteryAndGoesOn) {
  Bench bench;
  bench.drive();
  bench.twin.set_fault("low_battery", bench.now);
  bench.run(milliseconds(500), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::running);
  EXPECT_EQ(bench.driver.health(bench.now).reason, "battery voltage low");
}

/// It drives on, and whoever looks is told the word that its chassis tells.
TEST(AgilexV2, TellsAnErrorOfWhichNoBitIsKnown) {
  Bench bench;
  bench.drive();
  DriverOut out;
  SystemState state{.vehicle = Vehicle::well, .mode = Mode::can, .battery_V = 26};
  state.error = 0x0080;
  bench.driver.on_frame(system_state_frame(state, 0), bench.now, out);
  EXPECT_EQ(bench.driver.health(bench.now).reason, "its error word is 0080");
  EXPECT_EQ(bench.driver.health(bench.now).state, SourceState::fresh);
  state.error = 0x0780;
  bench.driver.on_frame(system_state_frame(state, 0), bench.now, out);
  EXPECT_EQ(bench.driver.health(bench.now).reason,
            "battery voltage too low, its remote control is lost (its error word is 0780)")
      << "of a battery's two bits the worse, and of what has no words the number";
}

/// Why a start comes to nothing.
TEST(AgilexV2, TellsThatItStaysInStandby) {
  AgilexV2Driver driver(0, {}, false);
  Time now{std::chrono::seconds(1)};
  StatusInWords told;
  for (int i = 0; i < 200; ++i, now += milliseconds(10)) {
    DriverOut out;
    driver.on_frame(system_state_frame({}, 0), now, out);
    driver.on_frame(motion_frame({}), now, out);
    const Setpoint wanted{i < 50 ? AxisRequest::rest : AxisRequest::run, 0, {}};
    driver.on_setpoints({&wanted, 1}, now, out);
    driver.on_tick(now, out);
    for (const Measurement& each : out.measurements)
      if (const auto* value = std::get_if<AxisStatus>(&each.value))
        told = {*value, driver.words(each)};
    if (i >= 50 && i < 140) EXPECT_EQ(told.reason, "") << "it may still be on its way there";
  }
  EXPECT_EQ(told.state, AxisState::arming);
  EXPECT_EQ(told.reason, "the chassis stays in standby, though it was asked for CAN mode");
}

TEST(AgilexV2, NamesAChassisOfTheWrongProtocol) {
  Bench bench;
  DriverOut out;
  bench.driver.on_frame(make_frame(kV1SystemStateId, {0, 1, 1, 9, 0, 0, 0, 0}), bench.now, out);
  EXPECT_NE(bench.driver.health(bench.now).reason.view().find("protocol v1"),
            std::string_view::npos);
}

TEST(AgilexV2, ForbidsWhatIsNotAScoutsAndRoundsTowardsRest) {
  const AgilexV2Driver driver(0);
  const Time now{std::chrono::seconds(1)};
  EXPECT_EQ(driver.effect(make_frame(kMotionCommandId, {0, 0, 0, 0, 0, 1, 0, 0}), now).kind,
            FrameEffect::forbidden);
  EXPECT_EQ(driver.effect(make_frame(kModeCommandId, {2}), now).kind, FrameEffect::forbidden);
  EXPECT_EQ(driver.effect(make_frame(0x431, {0xAA}), now).kind, FrameEffect::forbidden);
  EXPECT_EQ(motion_command({0.57, -0.0019}),
            make_frame(kMotionCommandId, {0x02, 0x3A, 0xFF, 0xFF, 0, 0, 0, 0}));
  EXPECT_EQ(motion_command({kAbsent, 1e9}),
            make_frame(kMotionCommandId, {0, 0, 0x7F, 0xFF, 0, 0, 0, 0}));
}

}  // namespace
}  // namespace drover::agilex_v2
