#include "drivers/gt01/can/codec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace drover::gt01::can {
namespace {

CanFrame frame(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
  CanFrame out;
  out.id = id;
  out.len = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), out.data.begin());
  return out;
}

template <class T>
T decoded(const CanFrame& frame) {
  const auto report = decode(frame);
  const T* value = report ? std::get_if<T>(&*report) : nullptr;
  EXPECT_NE(value, nullptr);
  return value == nullptr ? T{} : *value;
}

void expect_bytes(const CanFrame& got, const CanFrame& wanted) {
  EXPECT_EQ(got.id, wanted.id);
  ASSERT_EQ(got.len, wanted.len);
  for (std::size_t i = 0; i < got.len; ++i) EXPECT_EQ(got.data[i], wanted.data[i]) << i;
}

// The maker's examples.

TEST(Gt01Can, WritesTheMakersTwists) {
  expect_bytes(motion({1, 0}), frame(1, {0x01, 0x01, 0xE8, 0x03, 0, 0, 0, 0}));
  expect_bytes(motion({-1, -0.1}), frame(1, {0x01, 0x01, 0x18, 0xFC, 0x9C, 0xFF, 0, 0}));
  expect_bytes(motion({1, 0}, TwistLayout::table), frame(1, {0xE8, 0x03, 0, 0, 0, 0, 0, 0}));
}

TEST(Gt01Can, WritesTheSoftwaresEmergencyStopAndItsEnd) {
  expect_bytes(estop(true), frame(1, {0x01, 0x0F, 0x01}));
  expect_bytes(estop(false), frame(1, {0x01, 0x0F, 0x00}));
  expect_bytes(ask_version(), frame(1, {0x01, 0x31}));
}

TEST(Gt01Can, ReadsBackWhatItAsks) {
  for (const auto layout : {TwistLayout::example, TwistLayout::table}) {
    const auto asked = asked_twist(motion({0.255, -0.5}, layout), layout);
    ASSERT_TRUE(asked);
    EXPECT_DOUBLE_EQ(asked->vx_mps, 0.255);
    EXPECT_DOUBLE_EQ(asked->wz_radps, -0.5);
  }
  EXPECT_FALSE(asked_twist(estop(false)));
  EXPECT_FALSE(asked_twist(frame(1, {0x01, 0x64, 0, 0xC8, 0, 0, 0}))) << "wheel speeds";
}

/// A speed whose low byte is 01 would be "emergency stop", "docking", or who knows what.
TEST(Gt01Can, SaysInTheTablesLayoutNoSpeedThatReadsAsAnotherCommand) {
  for (int mmps = -2000; mmps <= 2000; ++mmps) {
    const CanFrame said = motion({mmps / 1000.0, 0.015}, TwistLayout::table);
    EXPECT_NE(said.data[0], 0x01) << mmps;
    const auto asked = asked_twist(said, TwistLayout::table);
    ASSERT_TRUE(asked) << mmps;
    EXPECT_LE(std::abs(asked->vx_mps), std::abs(mmps / 1000.0));
    EXPECT_NEAR(asked->vx_mps, mmps / 1000.0, 0.0011);
  }
  EXPECT_FALSE(asked_twist(estop(true), TwistLayout::table));
  EXPECT_FALSE(asked_twist(frame(1, {0x01, 0x0F, 0, 0, 0, 0, 0, 0}), TwistLayout::table));
}

TEST(Gt01Can, AsksForNoMoreThanItIsTold) {
  for (const double speed_mps : {0.0129, -0.0129, 0.5706, 0.0009}) {
    const auto asked = asked_twist(motion({speed_mps, speed_mps}));
    EXPECT_LE(std::abs(asked->vx_mps), std::abs(speed_mps));
    EXPECT_LE(std::abs(asked->wz_radps), std::abs(speed_mps));
  }
  EXPECT_DOUBLE_EQ(asked_twist(motion({0.57, 0}))->vx_mps, 0.57);
}

TEST(Gt01Can, AsksForRestWhereItIsGivenNoNumberAndForTheMostWhereForTooMuch) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_bytes(motion({nan, nan}), motion({0, 0}));
  EXPECT_DOUBLE_EQ(asked_twist(motion({1e9, -1e9}))->vx_mps, 32.767);
  EXPECT_DOUBLE_EQ(asked_twist(motion({1e9, -1e9}))->wz_radps, -32.767);
}

