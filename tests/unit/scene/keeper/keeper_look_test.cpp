// What the Keeper answers, by where the robot is and where it goes.
#include "tests/unit/scene/keeper/fixture.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;

TEST_F(AKeeper, LooksAlongTheTrackFromWhereTheRobotIs) {
  const Path path = row(20);
  apply(box("near", 7, 0));
  from.pose.x_m = 3.4;
  on(path, 3, 0.4, 20);
  const Clearance found = look(&path);
  EXPECT_EQ(found.path, 3U);
  EXPECT_NEAR(found.along_m, 6.9 - 3.4 - 0.6, 0.02) << "not from the track's beginning";
  EXPECT_THAT(text(found.first), HasSubstr("near is in the way, 2.9"));
  EXPECT_THAT(text(found.first), HasSubstr("along the track"));
}

TEST_F(AKeeper, LooksAlongATrackThatIsDrivenFromItsEnd) {
  const Path path = row(20);
  apply(box("behind", 1, 0));
  from.pose.x_m = 5.5;
  from.pose.yaw_rad = kPi;
  on(path, 6, 0.5, 0, false);
  EXPECT_NEAR(look(&path).along_m, 5.5 - 1.1 - 0.6, 0.02);
  on(path, 6, 0.5, 4, false);
  EXPECT_EQ(look(&path).along_m, kEndless) << "it ends before";
}

TEST_F(AKeeper, IsNotHeldUpByWhatIsBehindTheGoal) {
  const Path path = row(20);
  apply(box("wall", 8.75, 0));
  on(path, 0, 0, 8);
  EXPECT_EQ(look(&path).along_m, kEndless);
  on(path, 0, 0, 9);
  EXPECT_LT(look(&path).along_m, 8.1);
}

TEST_F(AKeeper, LooksNoFartherAlongTheTrackThanItWasAskedTo) {
  const Path path = row(200);
  on(path, 0, 0, 200);
  EXPECT_NEAR(look(&path).along_m, 10, 1e-6);
  apply(box("far", 100, 50));
  EXPECT_NEAR(look(&path).along_m, 10, 1e-6);
}

TEST_F(AKeeper, AnswersForNoTrackThatItWasNotGiven) {
  Path path = row(20);
  apply(box("box1", 7, 0));
  on(path, 0, 0, 20);
  EXPECT_EQ(look(nullptr).path, 0U);
  EXPECT_EQ(text(look(nullptr).unknown), "");
  path.number = 4;
  EXPECT_EQ(look(&path).path, 0U);
  EXPECT_EQ(look(&path).along_m, 0);
}

TEST_F(AKeeper, SaysNothingOfAPlaceThatIsNotOnTheTrack) {
  const Path path = row(20);
  apply(box("box1", 7, 0));
  for (const WayLeft& way :
       {WayLeft{3, true, 20, 21, 0}, WayLeft{3, true, 21, 0, 0}, WayLeft{3, true, 5, 6, 0},
        WayLeft{3, false, 6, 5, 0}, WayLeft{3, true, 20, 0, NAN}}) {
    from.way = way;
    EXPECT_THAT(text(look(&path).unknown), HasSubstr("track"));
    EXPECT_EQ(look(&path).along_m, 0);
  }
}

TEST_F(AKeeper, LooksAlongTheCurveThatIsDrivenOrAskedFor) {
  from.commanded = {0.5, 0.35};
  from.asked = {0.5, -0.35};
  EXPECT_EQ(look().twist.wz_radps, 0.35);
  from.commanded = {};
  EXPECT_EQ(look().twist.wz_radps, -0.35);
  from.asked = {-0.3, 0};
  apply(box("behind", -2, 0));
  EXPECT_THAT(text(look().first), HasSubstr("behind"));
  from.commanded = {NAN, 0};
  EXPECT_FALSE(look().unknown.empty());
}

TEST_F(AKeeper, NeedsNoPlaceWhereNothingIsPlaced) {
  from.pose.position_sigma_m = from.pose.yaw_sigma_rad = kAbsent;
  from.origin_set = false;
  const Clearance found = look();
  EXPECT_EQ(text(found.unknown), "");
  EXPECT_DOUBLE_EQ(found.ahead_m, 3);
  EXPECT_EQ(found.left_rad, kEndless);
  apply(box("box1", 20, 0));
  EXPECT_THAT(text(look().unknown), HasSubstr("where the robot is"));
  keeper.clear();
  EXPECT_EQ(text(look().unknown), "");
  Constraints set;
  set.name = "row";
  set.joint_constraints = {{"base/y", 0, 1, 1, 0}};
  ASSERT_EQ(apply(set), "done");
  EXPECT_THAT(text(look().unknown), HasSubstr("where the robot is"));
}

