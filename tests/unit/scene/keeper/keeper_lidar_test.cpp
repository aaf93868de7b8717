// What scanners see close to a robot with a Keeper bounds turns, and tracks that bend into it.
#include "tests/unit/scene/keeper/fixture.h"
#include "tests/unit/scene/sensor/turns.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;

sensor::FieldView seen_free() {
  sensor::FieldView view;
  view.field.unknown = false;
  view.field.free_m = 2;
  return view;
}

/// With its scanner at the front, blind behind.
class AKeeperWithALidar : public AKeeper {
 protected:
  AKeeperWithALidar() {
    world.mount = {0.5, 0, 0.3, 0};
    world.blind_rad = kPi / 2;
    keeper.set_sensors(seen_free());
  }
  void run(double seconds, const Twist& twist) {
    for (int i = 0; i < static_cast<int>(seconds / 0.05 + 0.5); ++i) {
      from.t += std::chrono::milliseconds(50);
      const double turn_rad = 0.05 * twist.wz_radps;
      const Point2 ahead = direction(at.yaw_rad + turn_rad / 2);
      at = {at.x_m + 0.05 * twist.vx_mps * ahead.x_m, at.y_m + 0.05 * twist.vx_mps * ahead.y_m,
            at.yaw_rad + turn_rad};
      from.pose.x_m = at.x_m;
      from.pose.y_m = at.y_m;
      from.pose.yaw_rad = at.yaw_rad;
      from.pose.vx_mps = from.commanded.vx_mps = twist.vx_mps;
      from.pose.wz_radps = from.commanded.wz_radps = twist.wz_radps;
      keeper.see(from);
      if (i % 2 == 1) keeper.see_turn(0, world.turn(at, from.t, twist));
    }
  }

  sensor::World world;
  Pose2 at;
};

TEST_F(AKeeperWithALidar, TurnsNotIntoWhatItSees) {
  world.boxes = {{{0.5, 0.72}}};
  run(0.5, {});
  from.commanded = from.asked = {0, 0.5};
  const Clearance found = look();
  EXPECT_LT(found.left_rad, to_rad(20));
  EXPECT_GT(found.right_rad, to_rad(60));
  EXPECT_EQ(found.ahead_m, 3);
  EXPECT_THAT(text(found.first),
              HasSubstr("lidar sees something in the way of the turn to the left"));
}

TEST_F(AKeeperWithALidar, TurnsNotIntoWhatItSawBesideItsWay) {
  world.boxes = {{{1.5, 0.8}}};
  run(2.5, {0.6, 0});  // to 1.5 m: it is beside it, where nothing is seen
  run(0.3, {});
  from.asked = {0, 0.5};
  EXPECT_LT(look().left_rad, to_rad(45));
  EXPECT_LT(look().right_rad, to_rad(45));
  EXPECT_THAT(text(look().first), HasSubstr("lidar saw something in the way of the turn"));
  run(5, {});
  EXPECT_LT(look().left_rad, to_rad(45)) << "it may be there still";
}

TEST_F(AKeeperWithALidar, TurnsWhereItSawNothingAndSeesNothing) {
  run(2.5, {0.6, 0});
  EXPECT_EQ(look().left_rad, kEndless);
}

/// Neither needs what is seen from the robot a place of it, nor a heading.
TEST_F(AKeeperWithALidar, TurnsNotIntoWhatItSeesWhereverItIs) {
  from.pose.position_sigma_m = from.pose.yaw_sigma_rad = kAbsent;
  world.boxes = {{{0.5, 0.72}}};
  run(0.5, {});
  EXPECT_LT(look().left_rad, to_rad(20));
}

/// Its field is free, and its curve goes straight on; the track bends into what stands beside.
TEST_F(AKeeperWithALidar, DrivesNotAlongATrackIntoWhatItSees) {
  world.boxes = {{{1.0, 0.65}, 0.1}};
  run(0.5, {});
  from.commanded = from.asked = {0.3, 0};
  Path path;
  path.number = 3;
  path.points = {{0, 0}, {0.3, 0}, {0.6, 0.1}, {1.0, 0.4}, {1.4, 0.8}};
  on(path, 0, 0, 4);
  const Clearance found = look(&path);
  EXPECT_EQ(found.ahead_m, 3);
  EXPECT_GT(found.along_m, 0.05);
  EXPECT_LT(found.along_m, 0.6);
  EXPECT_EQ(found.bare.along_m, found.along_m);
  EXPECT_THAT(text(found.first), HasSubstr("lidar sees something, 0."));
  EXPECT_THAT(text(found.first), HasSubstr("m along the track"));
  const Path straight = row(20);
  on(straight, 0, 0, 4);
  EXPECT_EQ(look(&straight).along_m, kEndless);
}

TEST_F(AKeeperWithALidar, FollowsNoJumpOfThePosition) {
  world.boxes = {{{1.5, 0.8}}};
  run(2.5, {0.6, 0});
  const double left_rad = look().left_rad;
  from.pose.x_m += 3;
  ++from.place;
  EXPECT_EQ(look().left_rad, left_rad);
}

TEST_F(AKeeperWithALidar, WithoutScannersLooksAtNoneOfTheirPoints) {
  world.boxes = {{{0.5, 0.72}}};
  run(0.5, {});
  keeper.set_sensors(std::nullopt);
  EXPECT_EQ(look().left_rad, kEndless);
}

}  // namespace
}  // namespace drover::scene
