// A log of measurements as a table: what is read of it, and what is refused where.
#include "cli/estimate_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drover::cli {
namespace {

using testing::HasSubstr;

/// The row after this head.
Result<std::optional<LogRow>, LogError> read(std::string_view head, std::string_view row) {
  LogReader reader;
  if (const auto wrong = reader.read_head(head)) return *wrong;
  return reader.read_row(row);
}
std::string trouble(std::string_view head, std::string_view row) {
  const auto result = read(head, row);
  return result.ok() ? "" : result.error().text();
}
LogRow row(std::string_view head, std::string_view text) {
  const auto result = read(head, text);
  EXPECT_TRUE(result.ok() && result->has_value()) << (result.ok() ? "" : result.error().text());
  return result.ok() && *result ? **result : LogRow{};
}

TEST(EstimateLog, HasMeasurementsWhereTheirCellsAre) {
  constexpr std::string_view kHead =
      "time_s,left_rim_mps,right_rim_mps,gyro_z_radps,latitude_deg,longitude_deg,quality,"
      "heading_deg";
  const LogRow wheels = row(kHead, "1.5, 0.4, 0.5,,,,,");
  ASSERT_TRUE(wheels.motion);
  EXPECT_TRUE(wheels.motion->by_rims);
  EXPECT_EQ(wheels.motion->first, 0.4);
  EXPECT_EQ(wheels.motion->second, 0.5);
  EXPECT_EQ(wheels.time, Time{from_s(1.5)});
  EXPECT_EQ(wheels.received, wheels.time);
  EXPECT_FALSE(wheels.imu || wheels.position || wheels.heading);
  const LogRow fix = row(kHead, "1.6,,,,48.1372,11.5756,4,-90\r");
  ASSERT_TRUE(fix.position);
  EXPECT_EQ(fix.position->latitude_deg, 48.1372);
  EXPECT_EQ(fix.position->quality, FixQuality::rtk_fixed);
  EXPECT_EQ(fix.heading->heading_deg, 270);
  EXPECT_FALSE(fix.motion);
  const LogRow turn = row(kHead, "1.7,,,0.02,,,,");
  EXPECT_EQ(turn.imu->angular_velocity_radps.z, 0.02);
  EXPECT_EQ(turn.imu->acceleration_mps2.z, 9.81) << "level where nobody tells";
}

TEST(EstimateLog, HasTwistsAndTimesOfReceptionToo) {
  const LogRow one = row("time_s,received_s,vx_mps,wz_radps", "-3,-2.9,0.5,0.1");
  EXPECT_FALSE(one.motion->by_rims);
  EXPECT_EQ(one.motion->second, 0.1);
  EXPECT_EQ(one.received - one.time, std::chrono::milliseconds(100));
}

TEST(EstimateLog, HasWhatACalibrationLooksAt) {
  constexpr std::string_view kRims = "time_s,receiver_mps,command_left_mps,command_right_mps";
  const LogRow told = row(kRims, "1,,0.4,0.5");
  EXPECT_TRUE(told.command->by_rims);
  EXPECT_EQ(told.command->second, 0.5);
  EXPECT_FALSE(told.receiver_mps);
  EXPECT_EQ(row(kRims, "1,0.3,,").receiver_mps, 0.3);
  const LogRow twist = row("time_s,command_vx_mps,command_wz_radps", "1,0.5,-0.2");
  EXPECT_FALSE(twist.command->by_rims);
  EXPECT_EQ(twist.command->second, -0.2);
  EXPECT_THAT(trouble(kRims, "1,-0.3,,"), HasSubstr("(receiver_mps): -0.3 is not within"));
  EXPECT_THAT(trouble(kRims, "1,,0.4,"), HasSubstr("it needs command_right_mps"));
  EXPECT_THAT(trouble("time_s,command_left_mps,command_right_mps,command_vx_mps,command_wz_radps",
                      "1,0,0,0,0"),
              HasSubstr("told twice"));
}

TEST(EstimateLog, PassesCommentsAndEmptyLinesOverAndCountsThem) {
  LogReader reader;
  EXPECT_FALSE(reader.read_head("# of the robot in the yard"));
  EXPECT_FALSE(reader.has_head());
  EXPECT_FALSE(reader.read_head("time_s,heading_deg"));
  EXPECT_TRUE(reader.has_head());
  const auto empty = reader.read_row("  ");
  ASSERT_TRUE(empty.ok());
  EXPECT_FALSE(empty->has_value());
  EXPECT_THAT(reader.read_row("x,1").error().text(), HasSubstr("line 4, column 1 (time_s)"));
}

TEST(EstimateLog, NamesLineAndColumnOfWhatIsWrong) {
  EXPECT_EQ(trouble("time_s,hedding_deg", ""),
            "line 1, column 2 (hedding_deg): there is no such column; did you mean "
            "\"heading_deg\"?");
  EXPECT_EQ(trouble("time_s,heading_deg,heading_deg", ""),
            "line 1, column 3 (heading_deg): this column is there twice");
  EXPECT_EQ(trouble("heading_deg", ""), "line 1: there is no column time_s");
  EXPECT_EQ(trouble("time_s,latitude_deg", ""),
            "line 1, column 2 (latitude_deg): it needs longitude_deg beside it");
  EXPECT_EQ(trouble("time_s,heading_deg", "1"), "line 2: 1 cells, and there are 2 columns");
  EXPECT_EQ(trouble("time_s,heading_deg", "1,2,3"), "line 2: 3 cells, and there are 2 columns");
  EXPECT_EQ(trouble("time_s,heading_deg", "1,nan"),
            "line 2, column 2 (heading_deg): not a finite number; what is not known is an empty "
            "cell");
  EXPECT_EQ(trouble("time_s,heading_deg", "1,12 deg"),
            "line 2, column 2 (heading_deg): \"12 deg\" is no number");
  EXPECT_EQ(trouble("time_s,heading_deg", ",12"), "line 2, column 1 (time_s): is missing");
  EXPECT_EQ(trouble("time_s,vx_mps,wz_radps", "1,0.5,"),
            "line 2, column 2 (vx_mps): it needs wz_radps beside it");
  EXPECT_EQ(trouble("time_s,latitude_deg,longitude_deg,quality", "1,91,0,4"),
            "line 2, column 2 (latitude_deg): 91 is not within -90 and 90");
  EXPECT_THAT(trouble("time_s,latitude_deg,longitude_deg,quality", "1,9,0,4.5"),
              HasSubstr("column 4 (quality): is a whole number"));
  EXPECT_THAT(trouble("time_s,received_s,heading_deg", "2,1,0"),
              HasSubstr("column 2 (received_s): it was received before it was true"));
}

TEST(EstimateLog, MayCountFromAnyZero) {
  for (const double zero_s : {0.0, -5e8, 1772373900.25, 3.9e9}) {
    const LogRow one = row("time_s,received_s,heading_deg",
                           std::to_string(zero_s) + "," + std::to_string(zero_s + 0.5) + ",90");
    EXPECT_EQ(one.time, Time{from_s(zero_s)});
    EXPECT_NEAR(to_s(one.received - one.time), 0.5, 1e-6);
  }
  EXPECT_THAT(trouble("time_s,heading_deg", "1772373900250,90"),
              HasSubstr("is not within -4e+09 and 4e+09"))
      << "milliseconds";
}

TEST(EstimateLog, BeginsAsSpreadsheetsDo) {
  LogReader reader;
  EXPECT_FALSE(reader.read_head("\xEF\xBB\xBF# of the robot in the yard"));
  EXPECT_FALSE(reader.has_head());
  EXPECT_FALSE(reader.read_head("time_s,heading_deg"));
  EXPECT_EQ(row("\xEF\xBB\xBFtime_s,heading_deg", "1,90").heading->heading_deg, 90);
}

TEST(EstimateLog, WantsAQualityBesideItsPosition) {
  EXPECT_EQ(trouble("time_s,quality", "1,4"),
            "line 1, column 2 (quality): it needs latitude_deg beside it");
  EXPECT_EQ(trouble("time_s,latitude_deg,longitude_deg,quality", "1,,,4"),
            "line 2, column 4 (quality): it needs latitude_deg beside it");
}

TEST(EstimateLog, WantsTheMotionOfTheBaseOnce) {
  EXPECT_THAT(trouble("time_s,left_rim_mps,right_rim_mps,vx_mps,wz_radps", ""),
              HasSubstr("column 4 (vx_mps): the motion of the base is told twice"));
}

TEST(EstimateLog, WantsItsRowsInOrder) {
  LogReader reader;
  EXPECT_FALSE(reader.read_head("time_s,heading_deg"));
  EXPECT_TRUE(reader.read_row("2,0").ok());
  EXPECT_TRUE(reader.read_row("2,0").ok()) << "two of one instant";
  EXPECT_THAT(reader.read_row("1.9,0").error().text(),
              HasSubstr("line 4, column 1 (time_s): rows are in the order"));
}

TEST(EstimateLog, IsInTheOrderOfReceptionWhereThatIsTold) {
  LogReader reader;
  EXPECT_FALSE(reader.read_head("time_s,received_s,heading_deg"));
  EXPECT_TRUE(reader.read_row("2.00,2.00,0").ok());
  EXPECT_TRUE(reader.read_row("1.92,2.01,0").ok()) << "a late one";
  EXPECT_FALSE(reader.read_row("1.99,1.99,0").ok());
}

TEST(EstimateLog, EndsAtAGapThatWouldTakeForEver) {
  LogReader reader;
  EXPECT_FALSE(reader.read_head("time_s,heading_deg"));
  EXPECT_TRUE(reader.read_row("0,0").ok());
  EXPECT_THAT(reader.read_row("1e8,0").error().text(), HasSubstr("these are two logs"));
  EXPECT_THAT(trouble("time_s,heading_deg", "1e300,0"), HasSubstr("is not within"));
}

}  // namespace
}  // namespace drover::cli