TEST_F(AKeeper, SaysHowFarItIsFreeAllAroundWithoutAHeading) {
  apply(box("box1", 0, 3));
  from.pose.yaw_sigma_rad = kAbsent;
  const double reach_m = std::hypot(0.5, 0.35) + 0.1;
  const Clearance found = look();
  EXPECT_EQ(text(found.unknown), "");
  EXPECT_NEAR(found.ahead_m, 2.9 - reach_m, kResolution_m + 1e-9);
  EXPECT_DOUBLE_EQ(found.back_m, found.ahead_m);
  EXPECT_EQ(found.left_rad, kEndless);
  EXPECT_EQ(found.right_rad, kEndless);
  EXPECT_THAT(text(found.first), HasSubstr("box1 is in the way, 2.1"));
  const Path path = row(20);
  on(path, 0, 0, 20);
  EXPECT_THAT(text(look(&path).unknown), HasSubstr("which way"));
}

Constraints fence(double half_m) {
  Constraints set;
  set.name = "yard";
  PositionConstraint inside;
  inside.header.frame_id = "map";
  inside.link_name = "base_link";
  inside.constraint_region.primitives = {{SolidPrimitive::BOX, {2 * half_m, 2 * half_m, 2}}};
  inside.constraint_region.primitive_poses = {{}};
  set.position_constraints = {inside};
  return set;
}

TEST_F(AKeeper, NamesTheConstraintThatDoesNotHold) {
  ASSERT_EQ(apply(fence(2)), "done");
  EXPECT_EQ(text(look().broken), "");
  from.pose.x_m = 2.5;
  EXPECT_EQ(text(look().broken),
            "constraint yard.position_constraints[0] (base_link) does not hold: 0.500 m outside of "
            "its region; take it away or push it");
  EXPECT_EQ(text(look().unknown), "");
}

/// A long name is cut, and neither what is measured nor what is allowed.
TEST_F(AKeeper, SaysWhatIsAllowedOfAConstraintWithALongName) {
  Constraints set;
  set.name = std::string(199, 'n') + "o";
  VisibilityConstraint view;
  view.target_pose.header.frame_id = view.sensor_pose.header.frame_id = "map";
  view.max_view_angle = 0.8;
  view.sensor_view_direction = VisibilityConstraint::SENSOR_Y;
  set.visibility_constraints = {view};
  ASSERT_EQ(apply(set), "done");
  EXPECT_THAT(text(look().broken), HasSubstr("90.0 deg between the view and the target's back, "
                                             "allowed 45.8; take it away or push it"));
  EXPECT_THAT(text(look().broken), HasSubstr("constraint nnnnnnnnnnnnnnnnnnnnnnnn"));
}

/// Valid, and the robot stands: mostly a name that was mistyped.
TEST_F(AKeeper, NotesAConstraintOfWhatTheRobotDoesNotHave) {
  Constraints set = fence(2);
  set.joint_constraints = {
      {"base/y", 0, 1, 1, 0}, {"nojoint", 0, 1, 1, 0}, {"arm", 0, 1, 1, 0}, {"Arm", 0, 1, 1, 0}};
  OrientationConstraint level;
  level.header.frame_id = "map";
  level.link_name = "mast";
  set.orientation_constraints = {level};
  EXPECT_EQ(
      apply(set),
      "done; joint_constraints[1].joint_name: the robot has no joint \"nojoint\": it never "
      "holds; joint_constraints[3].joint_name: the robot has no joint \"Arm\": it never holds; "
      "orientation_constraints[0].link_name: the robot has no link \"mast\": it never holds");
  set.position_constraints[0].link_name = "bucket";
  set.joint_constraints.clear();
  set.orientation_constraints.clear();
  EXPECT_EQ(apply(set),
            "done; position_constraints[0].link_name: the robot has no link \"bucket\": it never "
            "holds");
  EXPECT_EQ(apply(fence(2)), "done");
}

TEST_F(AKeeper, EndsAWayBeforeTheEdgeOfAConstraint) {
  ASSERT_EQ(apply(fence(2)), "done");
  const Clearance found = look();
  EXPECT_EQ(text(found.broken), "");
  EXPECT_NEAR(found.ahead_m, 1.9, 0.005);
  EXPECT_NEAR(found.back_m, 1.9, 0.005);
  EXPECT_EQ(found.left_rad, kEndless);
  EXPECT_EQ(text(found.first),
            "the edge of constraint yard.position_constraints[0] (base_link) is 2.00 m ahead");
  from.pose.position_sigma_m = 0.15;
  EXPECT_NEAR(look().ahead_m, 1.6, 0.02) << "twice the sigma before it";
  from.pose.position_sigma_m = 0;
  from.asked = {-0.3, 0};
  EXPECT_THAT(text(look().first), HasSubstr("2.00 m back"));
  from.asked = {0.5, 0.5};  // a circle of 1 m: it stays inside
  EXPECT_DOUBLE_EQ(look().ahead_m, 3);
}

