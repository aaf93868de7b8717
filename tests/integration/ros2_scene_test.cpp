// A ROS 2 user who puts things around the robot: moveit_msgs by DDS, the field robot with a scene.
#include <moveit_msgs.h>

#include <cmath>

#include "integration/ros2_drive_rig.h"
#include "ros2/arena.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kAScene = R"("scene": {
  "footprint": [{"x_m": 0.45, "y_m": 0.35}, {"x_m": -0.415, "y_m": 0.35},
                {"x_m": -0.415, "y_m": -0.35}, {"x_m": 0.45, "y_m": -0.35}],
  "ground_clearance_m": 0.05, "height_m": 1})";

class SceneOfARos2User : public MovedFromRos2 {
 protected:
  SceneOfARos2User() : MovedFromRos2(R"("collision_object": true, "cmd_vel": "twist")") {
    add_section(kAScene);
  }
  /// A box of 0.4 x 2 x 1 m on the ground, `ahead_m` of the frame's origin.
  void put_box(dds_entity_t by, const char* id, const char* frame, double ahead_m) {
    ros2::Arena arena;
    moveit_msgs_msg_dds__CollisionObject_ object{};
    object.header_.frame_id_ = arena.text(frame);
    object.pose_.position_ = {ahead_m, 0, 0.5};
    object.pose_.orientation_.w_ = 1;
    object.id_ = arena.text(id);
    object.type_ = {arena.text(""), arena.text("")};
    auto* box = arena.fill(object.primitives_, 1);
    box->type_ = 1;
    auto* size = arena.fill(box->dimensions_, 3);
    size[0] = 0.4;
    size[1] = 2;
    size[2] = 1;
    dds_write(by, &object);
  }
  bool shows(std::string_view text) {
    return drover({"scene", "list"}).text.find(text) != std::string::npos;
  }
  std::string state() { return drover({"status", "--json"}).text; }
  bool journal_has(std::string_view text) {
    return program_.output().find(text) != std::string::npos;
  }
};

TEST_F(SceneOfARos2User, HasItsObjectsAndRefusesByField) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::collision_object_kind()));
  EXPECT_TRUE(journal_has("may put things around this robot")) << program_.output();
  put_box(writer_, "crate", "base_link", 3);
  ASSERT_TRUE(wait_until([this] { return shows("crate"); })) << program_.output() << state();
  put_box(writer_, "lost", "somewhere", 3);
  ASSERT_TRUE(wait_until([this] { return journal_has("/collision_object 'lost' refused: "); }))
      << program_.output();
  EXPECT_TRUE(journal_has("unknown frame")) << program_.output();
  put_box(writer_, "nowhere", "map", NAN);
  ASSERT_TRUE(wait_until([this] {
    return journal_has("/collision_object 'nowhere' refused: pose.position.x: is no finite number");
  })) << program_.output();
  EXPECT_FALSE(shows("lost"));
  EXPECT_FALSE(shows("nowhere"));
  EXPECT_THAT(state(), AllOf(HasSubstr("\"done\":1"), HasSubstr("is no finite number")));
  // An input that is closed has no reader.
  const dds_entity_t closed = writer(ros2::planning_constraints_kind());
  std::this_thread::sleep_for(1s);
  dds_publication_matched_status_t matched{};
  (void)dds_get_publication_matched_status(closed, &matched);
  EXPECT_EQ(matched.current_count, 0U);
}

TEST_F(SceneOfARos2User, KeepsWhatIsSaidOnceWhileItsProgramIsNotFollowedYet) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::collision_object_kind()));
  const auto met = [this] {
    dds_publication_matched_status_t matched{};
    (void)dds_get_publication_matched_status(writer_, &matched);
    return matched.total_count;
  };
  const auto before = met();
  program_.signal(SIGKILL);
  (void)program_.wait(5s);
  start_program();
  ASSERT_TRUE(wait_until([&] { return met() > before; })) << program_.output();
  // droverd keeps to the one before it for three seconds.
  put_box(writer_, "crate", "map", 3);
  EXPECT_TRUE(wait_until([this] { return shows("crate"); })) << program_.output() << state();
}

TEST_F(SceneOfARos2User, IsNotDrivenIntoItsObject) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::cmd_vel_kind(false)));
  const dds_entity_t objects = writer(ros2::collision_object_kind());
  ASSERT_TRUE(is_heard(objects));
  const auto say = [this](double vx_mps) {
    geometry_msgs_msg_dds__Twist_ twist{};
    twist.linear_.x_ = vx_mps;
    dds_write(writer_, &twist);
  };
  const auto drive = [&] {
    const double begin_s = now_s();
    return repeat_until([&] { say(now_s() - begin_s < 2 ? 0 : 0.3); }, 50ms,
                        [this] { return true_speed_mps() > 0.1; });
  };
  ASSERT_TRUE(drive()) << status();
  put_box(objects, "crate", "base_link", 1.2);
  EXPECT_TRUE(repeat_until([&] { say(0.3); }, 50ms, [this] { return at_rest(); })) << status();
  EXPECT_THAT(status(), HasSubstr("crate is in the way")) << "what it stands before";
  EXPECT_TRUE(shows("crate")) << program_.output();
}

class ConstraintsOfARos2User : public MovedFromRos2 {
 protected:
  ConstraintsOfARos2User() : MovedFromRos2(R"("planning_constraints": true)") {
    add_section(kAScene);
  }
};

TEST_F(ConstraintsOfARos2User, AreInTheScene) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::planning_constraints_kind()));
  ros2::Arena arena;
  moveit_msgs_msg_dds__Constraints_ row{};
  row.name_ = arena.text("row");
  *arena.fill(row.joint_constraints_, 1) = {arena.text("base/y"), 0, 50, 50, 1};
  dds_write(writer_, &row);
  ASSERT_TRUE(wait_until([this] {
    return drover({"scene", "list"}).text.find("row") != std::string::npos;
  })) << program_.output();
}

}  // namespace
}  // namespace drover::test
