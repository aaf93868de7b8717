// Scanners: they are on the robot, and somebody looks at what they see, in a field that is wide and
// long enough for it.
#include <algorithm>
#include <array>
#include <cmath>

#include "config/check_subjects.h"
#include "engine/clearance/stop_chain.h"
#include "text/number.h"

namespace drover::config {
namespace {

constexpr auto kAhead = "scene.field.ahead_m";
constexpr auto kBeside = "scene.field.beside_m";
constexpr double kFarOutside_m = 0.3;  // an arm that holds it

std::string metres(double value_m) {
  return text::formed("%.2f m", value_m);
}

void check_width(Findings& found) {
  const auto& scene = found.config().scene;
  if (found.has_problem("scene")) return;
  double half_width_m = 0;
  for (const auto& corner : scene.footprint)
    half_width_m = std::max(half_width_m, std::abs(corner.y_m));
  if (scene.field.beside_m >= half_width_m) return;
  found.add(
      kBeside,
      metres(scene.field.beside_m) + " is narrower than the robot, which reaches " +
          metres(half_width_m) + " to a side by scene.footprint",
      "\"field\": {\"beside_m\": " + text::formed("%.2f", std::ceil(100 * half_width_m) / 100) +
          "} or more in the section \"scene\": what stands before its corner would be seen and "
          "not minded");
}

/// From the footprint, which is convex and counter-clockwise; 0: inside.
double outside_m(const std::vector<CornerConfig>& footprint, const CornerConfig& place) {
  bool is_inside = true;
  double nearest_m = INFINITY;
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const auto& a = footprint[i];
    const auto& b = footprint[(i + 1) % footprint.size()];
    const double x_m = b.x_m - a.x_m;
    const double y_m = b.y_m - a.y_m;
    const double to_x_m = place.x_m - a.x_m;
    const double to_y_m = place.y_m - a.y_m;
    is_inside = is_inside && x_m * to_y_m - y_m * to_x_m >= 0;
    const double along =
        std::clamp((to_x_m * x_m + to_y_m * y_m) / (x_m * x_m + y_m * y_m), 0.0, 1.0);
    nearest_m = std::min(nearest_m, std::hypot(to_x_m - along * x_m, to_y_m - along * y_m));
  }
  return is_inside ? 0 : nearest_m;
}

/// A slip in its place shifts all that it sees, and the robot drives into it. The driver says what
/// is missing; here is what cannot be, the robot being as the scene has it.
void check_mounting(const DeviceConfig& device, Findings& found) {
  const auto& scene = found.config().scene;
  const auto& options = device.options;
  if (found.has_problem("scene") || found.has_problem(device_path(device, "options"))) return;
  if (options.has("mount_x_m") && options.has("mount_y_m")) {
    const CornerConfig place{options.number("mount_x_m"), options.number("mount_y_m")};
    const double far_m = outside_m(scene.footprint, place);
    if (far_m > kFarOutside_m)
      found.add(device_path(device, "options.mount_x_m"),
                "with mount_y_m it is " + metres(far_m) + " outside of scene.footprint",
                "metres ahead of base_link, and to its left: a scanner is on the robot");
  }
  if (!options.has("mount_z_m")) return;
  const double z_m = options.number("mount_z_m");
  if (z_m < scene.ground_clearance_m)
    found.add(device_path(device, "options.mount_z_m"),
              "its beams, " + metres(z_m) +
                  " above the ground, are below scene.ground_clearance_m, " +
                  metres(scene.ground_clearance_m),
              "what it sees there would be driven over");
  else if (z_m > scene.height_m)
    found.add(device_path(device, "options.mount_z_m"),
              "its beams, " + metres(z_m) + " above the ground, are above scene.height_m, " +
                  metres(scene.height_m),
              "scene.height_m is the top of all that is on the robot");
}

}  // namespace

void check_scanners(Findings& found) {
  const auto& config = found.config();
  std::size_t count = 0;
  for (const auto& device : config.devices) {
    if (find_driver(device.driver, SlotKind::scanner) == nullptr) continue;
    ++count;
    if (!config.scene.configured && !found.has_problem("scene"))
      found.add(device_path(device), "is a scanner, and nobody looks at what it sees",
                "a section \"scene\" with the robot's footprint");
    if (config.scene.configured) check_mounting(device, found);
    if (count == kMaxOfKind + 1)
      found.add(device_path(device),
                "is one scanner too many: there may be " + std::to_string(kMaxOfKind));
  }
  if (count > 0 && config.scene.configured) check_width(found);
}

/// A field that is free says nothing of what is behind it, so that it does not bound the speed.
void warn_of_short_field(Findings& found) {
  const auto& config = found.config();
  if (first(config, SlotKind::scanner) == nullptr || !config.scene.configured ||
      found.has_problem("scene") || found.has_problem("limits"))
    return;
  const engine::StopChain chain{config.engine.clearance.reaction_s,
                                config.engine.limits.deceleration_mps2};
  const double needed_m = engine::stop_way(fastest_mps(config), chain) + config.scene.margin_m;
  if (config.scene.field.ahead_m >= needed_m) return;
  found.warn(kAhead,
             "is shorter than the way to stop from limits.max_speed_mps: what a scanner alone sees "
             "is met",
             "short_look", metres(std::ceil(100 * needed_m) / 100) + " or more");
}

}  // namespace drover::config
