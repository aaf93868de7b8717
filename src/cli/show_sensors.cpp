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

}  // namespace drover::cli
