#include "store/derive.h"

#include <gtest/gtest.h>

#include "store/drivable.h"

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
  const Track track{"t", {{113.0001000001, 23.0, 0, 10.25, 0, 3, 4}}, kOld};
  const Track derived = derive(track, kNew);
  // One thousandth of a degree of latitude at 23 degrees is 110.75 m, of longitude 102.5 m.
  EXPECT_NEAR(derived.points[0].x_m, 10.25, 0.01);
  EXPECT_NEAR(derived.points[0].y_m, -110.75, 0.01);
  EXPECT_EQ(derived.points[0].yaw_rad, 3);
  EXPECT_EQ(derived.points[0].z_m, 4);
}

TEST(Derive, MovesPointsThatHaveOnlyXAndYWithTheOrigin) {
  const Track track{"t", {{0, 0, 0, 1.5, 2.5, 0, 0}, {0, 0, 0, 4.5, 2.5, 0, 0}}, kOld};
  const Track derived = derive(track, kNew);
  EXPECT_NEAR(derived.points[0].x_m, 1.5, 0.01);
  EXPECT_NEAR(derived.points[1].x_m, 4.5, 0.01);
  EXPECT_NEAR(derived.points[0].y_m, 2.5 - 110.75, 0.01);
  EXPECT_EQ(derived.points[0].latitude_deg, 0) << "as it came";
}

TEST(Derive, MovesXAndYOfPointsWhoseLatitudesAreCoarse) {
  const Track track{"t", {{113.00001, 23.00002, 10, 1.234, 2.345, 0.1, 0}}, kOld};
  const Track derived = derive(track, kNew);
  EXPECT_NEAR(derived.points[0].x_m, 1.234, 0.01);
  EXPECT_NEAR(derived.points[0].y_m, 2.345 - 110.75, 0.01);
}

TEST(Derive, LeavesXAndYOfNoKnownOriginAsTheyCame) {
  const Track track{"t", {{0, 0, 0, 1.5, 2.5, 0, 0}}, std::nullopt};
  EXPECT_EQ(derive(track, kNew).points[0].x_m, 1.5);
}

TEST(Derive, ShowsTheLineThatIsDriven) {
  const Track track{"t",
                    {{113.0000100001, 23.0000100001, 10, 0.93, 1.05, 0.1, 0},
                     {0, 0, 0, 4.5, 2.5, 0, 0},
                     {113.00003, 23.00003, 0, 3.07, 3.32, 0, 0}},
                    kOld};
  const AntennaOffset antenna{0.1, 0.05};
  const auto path = build_path(track, kNew, antenna);
  ASSERT_TRUE(path.ok()) << path.error();
  const Track derived = derive(track, kNew, antenna);
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    EXPECT_DOUBLE_EQ(derived.points[i].x_m, path.value()->points[i].x_m) << i;
    EXPECT_DOUBLE_EQ(derived.points[i].y_m, path.value()->points[i].y_m) << i;
  }
}

}  // namespace
}  // namespace drover::store
