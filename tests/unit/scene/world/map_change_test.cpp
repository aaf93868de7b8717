// The origin moves: everything stays at its place on earth.
#include "scene/world/map_change.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/LocalCartesian.hpp>

#include "scene/world/rigid.h"
#include "unit/scene/world/yard.h"

namespace drover::scene {
namespace {

using yard::add_box;
using yard::at;
using yard::expect_at;
using yard::kOrigin;
using yard::Yard;

const GeodeticPoint kOther{48.01, 11.03, 480.0};  // 1.1 km north, 2.2 km east

/// Where a place of one map is on earth, by the library itself.
GeodeticPoint on_earth(const GeodeticPoint& origin, const Vector3& place) {
  const GeographicLib::LocalCartesian map(origin.latitude_deg, origin.longitude_deg,
                                          origin.altitude_m);
  GeodeticPoint point;
  map.Reverse(place.x, place.y, place.z, point.latitude_deg, point.longitude_deg, point.altitude_m);
  return point;
}

double apart_m(const GeodeticPoint& a, const GeodeticPoint& b) {
  double way_m = 0;
  GeographicLib::Geodesic::WGS84().Inverse(a.latitude_deg, a.longitude_deg, b.latitude_deg,
                                           b.longitude_deg, way_m);
  return way_m;
}

TEST(MapChange, AnObjectStaysAtItsPlaceOnEarth) {
  Yard yard;
  yard.apply(add_box("box1", at(300, -200, 0.7)));
  const GeodeticPoint before = on_earth(kOrigin, yard.place_of("box1"));
  const std::uint64_t revision = yard.world.revision();
  EXPECT_TRUE(yard.world.move_origin(kOther));
  const Vector3 place = yard.place_of("box1");
  EXPECT_LT(apart_m(before, on_earth(kOther, place)), 1e-3);
  EXPECT_GT(std::hypot(place.x - 300, place.y + 200), 2000);
  EXPECT_NE(yard.world.revision(), revision);
}

TEST(MapChange, HeightsAreAboveTheGroundAndStay) {
  Yard yard;
  yard.apply(add_box("box1", at(300, -200, 0.7)));
  EXPECT_TRUE(yard.world.move_origin({48.0, 11.0, 530.0}));
  expect_at(yard.place_of("box1"), 300, -200, 0.7, 5e-3);  // 30 m of 6400 km
}

TEST(MapChange, ThingsTurnByTheConvergence) {
  Yard yard;
  yard.apply(add_box("box1", at(0, 0)));
  yard.world.move_origin(kOther);
  const Quaternion turn = yard.world.object("box1")->primitives[0].in_map.orientation;
  const double expected_rad = -to_rad(0.03) * std::sin(to_rad(48.005));
  EXPECT_NEAR(2 * std::atan2(turn.z, turn.w), expected_rad, 2e-6);
}

// The sign of the turn by two points on earth: a wall from one to the other still is. The map of a
// lower origin is smaller: 20 m of 6400 km, 0.3 mm of 100 m.
TEST(MapChange, AWallStillLeadsFromOnePlaceToTheOther) {
  Yard yard;
  yard.apply(add_box("begin", at(300, -200, 0, 0.4)));
  const Vector3 end{300 + 100 * std::cos(0.4), -200 + 100 * std::sin(0.4), 0};
  yard.apply(add_box("end", {end, {}}));
  yard.world.move_origin(kOther);
  const Pose begin = yard.world.object("begin")->primitives[0].in_map;
  const Vector3 by_turn = rigid::in_parent(begin, {100, 0, 0});
  const Vector3 by_place = yard.place_of("end");
  EXPECT_LT(std::hypot(by_turn.x - by_place.x, by_turn.y - by_place.y), 5e-4);
}

TEST(MapChange, ThereAndBackIsWhereItWas) {
  Yard yard;
  yard.apply(add_box("box1", at(4000, -3000, 1, 0.3)));
  for (int i = 0; i < 10; ++i) {
    yard.world.move_origin(kOther);
    yard.world.move_origin(kOrigin);
  }
  expect_at(yard.place_of("box1"), 4000, -3000, 1, 1e-9);
  const Pose2 there = moved(Pose2{4000, -3000, 0.3}, kOrigin, kOther);
  const Pose2 back = moved(there, kOther, kOrigin);
  EXPECT_NEAR(back.x_m, 4000, 1e-6);
  EXPECT_NEAR(back.y_m, -3000, 1e-6);
  EXPECT_NEAR(back.yaw_rad, 0.3, 1e-9);
}

TEST(MapChange, ShapesThatCameUnderAnotherOriginKeepTheirs) {
  Yard yard;
  yard.apply(add_box("box1", at(300, -200)));
  yard.world.move_origin(kOther);
  CollisionObject message = add_box("box1", at(5, 5));
  message.operation = CollisionObject::APPEND;
  yard.apply(message);
  yard.world.move_origin(kOrigin);
  expect_at(yard.place_of("box1", 0), 300, -200, 0, 1e-9);
  EXPECT_GT(yard.place_of("box1", 1).x, 2000);
}

TEST(MapChange, TheOtherSideOfTheEarthDoesNotFoldOntoThisOne) {
  for (const GeodeticPoint& far :
       {GeodeticPoint{-48, -169, 0}, {-47.999, -168.999, 0}, {-40, -160, 0}, {0, -100, 0}}) {
    Yard yard;
    yard.apply(add_box("box1", at(30, -20)));
    yard.world.move_origin(far);
    const Vector3 place = yard.place_of("box1");
    EXPECT_GT(std::hypot(place.x, place.y), 5e6);
    yard.world.move_origin(kOrigin);
    expect_at(yard.place_of("box1"), 30, -20, 0);
  }
}

TEST(MapChange, WhatIsNoPlaceIsNoOrigin) {
  Yard yard;
  yard.apply(add_box("box1", at(300, -200)));
  const std::uint64_t revision = yard.world.revision();
  for (const GeodeticPoint& bad :
       {GeodeticPoint{91, 11, 0}, {48, 400, 0}, {kAbsent, 11, 0}, {48, 11, kAbsent}})
    EXPECT_FALSE(yard.world.move_origin(bad));
  EXPECT_TRUE(yard.world.move_origin(kOrigin));
  EXPECT_EQ(yard.world.revision(), revision);
  expect_at(yard.place_of("box1"), 300, -200, 0);
}

}  // namespace
}  // namespace drover::scene
