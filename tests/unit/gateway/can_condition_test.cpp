// The error frames are those of Linux 6.1's slcan driver, as candump printed them for the adapter's
// texts sw128096, sp130010, e3acO and sb256256.
#include "gateway/can_condition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace drover::gateway {
namespace {

using namespace std::chrono_literals;
using State = CanCondition::State;

constexpr Time kStart{std::chrono::seconds(100)};

CanFrame error_frame(std::uint32_t classes, std::array<std::uint8_t, 8> data) {
  CanFrame frame;
  frame.error = true;
  frame.id = classes;
  frame.len = 8;
  std::copy(data.begin(), data.end(), frame.data.begin());
  return frame;
}

const CanFrame kWarning = error_frame(0x204, {0, 0x04, 0, 0, 0, 0, 0x60, 0x80});
const CanFrame kPassive = error_frame(0x204, {0, 0x10, 0, 0, 0, 0, 0x0A, 0x82});
const CanFrame kManyClasses = error_frame(0x0AC, {0, 0x02, 0x01, 0x08, 0, 0, 0, 0});
const CanFrame kOff = error_frame(0x040, {});

TEST(CanCondition, IsGoodWithoutErrorFrames) {
  CanCondition condition;
  EXPECT_TRUE(condition.text("can0", kStart).empty());
  condition.on_frame(kStart);
  EXPECT_TRUE(condition.text("can0", kStart + 10s).empty());
}

TEST(CanCondition, TellsTheErrorCounters) {
  CanCondition condition;
  condition.on_error_frame(kWarning, kStart);
  EXPECT_EQ(condition.state(), State::warning);
  EXPECT_EQ(condition.text("can0", kStart),
            "can0 has many errors (errors: 96 sending, 128 receiving): wiring or termination");
  condition.on_error_frame(kPassive, kStart);
  EXPECT_EQ(condition.state(), State::passive);
  EXPECT_EQ(condition.text("can1", kStart),
            "can1 is error-passive (errors: 10 sending, 130 receiving): wiring, termination, or "
            "drives without power");
}

TEST(CanCondition, KeepsItsStateWhenAFrameSaysNothingOfIt) {
  CanCondition condition;
  condition.on_error_frame(kPassive, kStart);
  condition.on_error_frame(kManyClasses, kStart + 1ms);
  condition.on_frame(kStart + 2ms);
  EXPECT_EQ(condition.state(), State::passive);
}

TEST(CanCondition, IsBusOffUntilItIsRestartedOrHearsAFrame) {
  CanCondition condition;
  condition.on_error_frame(kOff, kStart);
  EXPECT_EQ(condition.text("can0", kStart + 1h),
            "can0 is bus-off: look at wiring, termination and bit rate, then set it down and up");
  condition.on_error_frame(error_frame(0x100, {}), kStart + 1h);
  EXPECT_EQ(condition.state(), State::active);
  condition.on_error_frame(kOff, kStart + 2h);
  condition.on_frame(kStart + 3h);
  EXPECT_EQ(condition.state(), State::active);
}

TEST(CanCondition, GetsWellWhenTheControllerSaysSo) {
  CanCondition condition;
  condition.on_error_frame(kPassive, kStart);
  condition.on_error_frame(error_frame(0x004, {0, 0x40, 0, 0, 0, 0, 0, 0}), kStart + 1s);
  EXPECT_EQ(condition.state(), State::active);
  EXPECT_TRUE(condition.text("can0", kStart + 1s).empty());
}

TEST(CanCondition, DoubtsTheBitRateWhenThereAreOnlyErrors) {
  CanCondition condition;
  for (auto t = kStart; t <= kStart + 2s; t += 10ms) condition.on_error_frame(kManyClasses, t);
  EXPECT_EQ(condition.text("can0", kStart + 2s), "can0 hears only errors: is the bit rate right?");
  EXPECT_TRUE(condition.text("can0", kStart + 4s).empty()) << "they have ceased";
  condition.on_frame(kStart + 5s);
  condition.on_error_frame(kManyClasses, kStart + 6s);
  EXPECT_TRUE(condition.text("can0", kStart + 6s).empty()) << "one among frames";
}

}  // namespace
}  // namespace drover::gateway
