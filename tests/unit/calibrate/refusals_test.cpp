// What a drive cannot tell is refused by name, with what to drive; the rest of it is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/calibrate/simulated_drive.h"

namespace drover::calibrate {
namespace {

using testing::HasSubstr;

Drive driven(const Legs& legs) {
  return SimulatedDrive({}, {}, 5).drive(legs);
}

TEST(Calibrate, RefusesADriveThatIsTooShort) {
  EXPECT_THAT(calibrate(driven({{3, 0, 0}, {10, 0.5, 0}}), {}).refused, HasSubstr("20 s"));
  EXPECT_THAT(calibrate(driven({{30, 0, 0}}), {}).refused, HasSubstr("less than 5 m"));
  EXPECT_THAT(calibrate({}, {}).refused, HasSubstr("no wheel speeds"));
}

TEST(Calibrate, RefusesADriveWithoutAFix) {
  Drive drive = driven(good_legs());
  drive.places.resize(20);
  EXPECT_THAT(calibrate(drive, {}).refused, HasSubstr("20 positions with an RTK fix"));
}

TEST(Calibrate, RefusesWhatNeedsTurnsWhenItOnlyWentStraight) {
  const auto result = calibrate(
      driven({{6, 0, 0}, {6, 0.3, 0}, {6, 0.7, 0}, {6, 0.3, 0}, {6, 0.7, 0}, {10, 0.5, 0}}), {});
  ASSERT_EQ(result.refused, "");
  for (const auto what : {Quantity::yaw_slip_factor, Quantity::antenna_x_m, Quantity::antenna_y_m,
                          Quantity::gyro_scale})
    EXPECT_THAT(result.of(what).refused, HasSubstr("drive a left and a right circle"));
  EXPECT_EQ(result.of(Quantity::wheel_radius_m).refused, "");
  EXPECT_NEAR(result.of(Quantity::wheel_radius_m).value, 0.165, 0.002);
  EXPECT_EQ(result.of(Quantity::heading_offset_deg).refused, "");
}

TEST(Calibrate, RefusesWhatNeedsTurnsToBothSides) {
  const auto result =
      calibrate(driven({{6, 0, 0}, {5, 0.3, 0}, {5, 0.7, 0}, {20, 0.4, 0.4}, {9, 0.5, 0}}), {});
  ASSERT_EQ(result.refused, "");
  for (const auto what : {Quantity::yaw_slip_factor, Quantity::antenna_x_m, Quantity::antenna_y_m,
                          Quantity::gyro_scale})
    EXPECT_THAT(result.of(what).refused, HasSubstr("0 degrees to the right"));
}

TEST(Calibrate, RefusesLatenessOfADriveAtOneSpeed) {
  Drive drive = driven({{10, 0.4, 0}, {18, 0.4, 0.4}, {10, 0.4, 0}, {18, 0.4, -0.4}, {20, 0.4, 0}});
  const double from_s = drive.places.front().time_s + 4;  // it drives already
  std::erase_if(drive.places, [&](const PlaceRow& row) { return row.time_s < from_s; });
  const auto result = calibrate(drive, {});
  ASSERT_EQ(result.refused, "");
  EXPECT_THAT(result.of(Quantity::position_late_s).refused,
              HasSubstr("change the speed while straight"));
  EXPECT_THAT(result.of(Quantity::antenna_x_m).refused,
              HasSubstr("change the speed while straight"));
  EXPECT_THAT(result.of(Quantity::drive_lag_s).refused, HasSubstr("hardly changed"));
  EXPECT_EQ(result.of(Quantity::antenna_y_m).refused, "");
  EXPECT_EQ(result.of(Quantity::yaw_slip_factor).refused, "");
}

TEST(Calibrate, RefusesByNameWhatNobodyTold) {
  Drive drive = driven(good_legs());
  drive.gyro_radps.clear();
  drive.headings_rad.clear();
  drive.commands.clear();
  drive.receiver_mps.clear();
  const auto result = calibrate(drive, {});
  ASSERT_EQ(result.refused, "");
  EXPECT_EQ(result.of(Quantity::gyro_scale).refused, "there is no gyro");
  EXPECT_EQ(result.of(Quantity::gyro_bias_radps).refused, "there is no gyro");
  EXPECT_EQ(result.of(Quantity::heading_offset_deg).refused, "the receiver told no heading");
  EXPECT_EQ(result.of(Quantity::heading_late_s).refused, "the receiver told no heading");
  EXPECT_EQ(result.of(Quantity::drive_lag_s).refused, "no commanded speeds were recorded");
  EXPECT_THAT(result.of(Quantity::speed_late_s).refused, HasSubstr("no speed of its own"));
  EXPECT_EQ(result.speed_source, SpeedSource::unknown);
  EXPECT_EQ(result.of(Quantity::antenna_x_m).refused, "");
}

TEST(Calibrate, IsNotMisledByAJumpOfTheReceiverOrBySlip) {
  Drive drive = driven(good_legs());
  for (PlaceRow& row : drive.places)
    if (row.time_s > 1060 && row.time_s < 1070) row.east_m += 0.3;
  for (RimRow& row : drive.rims)
    if (row.time_s > 1010 && row.time_s < 1011) row.left_mps = row.right_mps *= 1.4;
  const auto result = calibrate(drive, {});
  ASSERT_EQ(result.refused, "");
  for (const auto& [what, truth] :
       {std::pair{Quantity::wheel_radius_m, 0.165}, std::pair{Quantity::antenna_x_m, 0.0},
        std::pair{Quantity::antenna_y_m, 0.0}, std::pair{Quantity::heading_offset_deg, 0.0},
        std::pair{Quantity::position_late_s, 0.0}}) {
    const Found& found = result.of(what);
    EXPECT_EQ(found.refused, "");
    EXPECT_NEAR(found.value, truth, found.interval);
  }
}

TEST(Calibrate, TakesNumbersThatAreNone) {
  Drive drive = driven(good_legs());
  drive.rims[100].left_mps = std::nan("");
  drive.places[50].east_m = std::nan("");
  drive.gyro_radps[7].value = HUGE_VAL;
  std::swap(drive.places[30], drive.places[31]);
  EXPECT_EQ(calibrate(drive, {}).refused, "");
}

}  // namespace
}  // namespace drover::calibrate
