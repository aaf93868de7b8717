// What the Keeper keeps: messages, zones, the store, places.
#include "scene/keeper/keeper.h"

#include "tests/unit/scene/keeper/fixture.h"

namespace drover::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Keeper, FindsNothingFreeBeforeItWasToldWhatIsStored) {
  Keeper keeper(keeper_settings());
  Viewpoint from;
  from.pose.position_sigma_m = from.pose.yaw_sigma_rad = 0;
  keeper.see(from);
  EXPECT_THAT(std::string(keeper.look(nullptr).unknown.view()), HasSubstr("zones were not read"));
  keeper.set_zones({}, "");
  EXPECT_THAT(std::string(keeper.look(nullptr).unknown.view()), HasSubstr("scene was not read"));
  keeper.set_scene_problem("");
  EXPECT_EQ(keeper.look(nullptr).unknown.view(), "");
  keeper.set_scene_problem("the stored scene is lost");
  EXPECT_EQ(keeper.look(nullptr).unknown.view(), "the stored scene is lost");
  keeper.set_zones({}, "zones.texts is damaged");
  EXPECT_EQ(keeper.look(nullptr).unknown.view(), "zones.texts is damaged");
  EXPECT_EQ(keeper.look(nullptr).ahead_m, 0);
}

TEST_F(AKeeper, KnowsNothingBeforeTheRobotWasHeard) {
  Keeper other(keeper_settings());
  EXPECT_FALSE(other.look(nullptr).unknown.empty());
}

TEST_F(AKeeper, SeesAnObjectFromTheMessageOn) {
  EXPECT_DOUBLE_EQ(look().ahead_m, 3);
  const auto number = keeper.number();
  EXPECT_EQ(apply(box("box1", 2, 0)), "done");
  EXPECT_GT(keeper.number(), number);
  const Clearance found = look();
  EXPECT_EQ(found.t, from.t);
  EXPECT_EQ(found.scene, keeper.number());
  EXPECT_NEAR(found.ahead_m, 1.9 - 0.5 - 0.1, kResolution_m + 1e-9);
  EXPECT_THAT(text(found.first), HasSubstr("box1 is in the way"));
  CollisionObject gone = box("box1", 0, 0);
  gone.operation = CollisionObject::REMOVE;
  EXPECT_EQ(apply(gone), "done");
  EXPECT_DOUBLE_EQ(look().ahead_m, 3);
}

TEST_F(AKeeper, SeesWhatIsAppendedAndMoved) {
  apply(box("box1", 0, 2.5));
  CollisionObject more = box("box1", 2, 0);
  more.operation = CollisionObject::APPEND;
  EXPECT_EQ(apply(more), "done");
  EXPECT_LT(look().ahead_m, 1.5);
  CollisionObject move;
  move.id = "box1";
  move.header.frame_id = "map";
  move.operation = CollisionObject::MOVE;
  move.primitive_poses = {{{0, 2.5, 0.5}, {}}, {{0, -2.5, 0.5}, {}}};
  EXPECT_EQ(apply(move), "done");
  EXPECT_DOUBLE_EQ(look().ahead_m, 3);
}

TEST_F(AKeeper, KeepsAnObjectAndZonesOfOneNameApart) {
  keeper.set_zones({zone("north", Zone::Kind::keep_out, 2.5, 0, 0.5),
                    zone("yard", Zone::Kind::keep_in, 0, 0, 40)},
                   "");
  EXPECT_THAT(text(look().first), HasSubstr("keep-out north is in the way"));
  apply(box("north", 20, 0));
  EXPECT_LT(look().ahead_m, 1.5) << "the object did not take the zone away";
  CollisionObject gone = box("north", 0, 0);
  gone.operation = CollisionObject::REMOVE;
  apply(gone);
  EXPECT_LT(look().ahead_m, 1.5) << "no message removes a zone";
  from.pose.x_m = 38;
  EXPECT_THAT(text(look().first), HasSubstr("the fence of yard"));
}

TEST_F(AKeeper, KeepsTwoKeepOutsOfOneName) {
  keeper.set_zones({zone("north", Zone::Kind::keep_out, 2.5, 0, 0.5),
                    zone("north", Zone::Kind::keep_out, -2.5, 0, 0.5)},
                   "");
  EXPECT_LT(look().ahead_m, 1.5);
  EXPECT_LT(look().back_m, 1.5);
}

