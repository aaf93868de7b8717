#include "store/derive.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace drover::store
