#include "sim/scenario/map_sketch.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "drover/angle.h"

namespace drover::sim {
namespace {

std::size_t row_of(const std::vector<std::string>& rows, const std::string& mark) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].find(mark) != std::string::npos) return i;
  return rows.size();
}

TEST(AMapSketch, DrawsNothingBeyondItsEdge) {
  MapSketch map(make_track({}, {{.straight_m = 10}}));
  const auto before = map.rows();
  map.put({1000, 0, 0}, "#");
  map.put({0, -1000, 0}, "#");
  EXPECT_EQ(map.rows(), before);
}

TEST(AMapSketch, HasNorthUpAndEastRight) {
  MapSketch map(make_track({}, {{.straight_m = 10}, {.turn_rad = kPi / 2, .radius_m = 3}}));
  map.put({0, 0, 0}, "S");
  map.put({13, 3, 0}, "E");
  const auto rows = map.rows();
  ASSERT_LT(row_of(rows, "S"), rows.size());
  EXPECT_LT(row_of(rows, "E"), row_of(rows, "S"));
  EXPECT_GT(rows[row_of(rows, "E")].find('E'), rows[row_of(rows, "S")].find('S'));
}

TEST(AMapSketch, TellsItsScaleInARoundLength) {
  for (const double length_m : {3.0, 10.0, 40.0, 700.0}) {
    MapSketch map(make_track({}, {{.straight_m = length_m}}));
    map.put({0, 0, 0}, "A");
    map.put({length_m, 0, 0}, "B");
    const auto rows = map.rows();
    const auto& row = rows.at(row_of(rows, "A"));
    const double cell_m = length_m / static_cast<double>(row.rfind('B') - row.find('A'));
    const auto scale = map.scale();
    const auto bar = scale.rfind('|') - scale.find('|');
    const double told_m = std::stod(scale.substr(scale.rfind('|') + 1));
    EXPECT_NEAR(static_cast<double>(bar) * cell_m, told_m, cell_m) << scale;
    EXPECT_TRUE(scale.ends_with(" m")) << scale;
    EXPECT_LT(scale.size(), 40U);
  }
}

TEST(AMapSketch, DrawsTheTrackWithoutGaps) {
  const auto rows = MapSketch(make_track({}, {{.straight_m = 10}})).rows();
  const auto& row = rows.at(row_of(rows, "."));
  EXPECT_EQ(row.find_first_not_of('.', row.find('.')), row.find_last_of('.') + 1);
}

TEST(AMapSketch, FitsAnEightyColumnTerminalWhateverTheTrack) {
  for (const double length_m : {1.0, 50.0, 900.0}) {
    for (const double yaw_rad : {0.0, 1.5}) {
      const auto rows = MapSketch(make_track({0, 0, yaw_rad}, {{.straight_m = length_m}})).rows();
      EXPECT_LE(rows.size(), 15U);
      EXPECT_LE(rows.at(0).size(), 78U);
    }
  }
}

TEST(AnArrow, PointsWhereTheRobotLooks) {
  EXPECT_EQ(arrow(0.1), "→");
  EXPECT_EQ(arrow(kPi / 2), "↑");
  EXPECT_EQ(arrow(-kPi / 2 + 0.2), "↓");
  EXPECT_EQ(arrow(3.1), "←");
  EXPECT_EQ(arrow(-3.1), "←");
  EXPECT_EQ(arrow(-kPi / 4), "↘");
}

TEST(AMapSketch, DrawsTheEdgeOfAPolygon) {
  MapSketch map({{0, 0, 0}, {10, 0, 0}});
  map.put_edge({{2, -1, 0}, {4, -1, 0}, {4, 1, 0}, {2, 1, 0}}, "x");
  std::size_t marks = 0;
  for (const auto& row : map.rows())
    marks += static_cast<std::size_t>(std::count(row.begin(), row.end(), 'x'));
  EXPECT_GT(marks, 20U);
  map.put_edge({{20, 20, 0}, {1e9, 0, 0}}, "x");  // beyond the edge, and endless: nothing happens
}

}  // namespace
}  // namespace drover::sim
