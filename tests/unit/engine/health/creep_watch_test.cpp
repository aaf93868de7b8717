#include "engine/health/creep_watch.h"

#include <gtest/gtest.h>

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

/// Its wheels are heard in closed loop, 200 times a second.
class ACreepWatch : public testing::Test {
 protected:
  ACreepWatch() {
    rims_.heard = rims_.driven = true;
    input_.dt = 5ms;
    watch_.begin(now_);
  }
  /// True when it was found to creep on.
  bool goes(double mps, double for_s) {
    rims_.fastest_mps = mps;
    rims_.ahead = mps < 0 ? -1 : 1;
    bool found = false;
    for (int i = 0; i < static_cast<int>(200 * for_s); ++i) {
      input_.now = now_ += 5ms;
      found = watch_.update(input_, rims_) || found;
    }
    return found;
  }
  bool is_silent(double for_s) {
    rims_.silent = true;
    rims_.heard = false;
    const bool found = goes(0, for_s);
    rims_.silent = false;
    rims_.heard = true;
    return found;
  }

  CreepWatch watch_;
  CreepInput input_;
  RimMotion rims_;
  Time now_{100s};
};

TEST_F(ACreepWatch, FindsATenthOfAMetre) {
  EXPECT_FALSE(goes(0.03, 3.5));
  EXPECT_TRUE(goes(0.03, 0.5));
}

TEST_F(ACreepWatch, EndsWhenItStood) {
  EXPECT_FALSE(goes(0.01, 1.5));
  EXPECT_FALSE(goes(0.045, 10)) << "a person pushes it";
}

TEST_F(ACreepWatch, IsNotEndedByALooseContact) {
  EXPECT_FALSE(goes(0.028, 1.2));
  EXPECT_FALSE(is_silent(1));
  EXPECT_TRUE(goes(0.028, 4));
}

TEST_F(ACreepWatch, ForgetsInALongSilence) {
  EXPECT_FALSE(goes(0.028, 1.2));
  EXPECT_FALSE(is_silent(6));
  EXPECT_FALSE(goes(0.028, 10));
}

TEST_F(ACreepWatch, LeavesWhatIsFastWhereItMayRollToOthersAndGoesOn) {
  input_.may_roll = true;
  input_.falls_ahead = 0;
  EXPECT_FALSE(goes(0.045, 2));
  EXPECT_FALSE(goes(0.055, 0.005));
  EXPECT_TRUE(goes(0.045, 4));
}

TEST_F(ACreepWatch, FindsNothingThatGoesDownOrMayDoSo) {
  input_.may_roll = true;
  for (const double falls_ahead : {0.15, kAbsent}) {
    input_.falls_ahead = falls_ahead;
    EXPECT_FALSE(goes(0.045, 10)) << falls_ahead;
  }
  input_.falls_ahead = -0.15;
  EXPECT_TRUE(goes(0.045, 4));
}

TEST_F(ACreepWatch, FindsNothingWhereItMayRollAndIsSeenToStand) {
  input_.may_roll = input_.seen_to_stand = true;
  EXPECT_FALSE(goes(0.045, 10));
}

TEST_F(ACreepWatch, EndsWithoutPower) {
  input_.power = false;
  EXPECT_FALSE(goes(0.045, 1));
  input_.power = true;
  EXPECT_FALSE(goes(0.045, 10));
}

}  // namespace
}  // namespace drover::engine
