// The pieces of the drive, as a function of what was driven.
#include "calibrate/recipe.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drover/angle.h"
#include "drover/snapshot.h"

namespace drover::calibrate {
namespace {

constexpr double kLook_s = 0.05;

/// A base that does at once what is wanted.
void drive(Recipe& recipe, double seconds) {
  for (double t = 0; t < seconds && !recipe.over() && !recipe.asks_for_signs(); t += kLook_s) {
    const Twist twist = recipe.wanted();
    recipe.look({kLook_s, twist.vx_mps * kLook_s, twist.wz_radps * kLook_s, is_zero(twist)});
  }
}

TEST(Recipe, StandsFirstAndIsSlowUntilTheSignsAreProved) {
  Recipe recipe({0.8, 0.8});
  EXPECT_TRUE(is_zero(recipe.wanted()));
  double fastest_mps = 0;
  while (!recipe.asks_for_signs()) {
    fastest_mps = std::max(fastest_mps, std::abs(recipe.wanted().vx_mps));
    drive(recipe, kLook_s / 2);
  }
  EXPECT_DOUBLE_EQ(fastest_mps, kUnproved_mps);
  drive(recipe, 100);
  EXPECT_TRUE(is_zero(recipe.wanted())) << "nothing more before they are proved";
  EXPECT_TRUE(recipe.asks_for_signs());
  recipe.proved();
  EXPECT_GT(recipe.wanted().vx_mps, kUnproved_mps);
}
TEST(Recipe, DrivesBothSpeedsAndBothWaysRoundAndEndsWithAStand) {
  Recipe recipe({0.8, 0.8});
  drive(recipe, 200);
  recipe.proved();
  double left_rad = 0;
  double right_rad = 0;
  double fastest_mps = 0;
  double slowest_mps = 1;
  while (!recipe.over()) {
    const Twist twist = recipe.wanted();
    (twist.wz_radps > 0 ? left_rad : right_rad) += std::abs(twist.wz_radps) * kLook_s;
    fastest_mps = std::max(fastest_mps, twist.vx_mps);
    if (twist.vx_mps > 0) slowest_mps = std::min(slowest_mps, twist.vx_mps);
    drive(recipe, kLook_s / 2);
  }
  EXPECT_GT(left_rad, 2 * kPi);
  EXPECT_GT(right_rad, 2 * kPi);
  EXPECT_DOUBLE_EQ(fastest_mps, 0.7);
  EXPECT_DOUBLE_EQ(slowest_mps, 0.3);
  EXPECT_EQ(recipe.pieces().back().stand_s, 6);
  EXPECT_TRUE(is_zero(recipe.wanted()));
}
TEST(Recipe, APauseKeepsWhatWasDrivenAndBreaksAStand) {
  Recipe recipe({0.8, 0.8});
  for (int i = 0; i < 100; ++i) recipe.look({kLook_s, 0, 0, true});  // 5 s of 6
  recipe.look({kLook_s, 0.01, 0, false});
  EXPECT_EQ(recipe.done(), 0);
  EXPECT_EQ(recipe.at(), 0U);
  drive(recipe, 10);
  ASSERT_EQ(recipe.at(), 1U);
  drive(recipe, 5);
  const double done_m = recipe.done();
  EXPECT_GT(done_m, 0.1);
  for (int i = 0; i < 1000; ++i) recipe.look({kLook_s, 0, 0, true});
  EXPECT_EQ(recipe.done(), done_m);
}
TEST(Recipe, ATurnTheWrongWayRoundIsNoneOfThePiece) {
  Recipe recipe({0.8, 0.8});
  drive(recipe, 35);
  ASSERT_EQ(recipe.pieces()[recipe.at()].what, "slowly to the left");
  for (int i = 0; i < 100; ++i) recipe.look({kLook_s, 0.1, -0.1, false});
  EXPECT_EQ(recipe.pieces()[recipe.at()].what, "slowly to the left");
}
TEST(Recipe, KeepsToTheLimitsOfTheBase) {
  Recipe recipe({0.4, 0.2});
  drive(recipe, 200);
  recipe.proved();
  while (!recipe.over()) {
    const Twist twist = recipe.wanted();
    ASSERT_LE(twist.vx_mps, 0.4);
    ASSERT_LE(std::abs(twist.wz_radps), 0.2 + 1e-12);
    drive(recipe, kLook_s / 2);
  }
}
TEST(Recipe, SteersBackOnAStraightButNotBeforeTheSignsAreProved) {
  Recipe recipe({0.8, 0.8});
  drive(recipe, 10);
  recipe.look({kLook_s, 0.01, 0.1, false});
  EXPECT_EQ(recipe.wanted().wz_radps, 0);
  drive(recipe, 200);
  recipe.proved();
  recipe.look({kLook_s, 0.01, 0.1, false});
  EXPECT_LT(recipe.wanted().wz_radps, 0);
}
TEST(Recipe, ItsAreaHasRoomForABaseThatComesToRestSlowly) {
  const Area brisk = Recipe({0.8, 0.8, 0.8}).area();
  const Area slow = Recipe({0.8, 0.8, 0.05}).area();
  const double rolls_on_m = 0.7 * 0.3 + 0.7 * 0.7 / (2 * 0.05);
  EXPECT_GT(slow.ahead_m, brisk.ahead_m - 1 + rolls_on_m - 1);
  EXPECT_GE(slow.behind_m, rolls_on_m);
  EXPECT_GE(slow.right_m, brisk.right_m + rolls_on_m - 2);
}
TEST(Recipe, AnotherRoundTurnsRoundFirstAndThereAreThree) {
  Recipe recipe({0.8, 0.8});
  const Area area = recipe.area();
  drive(recipe, 200);
  recipe.proved();
  Pose at;
  for (int round = 0; round < 3; ++round) {
    while (!recipe.over()) {
      const Twist twist = recipe.wanted();
      at.yaw_rad += twist.wz_radps * kLook_s;
      at.x_m += twist.vx_mps * std::cos(at.yaw_rad) * kLook_s;
      at.y_m += twist.vx_mps * std::sin(at.yaw_rad) * kLook_s;
      ASSERT_LT(at.x_m + 3.6, area.ahead_m);  // the slow pieces
      ASSERT_GT(at.x_m + 3.6, -area.behind_m);
      ASSERT_LT(at.y_m + 1, area.left_m);
      ASSERT_GT(at.y_m + 1, -area.right_m);
      recipe.look({kLook_s, twist.vx_mps * kLook_s, twist.wz_radps * kLook_s, is_zero(twist)});
    }
    ASSERT_EQ(recipe.again(), round < 2);
    if (round < 2) EXPECT_EQ(recipe.pieces()[recipe.at()].what, "turn round");
  }
}

}  // namespace
}  // namespace drover::calibrate
