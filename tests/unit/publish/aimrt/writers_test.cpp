#include "publish/aimrt/writers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drover::publish::aimrt {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

constexpr Duration kSilence = 100ms;

class TwoPrograms : public testing::Test {
 protected:
  /// Why it is refused; empty when it is followed.
  std::string give(const Writer& writer, double velocity_radps) {
    const auto hindered = writers_.hindrance(writer, velocity_radps == 0, now_);
    if (!hindered.empty()) return std::string(hindered.view());
    JointTargets targets;
    (void)targets.joints.push_back({0, velocity_radps});
    auto why = std::string(writers_.weigh(writer, targets, now_).view());
    writers_.take(writer, now_);
    return why;
  }
  std::string rivals() const { return std::string(writers_.rivals(now_)); }

  Writers writers_{kSilence};
  Time now_{10s};
  const Writer document_{};
  const Writer array_{.names = Names::aimrt_1x, .content = Content::json};
};

TEST_F(TwoPrograms, AreToldApartByNamesAndContentAndTheFirstKeepsTheJoints) {
  for (int i = 0; i < 50; ++i, now_ += 10ms) {
    EXPECT_EQ(give(document_, 1), "");
    EXPECT_EQ(give(array_, 2),
              "two programs write joint commands: JointCommand (pb) has the joints, "
              "JointCommandArray (json) is refused");
  }
  EXPECT_EQ(writers_.refused(), 50U);
  EXPECT_THAT(rivals(), HasSubstr("JointCommandArray (json) is refused"));
}

TEST_F(TwoPrograms, AreToldApartByTheirFrame) {
  EXPECT_EQ(give({.frame_id = "teleop"}, 1), "");
  EXPECT_EQ(give({.frame_id = "a planner with a name"}, 1),
            "two programs write joint commands: JointCommand (pb, frame_id 'teleop') has the "
            "joints, JointCommand (pb, frame_id 'a planner wi...') is refused");
}

TEST_F(TwoPrograms, AreToldApartByTimeStampsThatOneOfThemHasNot) {
  EXPECT_EQ(give({.stamp_ns = 5}, 1), "");
  EXPECT_THAT(give({}, 1), HasSubstr("one with time_stamp and one without"));
}

TEST_F(TwoPrograms, AreToldApartByTheirCount) {
  std::uint64_t first = 7;
  std::uint64_t second = 5000;
  for (int i = 0; i < 20; ++i, now_ += 10ms) {
    EXPECT_EQ(give({.sequence = ++first}, 1), "");
    EXPECT_THAT(give({.sequence = ++second}, 2), HasSubstr("each with its sequence_num"));
  }
  EXPECT_THAT(give({.sequence = 3}, 2), HasSubstr("each with its sequence_num"));
  EXPECT_THAT(give({}, 2), HasSubstr("each with its sequence_num"));
}

TEST_F(TwoPrograms, AreToldApartByACountThatJumpsFurtherThanMessagesCanGetLost) {
  EXPECT_EQ(give({.sequence = 1}, 1), "");
  EXPECT_EQ(give({.sequence = 102}, 1), "") << "100 are lost in 0.1 s at most";
  EXPECT_NE(give({.sequence = 204}, 1), "");
}

TEST_F(TwoPrograms, OneOfWhichCountsAreToldApartWhicheverWasFirst) {
  EXPECT_EQ(give({}, 1), "");
  EXPECT_EQ(give({}, 1), "");
  EXPECT_NE(give({.sequence = 1}, 1), "");
}

TEST_F(TwoPrograms, GetTheJointsOneAfterTheOtherWithAMessageOfZeros) {
  EXPECT_EQ(give(document_, 1), "");
  now_ += kSilence;
  EXPECT_NE(give(array_, 0), "") << "not silent for longer";
  now_ += 1ms;
  EXPECT_EQ(give(array_, 1), "a stream of joint commands begins with velocity 0");
  EXPECT_EQ(give(array_, 0), "");
  EXPECT_EQ(give(array_, 1), "");
  EXPECT_NE(give(document_, 0), "");
}

TEST_F(TwoPrograms, AreForgottenASecondAfterTheyWroteAtOnce) {
  (void)give(document_, 1);
  (void)give(array_, 1);
  now_ += 1s;
  EXPECT_NE(rivals(), "");
  now_ += 1ms;
  EXPECT_EQ(rivals(), "");
}

TEST_F(TwoPrograms, WithOneFormAndClocksThatDifferAreNoticed) {
  // The second one's stamps are 4 ms behind; which of two is newer changes with each message.
  std::uint64_t at_ns = 1'000'000'000;
  for (int i = 0; i < 100; ++i, now_ += 20ms, at_ns += 20'000'000) {
    EXPECT_EQ(give({.stamp_ns = at_ns}, 1), "");
    (void)give({.stamp_ns = at_ns - 4'000'000}, 1);
  }
  EXPECT_THAT(rivals(), HasSubstr("their time stamps interleave"));
}

