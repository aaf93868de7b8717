// The messages in config/scene: read, found good, and doing what their README says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "publish/scene/messages.h"
#include "scene/constraint/evaluate.h"
#include "scene/keeper/keeper.h"

namespace drover::publish {
namespace {

using scene::Pose2;
using scene::RobotModel;
using scene::RobotState;
using scene::World;

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::filesystem::path example(const std::string& name) {
  return std::filesystem::path(DROVER_SOURCE_DIR) / "config/scene" / (name + ".json");
}

/// A robot at (1, 2) of the map that looks along x.
struct Example {
  World world;
  RobotModel robot;
  scene::PoseHistory poses;
  Time arrived{from_s(10)};

  Example() {
    world.move_origin({48, 11, 500});
    poses.add(arrived, {1, 2, 0});
  }
  /// Empty when all was done, and without a note.
  std::string apply_object(const std::string& name) {
    const auto read = parse_collision_objects(text_of(example(name)), Retain::no);
    if (!read) return read.error().why;
    const auto& result = read->messages.at(0).result;
    if (!result) return result.error().path + ": " + result.error().why;
    if (!result->notes.empty()) return "note: " + result->notes[0];
    const auto done = world.apply(result->message, {robot, poses, arrived, Duration{0}});
    return done ? "" : done.error().path + ": " + done.error().why;
  }
  std::string apply_constraints(const std::string& name) {
    const auto read = parse_planning_constraints(text_of(example(name)), Retain::no);
    if (!read) return read.error().why;
    const auto& result = read->messages.at(0).result;
    if (!result) return result.error().path + ": " + result.error().why;
    if (!result->notes.empty()) return "note: " + result->notes[0];
    const auto done = world.apply(result->message, robot);
    return done ? "" : done.error().path + ": " + done.error().why;
  }
  bool holds_at(const Pose2& base, scene::Tilt tilt = {}) const {
    RobotState state;
    state.base = base;
    state.tilt = tilt;
    return all_hold(evaluate(world, robot, state));
  }
};

TEST(SceneExamples, AreAllReadAndApplied) {
  Example scene;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(example("").parent_path())) {
    if (entry.path().extension() != ".json") continue;
    ++files;
    const std::string name = entry.path().stem();
    if (name == "object_moved" || name == "object_removed") continue;
    EXPECT_EQ(name.starts_with("object") ? scene.apply_object(name) : scene.apply_constraints(name),
              "")
        << name;
  }
  EXPECT_EQ(files, 12U);
  EXPECT_EQ(scene.world.objects().size(), 6U);
  EXPECT_EQ(scene.world.constraints().size(), 4U);
}

TEST(SceneExamples, TheCrateIsPlacedByTheRobot) {
  Example scene;
  ASSERT_EQ(scene.apply_object("object_box"), "");
  const scene::Object& crate = *scene.world.object("crate");
  EXPECT_NEAR(crate.primitives[0].in_map.position_m.x, 4, 1e-9);
  EXPECT_NEAR(crate.primitives[0].in_map.position_m.y, 2.5, 1e-9);
}

TEST(SceneExamples, ThePoleIsMovedAndRemoved) {
  Example scene;
  ASSERT_EQ(scene.apply_object("object_cylinder"), "");
  ASSERT_EQ(scene.apply_object("object_moved"), "");
  EXPECT_EQ(scene.world.object("pole")->primitives[0].in_map.position_m.y, 3);
  ASSERT_EQ(scene.apply_object("object_removed"), "");
  EXPECT_TRUE(scene.world.objects().empty());
}

TEST(SceneExamples, TheConstraintsHoldWhereTheReadmeSaysSo) {
  Example joint;
  ASSERT_EQ(joint.apply_constraints("constraint_joint"), "");
  EXPECT_TRUE(joint.holds_at({5, 0.3, 0.4}));
  EXPECT_FALSE(joint.holds_at({5, 0.5, 0}));
  EXPECT_FALSE(joint.holds_at({5, 0, 0.6}));
  Example position;
  ASSERT_EQ(position.apply_constraints("constraint_position"), "");
  EXPECT_TRUE(position.holds_at({29, 9, 0}));
  EXPECT_TRUE(position.holds_at({41, 0, 0}));
  EXPECT_FALSE(position.holds_at({31, 9, 0}));
  Example orientation;
  ASSERT_EQ(orientation.apply_constraints("constraint_orientation"), "");
  EXPECT_TRUE(orientation.holds_at({0, 0, 2}, {0.1, 0.1}));
  EXPECT_FALSE(orientation.holds_at({0, 0, 2}, {0, 0.3}));
  Example visibility;
  ASSERT_EQ(visibility.apply_constraints("constraint_visibility"), "");
  EXPECT_TRUE(visibility.holds_at({0, 0, 0.3}));
  EXPECT_FALSE(visibility.holds_at({0, 0, 0.8}));
  EXPECT_FALSE(visibility.holds_at({20, 0, 0}));
}

/// A robot far from where they hold is told what is measured, what is allowed, and what to do.
TEST(SceneExamples, SayWhatIsAllowedWhereTheyDoNotHold) {
  const std::map<std::string, std::string> allowed = {
      {"constraint_joint", "allowed -0.4"},
      {"constraint_orientation", "allowed"},
      {"constraint_position", "outside of its region"},
      {"constraint_visibility", "allowed 45.8"},
  };
  for (const auto& entry : std::filesystem::directory_iterator(example("").parent_path())) {
    const std::string name = entry.path().stem();
    if (!name.starts_with("constraint")) continue;
    const auto read = parse_planning_constraints(text_of(entry.path()), Retain::no);
    scene::Constraints set = read->messages.at(0).result->message;
    set.name.append(200 - set.name.size(), '_');
    scene::Keeper keeper({});
    keeper.set_zones({}, "");
    keeper.set_scene_problem("");
    Viewpoint from;
    from.t = Time{from_s(100)};
    from.pose = {.x_m = 500, .y_m = 500, .yaw_rad = 2};
    from.pose.position_sigma_m = from.pose.yaw_sigma_rad = 0;
    from.roll_rad = from.pitch_rad = 0.4;
    from.origin_set = true;
    from.origin = {48, 11, 500};
    keeper.see(from);
    ASSERT_TRUE(keeper.apply(set, {from.t, Duration{0}})) << name;
    const std::string broken(keeper.look(nullptr).broken.view());
    EXPECT_THAT(broken, testing::HasSubstr(allowed.at(name))) << name;
    EXPECT_THAT(broken, testing::EndsWith("; take it away or push it")) << name;
  }
}

}  // namespace
}  // namespace drover::publish
