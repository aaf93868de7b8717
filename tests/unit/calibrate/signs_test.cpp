// Sides that are reversed or swapped, a gyro or an antenna line the other way round: found, told,
// and put right before anything else is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/signs.h"
#include "unit/calibrate/simulated_drive.h"

namespace drover::calibrate {
namespace {

using testing::HasSubstr;

class WrongSigns : public testing::TestWithParam<int> {};

Planted wrong(int which) {
  Planted p;
  p.left_reversed = (which & 1) != 0;
  p.right_reversed = (which & 2) != 0;
  p.swapped = (which & 4) != 0;
  p.gyro_reversed = (which & 8) != 0;
  return p;
}

Calibration found(const Planted& planted, bool headings = true) {
  Drive drive = SimulatedDrive(planted, {}, 11).drive(good_legs());
  if (!headings) drive.headings_rad.clear();
  return calibrate(drive, {});
}

TEST_P(WrongSigns, AreFound) {
  const Planted planted = wrong(GetParam());
  FirstGuess guess;
  const Signs signs = find_signs(SimulatedDrive(planted, {}, 11).drive(good_legs()), {}, guess);
  EXPECT_EQ(signs.refused, "");
  // Of swapped sides the columns are told, not the wheels.
  const bool left = planted.swapped ? planted.right_reversed : planted.left_reversed;
  const bool right = planted.swapped ? planted.left_reversed : planted.right_reversed;
  EXPECT_EQ(signs.gyro_reversed, planted.gyro_reversed);
  if (planted.swapped && left && right) {  // looks like a robot whose other end is ahead
    EXPECT_TRUE(signs.heading_opposite);
    EXPECT_NEAR(std::abs(guess.heading_rad), kPi, 0.02);
    return;
  }
  EXPECT_EQ(signs.left_reversed, left);
  EXPECT_EQ(signs.right_reversed, right);
  EXPECT_EQ(signs.swapped, planted.swapped);
  EXPECT_FALSE(signs.heading_opposite);
}

INSTANTIATE_TEST_SUITE_P(EachOfThem, WrongSigns, testing::Range(0, 16));

TEST(Signs, ArePutRightBeforeAnythingElse) {
  for (const int which : {1, 4, 14}) {
    const auto result = found(wrong(which));
    ASSERT_EQ(result.refused, "");
    EXPECT_TRUE(result.signs.wrong());
    EXPECT_NEAR(result.of(Quantity::wheel_radius_m).value, 0.165, 0.002);
    EXPECT_NEAR(result.of(Quantity::yaw_slip_factor).value, 1.2, 0.04);
    EXPECT_NEAR(result.of(Quantity::gyro_scale).value, 1, 0.01);
  }
}

TEST(Signs, OfAnAntennaLineTheOtherWayRound) {
  Planted planted;
  planted.heading_offset_deg = 180;
  const auto result = found(planted);
  EXPECT_TRUE(result.signs.heading_opposite);
  EXPECT_FALSE(result.signs.swapped);
  EXPECT_NEAR(std::abs(result.of(Quantity::heading_offset_deg).value), 180, 0.5);
}

TEST(Signs, OfOneSideAreFoundByTheCourse) {
  const auto left = found(wrong(1), false);
  EXPECT_TRUE(left.signs.left_reversed);
  EXPECT_FALSE(left.signs.right_reversed);
  const auto right = found(wrong(2), false);
  EXPECT_TRUE(right.signs.right_reversed);
  EXPECT_FALSE(right.signs.left_reversed);
  EXPECT_NEAR(right.of(Quantity::wheel_radius_m).value, 0.165, 0.002);
}

TEST(Signs, ThatTheCourseCannotTellApartAreRefused) {
  EXPECT_THAT(found(wrong(4), false).refused, HasSubstr("swapped, or both are reversed"));
  EXPECT_THAT(found(wrong(3), false).refused, HasSubstr("swapped, or both are reversed"));
}

}  // namespace
}  // namespace drover::calibrate
