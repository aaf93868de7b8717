#include "runtime/heard_twice.h"

#include <gtest/gtest.h>

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

constexpr Time kNow{1000s};

TEST(HeardTwice, KnowsAStopThatCameTheOtherWayWhicheverWasFirst) {
  HeardTwice heard;
  EXPECT_FALSE(heard.again(Way::alone, "stop", kNow));
  EXPECT_TRUE(heard.again(Way::with_others, "stop", kNow + 20s));
  EXPECT_FALSE(heard.again(Way::with_others, "stop", kNow + 21s));
  EXPECT_TRUE(heard.again(Way::alone, "stop", kNow + 21s));
}

TEST(HeardTwice, CountsEachStopOfAPersonWhoPressesTwice) {
  HeardTwice heard;
  EXPECT_FALSE(heard.again(Way::alone, "stop", kNow));
  EXPECT_FALSE(heard.again(Way::alone, "stop", kNow));
  EXPECT_FALSE(heard.again(Way::alone, "cancel", kNow));
  EXPECT_TRUE(heard.again(Way::with_others, "stop", kNow + 1s));
  EXPECT_TRUE(heard.again(Way::with_others, "stop", kNow + 1s));
  EXPECT_FALSE(heard.again(Way::with_others, "stop", kNow + 1s));
}

TEST(HeardTwice, ForgetsWhatNeverCameTheOtherWay) {
  HeardTwice heard;
  EXPECT_FALSE(heard.again(Way::alone, "stop", kNow));
  EXPECT_FALSE(heard.again(Way::with_others, "stop", kNow + 61s));
}

TEST(HeardTwice, DistrustsWhatComesBetweenAStopAndItsOtherSelf) {
  HeardTwice heard;
  EXPECT_FALSE(heard.overtook(kNow));
  EXPECT_FALSE(heard.again(Way::alone, "stop", kNow));
  EXPECT_TRUE(heard.overtook(kNow + 1s));
  EXPECT_TRUE(heard.again(Way::with_others, "stop", kNow + 1s));
  EXPECT_FALSE(heard.overtook(kNow + 1s));
}

TEST(HeardTwice, DistrustsNothingForEverWhenTheBrokerDroppedTheOther) {
  HeardTwice heard;
  EXPECT_FALSE(heard.again(Way::alone, "stop", kNow));
  EXPECT_FALSE(heard.overtook(kNow + 2100ms));
}

TEST(HeardTwice, DistrustsNothingAfterAStopThatCameWithTheOthersOnly) {
  HeardTwice heard;
  EXPECT_FALSE(heard.again(Way::with_others, "stop", kNow));
  EXPECT_FALSE(heard.overtook(kNow));
}

}  // namespace
}  // namespace drover::runtime
