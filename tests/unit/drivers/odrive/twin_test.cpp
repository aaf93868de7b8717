#include "drivers/odrive/twin.h"

#include <gtest/gtest.h>

#include <functional>

#include "drivers/odrive/driver.h"
#include "drivers/odrive/entry.h"
#include "unit/drivers/conformance/harness.h"

namespace drover::odrive {
namespace {

using std::chrono::milliseconds;
using test::CanBench;

constexpr auto kRun = AxisRequest::run;
constexpr auto kRest = AxisRequest::rest;

test::Subject subject(const std::function<void(Options&)>& change = [](Options&) {}) {
  const DriverEntry* entry = find_driver("odrive");
  test::Subject made{entry, test::example_options(*entry), "odrive"};
  change(made.options);
  return made;
}

void old_firmware(Options& options) {
  options.set("firmware", std::string("0.5.6"));
}
void with_endpoints(Options& options) {
  options.set("watchdog_timeout_s", 0.1)
      .set("watchdog_enable_endpoint", 300.0)
      .set("watchdog_timeout_endpoint", 301.0);
}

void start(CanBench& bench, double velocity_radps) {
  bench.run(milliseconds(300), kRest);
  bench.run(milliseconds(2000), kRun, velocity_radps);
  ASSERT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
}

TEST(OdriveTwin, KnowsOnlyItsFaults) {
  CanBench bench(subject());
  for (const char* name : {"no such fault", "error:", "error:xyz", "error:0", "error:10 "})
    EXPECT_FALSE(bench.twin->set_fault(name, bench.now)) << name;
  for (const char* name : {"", "over_temperature", "stuck_encoder", "wrong_sign", "silent",
                           "leaves_closed_loop", "error:2000"})
    EXPECT_TRUE(bench.twin->set_fault(name, bench.now)) << name;
}

TEST(OdriveTwin, WithoutAWatchdogRunsOnForEverWhenFramesCease) {
  CanBench bench(subject());
  start(bench, 3.0);
  bench.driver_alive = false;
  bench.run(milliseconds(5000), kRest);
  EXPECT_NEAR(bench.shaft.velocity_radps, 3.0, 0.3);
}

TEST(OdriveTwin, FreeWheelsWhenItsWatchdogExpires) {
  for (const bool old : {false, true}) {
    CanBench bench(subject([&](Options& options) {
      options.set("watchdog_timeout_s", 0.1);
      if (old) old_firmware(options);
    }));
    start(bench, 3.0);
    bench.driver_alive = false;
    bench.run(milliseconds(95), kRest);
    EXPECT_NE(bench.shaft.torque_Nm, 0.0);
    bench.run(milliseconds(20), kRest);
    EXPECT_EQ(bench.shaft.torque_Nm, 0.0);
    bench.driver_alive = true;
    bench.run(milliseconds(200), kRest);
    EXPECT_EQ(bench.status.state, AxisState::idle);
    EXPECT_EQ(bench.status.reason,
              "its watchdog ran out while nobody fed it: cleared at the next start");
    EXPECT_EQ(bench.status.error_code, old ? 0x800U : 0x1000000U);
    bench.run(milliseconds(1000), kRun, 1.0);
    EXPECT_EQ(bench.status.state, AxisState::running) << "a new request clears it";
  }
}

TEST(OdriveTwin, IsKeptAliveByTheDriverForAsLongAsItLives) {
  CanBench bench(subject([](Options& options) { options.set("watchdog_timeout_s", 0.05); }));
  bench.run(milliseconds(5000), kRest);
  EXPECT_EQ(bench.status.state, AxisState::idle) << bench.status.reason.view();
  start(bench, 1.0);
  bench.run(milliseconds(5000), kRest);
  EXPECT_EQ(bench.status.state, AxisState::running);
}

TEST(OdriveWatchdog, IsSetReadBackAndInForce) {
  CanBench bench(subject(with_endpoints));
  start(bench, 3.0);
  EXPECT_NE(bench.actuator->silence().text.find("set and read back"), std::string::npos);
  bench.driver_alive = false;
  bench.run(milliseconds(120), kRest);
  EXPECT_EQ(bench.shaft.torque_Nm, 0.0);
}

TEST(OdriveWatchdog, IsSetAgainAfterAPowerCycle) {
  CanBench bench(subject(with_endpoints));
  start(bench, 3.0);
  bench.twin->set_power(false, bench.now);
  bench.run(milliseconds(500), kRest);
  bench.twin->set_power(true, bench.now);
  bench.run(milliseconds(1000), kRest);
  start(bench, 3.0);
  bench.driver_alive = false;
  bench.run(milliseconds(120), kRest);
  EXPECT_EQ(bench.shaft.torque_Nm, 0.0);
}

TEST(OdriveWatchdog, ThatCannotBeReadBackKeepsTheAxisFromArming) {
  // The drive knows other end points than the configuration: it does not answer.
  const test::Subject stated = subject(with_endpoints);
  CanBench bench(stated);
  Options other = stated.options;
  other.set("watchdog_enable_endpoint", 310.0).set("watchdog_timeout_endpoint", 311.0);
  bench.twin = std::get<MakeCanTwin>(stated.entry->make_twin)(other);
  bench.run(milliseconds(300), kRest);
  bench.run(milliseconds(2000), kRun, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason.view().substr(0, 16), "watchdog not set");
  EXPECT_EQ(bench.shaft.torque_Nm, 0.0);
  EXPECT_EQ(bench.off_list, 0);
}

TEST(OdriveWatchdog, ThatReadsBackAnotherTimeIsNotBelieved) {
  WatchdogSetup setup(read_settings(subject(with_endpoints).options));
  Time now{std::chrono::seconds(1)};
  DriverOut out;
  setup.begin(now);
  for (int i = 0; i < 100; ++i, now += milliseconds(5)) {
    out.clear();
    setup.on_tick(now, out);
    for (const CanFrame& frame : out.frames) {
      SdoValue value;
      value.endpoint = static_cast<std::uint16_t>(frame.data[1] | frame.data[2] << 8U);
      value.size = 4;
      value.raw = value.endpoint == 300 ? 1 : 0x3F000000;  // 0.5 s
      setup.on_reply(value);
    }
  }
  EXPECT_FALSE(setup.done());
  EXPECT_TRUE(setup.failed());
  EXPECT_EQ(setup.reason(),
            "watchdog not set: the drive has it on with 0.500 s instead of on with 0.100 s");
}

TEST(OdriveWatchdog, TakesNoConfirmationOfAWriteForWhatWasReadBack) {
  WatchdogSetup setup(read_settings(subject(with_endpoints).options));
  const Time now{std::chrono::seconds(1)};
  DriverOut out;
  setup.begin(now);
  setup.on_tick(now, out);
  ASSERT_EQ(out.frames.size(), 2U);  // the writes
  setup.on_reply({.endpoint = 300, .size = 1, .raw = 1});
  setup.on_reply({.endpoint = 301, .size = 4, .raw = 0x3DCCCCCD});  // 0.1 s
  EXPECT_FALSE(setup.done());
  setup.on_tick(now + milliseconds(20), out);  // the reads
  setup.on_reply({.endpoint = 300, .size = 1, .raw = 1});
  setup.on_reply({.endpoint = 301, .size = 4, .raw = 0x3DCCCCCD});
  EXPECT_TRUE(setup.done());
}

TEST(OdriveTwin, OverTemperatureStopsItAndDoesNotClear) {
  for (const bool old : {false, true}) {
    CanBench bench(subject([&](Options& options) {
      if (old) old_firmware(options);
    }));
    start(bench, 2.0);
    bench.twin->set_fault("over_temperature", bench.now);
    bench.run(milliseconds(200), kRun, 2.0);
    EXPECT_EQ(bench.status.state, AxisState::fault);
    EXPECT_NE(bench.status.reason.view().find("over temperature"), std::string::npos)
        << bench.status.reason.view();
    bench.run(milliseconds(100), kRest);
    bench.run(milliseconds(1000), kRun, 2.0);
    EXPECT_EQ(bench.status.state, AxisState::fault) << "still hot";
    bench.twin->set_fault("", bench.now);
    bench.run(std::chrono::minutes(10), kRest);
    bench.run(milliseconds(1000), kRun, 2.0);
    EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
  }
}

TEST(OdriveTwin, WarmsUpUnderLoad) {
  CanBench bench(subject([](Options& options) { options.set("torque_constant_Nm_per_A", 1.0); }));
  start(bench, 1.0);
  bench.load_Nm = -20;
  double motor_degC = 0;
  for (int i = 0; i < 12000; ++i) {
    bench.step({kRun, 1.0});
    bench.twin_frames.clear();
    bench.twin->on_frame(encode_poll(3, cmd::kTemperature), bench.now, bench.twin_frames);
    for (const CanFrame& frame : bench.twin_frames)
      if (frame.id == 0x075) motor_degC = static_cast<double>(read_float(frame, 4));
  }
  EXPECT_GT(motor_degC, 30);
  EXPECT_LT(motor_degC, 100);
}

TEST(OdriveTwin, StuckEncoderRunsAwayAndIsSeenStandingStill) {
  CanBench bench(subject());
  start(bench, 1.0);
  bench.twin->set_fault("stuck_encoder", bench.now);
  bench.run(milliseconds(1000), kRun, 1.0);
  EXPECT_GT(bench.shaft.velocity_radps, 5.0);
  EXPECT_NEAR(bench.motion.velocity_radps, 0.0, 0.05);
}

TEST(OdriveTwin, WrongSignTurnsTheOtherWayAndSeesItselfRight) {
  CanBench bench(subject());
  bench.twin->set_fault("wrong_sign", bench.now);
  start(bench, 1.0);
  EXPECT_NEAR(bench.shaft.velocity_radps, -1.0, 0.1);
  EXPECT_NEAR(bench.motion.velocity_radps, 1.0, 0.1);
}

TEST(OdriveTwin, SilentStillObeys) {
  CanBench bench(subject());
  start(bench, 1.0);
  bench.twin->set_fault("silent", bench.now);
  bench.run(milliseconds(1000), kRun, 1.0);
  EXPECT_EQ(bench.device->health(bench.now).state, SourceState::stale);
  EXPECT_NEAR(bench.shaft.velocity_radps, 0.0, 0.05) << "the driver's zeros still arrive";
}

TEST(OdriveTwin, LeavingClosedLoopIsReportedWithinAHeartbeat) {
  CanBench bench(subject());
  start(bench, 1.0);
  bench.twin->set_fault("leaves_closed_loop", bench.now);
  bench.run(milliseconds(110), kRun, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason.view().substr(0, 16), "left closed loop");
  EXPECT_EQ(bench.shaft.torque_Nm, 0.0);
}

TEST(OdriveTwin, DoesNotMoveBeforeItsModeIsSet) {
  CanBench bench(subject());
  bench.driver_alive = false;
  bench.run(milliseconds(100), kRest);
  bench.send(encode_set_axis_state(3, kStateClosedLoop));
  bench.send(encode_set_input_vel(3, 1.0));
  bench.run(milliseconds(500), kRest);
  EXPECT_NEAR(bench.shaft.velocity_radps, 0.0, 1e-6);
  bench.send(encode_set_controller_mode(3, kControlVelocity, kInputPassthrough));
  bench.run(milliseconds(1000), kRest);
  EXPECT_GT(bench.shaft.velocity_radps, 5.0);
}

TEST(OdriveTwin, LimitsItsTorque) {
  CanBench bench(subject());
  start(bench, 0.0);
  double highest_Nm = 0;
  for (int i = 0; i < 200; ++i) {
    bench.step({kRun, 50.0});
    highest_Nm = std::max(highest_Nm, std::abs(bench.shaft.torque_Nm));
  }
  EXPECT_LE(highest_Nm, 40.0);
  EXPECT_GT(highest_Nm, 39.0);
}

TEST(OdriveTwin, SendsItsCyclicFramesAtTheDrivesRates) {
  CanBench bench(subject());
  bench.driver_alive = false;
  int heartbeats = 0;
  int estimates = 0;
  for (int i = 0; i < 800; ++i) {
    bench.now += std::chrono::microseconds(2500);
    bench.twin_frames.clear();
    bench.twin->on_tick(bench.now, {&bench.shaft, 1}, bench.twin_frames);
    for (const CanFrame& frame : bench.twin_frames) {
      heartbeats += frame.id == 0x061 ? 1 : 0;
      estimates += frame.id == 0x069 ? 1 : 0;
    }
  }
  EXPECT_EQ(heartbeats, 20);
  EXPECT_EQ(estimates, 200);
}

}  // namespace
}  // namespace drover::odrive
