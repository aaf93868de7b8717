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

TEST(HeardTwice, WaitsForNothingThatWasLostWithTheConnection) {
  HeardTwice heard;
  EXPECT_FALSE(heard.again(Way::alone, "stop", kNow)) << "the first connection was away";
  heard.begin_anew();
  EXPECT_FALSE(heard.again(Way::alone, "stop", kNow + 5s));
  EXPECT_TRUE(heard.again(Way::with_others, "stop", kNow + 5s));
  EXPECT_FALSE(heard.overtook(kNow + 6s));
  EXPECT_FALSE(heard.again(Way::with_others, "stop", kNow + 10s)) << "it wants an answer";
}

TEST(HeardTwice, DistrustsWhatComesBetweenAStopAndItsOtherSelf) {
  HeardTwice heard;
  EXPECT_FALSE(heard.overtook(kNow));
  EXPECT_FALSE(heard.again(Way::alone, "stop", kNow));
  EXPECT_TRUE(heard.overtook(kNow + 1s));
  EXPECT_TRUE(heard.again(Way::with_others, "stop", kNow + 1s));
  EXPECT_FALSE(heard.overtook(kNow + 1s));
}

TEST(HeardTwice, TakesNoStopForTheOtherSelfOfOneLongAgo) {
  HeardTwice heard;
  EXPECT_FALSE(heard.again(Way::with_others, "stop", kNow)) << "the second connection was away";
  EXPECT_FALSE(heard.again(Way::alone, "stop", kNow + 10s));
  EXPECT_TRUE(heard.overtook(kNow + 10s));
}

TEST(HeardTwice, DistrustsWhatComesAfterAStopThatNobodyCouldKeep) {
  HeardTwice heard;
  heard.lost(kNow);
  EXPECT_TRUE(heard.overtook(kNow + 1s));
  EXPECT_FALSE(heard.overtook(kNow + 2100ms));
}

TEST(HeardTwice, ExpectsTheOtherSelfOfAStopThatCameJustNow) {
  HeardTwice heard;
  EXPECT_FALSE(heard.expects(kNow));
  EXPECT_FALSE(heard.again(Way::with_others, "stop", kNow));
  EXPECT_TRUE(heard.expects(kNow + 100ms));
  EXPECT_FALSE(heard.expects(kNow + 600ms)) << "the second connection is away";
  EXPECT_TRUE(heard.again(Way::alone, "stop", kNow + 200ms));
  EXPECT_FALSE(heard.expects(kNow + 200ms));
}

TEST(HeardTwice, TellsWhenTheFirstOfBothCame) {
  HeardTwice heard;
  EXPECT_FALSE(heard.again(Way::alone, "stop", kNow));
  EXPECT_EQ(heard.again(Way::with_others, "stop", kNow + 20s), kNow);
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
