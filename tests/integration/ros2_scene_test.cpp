// A ROS 2 user who puts things around the robot: moveit_msgs by DDS, the field robot with a scene.
#include <cmath>

#include "integration/ros2_scene_rig.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class SceneOfARos2User : public SceneFromRos2 {
 protected:
  SceneOfARos2User() : SceneFromRos2(R"("collision_object": true, "cmd_vel": "twist")") {}
  bool shows_unmet(int count) {
    return state().find("\"incompatible\":" + std::to_string(count)) != std::string::npos;
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

TEST_F(SceneOfARos2User, IsNamedInTheJournalWhereHisWriterMayLoseAnObject) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::collision_object_kind()));
  const dds_entity_t unsure =
      make_writer(participant_, ros2::collision_object_kind(), DDS_RELIABILITY_BEST_EFFORT);
  EXPECT_TRUE(wait_until([this] {
    return journal_has("a writer of /collision_object offers a reliability that is not asked for");
  })) << program_.output();
  EXPECT_TRUE(wait_until([this] { return shows_unmet(1); })) << state();
  put_box(unsure, "crate", "map", 3);
  put_box(writer_, "shed", "map", 4);
  ASSERT_TRUE(wait_until([this] { return shows("shed"); })) << program_.output();
  EXPECT_FALSE(shows("crate")) << "it is not heard";
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

class ConstraintsOfARos2User : public SceneFromRos2 {
 protected:
  ConstraintsOfARos2User() : SceneFromRos2(R"("planning_constraints": true)") {}
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