TEST_F(AKeeper, ClearsObjectsAndConstraintsAndNoZone) {
  keeper.set_zones({zone("north", Zone::Kind::keep_out, -2.5, 0, 0.5)}, "");
  apply(box("box1", 2, 0));
  keeper.clear();
  EXPECT_DOUBLE_EQ(look().ahead_m, 3);
  EXPECT_LT(look().back_m, 1.5);
  EXPECT_EQ(keeper.zones().size(), 1U);
}

TEST_F(AKeeper, KeepsEverythingAtItsPlaceOnEarthWhenTheOriginMoves) {
  apply(box("box1", 2, 0));
  keeper.set_zones({zone("north", Zone::Kind::keep_out, -2.5, 0, 0.5)}, "");
  const Clearance before = look();
  const auto number = keeper.number();
  from.origin.latitude_deg += 10 / 111'200.0;  // 10 m north
  from.pose.y_m -= 10;
  ++from.place;
  const Clearance after = look();
  EXPECT_GT(keeper.number(), number);
  EXPECT_NEAR(after.ahead_m, before.ahead_m, 0.03);
  EXPECT_NEAR(after.back_m, before.back_m, 0.03);
}

TEST_F(AKeeper, HasNoPlaceForZonesBeforeTheMapHasAnOrigin) {
  Keeper other(keeper_settings());
  other.set_scene_problem("");
  other.set_zones({zone("north", Zone::Kind::keep_out, 2.5, 0, 0.5)}, "");
  from.origin_set = false;
  other.see(from);
  EXPECT_THAT(text(other.look(nullptr).unknown), HasSubstr("no origin"));
  from.origin_set = true;
  other.see(from);
  EXPECT_LT(other.look(nullptr).ahead_m, 1.5);
  EXPECT_EQ(text(other.look(nullptr).unknown), "");
  from.origin.latitude_deg = NAN;
  other.see(from);
  EXPECT_FALSE(other.look(nullptr).unknown.empty());
}

TEST_F(AKeeper, PlacesNothingByPosesFromBeforeAJump) {
  EXPECT_EQ(apply(box("seen", 3, 0, 0.2, "base_link")), "done");
  const Time seen_at = from.t;
  from.t += std::chrono::milliseconds(500);
  ++from.place;
  keeper.see(from);
  CollisionObject old = box("old", 3, 0, 0.2, "base_link");
  old.header.stamp.sec = 100;
  ASSERT_EQ(to_s(seen_at), 100);
  EXPECT_THAT(apply(old), HasSubstr("header.stamp"));
  EXPECT_EQ(apply(box("new", 3, 0, 0.2, "base_link")), "done");
}

TEST_F(AKeeper, PlacesNothingByAPoseThatIsHardlyKnown) {
  from.pose.position_sigma_m = 0.5;
  from.t += std::chrono::milliseconds(100);
  keeper.see(from);
  EXPECT_THAT(apply(box("box1", 3, 0, 0.2, "base_link")), HasSubstr("known to 0.50 m only"));
  EXPECT_EQ(apply(box("box2", 3, 0)), "done") << "in map the robot's place says nothing";
  from.pose.position_sigma_m = 0.1;
  from.pose.yaw_sigma_rad = kAbsent;
  from.t += std::chrono::milliseconds(100);
  keeper.see(from);
  EXPECT_THAT(apply(box("box1", 3, 0, 0.2, "base_link")), HasSubstr("which way the robot looked"));
  from.pose.position_sigma_m = kAbsent;
  from.t += std::chrono::milliseconds(500);
  keeper.see(from);
  EXPECT_THAT(apply(box("box1", 3, 0, 0.2, "base_link")), HasSubstr("not known"));
}

