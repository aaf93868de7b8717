// A keeper whose robot does not know where it looks: what is on its place only is judged all the
// same, and its heading may be searched for.
#include "tests/unit/scene/keeper/fixture.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;

class AKeeperWithoutAHeading : public AKeeper {
 protected:
  AKeeperWithoutAHeading() { from.pose.yaw_sigma_rad = kAbsent; }

  /// Of 40 m and 40 m about the map's origin.
  static Constraints yard() {
    Constraints set;
    set.name = "yard";
    PositionConstraint inside;
    inside.header.frame_id = "map";
    inside.link_name = "base_link";
    inside.constraint_region.primitives = {{SolidPrimitive::BOX, {40, 40, 4}}};
    inside.constraint_region.primitive_poses = {{}};
    set.position_constraints = {inside};
    return set;
  }
};

TEST_F(AKeeperWithoutAHeading, MaySearchForItInAYard) {
  ASSERT_EQ(apply(yard()), "done");
  const Clearance found = look();
  EXPECT_EQ(text(found.unknown), "");
  EXPECT_EQ(text(found.broken), "");
  EXPECT_DOUBLE_EQ(found.ahead_m, 3);
  EXPECT_EQ(found.left_rad, kEndless);
  EXPECT_EQ(text(found.first), "");
}

TEST_F(AKeeperWithoutAHeading, MaySearchForItOnlyWithinTheEdgeWhicheverWayThatIs) {
  ASSERT_EQ(apply(yard()), "done");
  for (const Point2 at : {Point2{18.5, 0}, Point2{-18.5, 7}, Point2{0, 18.5}, Point2{3, -18.5}}) {
    from.pose.x_m = at.x_m;
    from.pose.y_m = at.y_m;
    const Clearance found = look();
    EXPECT_EQ(text(found.broken), "");
    EXPECT_LE(found.ahead_m, 1.4);
    EXPECT_GE(found.ahead_m, 1.5 * 0.98 - 0.1 - 0.002) << "a circle is taken 2 % too wide";
    EXPECT_DOUBLE_EQ(found.back_m, found.ahead_m);
    EXPECT_LE(found.bare.ahead_m, found.ahead_m);
    EXPECT_EQ(found.right_rad, kEndless);
    EXPECT_THAT(text(found.first),
                testing::StartsWith("the edge of constraint yard.position_constraints[0] "
                                    "(base_link) is 1.4"));
  }
}

TEST_F(AKeeperWithoutAHeading, MaySearchForItWithinTheLimitsOfItsPlace) {
  Constraints set;
  set.name = "row";
  set.joint_constraints = {{"base/y", 0, 1, 1, 0}};
  ASSERT_EQ(apply(set), "done");
  from.pose.y_m = -0.5;
  const Clearance found = look();
  EXPECT_EQ(text(found.broken), "");
  EXPECT_LE(found.ahead_m, 0.4);
  EXPECT_GE(found.ahead_m, 0.5 * 0.98 - 0.1 - 0.002);
  from.pose.y_m = -1.5;
  EXPECT_THAT(text(look().broken), HasSubstr("does not hold"));
}

TEST_F(AKeeperWithoutAHeading, IsHeldWhereAPointOfItMayBeOutside) {
  Constraints set = yard();
  set.position_constraints[0].target_point_offset = {2, 0, 0};
  ASSERT_EQ(apply(set), "done");
  EXPECT_EQ(text(look().broken), "");
  from.pose.y_m = 19;
  EXPECT_THAT(text(look().broken), HasSubstr("does not hold: 1.0"));
  EXPECT_THAT(text(look().broken), HasSubstr("with no heading"));
  from.pose.yaw_sigma_rad = 0;
  EXPECT_EQ(text(look().broken), "");
}

TEST_F(AKeeperWithoutAHeading, StaysInTheYardWhenTheOriginMoves) {
  ASSERT_EQ(apply(yard()), "done");
  from.origin.latitude_deg += 0.001;  // 111 m
  ++from.place;
  from.pose.y_m -= 111.2;
  EXPECT_EQ(text(look().broken), "");
  from.pose.y_m += 30;
  EXPECT_THAT(text(look().broken), HasSubstr("does not hold: "));
}

TEST_F(AKeeperWithoutAHeading, IsToldWhatIsMissingAndNotToPushIt) {
  Constraints set;
  set.name = "north";
  set.joint_constraints = {{"base/theta", 0, 1, 1, 0}};
  ASSERT_EQ(apply(set), "done");
  EXPECT_EQ(text(look().broken),
            "constraint north.joint_constraints[0] (base/theta) cannot be judged: the robot's "
            "heading is not known; take it away");
}

}  // namespace
}  // namespace drover::scene
