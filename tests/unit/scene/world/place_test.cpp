// Objects in frames of the robot: where it was at their stamp.
#include "scene/world/place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/scene/world/yard.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;
using yard::add_box;
using yard::at;
using yard::expect_at;
using yard::stamp_s;
using yard::Yard;

CollisionObject seen(double monotonic_s, const std::string& frame = "base_link") {
  CollisionObject message = add_box("box1", at(2, 0, 0.3), frame);
  message.header.stamp = stamp_s(monotonic_s);
  return message;
}

TEST(Place, AnObjectInBaseLinkIsWhereTheRobotWasAtItsStamp) {
  Yard yard;
  yard.drive(1, 1, {10, 5, kPi / 2});  // now at y = 6
  EXPECT_EQ(yard.apply(seen(100.5)), "added");
  expect_at(yard.place_of("box1"), 10, 7.5, 0.3, 1e-6);
}

TEST(Place, AStampOfZeroMeansNow) {
  Yard yard;
  yard.drive(1, 1, {10, 5, kPi / 2});
  CollisionObject message = seen(0);
  message.header.stamp = {};
  EXPECT_EQ(yard.apply(message), "added");
  expect_at(yard.place_of("box1"), 10, 8, 0.3);
}

TEST(Place, AnObjectInBaseLinkDoesNotRideAlong) {
  Yard yard;
  yard.drive(1, 1);
  yard.apply(seen(101));
  const Vector3 before = yard.place_of("box1");
  for (int i = 1; i < 100; ++i) yard.poses.add(Time{from_s(101 + i * 0.05)}, {1 + i * 0.05, 0, 0});
  yard.apply(add_box("box2", at(0, 0)));
  expect_at(yard.place_of("box1"), before.x, before.y, before.z);
  expect_at(before, 3, 0, 0.3);
}

TEST(Place, ASensorIsWhereItIsMounted) {
  Yard yard;  // the lidar: half a metre ahead, 0.3 m up, looks to the left
  yard.drive(1, 0, {10, 5, 0});
  EXPECT_EQ(yard.apply(seen(101, "lidar")), "added");
  expect_at(yard.place_of("box1"), 10.5, 7, 0.6);
  EXPECT_EQ(yard.apply(seen(101, "/lidar")), "replaced");
}

TEST(Place, AnObjectOfFiveSecondsAgoIsRefused) {
  Yard yard;
  yard.drive(10, 1);
  EXPECT_EQ(yard.apply(seen(105)),
            "header.stamp: stamped 5.0 s ago, the history reaches back 2.0 s");
  EXPECT_TRUE(yard.world.objects().empty());
}

TEST(Place, InMapTheStampSaysNothing) {
  Yard yard;
  CollisionObject message = add_box("box1", at(2, 0));
  for (const double monotonic_s : {95.0, 100.0, 1e6}) {
    message.header.stamp = stamp_s(monotonic_s);
    EXPECT_NE(yard.world.apply(message, yard.placement()).ok(), false);
  }
}

TEST(Place, AStampFromAClockAheadIsRefused) {
  Yard yard;
  yard.drive(1, 1);
  EXPECT_THAT(yard.apply(seen(103)), HasSubstr("stamped 2.0 s ahead of the robot's clock"));
}

TEST(Place, WithoutAPlaceOfTheRobotItsFramesPlaceNothing) {
  Yard yard;
  EXPECT_THAT(yard.apply(seen(100)), HasSubstr("the robot's place is not known"));
  EXPECT_THAT(yard.apply(add_box("box1", at(1, 1))), "added");
}

TEST(Place, APlaceThatWasLostIsNoPlaceOfNow) {
  Yard yard;
  yard.drive(1, 1);
  yard.now_s += 3;
  CollisionObject message = seen(0);
  message.header.stamp = {};
  EXPECT_THAT(yard.apply(message), HasSubstr("the robot's place is not known since 3.0 s"));
}

TEST(Place, OfAMessageThatABrokerHeldBackIsNotThatOfNow) {
  Yard yard;
  yard.drive(1, 1);
  yard.late = "the broker was late just now; try again";
  CollisionObject message = seen(0);
  message.header.stamp = {};
  EXPECT_EQ(yard.apply(message),
            "header.stamp: 0 means now, but this may be older: the broker was late just now; try "
            "again");
  EXPECT_TRUE(yard.world.objects().empty());
  EXPECT_EQ(yard.apply(seen(100.5)), "added") << "placed by its stamp as ever";
  expect_at(yard.place_of("box1"), 2.5, 0, 0.3, 1e-6);
  EXPECT_THAT(yard.apply(seen(97)), HasSubstr("the history reaches back"));
}

