// A look along a whole track before it is started.
#include "tests/unit/scene/keeper/fixture.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;

TEST_F(AKeeper, FindsNothingOnATrackThatIsFree) {
  const Path path = row(300);
  EXPECT_FALSE(check(path, 300).has_value());
  apply(box("beside", 100, 3));
  keeper.set_zones({zone("yard", Zone::Kind::keep_in, 0, 0, 400)}, "");
  EXPECT_FALSE(check(path, 300).has_value());
}

TEST_F(AKeeper, SaysWhyATrackIsNone) {
  Path path;
  path.points = {{1, 0}};
  EXPECT_EQ(check(path, 0)->what, "the track has only one point, two are needed");
  path.points = {{1, 0}, {1, 0}};
  EXPECT_EQ(check(path, 1)->what, "all points of the track are the same");
}

TEST_F(AKeeper, NamesTheFirstObjectOnATrackWithItsPointAndItsWay) {
  const Path path = row(300);
  apply(box("second", 200, 0));
  apply(box("first", 120, 0.3));
  const auto offence = check(path, 300);
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->point, 119U);
  EXPECT_NEAR(offence->way_m, 119.9 - 0.6, 0.05);
  EXPECT_EQ(offence->what, "first is in the way");
  EXPECT_FALSE(check(path, 118).has_value()) << "it ends before";
}

TEST_F(AKeeper, LooksAlongATrackFromWhereItWouldBegin) {
  const Path path = row(300);
  apply(box("behind", 20, 0));
  from.pose.x_m = 50.4;
  EXPECT_FALSE(check(path, 300).has_value());
  from.pose.yaw_rad = kPi;
  const auto offence = check(path, 0);
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->point, 21U) << "the last one before it, from the other side";
  EXPECT_NEAR(offence->way_m, 50.4 - 20.1 - 0.6, 0.05);
}

TEST_F(AKeeper, NamesWhatIsWhereTheRobotIs) {
  const Path path = row(30);
  apply(box("box1", 0.3, 0));
  const auto offence = check(path, 30);
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->way_m, 0);
  EXPECT_EQ(offence->what, "box1 is where the robot is, or within its margin");
}

TEST_F(AKeeper, LooksAlongATrackWithTheErrorsOfPlaceAndHeading) {
  const Path path = row(100);
  apply(box("beside", 50, 0.35 + 0.1 + 0.05 + 0.1));
  EXPECT_FALSE(check(path, 100).has_value());
  from.pose.position_sigma_m = 0.02;
  EXPECT_FALSE(check(path, 100).has_value());
  from.pose.yaw_sigma_rad = 0.01;  // 1.2 cm at the corners
  const auto offence = check(path, 100);
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->what, "beside is in the way");
}

TEST_F(AKeeper, NamesTheZonesOfATrack) {
  const Path path = row(100);
  keeper.set_zones({zone("pond", Zone::Kind::keep_out, 50, 2, 1.8)}, "");
  auto offence = check(path, 100);
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->what, "keep-out pond is in the way");
  EXPECT_NEAR(offence->way_m, 48.2 - 0.6, 0.3);
  keeper.set_zones({zone("yard", Zone::Kind::keep_in, 0, 0, 30)}, "");
  offence = check(path, 100);
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->what, "the fence of yard is in the way");
  EXPECT_NEAR(offence->way_m, 30 - 0.6, 0.2);
}

TEST_F(AKeeper, SweepsTheTurnsOfATrack) {
  Path path;
  path.number = 3;
  path.points = {{0, 0}, {10, 0}, {10, 10}};
  // Beyond the corner only its turn on the spot comes there: 0.61 m reach, 0.35 m half a width.
  apply(box("post", 10.25, -0.56, 0.02));
  const auto offence = check(path, 2);
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->what, "post is in the way");
  EXPECT_EQ(offence->point, 1U);
  EXPECT_NEAR(offence->way_m, 10, 0.05);
  EXPECT_FALSE(check(path, 1).has_value());
}

TEST_F(AKeeper, LooksAlongALoopTheWayThatItIsDriven) {
  Path path;
  path.number = 3;
  for (int i = 0; i <= 40; ++i) {
    const double angle_rad = 2 * kPi * i / 40;
    path.points.push_back({10 * std::sin(angle_rad), 10 - 10 * std::cos(angle_rad)});
  }
  apply(box("top", 0, 20));
  const auto ahead = check(path, 0);  // the way to the first point lies behind: to the last
  ASSERT_TRUE(ahead);
  EXPECT_EQ(ahead->what, "top is in the way");
  EXPECT_NEAR(ahead->way_m, 10 * kPi - 0.7, 0.3);
}

TEST_F(AKeeper, NamesTheConstraintThatATrackBreaks) {
  const Path path = row(100);
  Constraints set;
  set.name = "row";
  set.joint_constraints = {{"base/x", 0, 40, 40, 0}};
  ASSERT_EQ(apply(set), "done");
  const auto offence = check(path, 100);
  ASSERT_TRUE(offence);
  EXPECT_THAT(offence->what, HasSubstr("constraint row.joint_constraints[0] (base/x)"));
  EXPECT_NEAR(offence->way_m, 40, 0.2);
  EXPECT_EQ(offence->point, 40U);
  EXPECT_FALSE(check(path, 39).has_value());
}

TEST_F(AKeeper, AsksForConstraintsThatAreOfNowOnly) {
  const Path path = row(100);
  Constraints set;
  set.name = "arm";
  set.joint_constraints = {{"arm", 0, 0.5, 0.5, 0}};
  ASSERT_EQ(apply(set), "done");
  from.joint_rad.resize(3);
  EXPECT_FALSE(check(path, 100).has_value());
  from.joint_rad[2] = 1;
  const auto offence = check(path, 100);
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->way_m, 0);
  EXPECT_THAT(offence->what, HasSubstr("(arm)"));
}

