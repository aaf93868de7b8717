// Messages in any order, good and bad: what is refused changes nothing, and what is kept is finite.
#include <gtest/gtest.h>

#include <random>

#include "scene/world/rigid.h"
#include "unit/scene/world/yard.h"

namespace drover::scene {
namespace {

using yard::Yard;

class AnyMessage {
 public:
  explicit AnyMessage(unsigned seed) : random_(seed) {}

  CollisionObject next() {
    CollisionObject message;
    message.id = pick<const char*>({"a", "b", "c", "d", "a", "b", "c", ""});
    message.operation = static_cast<std::uint8_t>(number(0, 4));
    message.header.frame_id =
        pick<const char*>({"map", "map", "map", "1", "base_link", "lidar", "0", "x"});
    if (number(0, 3) == 0) message.header.stamp = yard::stamp_s(pick({95.0, 99.5, 100.3, 102.0}));
    const bool geometry = message.operation != CollisionObject::MOVE || number(0, 5) == 0;
    if (geometry) {
      message.primitives.assign(number(0, 2), yard::box(1, 1, 1));
      message.meshes.assign(number(0, 1), yard::mesh(number(1, 3)));
      message.planes.assign(number(0, 1), Plane{{0, 0, 1, 0}});
    }
    message.primitive_poses = poses(number(0, 2));
    message.mesh_poses = poses(number(0, 1));
    message.plane_poses = poses(number(0, 1));
    return message;
  }
  std::size_t number(int least, int most) {
    return std::uniform_int_distribution<std::size_t>(least, most)(random_);
  }

 private:
  template <class T>
  T pick(std::initializer_list<T> from) {
    return *(from.begin() + number(0, static_cast<int>(from.size()) - 1));
  }
  std::vector<Pose> poses(std::size_t count) {
    std::vector<Pose> all(count);
    for (Pose& pose : all) {
      pose = yard::at(double(number(0, 100)), double(number(0, 100)), 0.5, double(number(0, 6)));
      if (number(0, 20) == 0) pose.position_m.x = pick({kAbsent, 1e9, -1e300});
      if (number(0, 20) == 0) pose.orientation = {0, 0, 0, 0};
    }
    return all;
  }

  std::mt19937 random_;
};

void expect_sound(const World& world) {
  Amount all;
  for (const Object& object : world.objects()) all = sum(all, amount_of(object));
  EXPECT_EQ(world.amount(), all) << "it is reckoned along with each message";
  for (const Object& object : world.objects()) {
    EXPECT_GT(amount_of(object).shapes, 0U);
    EXPECT_FALSE(object.id.empty());
    EXPECT_LE(object.revision, world.revision());
    EXPECT_EQ(world.object(object.id), &object);
    const CollisionObject message = as_message(object);
    for (const auto* poses :
         {&message.primitive_poses, &message.mesh_poses, &message.plane_poses}) {
      for (const Pose& pose : *poses) {
        EXPECT_TRUE(rigid::is_finite(pose));
        const Quaternion& q = pose.orientation;
        EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1, 1e-9);
      }
    }
  }
}

TEST(World, TakesAnyMessagesInAnyOrder) {
  AnyMessage any(11);
  Yard yard;
  yard.drive(1, 1);
  int done = 0;
  for (int i = 0; i < 5000; ++i) {
    const CollisionObject message = any.next();
    const std::uint64_t revision = yard.world.revision();
    const std::size_t shapes = yard.world.amount().shapes;
    const auto applied = yard.world.apply(message, yard.placement());
    if (applied) {
      ++done;
      EXPECT_EQ(applied->revision, yard.world.revision());
      EXPECT_GT(yard.world.revision(), revision);
    } else {
      EXPECT_EQ(yard.world.revision(), revision);
      EXPECT_EQ(yard.world.amount().shapes, shapes);
      EXPECT_FALSE(applied.error().why.empty());
    }
    if (any.number(0, 50) == 0)
      yard.world.move_origin({48 + 0.001 * double(any.number(0, 9)), 11, 500});
    if (i % 10 == 0) expect_sound(yard.world);
  }
  EXPECT_GT(done, 500);
  EXPECT_LT(done, 4500);
}

}  // namespace
}  // namespace drover::scene
