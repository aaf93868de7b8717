#include "store/drivable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

namespace drover::store {
namespace {

using testing::HasSubstr;

const GeodeticPoint kOld{23.0, 113.0, 10.0};
const GeodeticPoint kNew{23.001, 113.0, 10.0};
constexpr AntennaOffset kArm{0.5, 0.2};

/// As a robot under `origin` shows a place of its base: the antenna's latitude and longitude.
TrackPoint shown(const GeodeticPoint& origin, double x_m, double y_m, double yaw_rad,
                 const AntennaOffset& arm = kArm) {
  const GeographicLib::LocalCartesian frame(origin.latitude_deg, origin.longitude_deg,
                                            origin.altitude_m);
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  TrackPoint point;
  double height_m = 0;
  frame.Reverse(x_m + c * arm.x_m - s * arm.y_m, y_m + s * arm.x_m + c * arm.y_m, 0,
                point.latitude_deg, point.longitude_deg, height_m);
  point.x_m = x_m;
  point.y_m = y_m;
  point.yaw_rad = yaw_rad;
  point.angle_deg = compass_deg_from_yaw_rad(yaw_rad);
  return point;
}

/// A bend, ten points.
Track recorded(const GeodeticPoint& origin = kOld) {
  Track track{"t", {}, origin};
  for (int i = 0; i < 10; ++i) {
    const double yaw_rad = 0.1 * i;
    track.points.push_back(
        shown(origin, 40 + 5 * std::sin(yaw_rad), 7 - 5 * std::cos(yaw_rad), yaw_rad));
  }
  return track;
}

std::string refusal(const Track& track, const GeodeticPoint& origin = kOld,
                    const AntennaOffset& arm = kArm) {
  const auto path = build_path(track, origin, arm);
  return path.ok() ? "" : path.error();
}

void round_places(Track& track, double steps_per_deg) {
  for (auto& point : track.points) {
    point.latitude_deg = std::round(point.latitude_deg * steps_per_deg) / steps_per_deg;
    point.longitude_deg = std::round(point.longitude_deg * steps_per_deg) / steps_per_deg;
  }
}

TEST(Drivable, DrivesWhereTheTrackWasRecordedWhateverTheOrigin) {
  const Track track = recorded();
  const auto here = build_path(track, kOld, kArm);
  const auto there = build_path(track, kNew, kArm);
  ASSERT_TRUE(here.ok() && there.ok());
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    EXPECT_NEAR((*here)->points[i].x_m, track.points[i].x_m, 1e-6);
    EXPECT_NEAR((*here)->points[i].y_m, track.points[i].y_m, 1e-6);
    EXPECT_NEAR((*there)->points[i].x_m, track.points[i].x_m, 1e-3);
    EXPECT_NEAR((*there)->points[i].y_m, track.points[i].y_m - 110.75, 0.01);
  }
}

TEST(Drivable, RefusesATrackThatWasRecordedUnderAnotherOriginThanItWasSavedUnder) {
  Track track = recorded(kNew);
  track.origin = kOld;
  EXPECT_EQ(refusal(track),
            "point 1: x, y are 110.74 m away from its latitude and longitude, allowed 0.050 m: "
            "were they recorded before the origin was set, or with the antenna elsewhere?");
}

TEST(Drivable, TellsADistanceOfAnySizeInFewDigitsAndWithItsUnit) {
  Track track = recorded();
  track.points[0].x_m = 1e308;
  EXPECT_THAT(refusal(track), HasSubstr("point 1: x, y are 1e+308 m away from"));
  track.points[0].x_m = 123456.7;
  EXPECT_THAT(refusal(track), HasSubstr("point 1: x, y are 123417 m away from"));
  track = recorded();
  track.points[6].x_m += 0.052;
  EXPECT_THAT(refusal(track), HasSubstr("are 0.052 m away from its latitude and longitude, "
                                        "allowed 0.050 m"))
      << "not that 0.05 is more than 0.05";
}

TEST(Drivable, NamesTheFirstPointThatDoesNotFit) {
  Track track = recorded();
  track.points[6].x_m += 0.1;
  EXPECT_THAT(refusal(track), HasSubstr("point 7: x, y are 0.100 m away"));
  EXPECT_EQ(find_disagreement(track, kArm)->index, 6U);
  track.points[6].x_m -= 0.06;
  EXPECT_EQ(refusal(track), "") << "4 cm";
}

TEST(Drivable, TakesTheLatitudeWhereXAndYAreAFewCentimetresOff) {
  Track track = recorded();
  for (auto& point : track.points) point.y_m += 0.04;
  const auto path = build_path(track, kOld, kArm);
  ASSERT_TRUE(path.ok());
  EXPECT_NEAR((*path)->points[3].y_m, track.points[3].y_m - 0.04, 1e-6);
}

TEST(Drivable, RefusesATrackOfAnotherContinent) {
  Track track = recorded();
  for (auto& point : track.points) point.longitude_deg -= 100;
  EXPECT_THAT(refusal(track), HasSubstr("point 1: x, y are "));
}

TEST(Drivable, TurnsTheArmByTheAngleWhereTheYawIsNone) {
  Track track = recorded();
  for (auto& point : track.points) point.yaw_rad = 230;
  EXPECT_EQ(refusal(track), "");
  for (auto& point : track.points) point.angle_deg = 200;
  EXPECT_NE(refusal(track), "") << "neither fits";
}

TEST(Drivable, CountsTheAngleAsConfigured) {
  Track track = recorded();
  AntennaOffset arm = kArm;
  arm.heading = HeadingConvention::counterclockwise_from_east;
  for (auto& point : track.points) {
    point.angle_deg = to_deg(point.yaw_rad);
    point.yaw_rad = 230;
  }
  EXPECT_EQ(refusal(track, kOld, arm), "");
}

TEST(Drivable, APointWithoutAngleMayBeAnywhereWithinTheArm) {
  Track track = recorded();
  for (auto& point : track.points) point.yaw_rad = point.angle_deg = 0;
  const auto path = build_path(track, kOld, kArm);
  ASSERT_TRUE(path.ok()) << path.error();
  EXPECT_EQ((*path)->points[3].x_m, track.points[3].x_m) << "nothing else tells the base's place";
  for (auto& point : track.points) point.x_m += 1.2;
  EXPECT_NE(refusal(track), "");
}

TEST(Drivable, AllowsWhatTheNumbersCannotTell) {
  Track track = recorded();
  round_places(track, 1e6);  // 11 cm
  EXPECT_EQ(refusal(track), "");
  EXPECT_EQ((*build_path(track, kOld, kArm))->points[3].x_m, track.points[3].x_m)
      << "a line of such steps cannot be driven";
  for (auto& point : track.points) point.y_m += 1;
  EXPECT_THAT(refusal(track), HasSubstr("allowed 0.2"));
  track = recorded();
  round_places(track, 1e4);  // 11 m
  EXPECT_NE(refusal(track), "") << "that is no place";
}

TEST(Drivable, TakesXAndYAloneWhereThereIsNoLatitude) {
  Track track = recorded();
  for (auto& point : track.points) point.latitude_deg = point.longitude_deg = 0;
  const auto here = build_path(track, kOld, kArm);
  const auto there = build_path(track, kNew, kArm);
  ASSERT_TRUE(here.ok() && there.ok());
  EXPECT_EQ((*here)->points[2].y_m, track.points[2].y_m);
  EXPECT_NEAR((*there)->points[2].y_m, track.points[2].y_m - 110.75, 0.01);
  track.origin.reset();
  EXPECT_THAT(refusal(track), HasSubstr("point 1: it has no latitude and longitude"));
}

TEST(Drivable, TakesATrackWithoutOriginFromItsLatitudes) {
  const Track track{"t", {{113.0, 23.001, 0, 322100, 45220, std::acos(0.0), 0}}, std::nullopt};
  const auto path = build_path(track, kNew, kArm);
  ASSERT_TRUE(path.ok());
  EXPECT_NEAR((*path)->points[0].x_m, 0.2, 1e-6);
  EXPECT_NEAR((*path)->points[0].y_m, -0.5, 1e-6);
}

TEST(Drivable, RefusesImpossibleLatitudes) {
  const Track track{"t", {{113.0, 91.0, 0, 1, 2, 3, 4}}, kOld};
  EXPECT_EQ(refusal(track, kNew), "point 1: its latitude or longitude is no place on earth");
}

TEST(Drivable, RefusesTheDocumentsOwnSample) {
  const TrackPoint sample{188.2222333, 23.04934955, 230, 322100.0, 45220.0, 3.141592, 0};
  const std::string why = refusal({"test1", {sample, sample}, kOld});
  EXPECT_THAT(why, HasSubstr("point 1: x, y are "));
  EXPECT_THAT(why, HasSubstr("its longitude 188.2222 is beyond 180 degrees, which is -171.7778"));
}

TEST(Drivable, APathSharesNothingWithItsTrack) {
  Track track = recorded();
  const auto path = build_path(track, kOld, kArm);
  const double x_m = track.points[0].x_m;
  track.points.clear();
  track.name = "other";
  EXPECT_NEAR((*path)->points.at(0).x_m, x_m, 1e-6);
  EXPECT_EQ((*path)->name, "t");
}

}  // namespace
}  // namespace drover::store
