#include <gtest/gtest.h>
#include <linux/can.h>

#include "runtime/guard_client.h"

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

StopRecipe recipe(std::initializer_list<CanFrame> frames) {
  StopRound round;
  for (const CanFrame& frame : frames) EXPECT_TRUE(round.frames.push_back(frame));
  StopRecipe stop;
  EXPECT_TRUE(stop.rounds.push_back(round));
  return stop;
}

TEST(GuardedAxis, IsStoppedByAllFramesOfItsRecipeInOneRound) {
  const auto axis =
      guarded_axis("can0", recipe({make_frame(0x02D, {0, 0}), make_frame(0x02E, {1})}));
  EXPECT_EQ(axis.name, "can0 02D");
  ASSERT_EQ(axis.rounds.size(), 1U);
  ASSERT_EQ(axis.rounds[0].size(), 2U);
  EXPECT_EQ(axis.rounds[0][0].size(), sizeof(can_frame));
}

TEST(GuardedAxis, IsStoppedAtThePaceOfItsRecipe) {
  StopRecipe stop = recipe({make_frame(0x02D, {0})});
  EXPECT_EQ(guarded_axis("can0", stop).period, 10ms);
  stop.period = 25ms;
  EXPECT_EQ(guarded_axis("can0", stop).period, 25ms);
}

TEST(GuardedAxis, IsStoppedByEachRoundOfPacketsOnATty) {
  StopRecipe stop;
  for (const std::uint8_t count : {std::uint8_t{0}, std::uint8_t{1}}) {
    StopRound round;
    Packet packet;
    for (const std::uint8_t byte : {std::uint8_t{0x55}, count}) EXPECT_TRUE(packet.push_back(byte));
    EXPECT_TRUE(round.packets.push_back(packet));
    EXPECT_TRUE(stop.rounds.push_back(round));
  }
  const auto axis = guarded_axis("chassis", stop);
  EXPECT_EQ(axis.name, "chassis");
  ASSERT_EQ(axis.rounds.size(), 2U);
  EXPECT_EQ(axis.rounds[0][0], (std::vector<std::uint8_t>{0x55, 0}));
  EXPECT_EQ(axis.rounds[1][0], (std::vector<std::uint8_t>{0x55, 1}));
}

TEST(GuardedAxis, IsKnownByItsLongId) {
  CanFrame frame = make_frame(0x18FF0012, {0});
  frame.extended = true;
  EXPECT_EQ(guarded_axis("can1", recipe({frame})).name, "can1 18FF0012");
}

}  // namespace
}  // namespace drover::runtime