TEST_F(AKeeper, KeepsFartherFromWhatItPlacedByAPoseThatWasLessWellKnown) {
  from.pose.position_sigma_m = 0.05;
  from.pose.yaw_sigma_rad = 0.02;
  from.t += std::chrono::milliseconds(100);
  keeper.see(from);
  const double wider_m = 2 * (0.05 + 0.02 * std::hypot(2.1, 0.1));
  EXPECT_EQ(apply(box("box1", 2, 0, 0.2, "base_link")), "done");
  from.pose.position_sigma_m = from.pose.yaw_sigma_rad = 0;  // since then it is better known
  EXPECT_NEAR(look().ahead_m, 1.9 - 0.5 - 0.1 - wider_m, kResolution_m + 1e-9);
  EXPECT_EQ(apply(box("box2", -2, 0)), "done");
  EXPECT_NEAR(look().back_m, 1.9 - 0.5 - 0.1, kResolution_m + 1e-9) << "in map it has none";

  const auto stored = keeper.stored_object("box1");
  ASSERT_TRUE(stored);
  EXPECT_NEAR(stored->place_sigma_m, 0.5 * wider_m, 1e-9);
  Keeper next(keeper_settings());
  next.set_zones({}, "");
  next.set_scene_problem("");
  for (const CollisionObject& message : stored->messages)
    EXPECT_EQ(words(next.restore(message, stored->origin, stored->place_sigma_m)), "done");
  next.see(from);
  EXPECT_NEAR(next.look(nullptr).ahead_m, 1.3 - wider_m, kResolution_m + 1e-9);
  EXPECT_NEAR(next.stored_object("box1")->place_sigma_m, 0.5 * wider_m, 1e-9);

  from.origin.latitude_deg += 10 / 111'200.0;  // everything is placed anew
  from.pose.y_m -= 10;
  next.see(from);
  EXPECT_NEAR(next.look(nullptr).ahead_m, 1.3 - wider_m, 0.03);
}

TEST_F(AKeeper, KeepsFartherFromAllOfAnObjectThatIsExtendedByAWorsePose) {
  apply(box("box1", 2, 0));
  from.pose.position_sigma_m = 0.1;
  from.t += std::chrono::milliseconds(100);
  keeper.see(from);
  CollisionObject more = box("box1", -2, 0, 0.2, "base_link");
  more.operation = CollisionObject::APPEND;
  EXPECT_EQ(apply(more), "done");
  from.pose.position_sigma_m = 0;
  EXPECT_NEAR(look().ahead_m, 1.3 - 0.2, kResolution_m + 1e-9);
  EXPECT_NEAR(look().back_m, 1.3 - 0.2, kResolution_m + 1e-9);
  more.header.frame_id = "map";
  more.primitive_poses[0].position_m.x = 20;
  EXPECT_EQ(apply(more), "done");
  EXPECT_NEAR(look().ahead_m, 1.3 - 0.2, kResolution_m + 1e-9) << "widened once";
  CollisionObject move;
  move.id = "box1";
  move.header.frame_id = "map";
  move.operation = CollisionObject::MOVE;
  move.primitive_poses = {{{2, 0, 0.5}, {}}, {{-2, 0, 0.5}, {}}, {{20, 0, 0.5}, {}}};
  EXPECT_EQ(apply(move), "done");
  EXPECT_NEAR(look().ahead_m, 1.3, kResolution_m + 1e-9);
}

TEST_F(AKeeper, PlacesNothingOfNowThatCameLate) {
  const Arrived late{from.t, Duration{0}, "the broker is late"};
  EXPECT_THAT(words(keeper.apply(box("box1", 2, 0, 0.2, "base_link"), late)),
              HasSubstr("header.stamp: 0 means now"));
  EXPECT_THAT(words(keeper.apply(box("box1", 2, 0, 0.2, "base_link"), late)),
              HasSubstr("the broker is late"));
  CollisionObject stamped = box("box1", 2, 0, 0.2, "base_link");
  stamped.header.stamp.sec = 100;
  EXPECT_EQ(words(keeper.apply(stamped, late)), "done");
  EXPECT_EQ(words(keeper.apply(box("box2", 2, 0), late)), "done");
}

TEST_F(AKeeper, NamesWhatTheStoreHasToHaveAnew) {
  EXPECT_THAT(keeper.take_changed_objects(), IsEmpty());
  apply(box("box2", 2, 0));
  apply(box("box1", 2, 0));
  apply(box("box1", 3, 0));
  EXPECT_THAT(keeper.take_changed_objects(), ElementsAre("box1", "box2"));
  EXPECT_THAT(keeper.take_changed_objects(), IsEmpty());
  CollisionObject bad = box("box3", 2, 0);
  bad.primitive_poses[0].position_m.x = 1e9;
  EXPECT_NE(apply(bad), "done");
  EXPECT_THAT(keeper.take_changed_objects(), IsEmpty());
  Constraints set;
  set.name = "row";
  set.joint_constraints = {{"base/y", 0, 1, 1, 0}};
  EXPECT_EQ(apply(set), "done");
  EXPECT_THAT(keeper.take_changed_sets(), ElementsAre("row"));
  keeper.clear();
  EXPECT_THAT(keeper.take_changed_objects(), ElementsAre("box1", "box2"));
  EXPECT_THAT(keeper.take_changed_sets(), ElementsAre("row"));
  EXPECT_FALSE(keeper.stored_object("box1").has_value());
  EXPECT_FALSE(keeper.stored_set("row").has_value());
}