TEST_F(AKeeper, StartsNoTrackInASceneThatIsNotKnown) {
  const Path path = row(100);
  keeper.set_scene_problem("the stored scene is lost");
  auto offence = check(path, 100);
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->what, "the stored scene is lost");
  EXPECT_EQ(offence->way_m, 0);
  keeper.set_scene_problem("");
  apply(box("far", 0, 50));
  from.pose.position_sigma_m = kAbsent;
  offence = check(path, 100);
  ASSERT_TRUE(offence);
  EXPECT_THAT(offence->what, HasSubstr("where the robot is"));
  from.pose.position_sigma_m = 0;
  from.pose.yaw_sigma_rad = kAbsent;
  offence = check(path, 100);
  ASSERT_TRUE(offence);
  EXPECT_THAT(offence->what, HasSubstr("which way"));
}

TEST_F(AKeeper, StartsNoTrackThatIsNone) {
  Path path = row(10);
  EXPECT_TRUE(check(path, 11).has_value());
  path.points[4].x_m = NAN;
  EXPECT_TRUE(check(path, 10).has_value());
  path.points.assign(3, {1, 1});
  EXPECT_TRUE(check(path, 2).has_value());
  path.points.clear();
  EXPECT_TRUE(check(path, 0).has_value());
}

TEST_F(AKeeper, LooksAlongTheWayOntoTheTrack) {
  const Path path = row(100);
  from.pose.y_m = 1.5;
  apply(box("post", 0.9, 0.75, 0.1));
  const auto offence = check(path, 100);
  ASSERT_TRUE(offence);
  EXPECT_EQ(offence->what, "post is in the way");
  from.pose.y_m = -1.5;
  EXPECT_FALSE(check(path, 100).has_value());
  from.pose.y_m = -40;
  EXPECT_THAT(check(path, 100)->what, HasSubstr("40 m away from the track"));
}

TEST_F(AKeeper, EndsALookAlongATrackWhenTheSceneChanges) {
  const Path path = row(1000);
  apply(box("far", 0, 50));
  keeper.see(from);
  const auto looking = keeper.check(path, 1000);
  EXPECT_FALSE(looking->advance(no_time));
  apply(box("box1", 10, 0));
  EXPECT_NE(looking->number(), keeper.number());
  EXPECT_TRUE(looking->advance(no_time));
  ASSERT_TRUE(looking->offence().has_value());
  EXPECT_THAT(looking->offence()->what, HasSubstr("changed"));
}

Constraints views(int count, double target_x_m) {
  Constraints set;
  set.name = "views";
  for (int i = 0; i < count; ++i) {
    VisibilityConstraint view;
    view.target_radius = 0.2;
    view.cone_sides = 4;
    view.sensor_pose.header.frame_id = view.target_pose.header.frame_id = "map";
    view.sensor_pose.pose.position_m = {target_x_m - 20, 30.0 + i, 1};
    view.target_pose.pose.position_m = {target_x_m, 30.0 + i, 1};
    view.sensor_view_direction = VisibilityConstraint::SENSOR_X;
    set.visibility_constraints.push_back(view);
  }
  return set;
}

/// A thousand views past a thousand objects take seconds at each pose.
TEST_F(AKeeper, AsksForTheTimeAfterEachConstraintOfATrack) {
  const Path path = row(10);
  ASSERT_EQ(apply(views(50, 100)), "done");
  keeper.see(from);
  const auto looking = keeper.check(path, 10);
  int asked = 0;
  const auto counts = [&asked] { return ++asked % 7 != 0; };
  int slices = 1;
  while (!looking->advance(counts)) ++slices;
  EXPECT_FALSE(looking->offence().has_value());
  EXPECT_GT(asked, 50 * 50);
  EXPECT_GT(slices, 50 * 50 / 7);
}

TEST_F(AKeeper, FindsTheSameInSlicesAsInOneGo) {
  const Path path = row(100);
  Constraints set = views(20, 100);
  set.joint_constraints = {{"base/x", 0, 40, 40, 0}, {"base/x", 0, 70, 70, 0}};
  ASSERT_EQ(apply(set), "done");
  keeper.see(from);
  const auto whole = keeper.check(path, 100);
  while (!whole->advance([] { return true; })) {
  }
  const auto in_slices = check(path, 100);
  ASSERT_TRUE(whole->offence() && in_slices);
  EXPECT_EQ(whole->offence()->what, in_slices->what);
  EXPECT_THAT(in_slices->what, HasSubstr("views.joint_constraints[0]"));
  EXPECT_EQ(whole->offence()->way_m, in_slices->way_m);
  EXPECT_NEAR(in_slices->way_m, 40, 0.2);
}

TEST_F(AKeeper, LooksAlongALongTrackInPartsThatAreShort) {
  Path path;
  path.number = 3;
  for (int i = 0; i < 50'000; ++i)
    path.points.push_back({0.02 * i, 3 * std::sin(0.005 * i) * std::min(1.0, i * 1e-3)});
  for (int i = 0; i < 900; ++i) apply(box("box" + std::to_string(i), 1.1 * i, 40 + i % 7));
  keeper.see(from);
  const auto looking = keeper.check(path, 49'999);
  int parts = 0;
  while (!looking->advance(no_time)) ++parts;
  EXPECT_FALSE(looking->offence().has_value());
  EXPECT_GT(parts, 40);
  EXPECT_LT(parts, 200);
}

}  // namespace
}  // namespace drover::scene
