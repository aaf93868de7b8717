// Solids in the robot's way: put, moved, taken away, and touched exactly where their edges meet.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "drover/angle.h"
#include "sim/plant/plant.h"

namespace drover::sim {
namespace {

// The outline of field_scene.xml's robot in base_link, and what it reaches up to.
constexpr double kFront_m = 0.45;
constexpr double kRear_m = 0.415;
constexpr double kSide_m = 0.35;
constexpr double kLow_m = 0.05;
constexpr double kTop_m = 1.0;
// The robot sinks a little into its tyres, and the solver needs a trace of overlap.
constexpr double kTrace_m = 0.003;

class Objects : public testing::Test {
 protected:
  Plant plant{std::string(DROVER_SOURCE_DIR) + "/sim/worlds/field_scene.xml"};

  Objects() {
    for (int i = 0; i < 200; ++i) plant.step();  // it settles
    plant.place(0, 0, 0);
  }
  static Solid box(double x_m, double y_m, double length_m = 0.2, double width_m = 0.2) {
    Solid solid;
    solid.x_m = x_m;
    solid.y_m = y_m;
    solid.z_m = 0.5;
    solid.length_m = length_m;
    solid.width_m = width_m;
    solid.height_m = 1;
    return solid;
  }
  static Solid round(Solid::Kind kind, double x_m, double y_m, double radius_m) {
    Solid solid = box(x_m, y_m);
    solid.kind = kind;
    solid.radius_m = radius_m;
    return solid;
  }
  /// Put there for one step, with the robot at its place.
  bool touched(const Solid& solid) {
    plant.place(0, 0, 0);
    EXPECT_EQ(plant.put_object("thing", solid), "");
    plant.step();
    const bool touched = !plant.touches().empty();
    for (const auto& touch : plant.touches()) {
      EXPECT_EQ(touch.what, "thing");
    }
    EXPECT_TRUE(plant.remove_object("thing"));
    return touched;
  }
  /// It is touched when moved by a trace towards the robot, and is not when moved away.
  void expect_edge(Solid solid, double towards_x, double towards_y, const char* what) {
    solid.x_m += kTrace_m * towards_x;
    solid.y_m += kTrace_m * towards_y;
    EXPECT_TRUE(touched(solid)) << what;
    solid.x_m -= 2 * kTrace_m * towards_x;
    solid.y_m -= 2 * kTrace_m * towards_y;
    EXPECT_FALSE(touched(solid)) << what;
  }
};

TEST_F(Objects, AreTouchedByTheWholeOutline) {
  expect_edge(box(kFront_m + 0.1, 0), -1, 0, "ahead");
  expect_edge(box(-kRear_m - 0.1, 0.2), 1, 0, "behind");
  expect_edge(box(0.3, kSide_m + 0.1), 0, -1, "left");
  expect_edge(box(-0.3, -kSide_m - 0.1), 0, 1, "right");
}

TEST_F(Objects, AreTouchedAtEveryHeightOfTheRobot) {
  Solid low = box(0.4, 0);
  low.height_m = 0.02;
  low.z_m = kLow_m - 0.015;
  EXPECT_FALSE(touched(low)) << "it drives over it";
  low.z_m = kLow_m + 0.01;
  EXPECT_TRUE(touched(low));
  Solid hanging = low;
  hanging.z_m = kTop_m - 0.015;
  EXPECT_TRUE(touched(hanging));
  hanging.z_m = kTop_m + 0.02;
  EXPECT_FALSE(touched(hanging)) << "it drives below it";
}

TEST_F(Objects, MayBeCylindersAndSpheres) {
  using Kind = Solid::Kind;
  expect_edge(round(Kind::cylinder, kFront_m + 0.3, 0, 0.3), -1, 0, "cylinder");
  expect_edge(round(Kind::cylinder, kFront_m + 0.01, 0.1, 0.01), -1, 0, "pole of 2 cm");
  expect_edge(round(Kind::sphere, 0, kSide_m + 0.3, 0.3), 0, -1, "sphere");
}

TEST_F(Objects, MayBeConesThatAreWideAtTheirFoot) {
  auto cone = round(Solid::Kind::cone, 0, 0, 0.3);
  cone.height_m = 0.8;
  cone.z_m = 0.4;
  const double at_clearance_m = 0.3 * (1 - kLow_m / 0.8);
  cone.x_m = kFront_m + at_clearance_m;
  expect_edge(cone, -1, 0, "as wide as it is at the robot's lower edge");
  cone.z_m = kTop_m + 0.4 - 0.1;  // only its foot is below the robot's top
  cone.x_m = kFront_m + 0.3;
  expect_edge(cone, -1, 0, "hanging");
}

TEST_F(Objects, MayBePrismsOfAPolygon) {
  auto prism = box(kFront_m + 0.2, 0.05);
  prism.kind = Solid::Kind::prism;
  prism.corners_m = {{-0.2, 0}, {0.2, -0.3}, {0.2, 0.3}};
  expect_edge(prism, -1, 0, "its tip is ahead");
  prism.yaw_rad = kPi;
  expect_edge(prism, -1, 0, "and its back when it is turned");
}

TEST_F(Objects, ChangeTheirShapeWhenTheyArePutAgain) {
  EXPECT_FALSE(touched(box(1, 0)));
  EXPECT_TRUE(touched(box(1, 0, 1.4, 0.2)));
  EXPECT_TRUE(touched(round(Solid::Kind::cylinder, 1, 0, 0.7)));
  EXPECT_FALSE(touched(box(1, 0)));
}

TEST_F(Objects, AreTurned) {
  auto plank = box(kFront_m + 0.3, 0, 0.1, 1);
  EXPECT_FALSE(touched(plank));
  plank.yaw_rad = kPi / 2;
  EXPECT_TRUE(touched(plank));
}

TEST_F(Objects, GoWhereTheyAreSent) {
  ASSERT_EQ(plant.put_object("person", round(Solid::Kind::cylinder, 3, -2, 0.25)), "");
  EXPECT_FALSE(plant.move_object("nobody", 0, 0, 1));
  ASSERT_TRUE(plant.move_object("person", 3, 2, 1));
  const auto steps = static_cast<int>(std::lround(1 / plant.timestep_s()));
  for (int i = 0; i < steps; ++i) plant.step();
  ASSERT_EQ(plant.objects().size(), 1U);
  EXPECT_NEAR(plant.objects()[0].solid.y_m, -1, 1e-6);
  EXPECT_TRUE(plant.objects()[0].moves);
  for (int i = 0; i < 4 * steps; ++i) plant.step();
  EXPECT_EQ(plant.objects()[0].solid.y_m, 2);
  EXPECT_FALSE(plant.objects()[0].moves);
}

TEST_F(Objects, AreNotSeenByTheScannersZones) {
  ASSERT_EQ(plant.put_object("thing", box(1, 0)), "");
  EXPECT_TRUE(std::isinf(plant.free_distance_m(0.8)));
}

TEST_F(Objects, AreRefusedWhenTheyAreNone) {
  auto thin = box(1, 0);
  thin.width_m = 0;
  EXPECT_NE(plant.put_object("thin", thin), "");
  auto dart = box(1, 0);
  dart.kind = Solid::Kind::prism;
  dart.corners_m = {{0, 0}, {1, 1}, {0.2, 0}, {1, -1}};
  EXPECT_NE(plant.put_object("dart", dart), "");
  EXPECT_NE(plant.put_object("", box(1, 0)), "");
  EXPECT_NE(plant.put_object("far", box(std::nan(""), 0)), "");
  EXPECT_TRUE(plant.objects().empty());
  EXPECT_FALSE(plant.remove_object("thin"));
}

TEST_F(Objects, AreAtMostAsManyAsTheWorldHolds) {
  std::size_t put = 0;
  while (put < 100 && plant.put_object("box" + std::to_string(put), box(5, 5)).empty()) ++put;
  EXPECT_EQ(put, 32U);
  EXPECT_EQ(plant.put_object("box7", box(6, 6)), "") << "in its own place";
  EXPECT_TRUE(plant.remove_object("box3"));
  EXPECT_EQ(plant.put_object("another", box(6, 6)), "");
  EXPECT_EQ(plant.put_object("cone", round(Solid::Kind::cone, 5, 5, 0.2)), "");
}

TEST(OtherWorlds, HoldNoObjects) {
  Plant plant(std::string(DROVER_SOURCE_DIR) + "/sim/worlds/field.xml");
  EXPECT_EQ(plant.object_slots(), 0U);
  Solid solid;
  solid.length_m = solid.width_m = solid.height_m = 1;
  EXPECT_NE(plant.put_object("box", solid), "");
}

TEST_F(Objects, StopARobotThatIsPushedIntoThem) {
  auto wall = box(1.0, 0, 0.2, 4);
  ASSERT_EQ(plant.put_object("wall", wall), "");
  plant.push(60, 0);
  double deepest_m = 0;
  for (int i = 0; i < 1200; ++i) {
    plant.step();
    for (const auto& touch : plant.touches()) deepest_m = std::max(deepest_m, touch.depth_m);
  }
  EXPECT_GT(deepest_m, 0) << "it came there";
  EXPECT_LT(plant.pose().x_m, 0.9 - kFront_m + 0.05);
}

}  // namespace
}  // namespace drover::sim
