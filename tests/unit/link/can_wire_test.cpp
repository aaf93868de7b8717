#include "link/can_wire.h"

#include <gtest/gtest.h>

namespace drover::link {

TEST(CanWire, RefusesSizesThatAreNoFrame) {
  const canfd_frame wire{};
  CanFrame frame;
  EXPECT_FALSE(from_wire(wire, 0, frame));
  EXPECT_FALSE(from_wire(wire, CAN_MTU - 1, frame));
  EXPECT_FALSE(from_wire(wire, CANFD_MTU - 1, frame));
}

TEST(CanWire, RefusesALengthBeyondTheFrame) {
  canfd_frame wire{};
  CanFrame frame;
  wire.len = 9;
  EXPECT_FALSE(from_wire(wire, CAN_MTU, frame));
  EXPECT_TRUE(from_wire(wire, CANFD_MTU, frame));
  wire.len = 65;
  EXPECT_FALSE(from_wire(wire, CANFD_MTU, frame));
}

TEST(CanWire, ReadsAnErrorFrameAsClassesNotAsAnIdentifier) {
  canfd_frame wire{};
  wire.can_id = 0x20000040;  // bus off, linux/can/error.h
  wire.len = 8;
  CanFrame frame;
  ASSERT_TRUE(from_wire(wire, CAN_MTU, frame));
  EXPECT_TRUE(frame.error);
  EXPECT_FALSE(frame.extended);
  EXPECT_EQ(frame.id, 0x40U);
}

TEST(CanWire, KeepsEveryKindOfFrame) {
  auto classic = make_frame(0x06D, {0, 0, 0, 0x40, 0, 0, 0, 0});
  auto extended = make_frame(0x18FF0001, {1});
  extended.extended = true;
  auto remote = make_frame(0x069);
  remote.remote = true;
  remote.len = 8;
  CanFrame fd;
  fd.id = 0x123;
  fd.fd = true;
  fd.len = 64;
  for (std::uint8_t i = 0; i < 64; ++i) fd.data[i] = i;
  for (const auto& frame : {classic, extended, remote, fd}) {
    canfd_frame wire;
    const auto size = to_wire(frame, wire);
    EXPECT_EQ(size, frame.fd ? CANFD_MTU : CAN_MTU);
    CanFrame again;
    ASSERT_TRUE(from_wire(wire, size, again));
    EXPECT_EQ(again, frame);
  }
}

}  // namespace drover::link
