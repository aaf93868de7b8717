// Several receivers, inertial sensors or batteries: which one the robot goes by.
#include <algorithm>
#include <vector>

#include "config/check_subjects.h"
#include "text/number.h"

namespace drover::config {
namespace {

struct RoleKind {
  SlotKind kind;
  const char* word;
  bool several_steer;  ///< packs in parallel
};
constexpr RoleKind kRoleKinds[] = {{SlotKind::gnss, "receiver", false},
                                   {SlotKind::imu, "inertial sensor", false},
                                   {SlotKind::battery, "battery", true}};

std::vector<DeviceConfig*> all_of(SlotKind kind, Findings& found) {
  std::vector<DeviceConfig*> all;
  for (auto& device : found.config().devices)
    if (find_driver(device.driver, kind) != nullptr) all.push_back(&device);
  return all;
}

/// Each has one; the first of its kind may leave it out.
void fill_in(const RoleKind& kind, const std::vector<DeviceConfig*>& all, Findings& found) {
  for (auto* device : all) {
    if (!device->role.empty()) continue;
    if (device == all.front()) {
      device->role = "steers";
      continue;
    }
    found.add(device_path(*device),
              "is a second " + std::string(kind.word) + " beside " + device_path(*all.front()) +
                  ": what is it for?",
              std::string("\"role\": \"spare\" takes over when the other is not well, \"told\" is "
                          "only shown") +
                  (kind.several_steer ? ", \"steers\" counts like the other" : ""));
  }
}

void one_steers(const RoleKind& kind, const std::vector<DeviceConfig*>& all, Findings& found) {
  const DeviceConfig* steers = nullptr;
  for (const auto* device : all) {
    if (device->role != "steers") continue;
    if (steers != nullptr && !kind.several_steer)
      found.add(device_path(*device, "role"),
                "the robot goes by one " + std::string(kind.word) + ", and " +
                    device_path(*steers) + " steers",
                "\"spare\" or \"told\"");
    if (steers == nullptr) steers = device;
  }
  if (steers != nullptr || found.has_problem(device_path(*all.front()))) return;
  found.add(device_path(*all.front(), "role"), "no " + std::string(kind.word) + " steers",
            "\"role\": \"steers\" at one of them");
}

constexpr const char* kAntennaKeys[] = {"antenna_x_m", "antenna_y_m", "antenna_z_m",
                                        "heading_baseline_offset_deg"};
constexpr double DeviceConfig::*kOfDevice[] = {
    &DeviceConfig::antenna_x_m, &DeviceConfig::antenna_y_m, &DeviceConfig::antenna_z_m,
    &DeviceConfig::heading_baseline_offset_deg};
constexpr double engine::EstimateConfig::*kOfEstimate[] = {
    &engine::EstimateConfig::antenna_x_m, &engine::EstimateConfig::antenna_y_m,
    &engine::EstimateConfig::antenna_z_m, &engine::EstimateConfig::heading_baseline_offset_deg};

/// `estimate` is the steering one's; what the others leave out is as there.
void antennas(const std::vector<DeviceConfig*>& receivers, Findings& found) {
  auto& estimate = found.config().engine.estimate;
  const auto given = [&](const DeviceConfig& device, const char* key) {
    return found.given(device_path(device, key));
  };
  for (const auto* device : receivers) {
    for (std::size_t i = 0; i < std::size(kAntennaKeys); ++i) {
      if (device->role != "steers" || !given(*device, kAntennaKeys[i])) continue;
      const auto other = "estimate." + std::string(kAntennaKeys[i]);
      if (found.given(other) && estimate.*kOfEstimate[i] != device->*kOfDevice[i])
        found.add(device_path(*device, kAntennaKeys[i]), "differs from " + other,
                  "leave one of them out");
      estimate.*kOfEstimate[i] = device->*kOfDevice[i];
    }
    if (device->role != "spare") continue;
    for (const char* key : {"antenna_x_m", "antenna_y_m"})
      if (!given(*device, key))
        found.add(device_path(*device, key), "is missing",
                  "where the antenna of a spare is must be known before it is needed");
  }
  for (auto* device : receivers) {
    for (std::size_t i = 0; i < std::size(kAntennaKeys); ++i)
      if (!given(*device, kAntennaKeys[i])) device->*kOfDevice[i] = estimate.*kOfEstimate[i];
    (void)estimate.antennas.push_back({device->antenna_x_m, device->antenna_y_m,
                                       device->antenna_z_m, device->heading_baseline_offset_deg});
  }
}

/// A position that is too old before the next one comes lets nothing start, and stops what drives.
void outlasts_its_period(const DeviceConfig& receiver, Findings& found) {
  constexpr double kPeriods = 1.5;
  const double stale_s = found.config().engine.health.gnss_stale_s;
  if (receiver.role == "told" || !receiver.options.has("rate_Hz")) return;
  const double rate_Hz = receiver.options.number("rate_Hz");
  if (stale_s * rate_Hz >= kPeriods) return;
  found.add("health.gnss_stale_s",
            text::formed("%g s", stale_s) + " is shorter than one and a half periods of " +
                device_path(receiver) + text::formed(", %g Hz", rate_Hz) +
                ": its positions would be too old before the next one comes",
            text::formed("%.2f", kPeriods / rate_Hz) +
                " or more, for which the robot drives without one; a receiver that tells ten "
                "times a second is better");
}

}  // namespace

void check_roles(Findings& found) {
  for (const RoleKind& kind : kRoleKinds) {
    const auto all = all_of(kind.kind, found);
    if (all.empty()) continue;
    if (all.size() > kMaxOfKind)
      found.add(device_path(*all[kMaxOfKind]), "is one " + std::string(kind.word) +
                                                   " too many: there may be " +
                                                   std::to_string(kMaxOfKind));
    fill_in(kind, all, found);
    one_steers(kind, all, found);
    if (kind.kind != SlotKind::gnss) continue;
    antennas(all, found);
    for (const auto* receiver : all) outlasts_its_period(*receiver, found);
  }
}

engine::SensorList sensors_of(const DroverConfig& config, SlotKind kind) {
  engine::SensorList list;
  for (const auto& device : config.devices) {
    if (device.kind != kind) continue;
    const Role role = device.role == "spare"  ? Role::spare
                      : device.role == "told" ? Role::told
                                              : Role::steers;
    (void)list.push_back({Name(device.name), role});
  }
  return list;
}

}  // namespace drover::config
