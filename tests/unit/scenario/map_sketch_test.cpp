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
    const auto row = characters(rows.at(row_of(rows, "A")));
    const auto from = std::find(row.begin(), row.end(), "A");
    const auto to = std::find(row.begin(), row.end(), "B");
    const double cell_m = length_m / static_cast<double>(to - from);
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
  const auto row = characters(rows.at(row_of(rows, "·")));
  const auto begin = std::find(row.begin(), row.end(), "·");
  EXPECT_GT(row.end() - begin, 50);
  EXPECT_EQ(std::count(begin, row.end(), "·"), row.end() - begin);
}

TEST(AMapSketch, FitsAnEightyColumnTerminalWhateverTheTrack) {
  for (const double length_m : {1.0, 50.0, 900.0}) {
    for (const double yaw_rad : {0.0, 1.5}) {
      const auto rows = MapSketch(make_track({0, 0, yaw_rad}, {{.straight_m = length_m}})).rows();
      EXPECT_LE(rows.size(), 15U);
      for (const auto& row : rows) EXPECT_LE(characters(row).size(), 78U);
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

std::vector<TrackPose> rectangle(double x_m, double y_m, double length_m, double width_m) {
  return {{x_m - length_m / 2, y_m - width_m / 2, 0},
          {x_m + length_m / 2, y_m - width_m / 2, 0},
          {x_m + length_m / 2, y_m + width_m / 2, 0},
          {x_m - length_m / 2, y_m + width_m / 2, 0}};
}

std::size_t marks_in(const std::vector<std::string>& rows, const std::string& mark) {
  std::size_t count = 0;
  for (const auto& row : rows) {
    const auto all = characters(row);
    count += static_cast<std::size_t>(std::count(all.begin(), all.end(), mark));
  }
  return count;
}

// A character is 13 m / 76 wide and twice as high.
const std::vector<TrackPose> kTenMetres{{0, 0, 0}, {10, 0, 0}};

TEST(AMapSketch, FillsAnArea) {
  MapSketch map(kTenMetres);
  map.put_area(rectangle(5, 0, 4, 1.4), "x");
  // As many as it has room for: no farther than half a character beside its edge.
  const double cell_m = 13.0 / 76;
  EXPECT_NEAR(static_cast<double>(marks_in(map.rows(), "x")), 4 * 1.4 / (2 * cell_m * cell_m), 24);
}

TEST(AMapSketch, ShowsASmallThingAsOneCharacter) {
  MapSketch map(kTenMetres);
  map.put_area(rectangle(5, 0.7, 0.3, 0.3), "o");
  EXPECT_EQ(marks_in(map.rows(), "o"), 1U);
}

TEST(AMapSketch, ShowsAWallThatIsThinnerThanACharacter) {
  for (const double y_m : {0.6, 0.65, 0.7, 0.75, 0.8}) {
    MapSketch map(kTenMetres);
    map.put_area(rectangle(5, y_m, 4, 0.02), "x");
    EXPECT_GE(marks_in(map.rows(), "x"), 20U) << y_m;
  }
}

TEST(AMapSketch, DrawsNoAreaBeyondItsEdge) {
  MapSketch map(kTenMetres);
  const auto before = map.rows();
  map.put_area(rectangle(50, 0, 4, 1), "x");
  map.put_name(rectangle(50, 0, 4, 1), "far", Colour::none);
  map.put_area({}, "x");
  map.put_name({}, "nothing", Colour::none);
  EXPECT_EQ(map.rows(), before);
}

TEST(AMapSketch, WritesANameInsideWhatIsWideEnough) {
  MapSketch map(kTenMetres);
  map.put_area(rectangle(5, 0, 4, 1.4), "x");
  map.put_name(rectangle(5, 0, 4, 1.4), "pond", Colour::none);
  const auto rows = map.rows();
  const auto& row = rows.at(row_of(rows, "pond"));
  EXPECT_NE(row.find("xxpondxx"), std::string::npos) << row;
}

TEST(AMapSketch, WritesANameBesideWhatIsNarrow) {
  MapSketch map(kTenMetres);
  map.put_area(rectangle(5, 0.8, 0.3, 0.3), "@");
  map.put_name(rectangle(5, 0.8, 0.3, 0.3), "pole", Colour::none);
  const auto rows = map.rows();
  EXPECT_EQ(row_of(rows, "pole"), row_of(rows, "@"));
}

TEST(AMapSketch, WritesNoNameOverTheTrack) {
  MapSketch map(kTenMetres);
  map.put_area(rectangle(5, 0, 0.3, 0.3), "@");
  const auto track = marks_in(map.rows(), "·");
  map.put_name(rectangle(5, 0, 0.3, 0.3), "pole", Colour::none);
  const auto rows = map.rows();
  EXPECT_EQ(marks_in(rows, "·"), track);
  EXPECT_LT(row_of(rows, "pole"), row_of(rows, "@")) << "above it is room";
}

TEST(AMapSketch, IsColouredOnlyWhenAsked) {
  MapSketch map(kTenMetres);
  map.put_area(rectangle(5, 0.8, 0.3, 0.3), {"o", Colour::red});
  for (const auto& row : map.rows()) EXPECT_EQ(row.find('\033'), std::string::npos);
  const auto rows = map.rows(true);
  EXPECT_TRUE(rows.at(row_of(rows, "o")).ends_with("\033[31mo\033[0m"));
}

}  // namespace
}  // namespace drover::sim
