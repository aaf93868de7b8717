#include "drivers/canopen/emcy.h"

#include <gtest/gtest.h>

#include "support/describe.h"

namespace drover::canopen {
namespace {

using test::parse_frame;

// Frames of christiansandberg/canopen, test/test_emcy.py.
TEST(CanopenEmergency, ReadsTheFramesOfALibrarysTests) {
  const auto first = decode_emergency(parse_frame("081#0120020001020304"), 1);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->code, 0x2001);
  EXPECT_EQ(first->error_register, 2);
  EXPECT_EQ(first->makers, (std::array<std::uint8_t, 5>{0, 1, 2, 3, 4}));
  EXPECT_EQ(decode_emergency(parse_frame("081#1090010403020100"), 1)->code, 0x9010);
}

// A drive's trace in ros-industrial/ros2_canopen#298.
TEST(CanopenEmergency, ReadsADrivesFaultAndItsEnd) {
  EXPECT_EQ(decode_emergency(parse_frame("081#0152800000007008"), 1)->code, 0x5201);
  EXPECT_TRUE(decode_emergency(parse_frame("081#0000000000000000"), 1)->is_reset());
}

TEST(CanopenEmergency, IsNotSyncAndNotAnotherNodes) {
  EXPECT_FALSE(decode_emergency(parse_frame("080#"), 1));
  EXPECT_FALSE(decode_emergency(parse_frame("080#0120020001020304"), 0));
  EXPECT_FALSE(decode_emergency(parse_frame("082#0120020001020304"), 1));
  EXPECT_FALSE(decode_emergency(parse_frame("081#01200200010203"), 1));
}

TEST(CanopenEmergency, IsToldInWords) {
  EXPECT_EQ(emergency_text(0x8130), "it misses the heartbeat it watches");
  EXPECT_EQ(emergency_text(0x3220), "supply voltage too low");
  EXPECT_EQ(emergency_text(0x3299), "supply voltage");
  EXPECT_EQ(emergency_text(0x4999), "temperature");
  EXPECT_EQ(emergency_text(0xFF01), "an error of the maker's own");
}

}  // namespace
}  // namespace drover::canopen