TEST(Place, OfALateMessageInMapIsTaken) {
  Yard yard;
  yard.late = "the broker was late just now; try again";
  EXPECT_EQ(yard.apply(add_box("box1", at(2, 0))), "added");
  EXPECT_EQ(yard.apply(add_box("box1", at(3, 0), "1")), "replaced");
  CollisionObject move = yard::only(CollisionObject::MOVE, "box1");
  move.primitive_poses = {at(7, 8)};
  EXPECT_EQ(yard.apply(move), "moved");
  EXPECT_EQ(yard.apply(yard::only(CollisionObject::REMOVE, "box1")), "removed");
}

TEST(PoseHistory, KnowsAPlaceBetweenTwoAsWellAsTheWorseOfBoth) {
  PoseHistory poses;
  poses.add(Time{from_s(1.0)}, {0, 0, 0}, 0.05, 0.03);
  poses.add(Time{from_s(1.2)}, {2, 0, 0}, 0.1, 0.01);
  const Time now{from_s(1.2)};
  EXPECT_EQ(poses.at(Time{from_s(1.1)}, now)->position_sigma_m, 0.1);
  EXPECT_EQ(poses.at(Time{from_s(1.1)}, now)->yaw_sigma_rad, 0.03);
  EXPECT_EQ(poses.at(now, now)->yaw_sigma_rad, 0.01);
}

TEST(PoseHistory, TurnsTheShorterWay) {
  PoseHistory poses;
  poses.add(Time{from_s(1.0)}, {0, 0, kPi - 0.1});
  poses.add(Time{from_s(1.2)}, {2, 0, -kPi + 0.1});
  const auto pose = poses.at(Time{from_s(1.1)}, Time{from_s(1.2)});
  ASSERT_TRUE(pose.ok());
  EXPECT_NEAR(std::abs(pose->pose.yaw_rad), kPi, 1e-9);
  EXPECT_NEAR(pose->pose.x_m, 1, 1e-9);
}

TEST(PoseHistory, ReachesBackTwoSecondsAtAnyRate) {
  for (const double step_s : {0.001, 0.005, 0.05, 0.2}) {
    PoseHistory poses;
    double t_s = 10;
    for (; t_s < 15; t_s += step_s) poses.add(Time{from_s(t_s)}, {t_s, 0, 0});
    const Time arrived{from_s(t_s)};
    const auto pose = poses.at(arrived - std::chrono::milliseconds(1790), arrived);
    ASSERT_TRUE(pose.ok()) << step_s << ": " << pose.error();
    EXPECT_NEAR(pose->pose.x_m, t_s - 1.79, 1e-6) << step_s;
    EXPECT_FALSE(poses.at(arrived - std::chrono::milliseconds(2210), arrived).ok()) << step_s;
  }
}

TEST(PoseHistory, DoesNotGuessWhatWasBetweenTwoPlacesAfterAPause) {
  PoseHistory poses;
  poses.add(Time{from_s(1.0)}, {0, 0, 0});
  poses.add(Time{from_s(1.5)}, {9, 0, 0});
  const auto pose = poses.at(Time{from_s(1.2)}, Time{from_s(1.5)});
  ASSERT_FALSE(pose.ok());
  EXPECT_THAT(pose.error(), HasSubstr("was not known when it was stamped, 0.3 s ago"));
  EXPECT_TRUE(poses.at(Time{from_s(1.0)}, Time{from_s(1.5)}).ok());
  EXPECT_TRUE(poses.at(Time{from_s(1.5)}, Time{from_s(1.5)}).ok());
}

TEST(PoseHistory, LeavesOutWhatIsNoPlace) {
  PoseHistory poses;
  poses.add(Time{from_s(1.0)}, {kAbsent, 0, 0});
  EXPECT_FALSE(poses.at(Time{from_s(1.0)}, Time{from_s(1.0)}).ok());
  poses.add(Time{from_s(1.0)}, {1, 0, 0});
  poses.add(Time{from_s(0.5)}, {2, 0, 0});
  ASSERT_TRUE(poses.at(Time{from_s(1.0)}, Time{from_s(1.0)}).ok());
  EXPECT_EQ(poses.at(Time{from_s(1.0)}, Time{from_s(1.0)})->pose.x_m, 1);
}

}  // namespace
}  // namespace drover::scene