TEST_F(TwoPrograms, ThatNothingTellsApartAreBothRefused) {
  for (int i = 0; i < 100; ++i, now_ += 20ms) {
    (void)give(document_, 3);
    (void)give(document_, 0);
  }
  EXPECT_THAT(rivals(), HasSubstr("the velocities jump to and fro, none is followed"));
  EXPECT_NE(give(document_, 3), "");
  EXPECT_NE(give(document_, 0), "");
}

TEST_F(TwoPrograms, AtUnlikeRatesThatNothingTellsApartAreBothRefused) {
  for (int i = 0; i < 200; ++i, now_ += 20ms) {
    (void)give(document_, 3);
    if (i % 3 == 0) (void)give(document_, -2);
  }
  EXPECT_THAT(rivals(), HasSubstr("none is followed"));
}

TEST_F(TwoPrograms, ThatCountAlikeAreBothRefusedToo) {
  std::uint64_t at_ns = 1'000'000'000;
  for (std::uint64_t i = 1; i < 100; ++i, now_ += 20ms, at_ns += 20'000'000) {
    (void)give({.stamp_ns = at_ns, .sequence = i}, 3);
    (void)give({.stamp_ns = at_ns + 1, .sequence = i}, 0);
  }
  EXPECT_THAT(rivals(), HasSubstr("none is followed"));
}

/// No velocity jumps; a number that is told twice has one stamp where one program sends it.
TEST_F(TwoPrograms, ThatCountAlikeAndAskForTheSameAreNoticedByTheirTimeStamps) {
  std::uint64_t at_ns = 1'000'000'000;
  std::string second;
  for (std::uint64_t i = 1; i < 100; ++i, now_ += 20ms, at_ns += 20'000'000) {
    EXPECT_EQ(give({.stamp_ns = at_ns, .sequence = i}, 1), "") << i;
    second = give({.stamp_ns = at_ns + 1, .sequence = i}, 1);
  }
  EXPECT_EQ(second,
            "two programs seem to write joint commands as JointCommand (pb): each sequence_num "
            "comes twice, the second is refused");
  EXPECT_EQ(rivals(), second);
}

TEST_F(TwoPrograms, OneOfWhichEndsLeaveTheJointsToTheOtherAfterASecond) {
  for (int i = 0; i < 100; ++i, now_ += 20ms) {
    (void)give(document_, 3);
    (void)give(document_, 0);
  }
  for (int i = 0; i < 55; ++i, now_ += 20ms) (void)give(document_, 3);
  EXPECT_EQ(give(document_, 3), "");
}

class OneProgram : public TwoPrograms {};

TEST_F(OneProgram, MayCountFromZeroLoseMessagesOrNotCount) {
  EXPECT_EQ(give({.sequence = 0}, 0), "");
  EXPECT_EQ(give({.sequence = 1}, 1), "");
  EXPECT_EQ(give({.sequence = 40}, 1), "");
  EXPECT_EQ(give({.sequence = 40}, 1), "") << "delivered twice: the stamp is for that";
  EXPECT_EQ(give({.sequence = 140}, 1), "");
  now_ += 1s;
  EXPECT_EQ(give({}, 0), "");
  EXPECT_EQ(give({}, 1), "");
  EXPECT_EQ(rivals(), "");
}

TEST_F(OneProgram, MayBeStartedAnewWhenItsOldStreamIsSilent) {
  EXPECT_EQ(give({.sequence = 9000}, 1), "");
  now_ += kSilence + 1ms;
  EXPECT_EQ(give({.sequence = 1}, 0), "");
  EXPECT_EQ(give({.sequence = 2}, 1), "");
  EXPECT_EQ(rivals(), "");
}

TEST_F(OneProgram, MaySendASineASquareWaveAndSmallNoise) {
  for (int i = 0; i < 500; ++i, now_ += 20ms) {
    EXPECT_EQ(give(document_, 5 * std::sin(2 * M_PI * 2 * i / 50.0)), "") << i;
    EXPECT_EQ(rivals(), "");
  }
  for (int i = 0; i < 500; ++i, now_ += 20ms)
    EXPECT_EQ(give(document_, i / 8 % 2 == 0 ? 3 : -3), "") << i;
  for (int i = 0; i < 500; ++i, now_ += 20ms)
    EXPECT_EQ(give(document_, i % 2 == 0 ? 1.0 : 1.2), "") << i;
  EXPECT_EQ(rivals(), "");
}

TEST_F(OneProgram, WhoseClockIsSetBackIsNoTwo) {
  EXPECT_EQ(give({.stamp_ns = 1'000'000'000}, 1), "");
  // Refused for their stamps, elsewhere: nothing newer is followed between them.
  for (std::uint64_t i = 0; i < 50; ++i, now_ += 1ms)
    EXPECT_EQ(std::string(writers_.hindrance({.stamp_ns = 900'000'000 + i}, false, now_).view()),
              "");
  EXPECT_EQ(rivals(), "");
}

}  // namespace
}  // namespace drover::publish::aimrt
