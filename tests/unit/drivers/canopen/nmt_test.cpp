#include "drivers/canopen/nmt.h"

#include <gtest/gtest.h>

#include "support/describe.h"

namespace drover::canopen {
namespace {

using test::describe;
using test::parse_frame;

TEST(CanopenNmt, CommandsOneNode) {
  EXPECT_EQ(describe(encode_nmt(NmtCommand::operational, 5).value()), "000#0105");
  EXPECT_EQ(describe(encode_nmt(NmtCommand::pre_operational, 5).value()), "000#8005");
  EXPECT_EQ(describe(encode_nmt(NmtCommand::reset_node, 5).value()), "000#8105");
}

TEST(CanopenNmt, NeverCommandsEveryNodeAtOnce) {
  EXPECT_FALSE(encode_nmt(NmtCommand::reset_node, 0));
  EXPECT_FALSE(encode_nmt(NmtCommand::reset_node, 128));
}

TEST(CanopenNmt, ReadsBootUpAndHeartbeat) {
  const auto boot = decode_heartbeat(parse_frame("705#00"));
  ASSERT_TRUE(boot);
  EXPECT_EQ(boot->node, 5);
  EXPECT_EQ(boot->state, NodeState::boot_up);
  EXPECT_EQ(decode_heartbeat(parse_frame("705#05"))->state, NodeState::operational);
  EXPECT_EQ(decode_heartbeat(parse_frame("77F#7F"))->state, NodeState::pre_operational);
  EXPECT_EQ(decode_heartbeat(parse_frame("701#04"))->state, NodeState::stopped);
}

TEST(CanopenNmt, ReadsTheToggledAnswerOfNodeGuarding) {
  EXPECT_EQ(decode_heartbeat(parse_frame("705#85"))->state, NodeState::operational);
}

TEST(CanopenNmt, TakesNothingElseForAHeartbeat) {
  for (const char* frame : {"700#05", "780#05", "705#0500", "705#06", "705#R", "00000705#05"})
    EXPECT_FALSE(decode_heartbeat(parse_frame(frame))) << frame;
}

TEST(CanopenNmt, SendsAHeartbeatOfItsOwn) {
  EXPECT_EQ(describe(encode_heartbeat(0x7F, NodeState::operational)), "77F#05");
}

}  // namespace
}  // namespace drover::canopen
