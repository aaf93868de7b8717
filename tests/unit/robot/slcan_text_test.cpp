// The serial CAN adapter's text, both ways.
#include "sim/robot/slcan_text.h"

#include <gtest/gtest.h>

namespace drover::sim {
namespace {

TEST(SlcanText, RefusesWhatIsNoFrame) {
  for (const auto* line :
       {"", "S6", "O", "C", "t", "t12", "t123", "t1239", "t1232112", "t12G0", "t8000", "t1231XY",
        "T123456781", "r12321122", "T200000000", "t123211223"})
    EXPECT_FALSE(parse_slcan(line)) << line;
}

TEST(SlcanText, RefusesFramesThatItCannotCarry) {
  std::string text;
  auto frame = make_frame(1, {2});
  frame.fd = true;
  EXPECT_FALSE(append_slcan(text, frame));
  frame.fd = false;
  frame.error = true;
  EXPECT_FALSE(append_slcan(text, frame));
  EXPECT_EQ(text, "");
}

TEST(SlcanText, ReadsTheFrameThatTheKernelWrote) {
  EXPECT_EQ(parse_slcan("t12321122"), make_frame(0x123, {0x11, 0x22}));
}

TEST(SlcanText, WritesWhatTheKernelReads) {
  std::string text;
  ASSERT_TRUE(append_slcan(text, make_frame(0x001, {0xAA, 0xBB})));
  EXPECT_EQ(text, "t0012AABB\r");
}

TEST(SlcanText, KeepsEveryKindOfFrame) {
  for (const bool extended : {false, true}) {
    for (const bool remote : {false, true}) {
      CanFrame frame = make_frame(extended ? 0x1ABCDEF0 : 0x7FF);
      frame.extended = extended;
      frame.remote = remote;
      frame.len = 8;
      for (std::size_t i = 0; i < 8 && !remote; ++i)
        frame.data[i] = static_cast<std::uint8_t>(i * 31);
      std::string text;
      ASSERT_TRUE(append_slcan(text, frame));
      text.pop_back();
      EXPECT_EQ(parse_slcan(text), frame) << text;
    }
  }
}

}  // namespace
}  // namespace drover::sim
