// The devices: what only their drivers and their register maps know.
#include <algorithm>
#include <exception>

#include "config/check_subjects.h"
#include "config/register_map.h"

namespace drover::config {
namespace {

void follow_baud(DeviceConfig& device, const LinkConfig& link, Findings& found) {
  if (!device.options.has("baud")) return;
  const auto path = device_path(device, "options.baud");
  const auto other = link_path(link, "baud");
  if (found.given(path) && device.options.number("baud") != link.baud)
    found.add(path, "differs from " + other, "leave it out: it follows " + other);
  device.options.set("baud", static_cast<double>(link.baud));
}

/// A drive whose time-out ends before the guard speaks lets go, and the guard's zeros hold nothing.
void look_at_guard(const DeviceConfig& device, const SilenceBehaviour& silence, Findings& found) {
  constexpr int kGuardsCycles_ms = 20;
  const auto& guard = found.config().guard;
  const Duration takes_over = std::chrono::milliseconds(guard.limit_ms + kGuardsCycles_ms);
  if (!guard.required || !silence.stops || silence.after > takes_over) return;
  found.add(device_path(device, "options"),
            "the drive lets go before drover-guard takes over when droverd dies: " +
                std::string(silence.text) + ", and the guard needs up to " +
                std::to_string(guard.limit_ms + kGuardsCycles_ms) + " ms",
            "a longer time-out of the drive, or a smaller guard.limit_ms");
}

/// A drive that nothing stops when the bus is cut is refused, unless a person says that it is so.
void look_at_silence(const DeviceConfig& device, const Actuator& driver, Findings& found) {
  const auto& words = device.accept;
  look_at_guard(device, driver.silence(), found);
  if (driver.silence().stops || std::find(words.begin(), words.end(), "no_watchdog") != words.end())
    return;
  found.add(device_path(device, "options"), std::string(driver.silence().text),
            "set its watchdog, or \"accept\": [\"no_watchdog\"] when that is meant");
}

/// What a driver says about options that do not fit together, it says when it is made.
Made build(const DeviceConfig& device, Findings& found) {
  const auto* entry = find_driver(device.driver);
  if (entry == nullptr || found.has_problem(device_path(device))) return {};
  try {
    return entry->make(device.options, context_of(device));
  } catch (const std::exception& error) {
    found.add(device_path(device, "options"), error.what());
    return {};
  }
}

void read_map(DeviceConfig& device, const std::string& folder, Findings& found) {
  const auto path = device_path(device, "map");
  if (found.has_problem(path)) return;
  auto loaded = found.loaded().register_map.empty()
                    ? load_register_map(find_register_map(device.map, folder))
                    : parse_register_map(found.loaded().register_map);
  found.loaded().register_map = std::move(loaded.text);
  if (!loaded.problems.empty()) found.add(path, "is no good register map", "see its own problems");
  for (auto& problem : loaded.problems) found.loaded().problems.push_back(std::move(problem));
  device.registers = std::move(loaded.map);
  if (device.unit == 0) device.unit = device.registers.unit;
  auto& link = found.config().links;
  if (device.link_index < link.size() && link[device.link_index].baud == 0)
    link[device.link_index].baud = device.registers.baud;
}

}  // namespace

void check_batteries(const std::string& folder, Findings& found) {
  for (auto& device : found.config().devices)
    if (device.kind == SlotKind::battery) read_map(device, folder, found);
}

void follow_baud_rates(Findings& found) {
  for (auto& device : found.config().devices)
    if (!found.has_problem(device_path(device, "link")) &&
        device.link_index < found.config().links.size())
      follow_baud(device, found.config().links[device.link_index], found);
}

void check_drivers(Findings& found) {
  for (const auto& device : found.config().devices) {
    const auto made = build(device, found);
    if (made.actuator != nullptr) look_at_silence(device, *made.actuator, found);
  }
}

}  // namespace drover::config
