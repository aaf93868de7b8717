// The track is where the operator's latitudes and longitudes say, and a crossing confuses nobody.
#include "mission/track.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drover::mission {
namespace {

const auto kScenario = nlohmann::json::parse(R"({
  "origin": {"latitude_deg": 23.0, "longitude_deg": 113.0, "altitude_m": 20},
  "gnss": {"antenna": {"x_m": 0.1, "y_m": 0.02}}})");

TEST(MissionTrack, NeedsOriginAndAntenna) {
  EXPECT_THROW(Earth{nlohmann::json::object()}, nlohmann::json::exception);
}

TEST(MissionTrack, TakesTheAntennaOff) {
  const Earth earth(kScenario);
  const Place east = earth.base(23.0, 113.0, 0);
  EXPECT_NEAR(east.x_m, -0.1, 1e-9);
  EXPECT_NEAR(east.y_m, -0.02, 1e-9);
  const Place north = earth.base(23.0, 113.0, M_PI / 2);
  EXPECT_NEAR(north.x_m, 0.02, 1e-9);
  EXPECT_NEAR(north.y_m, -0.1, 1e-9);
}

TEST(MissionTrack, ReadsLatitudeNorthAndLongitudeEast) {
  const Earth earth(kScenario);
  const auto track =
      read_track(nlohmann::json::parse(
                     R"({"data": {"data": [{"latitude": 23.001, "longitude": 113.0, "yaw": 0},
                                {"latitude": 23.0, "longitude": 113.001, "yaw": 0}]}})"),
                 earth);
  ASSERT_EQ(track.size(), 2U);
  // WGS 84 at 23 degrees: 110.75 km and 102.52 km a degree.
  EXPECT_NEAR(track[0].y_m, 110.75, 0.1);
  EXPECT_NEAR(track[1].x_m, 102.42, 0.1);
}

TEST(MissionTrack, MeasuresBesideTheNearestSegment) {
  const std::vector<Place> track{{0, 0}, {1, 0}, {1, 1}};
  Beside beside(track);
  EXPECT_NEAR(beside.distance_m({0.5, 0.2}), 0.2, 1e-12);
  EXPECT_NEAR(beside.distance_m({1.3, 0.5}), 0.3, 1e-12);
  EXPECT_NEAR(beside.distance_m({1, 2}), 1, 1e-12);
}

TEST(MissionTrack, StaysOnTheBranchThatIsDrivenWhereATrackCrossesItself) {
  std::vector<Place> track;
  for (int i = 0; i <= 20; ++i) track.push_back({0.5 * i, 0});
  for (int i = 1; i <= 20; ++i) track.push_back({10 - 0.1 * i, 0.5 * i});
  for (int i = 1; i <= 20; ++i) track.push_back({8 - 0.3 * i, 10 - 0.5 * i - 0.2});
  Beside beside(track);
  double worst_m = 0;
  for (const auto& place : track) worst_m = std::max(worst_m, beside.distance_m(place));
  EXPECT_LT(worst_m, 1e-9);
  // Far from the first branch's end, near its beginning: not that one.
  Beside elsewhere(track);
  for (int i = 0; i <= 20; ++i) (void)elsewhere.distance_m({0.5 * i, 0});
  EXPECT_NEAR(elsewhere.distance_m({5, 0}), 2.5, 1e-9);
}

TEST(MissionTrack, IsNoNumberBesideNoTrack) {
  const std::vector<Place> none;
  EXPECT_TRUE(std::isnan(Beside(none).distance_m({0, 0})));
}

}  // namespace
}  // namespace drover::mission
