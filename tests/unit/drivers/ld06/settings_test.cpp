#include "drivers/ld06/settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drivers/ld06/sort.h"
#include "unit/drivers/ld06/rig.h"

namespace drover::ld06 {
namespace {

std::string refusal_of(const Options& options) {
  try {
    read_settings(options);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

Options with(std::string_view name, OptionValue value) {
  return test::ld06_options().set(name, std::move(value));
}

TEST(Ld06Settings, AreReadFromTheirDefaults) {
  const Settings settings = read_settings(test::ld06_options());
  EXPECT_EQ(settings.sectors, 24U);
  EXPECT_TRUE(settings.self_filter.empty());
  EXPECT_DOUBLE_EQ(settings.range_max_m, 12);
}

TEST(Ld06Settings, SayWhereItIsMounted) {
  for (const char* const name : {"mount_x_m", "mount_y_m", "mount_z_m", "mount_yaw_deg"}) {
    const auto table = option_table();
    const auto spec = std::find_if(table.begin(), table.end(),
                                   [name](const OptionSpec& each) { return each.name == name; });
    ASSERT_NE(spec, table.end());
    EXPECT_TRUE(spec->required) << name << ": nobody guesses where a scanner is";
  }
  EXPECT_EQ(refusal_of(Options(option_table())), "mount_x_m is missing");
}

TEST(Ld06Settings, ReadAnOutlineInMetres) {
  const Settings settings = read_settings(with("self_filter", "0.5 0.35, .5 -0.35,-0.5 0 "));
  ASSERT_EQ(settings.self_filter.size(), 3U);
  EXPECT_DOUBLE_EQ(settings.self_filter[1].x_m, 0.5);
  EXPECT_DOUBLE_EQ(settings.self_filter[2].x_m, -0.5);
  EXPECT_TRUE(is_inside(settings.self_filter, 0.2, 0));
  EXPECT_FALSE(is_inside(settings.self_filter, -0.4, 0.3));
  EXPECT_FALSE(is_inside({}, 0, 0)) << "no outline holds nothing";
}

TEST(Ld06Settings, RefuseAnOutlineThatIsNone) {
  for (const char* text :
       {"1 2", "0 0, 1 0", "0 0, 1 0, 2 0", "0 0, 1 0, 0", "0 0 0, 1 0, 0 1", "a b, c d, e f",
        "0 0, 1 0, nan 1", "0 0, 1 0, 0 11", "0 0, 1 0, 0 1,", "0 0; 1 0; 0 1", "0 0, 1 0, 0 inf"})
    EXPECT_TRUE(refusal_of(with("self_filter", text)).starts_with("self_filter: ")) << text;
  std::string many = "0 0, 1 0, 0 1";
  for (int i = 0; i < 14; ++i) many += ", 0 0.5";
  EXPECT_EQ(refusal_of(with("self_filter", many)), "self_filter: more than 16 corners");
}

TEST(Ld06Settings, RefuseWhatIsOutOfRange) {
  EXPECT_TRUE(refusal_of(with("sectors", 7.0)).starts_with("sectors"));
  EXPECT_TRUE(refusal_of(with("least_share", 1.1)).starts_with("least_share"));
  EXPECT_TRUE(refusal_of(with("mount_x_m", std::nan(""))).starts_with("mount_x_m"));
  EXPECT_TRUE(
      refusal_of(with("range_min_m", 0.9).set("range_max_m", 0.8)).starts_with("range_min_m"));
}

TEST(Ld06Sort, LeavesARangeOnlyToObstaclesAndCountsTheRest) {
  Settings settings = read_settings(with("self_filter", "0.5 0.3, 0.5 -0.3, -0.5 -0.3, -0.5 0.3"));
  settings.mount = {0.4, 0, 0.2, to_rad(90)};  // its x looks to the left
  settings.range_max_m = 8;
  Scan turn;
  turn.points.resize(6);
  const double ranges_m[] = {0, 0.03, 0.2, 0.4, 5, 9};
  for (std::size_t i = 0; i < 6; ++i) turn.points[i].range_m = ranges_m[i];
  const TurnCounts counts = sort_beams(settings, turn);
  EXPECT_EQ(counts.beams, 6);
  EXPECT_EQ(counts.returns, 5);
  EXPECT_EQ(counts.lens, 1);
  EXPECT_EQ(counts.own, 1) << "0.2 m to the left of 0.4, 0 is inside";
  EXPECT_EQ(counts.ring, 2);
  EXPECT_EQ(counts.sectors[sector_of(0, 24)].seen, 3) << "beyond 8 m the way was free";
  const double left_m[] = {0, 0, 0, 0.4, 5, 0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(turn.points[i].range_m, left_m[i]) << i;
}

TEST(ScanSectors, CountFromBehindAndHoldEveryBearing) {
  EXPECT_EQ(sector_of(-kPi, 24), 0U);
  EXPECT_EQ(sector_of(0, 24), 12U);
  EXPECT_EQ(sector_of(std::nextafter(kPi, 0), 24), 23U);
  EXPECT_EQ(sector_of(kPi, 24), 23U);
  EXPECT_EQ(sector_of(std::nan(""), 24), 0U);
}

}  // namespace
}  // namespace drover::ld06
