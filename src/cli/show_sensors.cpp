#include "cli/show_sensors.h"

#include "cli/layout.h"

namespace drover::cli {

namespace {

using json::Node;

std::string values(const Node& sensor, std::string_view kind) {
  if (text(at(sensor, "health")) == "never heard") return "";
  if (kind == "gnss") return text(at(sensor, "quality")) + "  ";
  if (kind != "battery") return "";
  return quantity(at(sensor, "soc_percent"), "%.1f %%") + "  " +
         quantity(at(sensor, "voltage_V"), "%.2f V") + "  " +
         quantity(at(sensor, "current_A"), "%.1f A") + "  " +
         (yes(at(sensor, "charger_connected")) ? "CHARGER  " : "");
}

/// "nearest 0.98 m, 90° left": by that a person sees whether it is mounted as the configuration
/// says.
std::string nearest(const Node& scanner) {
  const auto bearing_deg = at(scanner, "nearest_deg").number();
  if (!bearing_deg) return "";
  std::string where = "ahead";
  if (*bearing_deg != 0)
    where = quantity(at(scanner, "nearest_deg"), *bearing_deg > 0 ? "+%.0f° left" : "%.0f° right");
  return quantity(at(scanner, "nearest_m"), "nearest %.2f m, ") + where + "  ";
}

}  // namespace

std::string show_sensors(const Node& status, std::string_view kind) {
  const auto* sensors = at(status, "sensors").list();
  std::string out;
  std::size_t count = 0;
  if (sensors == nullptr) return out;
  for (const auto& sensor : *sensors) {
    if (text(at(sensor, "kind")) != kind) continue;
    ++count;
    std::string value = padded(text(at(sensor, "name")), 16) + padded(text(at(sensor, "role")), 7) +
                        (yes(at(sensor, "in_use")) ? "IN USE  " : "        ") +
                        values(sensor, kind) + text(at(sensor, "health"));
    if (at(sensor, "age_s").number()) value += quantity(at(sensor, "age_s"), "  %.2f s old");
    if (!text(at(sensor, "reason")).empty()) value += "  " + text(at(sensor, "reason"));
    line(out, count == 1 ? kind : "", value);
  }
  return count > 1 ? out : "";
}

std::string show_scanners(const Node& status) {
  const auto* scanners = at(status, "scanners").list();
  std::string out;
  if (scanners == nullptr) return out;
  for (const auto& scanner : *scanners) {
    std::string value = padded(text(at(scanner, "name")), 16);
    if (text(at(scanner, "health")) != "never heard")
      value += quantity(at(scanner, "turn_Hz"), "%.1f turns/s") + "  " +
               quantity(at(scanner, "returns"), "%.0f") +
               quantity(at(scanner, "points"), " of %.0f points seen") + "  " + nearest(scanner);
    value += text(at(scanner, "health"));
    if (at(scanner, "age_s").number()) value += quantity(at(scanner, "age_s"), "  %.2f s old");
    if (!text(at(scanner, "reason")).empty()) value += "  " + text(at(scanner, "reason"));
    line(out, out.empty() ? "scanner" : "", value);
  }
  return out;
}

}  // namespace drover::cli
