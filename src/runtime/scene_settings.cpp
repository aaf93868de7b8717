#include "runtime/scene_settings.h"

#include <algorithm>
#include <limits>
#include <string>

#include "drover/angle.h"
#include "drover/rotation.h"

namespace drover::runtime {
namespace {

using config::SceneConfig;

constexpr Duration kLongerThanAnyWaits = std::chrono::seconds(10);

scene::Heights heights_of(const SceneConfig& config) {
  constexpr double kEnd = std::numeric_limits<double>::infinity();
  if (config.heights == "ignore") return {-kEnd, kEnd};
  return {config.ground_clearance_m, config.height_m};
}

/// The footprint as an upright prism. Seen from outside its triangles are counter-clockwise.
scene::Mesh prism(const SceneConfig& config) {
  const auto n = static_cast<std::uint32_t>(config.footprint.size());
  scene::Mesh mesh;
  for (const double z_m : {config.ground_clearance_m, config.height_m})
    for (const auto& corner : config.footprint)
      mesh.vertices.push_back({corner.x_m, corner.y_m, z_m});
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back({0, i + 1, i});          // below
    mesh.triangles.push_back({n, n + i, n + i + 1});  // above
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.triangles.push_back({i, next, n + next});
    mesh.triangles.push_back({i, n + next, n + i});
  }
  return mesh;
}

scene::Pose pose_of(const config::FrameConfig& frame) {
  return {{frame.x_m, frame.y_m, frame.z_m},
          from_angles(to_rad(frame.roll_deg), to_rad(frame.pitch_deg), to_rad(frame.yaw_deg))};
}

scene::RobotModel robot_of(const SceneConfig& config) {
  scene::RobotModel robot;
  robot.links.push_back({std::string(scene::kBaseLink), {}, {{prism(config), {}}}});
  for (const auto& frame : config.frames) robot.links.push_back({frame.name, pose_of(frame), {}});
  return robot;
}

}  // namespace

scene::KeeperSettings keeper_settings(const config::DroverConfig& config) {
  const SceneConfig& scene = config.scene;
  scene::KeeperSettings settings;
  for (const auto& corner : scene.footprint)
    settings.look.footprint.push_back({corner.x_m, corner.y_m});
  // Of no margin nothing could be left for curves that change; the half that is kept of what
  // scanners see has to hold all of it.
  settings.look.margin_m = std::max(scene.margin_m, 2 * scene.clearance.beside_m);
  settings.look.ahead_m = scene.ahead_m;
  settings.look.along_m = scene.along_m;
  settings.look.aside = config.engine.clearance_aside;
  settings.heights = heights_of(scene);
  settings.robot = robot_of(scene);
  for (const auto& joint : config.engine.joints) settings.joints.emplace_back(joint.view());
  settings.pivot_rad = to_rad(config.engine.navigate.pivot_angle_deg);
  settings.lookahead_s = config.engine.navigate.lookahead_s;
  settings.min_lookahead_m = config.engine.navigate.min_lookahead_m;
  settings.seen_kept = from_s(config.engine.navigate.obstacle_timeout_s) + kLongerThanAnyWaits;
  return settings;
}

scene::sensor::SensorField sensor_field(const config::DroverConfig& config,
                                        const ScanMount& mount) {
  double front_m = mount.x_m;
  for (const auto& corner : config.scene.footprint) front_m = std::max(front_m, corner.x_m);
  return {front_m, config.scene.field.ahead_m, config.scene.field.beside_m};
}

}  // namespace drover::runtime