TEST_F(AKeeper, RestoresWhatWasStoredUnderAnotherOrigin) {
  apply(box("box1", 2, 0));
  Constraints set;
  set.name = "row";
  set.joint_constraints = {{"base/y", 0, 1, 1, 0}};
  apply(set);
  const auto object = keeper.stored_object("box1");
  const auto constraints = keeper.stored_set("row");
  ASSERT_TRUE(object && constraints);
  EXPECT_EQ(object->messages.size(), 1U);
  EXPECT_EQ(object->origin.latitude_deg, kYard.latitude_deg);

  // The next run begins 10 m to the north; the store is read before the origin is known.
  Keeper next(keeper_settings());
  next.set_zones({}, "");
  for (const CollisionObject& message : object->messages)
    EXPECT_EQ(words(next.restore(message, object->origin)), "done");
  EXPECT_EQ(words(next.restore(constraints->message, constraints->origin)), "done");
  next.set_scene_problem("");
  EXPECT_THAT(next.take_changed_objects(), IsEmpty()) << "the store has it";
  EXPECT_THAT(next.take_changed_sets(), IsEmpty());
  from.origin.latitude_deg += 10 / 111'200.0;
  from.pose.y_m = -10;
  next.see(from);
  const Clearance found = next.look(nullptr);
  EXPECT_NEAR(found.ahead_m, 1.3, 0.02);
  EXPECT_EQ(text(found.broken), "");
  from.pose.y_m = -8;
  next.see(from);
  EXPECT_THAT(text(next.look(nullptr).broken), HasSubstr("row.joint_constraints[0] (base/y)"));
  // What was restored is stored as what is in the map now.
  const auto again = next.stored_object("box1");
  ASSERT_TRUE(again);
  EXPECT_EQ(again->origin.latitude_deg, from.origin.latitude_deg);
  EXPECT_NEAR(again->messages[0].primitive_poses[0].position_m.y, -10, 0.01);
}

TEST_F(AKeeper, RestoresObjectsOfOlderAndYoungerOriginsTogether) {
  GeodeticPoint north = kYard;
  north.latitude_deg += 10 / 111'200.0;
  EXPECT_EQ(words(keeper.restore(box("box1", 2, -10), north)), "done");
  EXPECT_EQ(words(keeper.restore(box("box2", -2, 0), kYard)), "done");
  EXPECT_NEAR(look().ahead_m, 1.3, 0.02);
  EXPECT_NEAR(look().back_m, 1.3, 0.02);
  EXPECT_NE(words(keeper.restore(box("box3", 2, 0, 0.2, "base_link"), kYard)), "done");
  EXPECT_NE(words(keeper.restore(box("box3", 2, 0), {NAN, 0, 0})), "done");
}

TEST_F(AKeeper, StoresAnObjectThatIsLargerThanAMessageAsSeveral) {
  CollisionObject big = box("big", 20, 0);
  big.primitives.assign(900, big.primitives[0]);
  big.primitive_poses.assign(900, big.primitive_poses[0]);
  EXPECT_EQ(apply(big), "done");
  big.operation = CollisionObject::APPEND;
  EXPECT_EQ(apply(big), "done");
  const auto stored = keeper.stored_object("big");
  ASSERT_TRUE(stored);
  ASSERT_EQ(stored->messages.size(), 2U);
  Keeper next(keeper_settings());
  for (const CollisionObject& message : stored->messages)
    EXPECT_EQ(words(next.restore(message, stored->origin)), "done");
  EXPECT_EQ(next.world().object("big")->primitives.size(), 1800U);
}

