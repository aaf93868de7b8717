#include "text/trimmed.h"

#include <gtest/gtest.h>

namespace drover::text {
namespace {

TEST(Trimmed, TakesAwayWhatStandsAroundAWord) {
  EXPECT_EQ(trimmed(" \t0x1000  0x0002\t\r"), "0x1000  0x0002");
  EXPECT_EQ(trimmed("word"), "word");
}

TEST(Trimmed, LeavesNothingOfNothing) {
  EXPECT_EQ(trimmed(""), "");
  EXPECT_EQ(trimmed(" \t \r"), "");
}

}  // namespace
}  // namespace drover::text
