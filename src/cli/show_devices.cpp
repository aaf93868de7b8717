#include "cli/show_devices.h"

#include <array>

#include "cli/layout.h"
#include "cli/show_sensors.h"

namespace drover::cli {

namespace {

using json::Node;

std::string vector(const Node& node, const char* format, std::string_view unit) {
  static const Node kNothing;
  const auto* list = node.list();
  std::string out;
  for (std::size_t i = 0; i < 3; ++i) {
    out += std::string(1, "xyz"[i]) + " ";
    out += quantity(list != nullptr && i < list->size() ? (*list)[i] : kNothing, format) + "  ";
  }
  return out + std::string(unit);
}

/// Pace, age and counts: the same of every device.
void show_source(std::string& out, const Node& device) {
  line(out, "rate",
       quantity(at(device, "rate_Hz"), "%.1f Hz") + "  " +
           labelled("age", at(device, "age_s"), "%.3f s") + "  " +
           labelled("samples", at(device, "samples"), "%.0f") + "  " +
           labelled("bad", at(device, "bad"), "%.0f"));
  line(out, "health", text(at(device, "health")));
  if (!text(at(device, "reason")).empty()) line(out, "", text(at(device, "reason")));
}

std::string show_gnss(const Node& status) {
  const auto& gnss = at(status, "gnss");
  std::string out;
  line(out, "quality",
       text(at(gnss, "quality")) + "  " + labelled("satellites", at(gnss, "satellites"), "%.0f") +
           "  " + labelled("hdop", at(gnss, "hdop"), "%.2f") + "  " +
           labelled("corrections", at(gnss, "correction_age_s"), "%.1f s old"));
  line(out, "position",
       labelled("latitude", at(gnss, "latitude_deg"), "%.9f deg") + "  " +
           labelled("longitude", at(gnss, "longitude_deg"), "%.9f deg") + "  " +
           labelled("altitude", at(gnss, "altitude_msl_m"), "%.3f m"));
  line(out, "sigma",
       labelled("east", at(gnss, "sigma_east_m"), "%.3f m") + "  " +
           labelled("north", at(gnss, "sigma_north_m"), "%.3f m"));
  line(out, "motion",
       labelled("speed", at(gnss, "speed_mps"), "%.3f m/s") + "  " +
           labelled("course", at(gnss, "course_deg"), "%.1f deg"));
  const bool told = at(gnss, "heading_age_s").number().has_value();
  line(out, "heading",
       labelled("as received", at(gnss, "receiver_heading_deg"), "%.2f deg") +
           (told ? quantity(at(gnss, "heading_age_s"), " (%.1f s old)") : "") + "  " +
           labelled("robot's, less the mounting", at(gnss, "heading_deg"), "%.2f deg"));
  show_source(out, gnss);
  return out + show_sensors(status, "gnss");
}

std::string show_imu(const Node& status) {
  const auto& imu = at(status, "imu");
  std::string out;
  line(out, "accel", vector(at(imu, "acceleration_mps2"), "%8.3f", "m/s2"));
  line(out, "gyro", vector(at(imu, "angular_velocity_radps"), "%8.4f", "rad/s"));
  line(out, "bias",
       vector(at(imu, "gyro_bias_radps"), "%8.5f", "rad/s") + "  " +
           labelled("sigma z", at(imu, "gyro_bias_sigma_radps"), "%.5f rad/s"));
  line(out, "attitude",
       labelled("roll", at(imu, "roll_rad"), "%.4f rad") + "  " +
           labelled("pitch", at(imu, "pitch_rad"), "%.4f rad"));
  line(out, "chip",
       labelled("temperature", at(imu, "temperature_degC"), "%.1f C") +
           (yes(at(imu, "saturated")) ? "  SATURATED" : ""));
  show_source(out, imu);
  return out + show_sensors(status, "imu");
}

std::string show_bms(const Node& status) {
  const auto& battery = at(status, "battery");
  std::string out;
  line(out, "charge",
       quantity(at(battery, "soc_percent"), "%.1f %%") + "  " +
           labelled("remaining", at(battery, "remaining_Ah"), "%.1f Ah") + "  " +
           text(at(battery, "flow")) +
           (yes(at(battery, "charger_connected")) ? "  CHARGER CONNECTED" : ""));
  line(out, "pack",
       quantity(at(battery, "voltage_V"), "%.2f V") + "  " +
           quantity(at(battery, "current_A"), "%.2f A") + " into it");
  line(out, "cells",
       labelled("lowest", at(battery, "min_cell_V"), "%.3f V") + "  " +
           labelled("highest", at(battery, "max_cell_V"), "%.3f V"));
  line(out, "warmth",
       labelled("cells", at(battery, "temperature_degC"), "%.1f C") + "  " +
           labelled("switch", at(battery, "mosfet_degC"), "%.1f C"));
  line(out, "alarm", text(at(battery, "alarm")).empty() ? "none" : text(at(battery, "alarm")));
  show_source(out, battery);
  return out + show_sensors(status, "battery");
}

/// A line whose label is a joint's name.
void wide(std::string& out, const std::string& label, std::string value) {
  while (!value.empty() && value.back() == ' ') value.pop_back();
  out += padded(label, 13) + " " + value + "\n";
}

std::string counter(const Node& link, const std::string& key) {
  return labelled(key, at(link, key), "%.0f") + " (" + quantity(at(link, key + "_Hz"), "%.1f/s") +
         ")  ";
}

/// One that takes a twist.
void show_whole_base(std::string& out, const Node& status) {
  const auto& base = at(status, "base");
  if (base.object() == nullptr) return;
  wide(out, "base",
       padded(text(at(base, "state")), 9) + quantity(at(base, "vx_mps"), "%7.3f m/s") + "  " +
           quantity(at(base, "wz_radps"), "%7.3f rad/s") + "  commanded " +
           quantity(at(base, "commanded_vx_mps"), "%.3f m/s") + " " +
           quantity(at(base, "commanded_wz_radps"), "%.3f rad/s") + "  " +
           labelled("bus", at(base, "bus_V"), "%.1f V") + " " +
           quantity(at(base, "bus_A"), "%.1f A"));
  std::string more = quantity(at(base, "rate_Hz"), "%.1f Hz") + "  " +
                     labelled("age", at(base, "age_s"), "%.3f s") + "  " +
                     labelled("bad", at(base, "bad"), "%.0f") + "  " + text(at(base, "health"));
  for (const auto* key : {"fault", "reason"})
    if (!text(at(base, key)).empty()) more += "  " + text(at(base, key));
  wide(out, "", more);
}

std::string show_can(const Node& status) {
  std::string out;
  if (const auto* links = at(status, "links").list()) {
    for (const auto& link : *links) {
      if (!yes(at(link, "bus"))) continue;
      wide(out, text(at(link, "name")),
           (yes(at(link, "up")) ? "up  " : "DOWN  ") + counter(link, "received") +
               counter(link, "sent") + counter(link, "dropped") + counter(link, "refused") +
               text(at(link, "reason")));
    }
  }
  show_whole_base(out, status);
  const auto* axes = at(status, "axes").list();
  if (axes == nullptr) return out;
  for (const auto& axis : *axes) {
    wide(out, text(at(axis, "joint")),
         padded(text(at(axis, "state")), 9) + quantity(at(axis, "position_rad"), "%10.3f rad") +
             "  " + quantity(at(axis, "velocity_radps"), "%7.3f rad/s") + "  " +
             quantity(at(axis, "effort_Nm"), "%6.2f Nm") + "  " +
             labelled("motor", at(axis, "motor_degC"), "%.0f C") + "  " +
             labelled("inverter", at(axis, "inverter_degC"), "%.0f C") + "  " +
             labelled("bus", at(axis, "bus_V"), "%.1f V") + " " +
             quantity(at(axis, "bus_A"), "%.1f A"));
    std::string more = quantity(at(axis, "rate_Hz"), "%.1f Hz") + "  " +
                       labelled("age", at(axis, "age_s"), "%.3f s") + "  " +
                       labelled("bad", at(axis, "bad"), "%.0f") + "  " + text(at(axis, "health"));
    for (const auto* key : {"fault", "reason"})
      if (!text(at(axis, key)).empty()) more += "  " + text(at(axis, key));
    wide(out, "", more);
  }
  return out;
}

std::string_view meaning(std::string_view line, bool active) {
  if (line == "estop") return active ? "pressed: no motion" : "released";
  if (line == "bumper") return active ? "touched" : "free";
  return active ? "occupied" : "free";
}

std::string show_gpio(const Node& status) {
  std::string out;
  if (const auto* inputs = at(status, "lines").object()) {
    for (const auto& input : *inputs) {
      const bool active = yes(at(input.node, "active"));
      std::string value = active ? "ACTIVE  " : "clear   ";
      value += padded(std::string(meaning(input.key, active)), 20) +
               padded(text(at(input.node, "health")), 12) +
               labelled("changes", at(input.node, "samples"), "%.0f");
      const auto reason = text(at(input.node, "reason"));
      line(out, input.key, reason.empty() ? value : value + "  " + reason);
    }
  }
  if (const auto* outputs = at(status, "outputs").object())
    for (const auto& output : *outputs)
      line(out, output.key + " ", yes(output.node) ? "on" : "off");
  return out;
}

constexpr std::string_view kGnssParts[] = {"gnss", "sensors"};
constexpr std::string_view kImuParts[] = {"imu", "sensors"};
constexpr std::string_view kBmsParts[] = {"battery", "sensors"};
constexpr std::string_view kCanParts[] = {"axes", "base", "links"};
constexpr std::string_view kGpioParts[] = {"lines", "outputs"};

constexpr std::array kViews{
    DeviceView{"gnss", "receiver", kGnssParts, show_gnss},
    DeviceView{"imu", "inertial sensor", kImuParts, show_imu},
    DeviceView{"bms", "battery", kBmsParts, show_bms},
    DeviceView{"can", "drive", kCanParts, show_can},
    DeviceView{"gpio", "digital input or output", kGpioParts, show_gpio},
};

}  // namespace

std::span<const DeviceView> device_views() {
  return kViews;
}

std::string missing(const DeviceView& view, const Node& status) {
  bool told = false;
  bool none = true;
  for (const auto name : view.parts) {
    const auto* part = status.find(name);
    // These are of other devices, too.
    if (part == nullptr || name == "links" || name == "sensors") continue;
    told = true;
    none = none && (part->is_null() || (part->object() != nullptr && part->object()->empty()) ||
                    (part->list() != nullptr && part->list()->empty()));
  }
  if (!told) return "this droverd does not tell of " + std::string(view.name) + ": it is older";
  if (!none) return "";
  return "not configured: there is no " + std::string(view.device) + " in droverd's configuration";
}

}  // namespace drover::cli
