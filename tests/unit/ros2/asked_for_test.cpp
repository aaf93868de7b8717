// What ROS 2 users ask for, and what droverd is told of it when.
#include "ros2/asked_for.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace drover::ros2 {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr Time kNow{100s};
constexpr const char* kStop = R"({"cmd":"stop"})";

class WhatUsersAskFor : public ::testing::Test {
 protected:
  std::vector<std::string> told(Time now, bool leaves = true) {
    std::vector<std::string> lines;
    asked.tell(now, [&](const std::string& line) {
      lines.push_back(line);
      return leaves;
    });
    return lines;
  }
  static TwistsHeard twist(double vx_mps, Time said = kNow) {
    return {Twist{vx_mps, 0}, vx_mps != 0, {}, {}, {}, said};
  }
  static TwistsHeard refusal(const std::string& why, bool rivals = false) {
    return {{}, false, why, rivals, false, {}};
  }
  AskedFor asked;
};

TEST_F(WhatUsersAskFor, AStopThatHasNotLeftIsToldAgainUntilItHas) {
  asked.stop();
  EXPECT_THAT(told(kNow, false), ElementsAre(kStop));
  EXPECT_TRUE(asked.stop_waits());
  EXPECT_EQ(asked.due(), kNow + 100ms);
  EXPECT_TRUE(told(kNow + 50ms, false).empty());
  for (int i = 1; i < 600; ++i) EXPECT_THAT(told(kNow + i * 100ms, false), ElementsAre(kStop));
  EXPECT_THAT(told(kNow + 60s), ElementsAre(kStop));
  EXPECT_FALSE(asked.stop_waits());
  EXPECT_FALSE(asked.due());
  EXPECT_TRUE(told(kNow + 70s).empty());
}
TEST_F(WhatUsersAskFor, AStopThatCouldNotLeaveIsNoReasonToPassTheNextOneOver) {
  asked.stop();
  (void)told(kNow, false);
  asked.stop();
  EXPECT_THAT(told(kNow + 100ms), ElementsAre(kStop));
}
TEST_F(WhatUsersAskFor, AStopIsToldAtOnceWhereThereIsNoLater) {
  asked.stop();
  (void)told(kNow);
  asked.answered();
  EXPECT_FALSE(asked.stop_is_open());
  asked.stop();
  EXPECT_TRUE(told(kNow + 5ms).empty());
  EXPECT_TRUE(asked.stop_is_open());
  asked.hurry();
  EXPECT_THAT(told(kNow + 5ms), ElementsAre(kStop));
  EXPECT_TRUE(asked.stop_is_open()) << "it is not answered yet";
  asked.answered();
  EXPECT_FALSE(asked.stop_is_open());
}
/// It may have been read by nobody: a kernel takes the line for a droverd that hangs.
TEST_F(WhatUsersAskFor, AStopThatWasNotAnsweredIsToldAgainWhenTheWayIsLost) {
  asked.stop();
  EXPECT_THAT(told(kNow), ElementsAre(kStop));
  EXPECT_TRUE(told(kNow + 10s).empty()) << "once on each way";
  EXPECT_TRUE(asked.way_lost());
  EXPECT_THAT(told(kNow + 20s, false), ElementsAre(kStop));
  EXPECT_THAT(told(kNow + 21s), ElementsAre(kStop));
  EXPECT_TRUE(asked.way_lost());
  EXPECT_THAT(told(kNow + 22s), ElementsAre(kStop));
  asked.answered();
  EXPECT_FALSE(asked.way_lost());
  EXPECT_FALSE(asked.due());
  EXPECT_TRUE(told(kNow + 30s).empty());
}
/// By its number droverd knows one that it has done; a person may have reset that.
TEST_F(WhatUsersAskFor, AStopThatIsToldAgainHasItsOwnNumberAndANewOneTheNext) {
  asked = AskedFor("1-2");
  asked.stop();
  constexpr const char* kFirst = R"({"cmd":"stop","from":"1-2","number":1})";
  EXPECT_THAT(told(kNow), ElementsAre(kFirst));
  EXPECT_TRUE(asked.way_lost());
  EXPECT_THAT(told(kNow + 1s, false), ElementsAre(kFirst));
  EXPECT_THAT(told(kNow + 2s), ElementsAre(kFirst));
  asked.stop_refused();
  EXPECT_THAT(told(kNow + 3s), ElementsAre(kFirst));
  EXPECT_TRUE(asked.way_lost());
  asked.stop();
  EXPECT_THAT(told(kNow + 4s), ElementsAre(R"({"cmd":"stop","from":"1-2","number":2})"));
}
TEST_F(WhatUsersAskFor, TheAnswerToAStopIsNoneToTheNextOne) {
  for (const Duration at : {0ms, 200ms}) {
    asked.stop();
    EXPECT_THAT(told(kNow + at), ElementsAre(kStop));
  }
  asked.answered();
  EXPECT_TRUE(asked.way_lost());
  EXPECT_THAT(told(kNow + 1s), ElementsAre(kStop));
  asked.answered();
  asked.answered();  // to nothing of it
  asked.stop();
  EXPECT_THAT(told(kNow + 2s), ElementsAre(kStop));
  EXPECT_TRUE(asked.way_lost());
}
TEST_F(WhatUsersAskFor, AStopThatWasRefusedIsCountedAndToldAgainUntilItIsDone) {
  asked.stop();
  EXPECT_THAT(told(kNow), ElementsAre(kStop));
  asked.stop_refused();
  EXPECT_EQ(asked.stops_refused(), 1U);
  EXPECT_EQ(asked.due(), kNow + 100ms);
  EXPECT_THAT(told(kNow + 100ms), ElementsAre(kStop));
  asked.stop_refused();
  EXPECT_THAT(told(kNow + 200ms), ElementsAre(kStop));
  asked.answered();
  EXPECT_EQ(asked.stops_refused(), 2U);
  EXPECT_FALSE(asked.due());
  EXPECT_FALSE(asked.way_lost()) << "none is owed an answer";
}
/// Between the two a person may have reset the first.
TEST_F(WhatUsersAskFor, AStopSoonAfterOneThatWasToldIsToldInItsTurn) {
  asked.stop();
  EXPECT_THAT(told(kNow), ElementsAre(kStop));
  asked.stop();
  EXPECT_FALSE(asked.stop_is_due(kNow + 80ms)) << "nobody says that droverd is away";
  EXPECT_TRUE(told(kNow + 80ms).empty());
  EXPECT_TRUE(asked.stop_is_due(kNow + 100ms));
  EXPECT_EQ(asked.due(), kNow + 100ms);
  EXPECT_THAT(told(kNow + 100ms), ElementsAre(kStop));
  EXPECT_FALSE(asked.due());
}
TEST_F(WhatUsersAskFor, OfStopsInARowTenASecondAreTold) {
  std::size_t lines = 0;
  for (int i = 0; i < 1000; ++i) {
    asked.stop();
    lines += told(kNow + i * 1ms).size();
  }
  EXPECT_EQ(lines, 10U);
  EXPECT_EQ(asked.due(), kNow + 1s) << "the last one waits for its turn";
}
TEST_F(WhatUsersAskFor, AStopGoesBeforeTwists) {
  asked.hear(twist(0.3));
  asked.stop();
  const auto lines = told(kNow);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], kStop);
}
TEST_F(WhatUsersAskFor, AHundredTwistsASecondAreTheNewest) {
  std::vector<std::string> lines;
  for (int i = 0; i <= 1000; ++i) {
    asked.hear(twist(i, kNow + i * 1ms));
    for (auto& line : told(kNow + i * 1ms)) lines.push_back(line);
  }
  EXPECT_EQ(lines.size(), 101U);
  EXPECT_THAT(lines.back(), HasSubstr(R"("vx_mps":1000)"));
  EXPECT_THAT(lines.back(), HasSubstr(R"("at_ns":101000000000)"));
}
TEST_F(WhatUsersAskFor, ATwistCountsFromWhenItWasSaidHoweverLongItWaited) {
  asked.hear(twist(0.3, kNow - 200ms));
  EXPECT_THAT(told(kNow + 50ms), ElementsAre(HasSubstr(R"("at_ns":99800000000)")));
}
/// Or a program that drives on would be taken for one at rest.
TEST_F(WhatUsersAskFor, AZeroThatFollowedMotionWithinOneLookSaysSo) {
  asked.hear(twist(0));
  EXPECT_THAT(told(kNow), ElementsAre(::testing::Not(HasSubstr("after_motion"))));
  asked.hear(twist(0.3));
  asked.hear(twist(0));
  EXPECT_THAT(told(kNow + 10ms), ElementsAre(HasSubstr(R"("after_motion":true)")));
  asked.hear({Twist{}, true, {}, {}, {}, kNow});
  EXPECT_THAT(told(kNow + 20ms), ElementsAre(HasSubstr(R"("after_motion":true)")));
  asked.hear(twist(0));
  EXPECT_THAT(told(kNow + 30ms), ElementsAre(::testing::Not(HasSubstr("after_motion"))));
}
TEST_F(WhatUsersAskFor, ATwistThatWaitsIsNotToldAfterARefusal) {
  asked.hear(twist(0.1));
  (void)told(kNow);
  asked.hear(twist(0.3));
  asked.hear(refusal("two programs write it", true));
  EXPECT_THAT(told(kNow + 10ms),
              ElementsAre(R"({"cmd":"cmd_vel","refused":"two programs write it","ends":true})"));
}
TEST_F(WhatUsersAskFor, OfRefusalsTenASecondAreToldTheNewest) {
  std::vector<std::string> lines;
  for (int i = 0; i < 1000; ++i) {
    asked.hear(refusal("reason " + std::to_string(i)));
    for (auto& line : told(kNow + i * 1ms)) lines.push_back(line);
  }
  ASSERT_EQ(lines.size(), 10U);
  EXPECT_THAT(lines.back(), HasSubstr("reason 900"));
  EXPECT_EQ(asked.due(), kNow + 1000ms) << "the last one waits for its turn";
  EXPECT_THAT(told(kNow + 1s), ElementsAre(HasSubstr("reason 999")));
}
TEST_F(WhatUsersAskFor, ARefusalThatFollowsDoesNotHideThatTwoProgramsWrite) {
  asked.hear(refusal("linear.y is 0.3"));
  (void)told(kNow);
  asked.hear(refusal("two programs write it", true));
  asked.hear(refusal("linear.y is 0.4"));
  EXPECT_THAT(told(kNow + 100ms), ElementsAre(HasSubstr(R"("ends":true)")));
  asked.hear(refusal("linear.y is 0.5"));
  EXPECT_THAT(told(kNow + 200ms), ElementsAre(HasSubstr(R"("ends":false)")));
}
TEST_F(WhatUsersAskFor, OfADomainThatIsGoneOnlyAStopIsLeft) {
  asked.hear(twist(0.3));
  asked.hear(refusal("linear.y is 0.3"));
  asked.stop();
  asked.forget_twists();
  EXPECT_THAT(told(kNow), ElementsAre(kStop));
}

}  // namespace
}  // namespace drover::ros2