TEST_F(AKeeper, RefusesWhatTheStoreCannotKeep) {
  CollisionObject mesh = box("mesh", 20, 0);
  mesh.primitives.clear();
  mesh.primitive_poses.clear();
  Mesh shape;
  shape.vertices.assign(30'000, Vector3{0.1234567890123456, 0, 0});
  shape.triangles = {{0, 1, 2}};
  mesh.meshes = {shape};
  std::string said = "done";
  int taken = 0;
  for (; taken < 20 && said == "done"; ++taken) {
    mesh.id = "mesh" + std::to_string(taken);
    said = apply(mesh);
  }
  EXPECT_THAT(said, HasSubstr("bytes of the store"));
  EXPECT_GT(taken, 4);
  EXPECT_LT(taken, 10);
}

class AKeeperWithoutHeights : public AKeeper {
 protected:
  static KeeperSettings settings() {
    KeeperSettings made = keeper_settings();
    made.heights = {-kEndless, kEndless};
    return made;
  }
  AKeeperWithoutHeights() : AKeeper(settings()) {}
  static CollisionObject plane(const std::string& id, std::array<double, 4> coef) {
    CollisionObject message;
    message.id = id;
    message.header.frame_id = "map";
    message.planes = {{coef}};
    message.plane_poses = {{}};
    return message;
  }
};

TEST_F(AKeeperWithoutHeights, SaysThatTheGroundBlocksNothing) {
  EXPECT_THAT(apply(plane("ground", {0, 0, 1, 0})),
              HasSubstr("done; planes[0]: nearly level: as heights are not looked at"));
  EXPECT_DOUBLE_EQ(look().ahead_m, 3);
  EXPECT_EQ(text(look().first), "");
}

TEST_F(AKeeperWithoutHeights, TakesAnUprightPlaneForAWall) {
  EXPECT_EQ(apply(plane("wall", {1, 0, 0, -2})), "done");
  EXPECT_NEAR(look().ahead_m, 2 - 0.5 - 0.1, kResolution_m + 1e-9);
  EXPECT_DOUBLE_EQ(look().back_m, 3);
}

TEST_F(AKeeperWithoutHeights, SaysThatASteepPlaneBlocksEverything) {
  EXPECT_THAT(apply(plane("scarp", {1, 0, 0.2, -200})), HasSubstr("blocks everything"));
  EXPECT_EQ(look().ahead_m, 0);
}

TEST_F(AKeeperWithoutHeights, SeesEverythingElseAtAnyHeight) {
  CollisionObject high = box("balloon", 2, 0);
  high.primitive_poses[0].position_m.z = 50;
  EXPECT_EQ(apply(high), "done");
  EXPECT_LT(look().ahead_m, 1.5);
}

TEST_F(AKeeper, SaysNothingOfPlanesWhereHeightsCount) {
  CollisionObject ground;
  ground.id = "ground";
  ground.header.frame_id = "map";
  ground.planes = {{{0, 0, 1, 0}}};
  EXPECT_EQ(apply(ground), "done");
  EXPECT_DOUBLE_EQ(look().ahead_m, 3);
}

TEST_F(AKeeper, TellsThePointOfAThingThatIsNearestToTheRobot) {
  CollisionObject wall = box("wall", 3, 10);
  wall.primitives[0].dimensions = {0.2, 30, 1};
  ASSERT_EQ(apply(wall), "done");
  CollisionObject hedge;
  hedge.id = "hedge";
  hedge.header.frame_id = "map";
  hedge.planes = {{{0, 1, 0, 2}}};  // y = -2
  hedge.plane_poses = {{}};
  ASSERT_EQ(apply(hedge), "done");
  CollisionObject beam = box("beam", 1, 0);
  beam.primitive_poses[0].position_m.z = 5;
  ASSERT_EQ(apply(beam), "done");

  const auto of_wall = keeper.nearest_of("wall");
  ASSERT_TRUE(of_wall);
  EXPECT_NEAR(of_wall->x_m, 2.9, 1e-6);
  EXPECT_NEAR(of_wall->y_m, 0, 1e-6);
  const auto of_hedge = keeper.nearest_of("hedge");
  ASSERT_TRUE(of_hedge);
  EXPECT_NEAR(of_hedge->y_m, -2, 0.02);
  EXPECT_FALSE(keeper.nearest_of("beam")) << "above the robot";
  EXPECT_FALSE(keeper.nearest_of("nobody"));
  from.pose.position_sigma_m = kAbsent;
  keeper.see(from);
  EXPECT_FALSE(keeper.nearest_of("wall")) << "it does not know where it is";
}

}  // namespace
}  // namespace drover::scene
