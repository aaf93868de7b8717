// A HiPNUC sensor beside its twin.
#include "drivers/hipnuc_can/driver.h"

#include <gtest/gtest.h>

#include <memory>

#include "drivers/hipnuc_can/entry.h"
#include "drivers/hipnuc_can/twin.h"
#include "drover/angle.h"
#include "drover/rotation.h"

namespace drover::hipnuc_can {
namespace {

using std::chrono::milliseconds;

/// 1 ms steps.
struct Bench {
  explicit Bench(Dialect dialect) {
    settings.address.dialect = dialect;
    settings.mount = from_degrees(10, -20, -90);
    driver = HipnucCanDriver(settings);
    twin = std::make_unique<HipnucCanTwin>(settings, TwinSettings{}, 1);
  }
  void run(Duration time) {
    for (const Time end = now + time; now < end; now += milliseconds(1)) {
      TwinFrames frames;
      twin->on_tick(now, truth, frames);
      for (const CanFrame& frame : frames) hear(frame);
    }
  }
  void send(const CanFrame& frame) {
    TwinFrames none;
    twin->on_frame(frame, now, none);
  }
  void hear(const CanFrame& frame) {
    DriverOut out;
    driver.on_frame(frame, now, out);
    for (const Measurement& each : out.measurements) {
      last = each;
      sample = std::get<ImuSample>(each.value);
      ++samples;
    }
  }
  Settings settings;
  ImuTruth truth{.specific_force_mps2 = {0.5, -1, 9.7},
                 .angular_velocity_radps = {0.1, -0.2, 0.9},
                 .orientation = from_degrees(3, 4, 70)};
  std::unique_ptr<HipnucCanTwin> twin;
  HipnucCanDriver driver{settings};
  Time now{std::chrono::seconds(1)};
  Measurement last;
  ImuSample sample;
  int samples = 0;
};

Bench bench_of(Dialect dialect) {
  Bench bench(dialect);
  bench.send(make_frame(0, {1, 8}));
  return bench;
}

class HipnucCan : public ::testing::TestWithParam<Dialect> {};

TEST_P(HipnucCan, TellsTheMotionOfItsTwinInTheAxesOfTheRobot) {
  Bench bench = bench_of(GetParam());
  bench.run(milliseconds(500));
  EXPECT_EQ(bench.samples, 50);
  EXPECT_NEAR(bench.sample.acceleration_mps2.x, 0.5, 0.02);
  EXPECT_NEAR(bench.sample.acceleration_mps2.y, -1, 0.02);
  EXPECT_NEAR(bench.sample.acceleration_mps2.z, 9.7, 0.02);
  EXPECT_NEAR(bench.sample.angular_velocity_radps.x, 0.1, 0.002);
  EXPECT_NEAR(bench.sample.angular_velocity_radps.y, -0.2, 0.002);
  EXPECT_NEAR(bench.sample.angular_velocity_radps.z, 0.9, 0.002);
  ASSERT_TRUE(bench.sample.has_orientation);
  // What is up; its yaw begins anywhere.
  const Vector3 up = rotate(conjugate(bench.sample.orientation), {0, 0, 1});
  const Vector3 truly_up = rotate(conjugate(bench.truth.orientation), {0, 0, 1});
  EXPECT_NEAR(up.x, truly_up.x, 4e-4);
  EXPECT_NEAR(up.y, truly_up.y, 4e-4);
  EXPECT_NEAR(up.z, truly_up.z, 4e-4);
  EXPECT_FALSE(bench.sample.saturated);
}

TEST_P(HipnucCan, IsNeverHeardThenFreshThenStaleAndSaysWhy) {
  Bench bench = bench_of(GetParam());
  EXPECT_EQ(bench.driver.health(bench.now).state, SourceState::never_heard);
  EXPECT_FALSE(bench.driver.health(bench.now).reason.empty());
  bench.run(milliseconds(100));
  EXPECT_EQ(bench.driver.health(bench.now).state, SourceState::fresh);
  EXPECT_TRUE(bench.driver.health(bench.now).reason.empty());
  bench.twin->set_state("silent", bench.now);
  bench.run(milliseconds(200));
  EXPECT_EQ(bench.driver.health(bench.now).state, SourceState::stale);
  EXPECT_FALSE(bench.driver.health(bench.now).reason.empty());
}

TEST_P(HipnucCan, NamesTheHalfThatIsMissing) {
  Bench bench = bench_of(GetParam());
  bench.run(milliseconds(100));
  const int before = bench.samples;
  bench.twin->set_state("no_rates", bench.now);
  bench.run(milliseconds(200));
  EXPECT_EQ(bench.samples, before);
  EXPECT_NE(bench.driver.health(bench.now).reason.view().find("no rates"), std::string_view::npos);
}

/// After CANopen the sensor's range ends long before the numbers do.
TEST_P(HipnucCan, AtTheEndOfItsRangeIsToldAndSoonStale) {
  const Vector3 turning_radps{0, 0, to_rad(-2000)};
  const Vector3 pushed_mps2{16 * kGravity_mps2, 0, 9.8};
  for (const bool turns : {true, false}) {
    Bench bench = bench_of(GetParam());
    bench.run(milliseconds(100));
    const Quaternion to_base = bench.settings.mount;
    (turns ? bench.truth.angular_velocity_radps : bench.truth.specific_force_mps2) =
        rotate(to_base, turns ? turning_radps : pushed_mps2);
    const int before = bench.samples;
    bench.run(milliseconds(200));
    EXPECT_GT(bench.samples, before + 15);
    EXPECT_TRUE(bench.sample.saturated);
    const SourceHealth health = bench.driver.health(bench.now);
    EXPECT_EQ(health.state, SourceState::stale) << "another one has to take over";
    EXPECT_NE(health.reason.view().find("at the end of its range"), std::string_view::npos)
        << health.reason.view();
  }
}

INSTANTIATE_TEST_SUITE_P(Dialects, HipnucCan, ::testing::Values(Dialect::j1939, Dialect::canopen));

/// Else a single lost frame would pair each half with that of the next sample for ever.
TEST(HipnucCanPairs, AreNotMadeAcrossSamples) {
  Bench bench = bench_of(Dialect::j1939);
  const CanFrame acceleration = acceleration_frame(bench.settings.address, {0, 0, 9.81});
  const CanFrame rates = rates_frame(bench.settings.address, {0, 0, 1});
  bench.hear(rates);  // its accelerations were lost
  for (int i = 0; i < 3; ++i) {
    bench.now += milliseconds(10);
    bench.hear(acceleration);
    EXPECT_EQ(bench.samples, i);
    bench.now += std::chrono::microseconds(300);
    bench.hear(rates);
    EXPECT_EQ(bench.samples, i + 1);
    EXPECT_EQ(bench.last.received - bench.last.time, std::chrono::microseconds(300));
  }
}

TEST(HipnucCanTwin, WithCanopenFramesIsSilentUntilItIsStarted) {
  Bench bench(Dialect::canopen);
  bench.run(milliseconds(100));
  EXPECT_EQ(bench.samples, 0);
  bench.send(make_frame(0, {1, 8}));
  bench.run(milliseconds(100));
  EXPECT_EQ(bench.samples, 10);
}

/// Who starts it once has to start it after each dip of its supply.
TEST(HipnucCanTwin, WithCanopenFramesWaitsForANewStartAfterItsSupplyWasAway) {
  Bench bench = bench_of(Dialect::canopen);
  bench.run(milliseconds(100));
  EXPECT_EQ(bench.samples, 10);
  EXPECT_TRUE(bench.twin->set_state("restart", bench.now));
  bench.run(milliseconds(100));
  EXPECT_EQ(bench.samples, 10);
  bench.send(make_frame(0, {1, 0}));  // to all
  bench.run(milliseconds(100));
  EXPECT_EQ(bench.samples, 20);
}

/// As a sensor without a magnetometer: no user may take its yaw for the robot's.
TEST(HipnucCanTwin, CountsItsYawFromWhereItWasSwitchedOn) {
  Bench bench = bench_of(Dialect::j1939);
  bench.run(milliseconds(100));
  const Quaternion level = from_degrees(3, 4, 0);
  EXPECT_NEAR(bench.sample.orientation.w, level.w, 2e-4);
  EXPECT_NEAR(bench.sample.orientation.x, level.x, 2e-4);
  EXPECT_NEAR(bench.sample.orientation.y, level.y, 2e-4);
  EXPECT_NEAR(bench.sample.orientation.z, level.z, 2e-4);
}

TEST(HipnucCanTwin, IsAsWrongAsItIsToldToBe) {
  Bench bench(Dialect::j1939);
  bench.run(milliseconds(20));
  EXPECT_TRUE(bench.twin->set_state("bias:2", bench.now));
  bench.run(milliseconds(20));
  EXPECT_NEAR(bench.sample.angular_velocity_radps.z, 0.9 + to_rad(2), 0.002);
  EXPECT_FALSE(bench.twin->set_state("bias:", bench.now));
  EXPECT_FALSE(bench.twin->set_state("tired", bench.now));
}

TEST(HipnucCanTwin, IsAnotherSensorWithAnotherSeed) {
  const auto rate_radps = [](std::uint64_t seed) {
    Bench bench(Dialect::j1939);
    bench.twin = std::make_unique<HipnucCanTwin>(bench.settings,
                                                 TwinSettings{.rate_bias_sigma_radps = 0.1}, seed);
    bench.run(milliseconds(20));
    return bench.sample.angular_velocity_radps.x;
  };
  EXPECT_EQ(rate_radps(1), rate_radps(1));
  EXPECT_NE(rate_radps(1), rate_radps(2));
}

TEST(HipnucCanEntry, RefusesAnOptionOutsideItsRange) {
  Options options(kHipnucCanEntry.options);
  options.set("node", 128.0);
  EXPECT_THROW(kHipnucCanEntry.make(options, {}), std::runtime_error);
}

}  // namespace
}  // namespace drover::hipnuc_can