class AKeeperOfARobotThatGoesAside : public AKeeper {
 protected:
  static KeeperSettings aside() {
    KeeperSettings settings = keeper_settings();
    settings.look.aside = true;
    return settings;
  }
  AKeeperOfARobotThatGoesAside() : AKeeper(aside()) {}
};

TEST_F(AKeeperOfARobotThatGoesAside, EndsAWayToTheSideBeforeTheEdgeOfAConstraint) {
  ASSERT_EQ(apply(fence(2)), "done");
  EXPECT_NEAR(look().aside_left_m, 1.9, 0.005);
  EXPECT_NEAR(look().aside_right_m, 1.9, 0.005);
  EXPECT_THAT(text(look().first), HasSubstr("2.00 m ahead"));
  from.asked = {0, 0, 0.3};
  EXPECT_THAT(text(look().first), HasSubstr("2.00 m to the left"));
  from.commanded = {0, 0, -0.3};
  EXPECT_THAT(text(look().first), HasSubstr("2.00 m to the right"));
}

TEST_F(AKeeper, ComesNoFartherThanTheEdgeAndMayGoBack) {
  ASSERT_EQ(apply(fence(2)), "done");
  double before_m = 3;
  for (from.pose.x_m = 0; from.pose.x_m < 2; from.pose.x_m += 0.013) {
    const Clearance found = look();
    EXPECT_NEAR(found.ahead_m, std::max(1.9 - from.pose.x_m, 0.0), 0.005);
    EXPECT_LE(found.ahead_m, before_m) << "no jump back";
    EXPECT_GT(found.back_m, 1.8);
    before_m = found.ahead_m;
  }
  from.pose.y_m = 1.97;
  from.pose.x_m = 0;
  EXPECT_NEAR(look().ahead_m, 1.9, 0.005) << "along the edge";
}

TEST_F(AKeeper, EndsATrackBeforeTheEdgeOfAConstraintThatCameLater) {
  const Path path = row(20);
  on(path, 0, 0, 20);
  ASSERT_EQ(apply(fence(2)), "done");
  EXPECT_NEAR(look(&path).along_m, 1.9, 0.005);
  EXPECT_THAT(text(look(&path).first), HasSubstr("2.00 m along the track"));
  EXPECT_DOUBLE_EQ(look(&path).ahead_m, 3) << "what is behind a goal does not slow a task";
  on(path, 0, 0, 1);
  EXPECT_EQ(look(&path).along_m, kEndless) << "it ends before";
}

TEST_F(AKeeper, EndsATurnBeforeTheEdgeOfAConstraint) {
  Constraints set;
  set.name = "row";
  set.joint_constraints = {{"base/theta", 0, 0.5, 1, 0}, {"base/x", 0, 1, 1, 0}};
  ASSERT_EQ(apply(set), "done");
  const Clearance found = look();
  EXPECT_NEAR(found.left_rad, 0.45, 0.005);
  EXPECT_NEAR(found.right_rad, 0.95, 0.005);
  EXPECT_NEAR(found.ahead_m, 0.9, 0.005);
  from.asked = {0, 0.5};
  EXPECT_EQ(text(look().turn),
            "the edge of constraint row.joint_constraints[0] (base/theta) is after 29 deg of the "
            "turn to the left");
  EXPECT_EQ(text(look().first), text(look().turn)) << "what is ahead hinders no turn";
  from.asked = {0, -0.5};
  EXPECT_THAT(text(look().first), HasSubstr("is after 57 deg of the turn to the right"));
}

TEST_F(AKeeper, EndsAWayAtTheNearerOfTwoEdgesWhicheverIsToldFirst) {
  from.pose.x_m = -10;
  const JointConstraint nearer{"base/x", 0, 100, 12.00, 0};
  const JointConstraint farther{"base/x", 0, 100, 12.06, 0};
  Constraints set;
  set.name = "row";
  set.joint_constraints = {farther, nearer};
  ASSERT_EQ(apply(set), "done");
  from.asked = {-0.3, 0};
  EXPECT_NEAR(look().back_m, 1.9, 0.005);
  EXPECT_THAT(text(look().first), HasSubstr("joint_constraints[1]"));
  set.joint_constraints = {nearer, farther};
  ASSERT_EQ(apply(set), "done");
  EXPECT_NEAR(look().back_m, 1.9, 0.005);
  EXPECT_THAT(text(look().first), HasSubstr("joint_constraints[0]"));
}

