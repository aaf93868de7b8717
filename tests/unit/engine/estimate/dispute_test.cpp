// Two places, of which one is right: when it is decided, and by what.
#include "engine/estimate/dispute.h"

#include <gtest/gtest.h>

namespace drover::engine::estimate {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Verdict = Dispute::Verdict;
using Offset = Dispute::Offset;

constexpr Time kBegin{seconds(100)};
constexpr double kWell_m = 0.016;  // two sigma of dead reckoning at the beginning
constexpr double kNoise_m = 0.0125;

class ADispute : public testing::Test {
 protected:
  ADispute() { dispute.begin({0.08, 0}, now, false, now); }
  /// A fix each tenth of a second, for `seconds`, or until it is decided.
  Verdict hear(const Offset& offset, double for_s, double two_sigma_m = kWell_m) {
    for (double s = 0; s < for_s - 0.05; s += 0.1) {
      now += milliseconds(100);
      const Verdict verdict = dispute.hear(offset, true, two_sigma_m, kNoise_m, true, false, now);
      if (verdict != Verdict::undecided) return verdict;
    }
    return Verdict::undecided;
  }

  Time now = kBegin;
  Dispute dispute;
};

TEST_F(ADispute, IsOverWhenItStepsBack) {
  EXPECT_EQ(hear({0.08, 0}, 10), Verdict::undecided);
  EXPECT_EQ(hear({0.005, 0.008}, 0.1), Verdict::came_back);
}

TEST_F(ADispute, IsOverWhenItStepsBackThoughDeadReckoningWentAstrayMeanwhile) {
  EXPECT_EQ(hear({0.08, 0}, 2), Verdict::undecided);
  EXPECT_EQ(hear({0.09, 0.02}, 3, 0.05), Verdict::undecided);
  EXPECT_EQ(hear({0.10, 0.04}, 3, 0.08), Verdict::undecided);
  EXPECT_EQ(hear({0.02, 0.04}, 0.2, 0.08), Verdict::came_back);
}

TEST_F(ADispute, IsNotOverBecauseDeadReckoningComesNear) {
  for (int i = 0; i <= 80; ++i)
    EXPECT_EQ(hear({0.08 - 0.001 * i, 0}, 0.2, 0.06), Verdict::undecided) << i;
}

TEST_F(ADispute, WasAnOutlierThatIsNearAgainAtOnce) {
  EXPECT_EQ(hear({0.01, 0.01}, 0.1, 0.06), Verdict::came_back);
}

/// The last position was the odd one, and the place it left is the one that is in question.
TEST_F(ADispute, EndsAtOnceWhenItSteppedToWhereDeadReckoningIs) {
  dispute.begin({0.005, 0}, now, false, now);
  dispute.came_from({-0.09, 0});
  EXPECT_NEAR(dispute.apart_m(), 0.09, 1e-9);
  EXPECT_EQ(hear({0.006, 0.004}, 0.1, 0.031), Verdict::came_back);
}

TEST_F(ADispute, ThatSteppedToDeadReckoningIsOverWhenItStepsBack) {
  dispute.begin({0.04, 0}, now, false, now);
  dispute.came_from({-0.05, 0});
  EXPECT_EQ(hear({0.04, 0}, 5, 0.031), Verdict::undecided);
  EXPECT_EQ(hear({-0.05, 0.005}, 0.1, 0.031), Verdict::came_back);
}

TEST_F(ADispute, DoesNotEndByTime) {
  EXPECT_EQ(hear({0.08, 0}, 600), Verdict::undecided);
}

TEST_F(ADispute, EndsAMinuteAfterAFixThatWasLostAndFoundAgain) {
  EXPECT_EQ(hear({0.08, 0}, 5), Verdict::undecided);
  dispute.lose_fix();
  EXPECT_EQ(hear({0.08, 0}, 59.5), Verdict::undecided);
  EXPECT_EQ(hear({0.08, 0}, 1), Verdict::renewed);
}

TEST_F(ADispute, WaitsAnotherMinuteForAFixThatMoved) {
  dispute.lose_fix();
  EXPECT_EQ(hear({0.08, 0}, 50), Verdict::undecided);
  EXPECT_EQ(hear({0.20, 0}, 59), Verdict::undecided);
  EXPECT_EQ(hear({0.20, 0}, 2), Verdict::renewed);
}

TEST_F(ADispute, CountsOnWhenTheNewFixIsLostForAMomentAndFoundWhereItWas) {
  dispute.lose_fix();
  EXPECT_EQ(hear({0.08, 0}, 40), Verdict::undecided);
  dispute.lose_fix();
  now += seconds(2);
  EXPECT_EQ(hear({0.08, 0}, 19), Verdict::undecided);
  EXPECT_EQ(hear({0.08, 0}, 2), Verdict::renewed);
}

TEST_F(ADispute, WaitsAnotherMinuteForAFixThatJumpsHoweverFarItWentMeanwhile) {
  dispute.lose_fix();
  EXPECT_EQ(hear({0.08, 0}, 50), Verdict::undecided);
  dispute.advance(30, 0);
  EXPECT_EQ(hear({0.08, 0}, 1), Verdict::undecided);
  EXPECT_EQ(hear({0.38, 0}, 20), Verdict::undecided);
}

TEST_F(ADispute, CountsSilenceAsALoss) {
  EXPECT_EQ(hear({0.08, 0}, 5), Verdict::undecided);
  now += seconds(3);
  EXPECT_EQ(hear({0.08, 0}, 61), Verdict::renewed);
}

TEST_F(ADispute, CountsALossJustBeforeItBegan) {
  dispute.begin({0.15, 0}, now, true, now);
  EXPECT_EQ(hear({0.15, 0}, 59.5), Verdict::undecided);
  EXPECT_EQ(dispute.decided_at(), kBegin + milliseconds(60100));
  EXPECT_EQ(hear({0.15, 0}, 1), Verdict::renewed);
}

/// Refused for long before it is told as a dispute: the fix was there all the time.
TEST_F(ADispute, ThatBeginsLateIsNoLoss) {
  dispute.begin({0.2, 0}, now - milliseconds(2500), false, now);
  EXPECT_EQ(hear({0.2, 0}, 70), Verdict::undecided);
  EXPECT_EQ(dispute.since(), kBegin - milliseconds(2500));
}

TEST_F(ADispute, WithoutALossIsNotDecidedByWaiting) {
  hear({0.08, 0}, 5);
  EXPECT_EQ(dispute.decided_at(), kNever);
}

TEST_F(ADispute, TellsHowDeadReckoningGoesOnByPositionsThatKeepTheirDistance) {
  EXPECT_EQ(hear({0.08, 0}, 0.9), Verdict::undecided);
  EXPECT_FALSE(dispute.steady());
  EXPECT_EQ(hear({0.08, 0}, 0.5), Verdict::undecided);
  EXPECT_EQ(hear({0.10, 0.01}, 0.1), Verdict::undecided);
  ASSERT_TRUE(dispute.steady());
  EXPECT_NEAR(dispute.astray().east_m, 0.02, 1e-9);
  dispute.put_right(dispute.astray());
  EXPECT_NEAR(dispute.apart_m(), 0.08, 1e-9);
  EXPECT_EQ(hear({0.20, 0}, 0.5), Verdict::undecided);
  EXPECT_FALSE(dispute.steady()) << "it jumped again";
  EXPECT_EQ(hear({0.20, 0}, 3), Verdict::undecided);
  EXPECT_TRUE(dispute.steady());
  EXPECT_NEAR(dispute.astray().east_m, 0, 1e-9);
}

/// What is put right step by step is no agreement.
TEST_F(ADispute, WaitsAnotherMinuteForAFixThatCreepsAway) {
  dispute.lose_fix();
  for (int i = 0; i < 70; ++i) {
    EXPECT_EQ(hear({0.08 + 0.005, 0}, 1), Verdict::undecided) << i;
    dispute.put_right({0.005, 0});
  }
}

TEST_F(ADispute, TellsHowFarThePlacesAreApart) {
  hear({0.3, 0.4}, 0.1);
  EXPECT_DOUBLE_EQ(dispute.apart_m(), 0.5);
}

constexpr double kSlip = 0.4;

/// Wheels that slip lead it along; aside it errs by a few hundredths of the way.
TEST_F(ADispute, LeadsDeadReckoningByNoMoreThanItErrs) {
  EXPECT_TRUE(dispute.may_lead(0, kSlip));
  dispute.put_right({0, 0.07});
  EXPECT_FALSE(dispute.may_lead(0, kSlip)) << "at rest";
  dispute.advance(2, 0);
  EXPECT_TRUE(dispute.may_lead(0, kSlip));
  dispute.put_right({-0.7, 0});
  EXPECT_TRUE(dispute.may_lead(0, kSlip)) << "they slip by a third";
  EXPECT_NEAR(dispute.led_m(), std::hypot(0.7, 0.07), 1e-9);
  EXPECT_NEAR(dispute.led_aside_m(0), 0.07, 1e-9);
  dispute.advance(50, 0);
  dispute.put_right({0, 0.1});
  EXPECT_TRUE(dispute.may_lead(0, kSlip));
  dispute.put_right({0, 0.1});
  EXPECT_FALSE(dispute.may_lead(0, kSlip)) << "a receiver that wanders";
}

TEST_F(ADispute, KnowsAFixThatIsFoundElsewhereByABaseThatStoodForOneThatWasCarried) {
  const auto stand = [&](const Offset& offset, double for_s) {
    Verdict last = Verdict::undecided;
    for (double s = 0; s < for_s && last == Verdict::undecided; s += 0.1) {
      now += milliseconds(100);
      last = dispute.hear(offset, true, kWell_m, kNoise_m, true, true, now);
    }
    return last;
  };
  EXPECT_EQ(stand({0.08, 0}, 5), Verdict::undecided);
  dispute.lose_fix();
  EXPECT_EQ(stand({0.08, 0}, 5), Verdict::undecided);
  EXPECT_FALSE(dispute.moved_at_rest());
  dispute.begin({0.08, 0}, now, false, now);
  EXPECT_EQ(stand({0.08, 0}, 5), Verdict::undecided);
  dispute.lose_fix();
  EXPECT_EQ(stand({0.5, 0.1}, 70), Verdict::renewed);
  EXPECT_TRUE(dispute.moved_at_rest());
}

}  // namespace
}  // namespace drover::engine::estimate
