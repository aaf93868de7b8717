// What is a chassis' own on either wire, beside what is asked of everything that takes a twist.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/gt01/can/codec.h"
#include "drivers/gt01/serial/codec.h"
#include "unit/drivers/conformance/twist_harness.h"

namespace drover::gt01 {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

constexpr auto kRun = AxisRequest::run;
constexpr auto kRest = AxisRequest::rest;

class AChassis : public ::testing::TestWithParam<const char*> {
 protected:
  static test::Subject subject() {
    const DriverEntry* const entry = find_driver(GetParam());
    return {entry, test::example_options(*entry), GetParam()};
  }
  bool on_can() const { return bench.can != nullptr; }
  std::string reason() const { return std::string(bench.status.reason.view()); }
  void drive() {
    bench.run(milliseconds(1500), kRest);
    bench.run(milliseconds(2000), kRun, {0.5, 0});
    ASSERT_NEAR(bench.motion.twist.vx_mps, 0.5, 0.04);
  }
  void expect_told_nothing_that_moves() {
    bench.sent.clear();
    bench.run(milliseconds(500), kRun, {0.5, 0});
    for (const auto& one : bench.sent)
      EXPECT_EQ(bench.effect_of(one), FrameEffect::stop) << test::text_of(one);
  }

  test::TwistBench bench{subject()};
};

TEST_P(AChassis, IsCommandedNoMoreThanFiftyTimesASecond) {
  drive();
  bench.sent.clear();
  bench.run(milliseconds(1000), kRun, {0.5, 0});
  EXPECT_NEAR(static_cast<double>(bench.sent.size()), 50, 1);
}

TEST(AChassisOnASerialLine, AsksForTheSpeedOfALineOfBytesWithoutAMessage) {
  const DriverEntry* const entry = find_driver("gt01_serial");
  test::TwistBench bench({entry, test::example_options(*entry), "gt01_serial"});
  const Packet packet = serial::motion(0, {});
  std::vector<std::uint8_t> bytes(packet.begin(), packet.end());
  EXPECT_EQ(bench.device->health(bench.now).reason, "the chassis was never heard");
  bytes.back() ^= 0xFFU;
  bench.made.bytes->on_bytes(bytes, bench.now, bench.out);
  EXPECT_EQ(bench.device->health(bench.now).reason,
            "bytes, but no message of the chassis: its speed, or another device?");
}

TEST_P(AChassis, StandsAfterAStopOfItsOwnUntilANewRequest) {
  for (const auto& [fault, words] : {std::pair{"estop", "emergency stop button"},
                                     {"soft_estop", "by software"},
                                     {"bumper", "bumper was touched"}}) {
    SCOPED_TRACE(fault);
    bench.set_fault("");
    bench.run(milliseconds(1500), kRest);
    drive();
    bench.set_fault(fault);
    bench.run(milliseconds(100), kRun, {0.5, 0});
    EXPECT_EQ(bench.status.state, AxisState::fault);
    EXPECT_THAT(reason(), HasSubstr(words));
    EXPECT_TRUE(bench.status.stops_all);
    expect_told_nothing_that_moves();
    bench.set_fault("");
    bench.run(milliseconds(3000), kRun, {0.5, 0});
    EXPECT_EQ(bench.status.state, AxisState::fault) << "whoever asked has not asked anew";
    EXPECT_FALSE(bench.status.stops_all) << "nobody presses it any more";
    EXPECT_LT(bench.fastest_radps(), 0.05);
  }
}

TEST_P(AChassis, IsGivenUpWhenItsRemoteControlTakesItOver) {
  drive();
  bench.set_fault("remote");
  bench.run(milliseconds(1500), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_THAT(reason(), HasSubstr("the remote control has"));
  EXPECT_FALSE(bench.status.stops_all);
  expect_told_nothing_that_moves();
  bench.set_fault("");
  bench.run(milliseconds(1000), kRun, {0.5, 0});
  EXPECT_LT(bench.fastest_radps(), 0.05) << "given back it remembers no twist";
}

/// Who sends it to its charger has it: what was asked is over, and comes back by a new request
/// only.
TEST_P(AChassis, IsGivenUpWhenItDocksByItself) {
  drive();
  ASSERT_TRUE(bench.set_fault("docking"));
  bench.run(milliseconds(100), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(reason(), "the chassis docks by itself: end it with its own tool");
  expect_told_nothing_that_moves();
  bench.set_fault("");
  bench.run(milliseconds(1500), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::fault) << "whoever asked has not asked anew";
  EXPECT_LT(bench.fastest_radps(), 0.05);
  bench.run(milliseconds(50), kRest);
  bench.run(milliseconds(2000), kRun, {0.5, 0});
  EXPECT_NEAR(bench.motion.twist.vx_mps, 0.5, 0.04);
}

/// Frozen at rest its speeds say that it does not obey, though it drives: it is told zero.
TEST_P(AChassis, IsStoppedWhenTheSpeedsThatItTellsFreezeAtRest) {
  bench.run(milliseconds(1500), kRest);
  ASSERT_TRUE(bench.set_fault("stuck_encoder"));
  bench.run(milliseconds(300), kRun, {0.5, 0});
  EXPECT_GT(bench.fastest_radps(), 1) << "it drives: this proves nothing";
  EXPECT_EQ(bench.motion.twist.vx_mps, 0);
  bench.run(milliseconds(900), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_THAT(reason(), HasSubstr("not in command"));
  expect_told_nothing_that_moves();
  bench.run(milliseconds(500), kRun, {0.5, 0});
  EXPECT_LT(bench.fastest_radps(), 0.05);
}

TEST_P(AChassis, IsNotInCommandWhenItIsToldToMoveAndStands) {
  bench.run(milliseconds(1500), kRest);
  bench.set_fault("deaf");
  bench.run(milliseconds(1200), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_THAT(reason(),
              HasSubstr(on_can() ? "does not let the host command it" : "not in command"));
  expect_told_nothing_that_moves();
}

TEST_P(AChassis, NamesWhatIsWrongWithItsDrives) {
  bench.run(milliseconds(1500), kRest);
  bench.set_fault("over_current");
  bench.run(milliseconds(200), kRest);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_THAT(reason(), HasSubstr(on_can() ? "left motor: overcurrent" : "front left drive"));
}

/// No frame lets go of it: told zero is all that it can be told, and nobody waits for more before
/// its power is taken.
TEST_P(AChassis, HasLetGoOnceItWasToldZeroThoughItDrivesOn) {
  drive();
  bench.set_fault("deaf");
  bench.run(milliseconds(500), kRest);
  ASSERT_GT(bench.motion.twist.vx_mps, 0.4) << "it does not hear";
  EXPECT_EQ(bench.status.state, AxisState::running);
  bench.run(milliseconds(40), AxisRequest::idle);
  EXPECT_EQ(bench.status.state, AxisState::idle);
}

/// Whatever else the wire knows: another state, a switch, an end of an emergency stop.
TEST_P(AChassis, IsNeverToldAnythingButTwists) {
  const auto is_forbidden = [&](const test::Sent& one) {
    return bench.effect_of(one) == FrameEffect::forbidden;
  };
  if (on_can()) {
    for (const bool on : {true, false}) EXPECT_TRUE(is_forbidden(can::estop(on)));
    EXPECT_TRUE(is_forbidden(can::ask_version()));
    // Wheel speeds: 15 mm/s on the left would end the emergency stop.
    CanFrame wheels;
    wheels.id = can::kCommandId;
    wheels.len = 8;
    wheels.data = {0x01, 0x0F, 0x00, 0x0F, 0x00};
    EXPECT_TRUE(is_forbidden(wheels));
    // A twist with something behind it.
    CanFrame more = can::motion({});
    more.data[7] = 1;
    EXPECT_TRUE(is_forbidden(more));
    return;
  }
  for (const bool on : {true, false}) EXPECT_TRUE(is_forbidden(serial::estop(1, on)));
  const std::uint8_t off[2] = {0, 0};
  for (const int id : {0x01, 0x05, 0x06, 0x07, 0xB0, 0xB1})
    EXPECT_TRUE(is_forbidden(serial::compose(1, static_cast<std::uint8_t>(id), off))) << id;
  // Wheel speeds, and half a packet.
  const std::uint8_t wheels[8] = {1, 0, 0xC8, 0, 0xC1};
  EXPECT_TRUE(is_forbidden(serial::compose(1, serial::id::kMotion, wheels)));
  Packet half = serial::motion(1, {});
  half.resize(half.size() - 1);
  EXPECT_TRUE(is_forbidden(half));
}

TEST_P(AChassis, ScalesWhatItIsToldAndTells) {
  test::Subject scaled = subject();
  scaled.options.set("speed_scale", 1.25).set("turn_scale", 0.8);
  test::TwistBench other(scaled);
  other.run(milliseconds(1500), kRest);
  other.run(milliseconds(2000), kRun, {0.5, 0.4});
  EXPECT_NEAR(other.motion.twist.vx_mps, 0.5, 0.04);
  EXPECT_NEAR(other.motion.twist.wz_radps, 0.4, 0.04);
  const Twist said = other.actuator->setpoint_twist(test::message_of(other.sent.back()), 0);
  EXPECT_NEAR(said.vx_mps, 0.5, 0.002);
  EXPECT_NEAR(said.wz_radps, 0.4, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Wires, AChassis, ::testing::Values("gt01_serial", "gt01_can"),
                         [](const auto& wire) { return std::string(wire.param); });

/// Two of three sums are wrong: what is left is enough to stop by, and is told.
TEST(Gt01SerialDriver, CountsWrongSumsAndGoesStaleWhenTooFewPacketsAreLeft) {
  const DriverEntry* const entry = find_driver("gt01_serial");
  test::TwistBench bench({entry, test::example_options(*entry), "gt01_serial"});
  bench.run(milliseconds(1500), kRest);
  const auto before = bench.device->health(bench.now);
  bench.set_fault("bad_sums");
  bench.run(milliseconds(3000), kRest);
  const auto after = bench.device->health(bench.now);
  EXPECT_GT(after.bad, before.bad + 50);
  EXPECT_EQ(after.state, SourceState::fresh) << "one packet in 60 ms";
}

/// Its speed comes on, and its motors' faults; who pressed what nobody knows any more.
TEST(Gt01CanDriver, NamesTheStateThatCeased) {
  const DriverEntry* const entry = find_driver("gt01_can");
  test::TwistBench bench({entry, test::example_options(*entry), "gt01_can"});
  bench.run(milliseconds(1500), kRest);
  bench.run(milliseconds(1000), kRun, {0.5, 0});
  bench.lost = 0x20;
  bench.run(milliseconds(150), kRun, {0.5, 0});
  EXPECT_EQ(bench.device->health(bench.now).state, SourceState::stale);
  EXPECT_THAT(std::string(bench.device->health(bench.now).reason.view()),
              HasSubstr("no state (0x20) for 0.1"));
  bench.set_fault("bumper");
  bench.run(milliseconds(250), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::unknown);
  EXPECT_THAT(std::string(bench.status.reason.view()), HasSubstr("no state (0x20) for"));
}

TEST(Gt01CanDriver, IsGivenUpWhenSomebodyElseCommandsIt) {
  const DriverEntry* const entry = find_driver("gt01_can");
  test::TwistBench bench({entry, test::example_options(*entry), "gt01_can"});
  bench.run(milliseconds(1500), kRest);
  bench.run(milliseconds(1000), kRun, {0.5, 0});
  bench.made.frames->on_frame(can::motion({}), bench.now, bench.out);
  bench.run(milliseconds(50), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::running) << "the guard's zeros are welcome";
  bench.made.frames->on_frame(can::motion({0.1, 0}), bench.now, bench.out);
  bench.run(milliseconds(50), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_THAT(std::string(bench.status.reason.view()), HasSubstr("somebody else commands it"));
}

}  // namespace
}  // namespace drover::gt01
