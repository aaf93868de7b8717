// Where the configuration has what a calibration finds.
#include "cli/show_calibration.h"
#include "json/located_json.h"

namespace drover::cli {
namespace {

bool has_key(const config::Loaded& loaded, const std::string& device, const char* key) {
  const auto document = json::parse(loaded.text);
  if (!document.ok()) return false;
  const json::Node* devices = document->root.find("devices");
  const json::Node* node = devices == nullptr ? nullptr : devices->find(device);
  return node != nullptr && node->find(key) != nullptr;
}

}  // namespace

CalibrationKeys calibration_keys(const config::Loaded& loaded, bool own_stamps) {
  CalibrationKeys keys;
  keys.own_stamps = own_stamps;
  keys.twist_base = engine::takes_twist(loaded.config.engine.base.kind);
  const auto& estimate = loaded.config.engine.estimate;
  keys.antenna_sigma_m = estimate.antenna_sigma_m;
  keys.heading_mount_sigma_deg = estimate.heading_mount_sigma_deg;
  keys.gnss_late_sigma_s = estimate.gnss_late_sigma_s;
  for (const auto& device : loaded.config.devices) {
    if (device.kind != SlotKind::gnss || device.role != "steers") continue;
    keys.receiver = device.name;
    keys.x_at_receiver = has_key(loaded, device.name, "antenna_x_m");
    keys.y_at_receiver = has_key(loaded, device.name, "antenna_y_m");
    keys.heading_at_receiver = has_key(loaded, device.name, "heading_baseline_offset_deg");
    if (device.options.has("latency_s")) keys.latency_s = device.options.number("latency_s");
  }
  return keys;
}

}  // namespace drover::cli
