// What the scene's keeper is told of the robot is what the configuration says.
#include "runtime/scene_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "config/load.h"
#include "drover/angle.h"
#include "drover/rotation.h"
#include "scene/look/with_points.h"
#include "scene/message/frames.h"

namespace drover::runtime {
namespace {

using scene::KeeperSettings;

config::DroverConfig field() {
  const auto loaded =
      config::load_file(std::string(DROVER_SOURCE_DIR) + "/sim/robots/field_scene.drover.json");
  EXPECT_TRUE(loaded.problems.empty()) << loaded.problems.front().text("field_scene");
  EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings.front().text("field_scene");
  return loaded.config;
}

const scene::Link& base_link(const KeeperSettings& settings) {
  return settings.robot.links.front();
}

/// Or a task would turn into what it saw, and waits for, when that is forgotten.
TEST(SceneSettings, RememberWhatWasSeenForLongerThanATaskWaits) {
  auto config = field();
  for (const double waits_s : {5.0, 120.0, 3600.0}) {
    config.engine.navigate.obstacle_timeout_s = waits_s;
    EXPECT_GT(to_s(keeper_settings(config).seen_kept), waits_s + 5);
  }
}

TEST(SceneSettings, LookAsIsConfigured) {
  auto config = field();
  config.scene.margin_m = 0.2;
  config.scene.ahead_m = 4;
  config.scene.along_m = 12;
  config.engine.navigate.pivot_angle_deg = 90;
  const auto settings = keeper_settings(config);
  ASSERT_EQ(settings.look.footprint.size(), 4U);
  EXPECT_EQ(settings.look.footprint[1], (scene::Point2{-0.415, 0.35}));
  EXPECT_EQ(settings.look.margin_m, 0.2);
  EXPECT_EQ(settings.look.ahead_m, 4);
  EXPECT_EQ(settings.look.along_m, 12);
  EXPECT_DOUBLE_EQ(settings.pivot_rad, kPi / 2);
}

/// Beside a curve half of the margin is looked at, and the base may leave that curve before the
/// next look: both are of the same margin.
TEST(SceneSettings, KeepMoreBesideACurveThanIsLeftOfItBetweenTwoLooks) {
  const std::string file = "/sim/robots/field_lidar.drover.json";
  std::string text;
  ASSERT_EQ(config::read_text(DROVER_SOURCE_DIR + file, text), "");
  const auto at = text.find("\"footprint\"");
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(text.find("\"margin_m\""), std::string::npos);
  for (const char* margin_m : {"0", "0.01", "0.02", "0.03", "0.05", "0.1", "0.2", "0.5", "2"}) {
    std::string changed = text;
    changed.insert(at, std::string("\"margin_m\": ") + margin_m + ", ");
    const auto loaded = config::load_text(changed, DROVER_SOURCE_DIR "/sim/robots");
    ASSERT_TRUE(loaded.problems.empty()) << loaded.problems.front().text("field_lidar");
    const auto look = keeper_settings(loaded.config).look;
    const double left_m = loaded.config.engine.clearance.beside_m;
    const double spent_m = left_m + (look.margin_m - scene::slim_margin_m(look));
    EXPECT_GT(left_m, 0) << margin_m;
    EXPECT_LE(spent_m, look.margin_m + 1e-12) << margin_m;
    if (look.margin_m > 0.04) {
      EXPECT_LT(spent_m, 0.8 * look.margin_m) << margin_m;
    }
  }
}

TEST(SceneSettings, NameTheJointsByTheirAxes) {
  EXPECT_THAT(keeper_settings(field()).joints,
              testing::ElementsAre("front_left", "rear_left", "front_right", "rear_right"));
}

TEST(SceneSettings, TakeTheRobotsHeights) {
  const auto settings = keeper_settings(field());
  EXPECT_EQ(settings.heights.low_m, 0.05);
  EXPECT_EQ(settings.heights.high_m, 1);
}

TEST(SceneSettings, HaveNoEndAboveAndBelowWhereHeightsAreIgnored) {
  auto config = field();
  config.scene.heights = "ignore";
  const auto settings = keeper_settings(config);
  EXPECT_EQ(settings.heights.low_m, -HUGE_VAL);
  EXPECT_EQ(settings.heights.high_m, HUGE_VAL);
  EXPECT_TRUE(scene::is_interval(settings.heights));
}

TEST(SceneSettings, PlaceFramesOnTheBase) {
  auto config = field();
  config.scene.frames = {{"mast", 0.1, -0.2, 0.6, 10, 20, 90}};
  const auto mast = scene::link_on_base(keeper_settings(config).robot, "mast");
  ASSERT_TRUE(mast.has_value());
  EXPECT_EQ(mast->position_m.x, 0.1);
  EXPECT_EQ(mast->position_m.y, -0.2);
  EXPECT_EQ(mast->position_m.z, 0.6);
  // Its x looks to the left, and down by the pitch; its y back, turned by the roll.
  const Vector3 x = rotate(mast->orientation, {1, 0, 0});
  EXPECT_NEAR(x.x, 0, 1e-12);
  EXPECT_NEAR(x.y, std::cos(to_rad(20)), 1e-12);
  EXPECT_NEAR(x.z, -std::sin(to_rad(20)), 1e-12);
  const Vector3 y = rotate(mast->orientation, {0, 1, 0});
  EXPECT_NEAR(y.x, -std::cos(to_rad(10)), 1e-12);
}

TEST(SceneSettings, KnowBaseLinkWithoutFrames) {
  auto config = field();
  config.scene.frames.clear();
  const auto settings = keeper_settings(config);
  ASSERT_EQ(settings.robot.links.size(), 1U);
  EXPECT_EQ(base_link(settings).name, scene::kBaseLink);
}

TEST(SceneSettings, HaveTheFootprintAsABodyFromClearanceToTop) {
  auto config = field();
  config.scene.heights = "ignore";  // the body has an end all the same
  const auto settings = keeper_settings(config);
  ASSERT_EQ(base_link(settings).bodies.size(), 1U);
  const auto& mesh = std::get<scene::Mesh>(base_link(settings).bodies[0].shape);
  EXPECT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.triangles.size(), 12U);
  // The volume by the triangles' own turns: all are there, and look outwards.
  double volume_m3 = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume_m3 += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c])) / 6;
  EXPECT_NEAR(volume_m3, 0.865 * 0.7 * 0.95, 1e-9);
  for (const auto& corner : mesh.vertices) EXPECT_TRUE(corner.z == 0.05 || corner.z == 1);
}

// The configuration refuses them by a list of its own.
TEST(SceneSettings, NamesThatAreNoFramesOfTheRobotAreRefusedByTheConfiguration) {
  for (const auto* name : {"map", "1", "/map", "/1"}) EXPECT_TRUE(scene::is_global_frame(name));
  EXPECT_TRUE(scene::is_no_frame("0"));
  EXPECT_EQ(scene::kBaseLink, "base_link");
}

}  // namespace
}  // namespace drover::runtime