/// Nothing came nearer when the position is not known as well as it was.
TEST_F(AKeeper, SaysWhatTheMarginAloneLeavesBeforeAnEdge) {
  ASSERT_EQ(apply(fence(2)), "done");
  from.pose.position_sigma_m = 0.15;
  Clearance found = look();
  EXPECT_NEAR(found.ahead_m, 1.6, 0.02);
  EXPECT_NEAR(found.bare.ahead_m, 1.9, 0.005);
  EXPECT_NEAR(found.bare.back_m, 1.9, 0.005);
  const Path path = row(20);
  on(path, 0, 0, 20);
  found = look(&path);
  EXPECT_NEAR(found.along_m, 1.6, 0.02);
  EXPECT_NEAR(found.bare.along_m, 1.9, 0.005);
}

TEST_F(AKeeper, LeavesWhatIsBrokenToThatWhichTellsIt) {
  ASSERT_EQ(apply(fence(2)), "done");
  from.pose.x_m = 2.5;
  EXPECT_DOUBLE_EQ(look().ahead_m, 3);
  EXPECT_EQ(text(look().first), "");
  EXPECT_NE(text(look().broken), "");
}

TEST_F(AKeeper, SaysTheWayOutHoweverLongTheNamesAre) {
  Constraints set = fence(2);
  set.name = std::string(200, 'y');
  ASSERT_EQ(apply(set), "done");
  from.pose.x_m = 2.5;
  EXPECT_THAT(text(look().broken), testing::EndsWith("; take it away or push it"));
}

TEST_F(AKeeper, TakesTwiceThePositionsSigmaForAConstraintsMargin) {
  ASSERT_EQ(apply(fence(2)), "done");
  from.pose.x_m = 1.8;
  EXPECT_EQ(text(look().broken), "");
  from.pose.position_sigma_m = 0.15;
  EXPECT_THAT(text(look().broken), HasSubstr("0.1"));
}

TEST_F(AKeeper, TakesTwiceTheHeadingsSigmaForAConstraintOnWhatIsFarFromItsMiddle) {
  Constraints set = fence(2);
  ASSERT_EQ(apply(set), "done");
  from.pose.x_m = 1.8;
  from.pose.yaw_sigma_rad = 0.1;
  EXPECT_EQ(text(look().broken), "") << "its middle does not move by it";
  from.pose.x_m = 0.9;
  set.position_constraints[0].target_point_offset = {1, 0, 0};
  ASSERT_EQ(apply(set), "done");
  EXPECT_THAT(text(look().broken), HasSubstr("0.10")) << "1 m away: 0.2 m";
  from.pose.yaw_sigma_rad = 0.04;
  EXPECT_EQ(text(look().broken), "");
}

TEST_F(AKeeper, JudgesTheTiltThatIsMeasuredAndNoOther) {
  Constraints set;
  set.name = "level";
  OrientationConstraint level;
  level.header.frame_id = "map";
  level.link_name = "base_link";
  level.absolute_x_axis_tolerance = level.absolute_y_axis_tolerance = 0.2;
  level.absolute_z_axis_tolerance = 4;
  set.orientation_constraints = {level};
  ASSERT_EQ(apply(set), "done");
  EXPECT_THAT(text(look().broken), HasSubstr("roll and pitch are not measured"));
  from.roll_rad = from.pitch_rad = 0.05;
  EXPECT_EQ(text(look().broken), "");
  from.pitch_rad = 0.3;
  EXPECT_THAT(text(look().broken), HasSubstr("level.orientation_constraints[0]"));
}

TEST_F(AKeeper, KnowsJointsByTheirNames) {
  Constraints set;
  set.name = "arm";
  set.joint_constraints = {{"arm", 0, 0.5, 0.5, 0}, {"left", 0, 0.5, 0.5, 9}};
  ASSERT_EQ(apply(set), "done");
  EXPECT_THAT(text(look().broken), HasSubstr("its position is not known"));
  from.joint_rad.resize(3);
  EXPECT_EQ(text(look().broken), "");
  from.joint_rad[2] = 0.7;
  EXPECT_THAT(text(look().broken), HasSubstr("arm.joint_constraints[0] (arm)"));
  from.joint_rad[0] = 0.6;
  EXPECT_THAT(text(look().broken), HasSubstr("(left)")) << "it weighs more";
}

