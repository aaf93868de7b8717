#include "store/derive.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drover::store {
namespace {

const GeodeticPoint kOld{23.0, 113.0, 10.0};
const GeodeticPoint kNew{23.001, 113.0, 10.0};

TEST(Derive, KeepsWhatWasSavedUnderTheSameOriginOrWithoutAny) {
  const Track track{"t", {{113.0001, 23.0, 0, 1, 2, 3, 4}}, kOld};
  EXPECT_EQ(derive(track, kOld).points[0].x_m, 1);
  EXPECT_EQ(derive(track, std::nullopt).points[0].y_m, 2);
}

TEST(Derive, TakesXAndYFromLatitudeAndLongitudeForAnotherOrigin) {
  const Track track{"t", {{113.0001, 23.0, 0, 1, 2, 3, 4}}, kOld};
  const Track derived = derive(track, kNew);
  // One thousandth of a degree of latitude at 23 degrees is 110.75 m, of longitude 102.5 m.
  EXPECT_NEAR(derived.points[0].x_m, 10.25, 0.01);
  EXPECT_NEAR(derived.points[0].y_m, -110.75, 0.01);
  EXPECT_EQ(derived.points[0].yaw_rad, 3);
  EXPECT_EQ(derived.points[0].z_m, 4);
}

TEST(Derive, TakesATrackWithoutOriginFromItsLatitudeAndLongitude) {
  const Track track{"t", {{113.0, 23.001, 0, 322100, 45220, 0, 0}}, std::nullopt};
  const auto path = build_path(track, kNew);
  EXPECT_NEAR(path->points[0].x_m, 0, 1e-6);
  EXPECT_NEAR(path->points[0].y_m, 0, 1e-6);
}

TEST(Derive, TakesTheAntennaOffThePoint) {
  // The antenna is 0.5 m ahead and 0.2 m to the left; the robot looks north (yaw 90 degrees).
  const Track track{"t", {{113.0, 23.001, 0, 0, 0, std::acos(0.0), 0}}, kOld};
  const auto path = build_path(track, kNew, {0.5, 0.2});
  EXPECT_NEAR(path->points[0].x_m, 0.2, 1e-6);
  EXPECT_NEAR(path->points[0].y_m, -0.5, 1e-6);
}

TEST(Derive, ImpossibleLatitudesGiveNoNumber) {
  const Track track{"t", {{113.0, 91.0, 0, 1, 2, 3, 4}}, kOld};
  EXPECT_TRUE(std::isnan(build_path(track, kNew)->points[0].x_m));
}

TEST(Derive, APathSharesNothingWithItsTrack) {
  Track track{"t", {{113.0, 23.0, 0, 1, 2, 0, 0}}, kOld};
  const auto path = build_path(track, kOld);
  track.points.clear();
  track.name = "other";
  EXPECT_EQ(path->points.at(0).x_m, 1);
  EXPECT_EQ(path->name, "t");
}

}  // namespace
}  // namespace drover::store