TEST(Gt01Can, ReadsTheMakersReports) {
  EXPECT_DOUBLE_EQ(decoded<Motion>(frame(0x10, {0x64, 0, 0x64, 0})).twist.vx_mps, 0.1);
  EXPECT_DOUBLE_EQ(decoded<Motion>(frame(0x10, {0x38, 0xFF, 0x64, 0})).twist.vx_mps, -0.2);
  EXPECT_DOUBLE_EQ(decoded<Motion>(frame(0x10, {0x38, 0xFF, 0x64, 0})).twist.wz_radps, 0.1);
  EXPECT_DOUBLE_EQ(decoded<Wheels>(frame(0x11, {0x64, 0, 0x96, 0})).left_mps, 0.1);
  EXPECT_DOUBLE_EQ(decoded<Wheels>(frame(0x11, {0x64, 0, 0x96, 0})).right_mps, 0.15);
  EXPECT_DOUBLE_EQ(decoded<Currents>(frame(0x12, {0x32, 0, 0x46, 0})).left_A, 5);
  EXPECT_DOUBLE_EQ(decoded<Currents>(frame(0x12, {0x32, 0, 0x46, 0})).right_A, 7);
  const auto state = decoded<State>(frame(0x20, {0x02, 0x39, 0xFE, 0x01, 0, 0, 0, 0}));
  EXPECT_EQ(state.mode, static_cast<std::uint8_t>(Mode::host));
  EXPECT_EQ(state.battery_percent, 57);
  EXPECT_DOUBLE_EQ(state.voltage_V, 51.0);
  EXPECT_EQ(state.status, 0);
  const auto faults = decoded<MotorFaults>(frame(0x30, {0x08, 0, 0x04, 0}));
  EXPECT_EQ(faults.left, 1U << 3U);
  EXPECT_EQ(faults.right, 1U << 2U);
  EXPECT_EQ(decoded<Version>(frame(0x41, {2, 0, 0, 0, 0x18, 9, 1, 0})).major, 2);
}

TEST(Gt01Can, HasAWordForEachFaultOfAMotor) {
  EXPECT_EQ(std::string(motor_fault(3)), "overcurrent");
  EXPECT_EQ(std::string(motor_fault(2)), "Hall sensors");
  EXPECT_EQ(std::string(motor_fault(15)), "");
}

TEST(Gt01Can, LeavesAloneWhatIsNotExactlyAsDocumented) {
  EXPECT_FALSE(decode(frame(0x10, {0x64, 0, 0x64}))) << "too short";
  EXPECT_FALSE(decode(frame(0x15, {0x64, 0, 0x64, 0})));
  CanFrame odd = frame(0x10, {0x64, 0, 0x64, 0});
  odd.extended = true;
  EXPECT_FALSE(decode(odd));
  odd.extended = false;
  odd.remote = true;
  EXPECT_FALSE(decode(odd));
}

TEST(Gt01Can, ReadsOfAnyFrameOnlyWhatItWouldWriteItself) {
  std::mt19937 random(1);
  int twists = 0;
  for (int i = 0; i < 100000; ++i) {
    CanFrame any;
    any.id = static_cast<std::uint32_t>(random() % 0x50);
    any.len = static_cast<std::uint8_t>(random() % 9);
    for (auto& byte : any.data) byte = static_cast<std::uint8_t>(random());
    any.id = i % 2 == 0 ? kCommandId : any.id;
    any.len = i % 2 == 0 ? std::uint8_t{8} : any.len;
    if (i % 4 == 0) any.data[0] = any.data[1] = 1;
    EXPECT_FALSE(any.id == kCommandId && decode(any)) << "a command is no report";
    const auto twist = asked_twist(any);
    if (!twist) continue;
    ++twists;
    if (twist->vx_mps < -32.767 || twist->wz_radps < -32.767)
      continue;  // it says no more than that
    const CanFrame again = motion(*twist);
    EXPECT_TRUE(std::equal(again.data.begin(), again.data.begin() + 6, any.data.begin()));
  }
  EXPECT_GT(twists, 20000);
}

}  // namespace
}  // namespace drover::gt01::can
