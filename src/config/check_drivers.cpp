// The devices: what only their drivers and their register maps know.
#include <algorithm>
#include <cstdio>
#include <exception>

#include "config/check_subjects.h"
#include "config/register_map.h"

namespace drover::config {
namespace {

/// "" when a battery's port is a device or tcp:ADDRESS:PORT. No names: to resolve one may take
/// longer than anything here waits.
std::string check_modbus_port(const std::string& port) {
  if (!port.starts_with("tcp:")) return "";
  unsigned a = 0;
  unsigned b = 0;
  unsigned c = 0;
  unsigned d = 0;
  unsigned number = 0;
  int used = 0;
  const int got =
      std::sscanf(port.c_str(), "tcp:%3u.%3u.%3u.%3u:%5u%n", &a, &b, &c, &d, &number, &used);
  const bool good = got == 5 && static_cast<std::size_t>(used) == port.size() &&
                    std::max({a, b, c, d}) <= 255 && number >= 1 && number <= 65535;
  return good ? "" : "must be tcp:ADDRESS:PORT with an IPv4 address, like tcp:192.168.1.50:502";
}

void follow_baud(const std::string& section, int baud, Options& options, Findings& found) {
  if (!options.has("baud")) return;
  if (found.given(section, "options", "baud") && options.number("baud") != baud)
    found.add(section + ".options.baud", "differs from " + section + ".baud",
              "leave it out: it follows " + section + ".baud");
  options.set("baud", static_cast<double>(baud));
}

/// A drive that nothing stops when the bus is cut is refused, unless a person says that it is so.
void look_at_silence(std::size_t i, const Actuator& driver, Findings& found) {
  const auto& drive = found.config().drives[i];
  const auto& words = drive.accept;
  if (driver.silence().stops || std::find(words.begin(), words.end(), "no_watchdog") != words.end())
    return;
  found.add(item("drives", i) + ".options", std::string(driver.silence().text),
            "set its watchdog, or \"accept\": [\"no_watchdog\"] when that is meant");
}

/// What a driver says about options that do not fit together, it says when it is made.
Made build(const std::string& path, const std::string& driver, const Options& options,
           const MakeContext& context, Findings& found) {
  if (found.has_problem(path)) return {};
  const auto* entry = find_driver(driver, context.kind);
  if (entry == nullptr) return {};
  try {
    return entry->make(options, context);
  } catch (const std::exception& error) {
    found.add(path + ".options", error.what());
    return {};
  }
}

}  // namespace

void check_battery(const std::string& folder, Findings& found) {
  auto& battery = found.config().battery;
  if (!battery.configured || found.has_problem("battery.map")) return;
  if (const auto why = check_modbus_port(battery.port); !why.empty())
    found.add("battery.port", why);
  auto loaded = found.loaded().register_map.empty()
                    ? load_register_map(find_register_map(battery.map, folder))
                    : parse_register_map(found.loaded().register_map);
  found.loaded().register_map = std::move(loaded.text);
  if (!loaded.problems.empty())
    found.add("battery.map", "is no good register map", "see its own problems");
  for (auto& problem : loaded.problems) found.loaded().problems.push_back(std::move(problem));
  battery.registers = std::move(loaded.map);
  if (battery.baud == 0) battery.baud = battery.registers.baud;
  if (battery.unit == 0) battery.unit = battery.registers.unit;
}

void follow_baud_rates(Findings& found) {
  auto& c = found.config();
  follow_baud("gnss", c.gnss.baud, c.gnss.options, found);
  follow_baud("imu", c.imu.baud, c.imu.options, found);
}

void check_drivers(Findings& found) {
  const auto& c = found.config();
  for (std::size_t i = 0; i < c.drives.size(); ++i) {
    const auto made = build(item("drives", i), c.drives[i].driver, c.drives[i].options,
                            {.kind = SlotKind::drive}, found);
    if (made.actuator != nullptr) look_at_silence(i, *made.actuator, found);
  }
  if (c.gnss.configured)
    build("gnss", c.gnss.driver, c.gnss.options, {.kind = SlotKind::gnss}, found);
  if (c.imu.configured) build("imu", c.imu.driver, c.imu.options, {.kind = SlotKind::imu}, found);
  if (c.battery.configured)
    build("battery", c.battery.driver, c.battery.options,
          {.kind = SlotKind::battery, .registers = &c.battery.registers}, found);
  for (std::size_t i = 0; i < kLineCount; ++i) {
    const auto& line = c.lines.line[i];
    if (line.configured)
      build("lines." + std::string(kLineKeys[i]), line.driver, line.options,
            {.kind = SlotKind::line, .line = static_cast<Line>(i)}, found);
  }
}

}  // namespace drover::config