sensor::FieldView seen_at(double free_m) {
  sensor::FieldView view;
  view.field.blocked = true;
  view.field.unknown = false;
  view.field.free_m = free_m;
  return view;
}

TEST_F(AKeeper, IsStoppedByWhatAScannerSees) {
  keeper.set_sensors(seen_at(1.5));
  EXPECT_DOUBLE_EQ(look().ahead_m, 1.4);
  EXPECT_DOUBLE_EQ(look().back_m, 3);
  keeper.set_sensors(sensor::view({}, from.t));
  EXPECT_THAT(text(look().unknown), HasSubstr("scanner"));
  EXPECT_EQ(look().back_m, 0);
  keeper.set_sensors(std::nullopt);
  EXPECT_DOUBLE_EQ(look().ahead_m, 3);
}

TEST_F(AKeeper, TakesOffWhatItDroveSinceTheScannerSaw) {
  sensor::FieldView view = seen_at(1.5);
  view.since = from.t - std::chrono::milliseconds(200);
  keeper.set_sensors(view);
  from.commanded = {0.5, 0};
  EXPECT_DOUBLE_EQ(look().ahead_m, 1.3);
  from.pose.vx_mps = 0.8;  // it is faster still
  EXPECT_DOUBLE_EQ(look().ahead_m, 1.24);
  from.pose.vx_mps = -0.5;
  from.commanded = {-0.5, 0};
  EXPECT_DOUBLE_EQ(look().ahead_m, 1.4);
}

TEST_F(AKeeper, BoundsATrackByAScannerOnlyWhereItGoesOnAhead) {
  Path path;
  path.number = 3;
  path.points = {{-5, 0}, {0, 0}, {0, 5}};
  keeper.set_sensors(seen_at(1.5));
  on(path, 0, 3, 2);
  from.pose.x_m = -2;
  EXPECT_DOUBLE_EQ(look(&path).along_m, 1.4);
  // At the corner it turns on the spot, away from what it sees.
  from.pose.x_m = 0;
  on(path, 1, 0, 2);
  EXPECT_EQ(look(&path).along_m, kEndless);
  EXPECT_DOUBLE_EQ(look(&path).ahead_m, 1.4);
}

/// The field sweeps over what stands inside the corner, or behind it.
TEST_F(AKeeper, DoesNotEndATrackByWhatItsFieldSweepsOverInATurn) {
  Path path;
  path.number = 3;
  path.points = {{-5, 0}, {0, 0}, {0, 5}};
  keeper.set_sensors(seen_at(0.1));
  for (const double before_m : {0.1, 0.0, -0.1}) {
    // The tracker's place does not go on while it turns.
    on(path, before_m > 0 ? 0 : 1, before_m > 0 ? 5 - before_m : -before_m, 2);
    from.pose.x_m = -before_m;
    from.commanded = from.asked = {0, 0.5};
    for (const double turned_deg : {0.0, 20.0, 45.0, 60.0, 80.0}) {
      from.pose.yaw_rad = to_rad(turned_deg);
      EXPECT_EQ(look(&path).along_m, kEndless) << before_m << " m, " << turned_deg;
    }
    from.pose.yaw_rad = to_rad(88);
    EXPECT_EQ(look(&path).along_m, 0) << "what it sees now is on its track";
  }
  from.commanded = from.asked = {};
  EXPECT_EQ(look(&path).along_m, 0);
}

TEST_F(AKeeper, EndsATrackByWhatIsSeenForOneWhoOnlySteers) {
  const Path path = row(5);
  keeper.set_sensors(seen_at(1.5));
  on(path, 0, 1, 5);
  from.pose.x_m = 1;
  from.pose.yaw_rad = to_rad(40);
  from.commanded = {0.3, -0.4};
  EXPECT_LT(look(&path).along_m, 1.5);
}

TEST_F(AKeeper, TakesOffWhatItDroveSinceTheScannerSawThoughItIsSlowNow) {
  sensor::FieldView view = seen_at(1.5);
  view.since = from.t + std::chrono::milliseconds(500);
  for (int i = 0; i <= 40; ++i) {
    from.pose.vx_mps = i < 36 ? 0.8 : 0.0;
    keeper.see(from);
    from.t += std::chrono::milliseconds(25);
  }
  from.t -= std::chrono::milliseconds(25);
  keeper.set_sensors(view);
  EXPECT_LE(keeper.look(nullptr).ahead_m, 1.4 - 0.375 * 0.8);
  EXPECT_GE(keeper.look(nullptr).ahead_m, 1.4 - 0.42 * 0.8);
}

}  // namespace
}  // namespace drover::scene
