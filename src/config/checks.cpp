#include "config/checks.h"

#include "config/check_subjects.h"

namespace drover::config {
namespace {

/// The engine's own copies of what other sections say.
void finish_engine(DroverConfig& c) {
  c.engine.tick_Hz = c.control.tick_Hz;
  c.engine.health.guard_required = c.guard.required;
  c.engine.battery_configured = first(c, SlotKind::battery) != nullptr;
  c.engine.receivers = sensors_of(c, SlotKind::gnss);
  c.engine.imus = sensors_of(c, SlotKind::imu);
  c.engine.batteries = sensors_of(c, SlotKind::battery);
  for (const auto* device : by_axis(c))
    for (const auto& joint : device->joints) (void)c.engine.joints.push_back(Name(joint.name));
  for (const auto& device : c.devices) {
    if (device.kind == SlotKind::line)
      c.engine.line_configured[static_cast<std::size_t>(line_of(device))] = true;
  }
  for (std::size_t i = 0; i < kOutputCount; ++i)
    c.engine.output_configured[i] = c.outputs.output[i].configured;
  c.engine.clearance_required = c.scene.configured;
  // What no scanner sees bounds nothing, and not all of them see both sides.
  c.engine.clearance_aside = c.scene.configured &&
                             c.engine.base.kind == engine::BaseKind::mecanum &&
                             first(c, SlotKind::scanner) == nullptr;
  c.engine.clearance = c.scene.clearance;
}

}  // namespace

void check_and_resolve(const json::Node& root, const GroupNames& groups, const std::string& folder,
                       Loaded& loaded) {
  Findings found(root, loaded);
  check_links(found);
  check_devices(found);
  check_joints(found);
  number_joints(groups.others, found);
  check_base(groups, found);
  check_groups(groups, found);
  check_lines(found);
  check_use_of_links(found);
  check_limits(found);
  check_paths(found);
  check_broker(found);
  check_channel(found);
  check_ros2(found);
  warn_of_deaf_arms(found);
  check_scene(found);
  check_scanners(found);
  check_batteries(folder, found);
  follow_baud_rates(found);
  finish_engine(loaded.config);
  check_drivers(found);  // with the options as they are by now
  check_accepted(found);
  warn_of_risks(found);
}

}  // namespace drover::config
