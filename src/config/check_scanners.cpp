// Scanners: somebody looks at what they see, in a field that is wide and long enough for the robot.
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
  found.add(kBeside,
            metres(scene.field.beside_m) + " is narrower than the robot, which reaches " +
                metres(half_width_m) + " to a side by scene.footprint",
            "what stands before its corner would be seen and not minded");
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
  const double needed_m =
      engine::stop_way(config.engine.limits.max_speed_mps, chain) + config.scene.margin_m;
  if (config.scene.field.ahead_m >= needed_m) return;
  found.warn(kAhead,
             "is shorter than the way to stop from limits.max_speed_mps: what a scanner alone sees "
             "is met",
             "short_look", metres(std::ceil(100 * needed_m) / 100) + " or more");
}

}  // namespace drover::config
