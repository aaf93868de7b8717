// A stop that two readers hear is one stop, and none is lost by that.
#include "ros2/stop_copies.h"

#include <gtest/gtest.h>

namespace drover::ros2 {
namespace {

using namespace std::chrono_literals;

class CopiesOfAStop : public ::testing::Test {
 protected:
  bool any(std::uint64_t writer, std::int64_t stamp) {
    return copies.is_stop(StopReader::any, {writer, stamp}, now);
  }
  bool sure(std::uint64_t writer, std::int64_t stamp) {
    return copies.is_stop(StopReader::sure, {writer, stamp}, now);
  }
  StopCopies copies;
  Time now{100s};
};

TEST_F(CopiesOfAStop, AreOneStopWhicheverComesFirst) {
  EXPECT_TRUE(any(1, 10));
  now += 100ms;
  EXPECT_FALSE(sure(1, 10));
  EXPECT_TRUE(sure(1, 20));
  EXPECT_FALSE(any(1, 20));
}
TEST_F(CopiesOfAStop, OfOtherWritersAndOtherMomentsAreOthers) {
  EXPECT_TRUE(any(1, 10));
  EXPECT_TRUE(sure(2, 10));
  EXPECT_TRUE(sure(1, 11));
}
/// A writer without a clock says each at the same moment.
TEST_F(CopiesOfAStop, ThatLookAlikeAreAsManyAsOneReaderHears) {
  int stops = 0;
  for (int i = 0; i < 10; ++i) stops += any(1, 0) ? 1 : 0;
  for (int i = 0; i < 10; ++i) stops += sure(1, 0) ? 1 : 0;
  EXPECT_EQ(stops, 10);
  EXPECT_TRUE(sure(1, 0));
}
TEST_F(CopiesOfAStop, AreNoneAnyMoreAfterSomeSeconds) {
  EXPECT_TRUE(any(1, 0));
  now += 6s;
  EXPECT_TRUE(sure(1, 0)) << "said again";
}
TEST_F(CopiesOfAStop, AreForgottenInAFlood) {
  EXPECT_TRUE(any(1, 0));
  for (int i = 1; i <= 1000; ++i) EXPECT_TRUE(any(1, i));
  EXPECT_TRUE(sure(1, 0)) << "a stop more, and none less";
}

}  // namespace
}  // namespace drover::ros2
