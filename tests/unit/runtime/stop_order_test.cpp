#include "runtime/stop_order.h"

#include <gtest/gtest.h>

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

constexpr Time kNow{1000s};

class SecondConnection final : public HearsStops {
 public:
  bool connected() const override { return is_connected; }
  bool take(HeardStop& heard) override {
    if (waiting.empty()) return false;
    heard = waiting.front();
    waiting.pop_front();
    return true;
  }
  std::uint64_t lost() const override { return lost_stops; }
  bool knows_more() const override { return begun; }

  bool is_connected = true;
  bool begun = false;
  std::uint64_t lost_stops = 0;
  std::deque<HeardStop> waiting;
};

class AStopOrder : public testing::Test {
 protected:
  void hear_alone(const char* text) {
    alone_.waiting.push_back({text, publish::Retain::no, {1, 0}});
  }
  std::optional<HeardStop> next_heard(Time now) {
    order_.hear(now);
    return order_.next_heard();
  }
  static Command stop(std::uint64_t number) {
    return {{RequestId::Source::mqtt, number}, kNow, CancelTask{}};
  }
  SecondConnection alone_;
  StopOrder order_{&alone_};
};

TEST_F(AStopOrder, GivesEachStopThatWasHeardAloneFirstToBeAnsweredOnce) {
  hear_alone("cancel");
  hear_alone("terminate");
  EXPECT_EQ(next_heard(kNow)->payload, "cancel");
  EXPECT_EQ(next_heard(kNow)->payload, "terminate");
  EXPECT_FALSE(next_heard(kNow));
  EXPECT_EQ(order_.heard_before("cancel", kNow + 300ms), kNow) << "it was carried out then";
  EXPECT_FALSE(order_.heard_before("cancel", kNow + 300ms)) << "a second press is another stop";
}

TEST_F(AStopOrder, WaitsForNothingThatWasLostWithTheConnection) {
  hear_alone("cancel");
  EXPECT_TRUE(next_heard(kNow));
  order_.begin_anew(kNow + 1s);
  hear_alone("cancel");
  EXPECT_TRUE(next_heard(kNow + 5s));
  EXPECT_TRUE(order_.heard_before("cancel", kNow + 5s));
  EXPECT_FALSE(order_.overtaken(kNow + 6s)) << "a start is younger";
  EXPECT_FALSE(order_.heard_before("cancel", kNow + 10s)) << "it wants an answer";
}

TEST_F(AStopOrder, DoesNotAnswerAgainWhatCameWithTheOthersFirst) {
  EXPECT_FALSE(order_.heard_before("cancel", kNow));
  EXPECT_TRUE(order_.expects_other_self(kNow));
  hear_alone("cancel");
  EXPECT_FALSE(order_.expects_other_self(kNow + 10ms));
  EXPECT_FALSE(next_heard(kNow + 10ms));
}

TEST_F(AStopOrder, ExpectsNothingOfAConnectionThatIsGone) {
  EXPECT_FALSE(order_.heard_before("cancel", kNow));
  alone_.is_connected = false;
  EXPECT_FALSE(order_.expects_other_self(kNow));
}

TEST_F(AStopOrder, HoldsBackWhatAStopMayHaveOvertaken) {
  EXPECT_FALSE(order_.overtaken(kNow));
  hear_alone("cancel");
  EXPECT_TRUE(order_.overtaken(kNow));
  EXPECT_TRUE(order_.overtaken(kNow + 1900ms));
  EXPECT_FALSE(order_.overtaken(kNow + 2100ms)) << "nothing is so late unnoticed";
}

TEST_F(AStopOrder, HoldsBackWhileAStopIsBeingHeardOrWasLost) {
  alone_.begun = true;
  EXPECT_TRUE(order_.overtaken(kNow));
  alone_.begun = false;
  EXPECT_FALSE(order_.overtaken(kNow));
  alone_.lost_stops = 1;
  EXPECT_TRUE(order_.overtaken(kNow));
}

TEST_F(AStopOrder, AnswersInTheOrderInWhichTheyWereAsked) {
  EXPECT_FALSE(order_.asked({1, 0}, stop(1)));
  EXPECT_FALSE(order_.asked({1, 1}, stop(2)));
  EXPECT_FALSE(order_.next_obeyed({0, 1})) << "the older one is not obeyed yet";
  EXPECT_EQ(order_.next_obeyed({1, 0})->number, 1U);
  EXPECT_FALSE(order_.next_obeyed({1, 0}));
  EXPECT_EQ(order_.next_obeyed({2, 1})->number, 2U);
  EXPECT_FALSE(order_.next_obeyed({2, 1}));
}

TEST_F(AStopOrder, GivesUpTheOldestAnswersWhenTheControlThreadHangs) {
  for (std::uint64_t i = 1; i <= 256; ++i) EXPECT_FALSE(order_.asked({i, 0}, stop(i))) << i;
  EXPECT_EQ(order_.asked({257, 0}, stop(257))->id.number, 1U);
  EXPECT_EQ(order_.next_obeyed({257, 0})->number, 2U);
}

TEST_F(AStopOrder, TellsOnceThatNobodyHearsStopsAlone) {
  alone_.is_connected = false;
  EXPECT_FALSE(order_.became_deaf(true, kNow));
  EXPECT_FALSE(order_.became_deaf(true, kNow + 5s));
  EXPECT_TRUE(order_.became_deaf(true, kNow + 5100ms));
  EXPECT_FALSE(order_.became_deaf(true, kNow + 9s));
  EXPECT_FALSE(order_.became_deaf(false, kNow + 10s)) << "the broker itself is gone";
  alone_.is_connected = true;
  EXPECT_FALSE(order_.became_deaf(true, kNow + 11s));
  alone_.is_connected = false;
  EXPECT_TRUE(order_.became_deaf(true, kNow + 17s)) << "and again when it happens again";
}

TEST(AStopOrderWithoutASecondConnection, HasNothingToWaitFor) {
  StopOrder order(nullptr);
  EXPECT_FALSE(order.overtaken(kNow));
  EXPECT_FALSE(order.expects_other_self(kNow));
  EXPECT_FALSE(order.next_heard());
  EXPECT_FALSE(order.became_deaf(true, kNow + 60s));
}

}  // namespace
}  // namespace drover::runtime
