#include "cli/candump.h"

#include <gtest/gtest.h>

namespace drover::cli {
namespace {

TEST(Candump, RefusesWhatIsNoLoggedFrame) {
  for (const auto* line :
       {"", "can0 123#00", "(1.5) can0", "(1.5) can0 123", "(1.5) can0 12#00", "(x.5) can0 123#00",
        "(1) can0 123#00", "(-1.5) can0 123#00", "(1.5) can0 123#0", "(1.5) can0 123#0G",
        "(1.5) can0 800#00", "(1.5) can0 123#001122334455667788", "(1.5) can0 123#R9",
        "(1.5) can0 123##", "(1.5) can0 FFFFFFFF#00", "(99999999999.5) can0 123#00",
        // No interface has such a name, and on a terminal it would do something.
        "(1.5) c\x1b[2J 123#00", "(1.5) can\x80 123#00", "(1.5) abcdefghijklmnop 123#00"})
    EXPECT_FALSE(parse_candump(line)) << line;
}

TEST(Candump, ReadsEveryKindOfFrame) {
  const auto plain = parse_candump("(1718000000.123456) can0 061#0000AAff R");
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->time.time_since_epoch().count(), 1718000000123456000);
  EXPECT_EQ(plain->bus, "can0");
  EXPECT_EQ(plain->frame, make_frame(0x61, {0, 0, 0xAA, 0xFF}));

  const auto extended = parse_candump("(0.5) vcan1 00000061#");
  ASSERT_TRUE(extended);
  EXPECT_TRUE(extended->frame.extended);
  EXPECT_EQ(extended->frame.id, 0x61U);

  const auto remote = parse_candump("(0.5) can0 061#R8");
  ASSERT_TRUE(remote);
  EXPECT_TRUE(remote->frame.remote);
  EXPECT_EQ(remote->frame.len, 8);

  const auto error = parse_candump("(0.5) can0 20000040#0000000000000000");
  ASSERT_TRUE(error);
  EXPECT_TRUE(error->frame.error);
  EXPECT_EQ(error->frame.id, 0x40U);

  const auto fd = parse_candump("(0.5) can0 123##1000102030405060708090A0B");
  ASSERT_TRUE(fd);
  EXPECT_TRUE(fd->frame.fd);
  EXPECT_EQ(fd->frame.len, 12);
  EXPECT_EQ(fd->frame.data[11], 0x0B);
}

}  // namespace
}  // namespace drover::cli
