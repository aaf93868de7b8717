#include "sim/scenario/track.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

#include "drover/angle.h"

namespace drover::sim {
namespace {

constexpr Origin kOrigin{23.1496524965, 113.0196366456667, 20};

void expect_place(const TrackPose& pose, double x_m, double y_m, double yaw_rad) {
  EXPECT_NEAR(pose.x_m, x_m, 1e-9);
  EXPECT_NEAR(pose.y_m, y_m, 1e-9);
  EXPECT_NEAR(wrap_rad(pose.yaw_rad - yaw_rad), 0, 1e-9);
}

TEST(MakeTrack, HasOnlyTheStartWithoutShapes) {
  const auto track = make_track({1, 2, 0.5}, {});
  ASSERT_EQ(track.size(), 1U);
  expect_place(track[0], 1, 2, 0.5);
}

TEST(MakeTrack, PutsAPointEachHalfMetreAndOneAtTheEnd) {
  const auto track = make_track({0, 0, kPi / 2}, {{.straight_m = 1.2}});
  ASSERT_EQ(track.size(), 4U);
  expect_place(track[1], 0, 0.5, kPi / 2);
  expect_place(track[2], 0, 1.0, kPi / 2);
  expect_place(track[3], 0, 1.2, kPi / 2);
}

TEST(MakeTrack, HasNoSecondPointWhereTheLastOneIsTheEnd) {
  EXPECT_EQ(make_track({}, {{.straight_m = 1.0}}).size(), 3U);
}

TEST(MakeTrack, TurnsToTheLeftAboutACentreBesideTheRobot) {
  const auto track = make_track({0, 0, 0}, {{.turn_rad = kPi, .radius_m = 1.5}});
  for (const auto& pose : track) EXPECT_NEAR(std::hypot(pose.x_m, pose.y_m - 1.5), 1.5, 1e-9);
  expect_place(track.back(), 0, 3, kPi);
}

TEST(MakeTrack, TurnsToTheRightForANegativeAngle) {
  const auto track = make_track({0, 0, 0}, {{.turn_rad = -kPi / 2, .radius_m = 2}});
  expect_place(track.back(), 2, -2, -kPi / 2);
}

TEST(MakeTrack, KeepsTheSpacingAcrossShapes) {
  const auto track = make_track(
      {}, {{.straight_m = 0.7}, {.turn_rad = kPi / 2, .radius_m = 1}, {.straight_m = 2}});
  for (std::size_t i = 1; i + 1 < track.size(); ++i) {
    const double d_m = std::hypot(track[i].x_m - track[i - 1].x_m, track[i].y_m - track[i - 1].y_m);
    EXPECT_LE(d_m, 0.5 + 1e-9) << i;
    EXPECT_GE(d_m, 0.49) << "a chord of half a metre of a circle of one metre, or longer: " << i;
  }
}

TEST(MakeTrack, TurnsACornerOnTheSpot) {
  const auto track =
      make_track({}, {{.straight_m = 1}, {.turn_rad = kPi / 2, .radius_m = 0}, {.straight_m = 1}});
  ASSERT_EQ(track.size(), 5U);
  expect_place(track[2], 1, 0, kPi / 2);
  expect_place(track[4], 1, 1, kPi / 2);
}

// The robot's origin is not the simulator's: it took its first position.
Fix fix_at(const TrackPose& base, const TrackPose& shift, const Antenna& antenna) {
  const double c = std::cos(base.yaw_rad);
  const double s = std::sin(base.yaw_rad);
  Fix fix{base.x_m + shift.x_m, base.y_m + shift.y_m, base.yaw_rad, 0, 0};
  double height_m = 0;
  GeographicLib::LocalCartesian(kOrigin.latitude_deg, kOrigin.longitude_deg, kOrigin.altitude_m)
      .Reverse(base.x_m + c * antenna.x_m - s * antenna.y_m,
               base.y_m + s * antenna.x_m + c * antenna.y_m, 0, fix.latitude_deg, fix.longitude_deg,
               height_m);
  return fix;
}

TEST(MapShift, FindsHowTheRobotsMapLiesWhateverTheHeading) {
  const Antenna antenna{0.3, -0.1};
  const TrackPose shift{12.5, -7.25, 0};
  for (const double yaw_rad : {0.0, 1.0, -2.5}) {
    const auto found = map_shift(fix_at({40, -30, yaw_rad}, shift, antenna), kOrigin, antenna);
    EXPECT_NEAR(found.x_m, shift.x_m, 1e-3) << yaw_rad;
    EXPECT_NEAR(found.y_m, shift.y_m, 1e-3) << yaw_rad;
  }
}

TEST(SaveMessage, SaysWhatBaseStatusWouldHaveShownAtEachPoint) {
  const Antenna antenna{0.3, -0.1};
  const TrackPose shift{12.5, -7.25, 0};
  const std::vector<TrackPose> track{{0, 0, 0}, {3, 4, 2}};
  const auto message = nlohmann::json::parse(save_message("a b", track, shift, kOrigin, antenna));
  EXPECT_EQ(message.at("cmd_type"), "trajectory_control");
  EXPECT_EQ(message.at("cmd"), "save_trajectory");
  EXPECT_EQ(message.at("data").at("name"), "a b");
  const auto& points = message.at("data").at("data");
  ASSERT_EQ(points.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto fix = fix_at(track[i], shift, antenna);
    EXPECT_DOUBLE_EQ(points[i].at("x").get<double>(), fix.x_m);
    EXPECT_DOUBLE_EQ(points[i].at("y").get<double>(), fix.y_m);
    EXPECT_DOUBLE_EQ(points[i].at("yaw").get<double>(), fix.yaw_rad);
    EXPECT_NEAR(points[i].at("latitude").get<double>(), fix.latitude_deg, 1e-12);
    EXPECT_NEAR(points[i].at("longitude").get<double>(), fix.longitude_deg, 1e-12);
  }
  EXPECT_NEAR(points[0].at("angle").get<double>(), 90, 1e-9) << "east";
}

TEST(CrossTrackDistance, IsToTheNearestPartOfTheLine) {
  const std::vector<TrackPose> track{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}};
  CrossTrack cross_track(track);
  EXPECT_DOUBLE_EQ(cross_track.distance_m(-3, 4), 5) << "before the start";
  EXPECT_DOUBLE_EQ(cross_track.distance_m(5, -0.25), 0.25);
  EXPECT_DOUBLE_EQ(cross_track.distance_m(9, 5), 1) << "the second segment";
  EXPECT_DOUBLE_EQ(cross_track.distance_m(10, 12), 2) << "past the end";
}

TEST(CrossTrackDistance, DoesNotTakeTheRowBesideForTheRowThatIsDriven) {
  const auto track =
      make_track({}, {{.straight_m = 20}, {.turn_rad = kPi, .radius_m = 0.5}, {.straight_m = 20}});
  CrossTrack cross_track(track);
  for (double x_m = 0; x_m < 10; x_m += 0.1) (void)cross_track.distance_m(x_m, 0);
  EXPECT_NEAR(cross_track.distance_m(10, 0.9), 0.9, 1e-9) << "the way back runs at 1 m";
}

}  // namespace
}  // namespace drover::sim
