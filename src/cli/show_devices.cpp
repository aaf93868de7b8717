#include "cli/show_devices.h"

#include <array>

#include "cli/layout.h"
#include "cli/show_sensors.h"
#include "cli/shown_text.h"

namespace drover::cli {

namespace {

using json::Node;

/// Pace, age and counts: the same of every device.
void show_source(std::string& out, const Node& device) {
  line(out, "rate",
       said(device, "rate_Hz") + "  " + said("age", device, "age_s") + "  " +
           said("samples", device, "samples") + "  " + said("bad", device, "bad"));
  line(out, "health", text(at(device, "health")));
  if (!text(at(device, "reason")).empty()) line(out, "", text(at(device, "reason")));
}

/// How long ago, behind a value that came then.
std::string old(const Node& device, std::string_view name) {
  return at(device, name).number() ? said(device, name) + " old" : "-";
}

std::string show_gnss(const Node& status) {
  const auto& gnss = at(status, "gnss");
  std::string out;
  line(out, "quality",
       text(at(gnss, "quality")) + "  " + said("satellites", gnss, "satellites") + "  " +
           said("hdop", gnss, "hdop") + "  corrections " + old(gnss, "correction_age_s"));
  line(out, "position",
       said("latitude", gnss, "latitude_deg") + "  " + said("longitude", gnss, "longitude_deg") +
           "  " + said("altitude", gnss, "altitude_msl_m"));
  line(out, "sigma",
       said("east", gnss, "sigma_east_m") + "  " + said("north", gnss, "sigma_north_m"));
  line(out, "motion", said("speed", gnss, "speed_mps") + "  " + said("course", gnss, "course_deg"));
  const bool told = at(gnss, "heading_age_s").number().has_value();
  line(out, "heading",
       said("as received", gnss, "receiver_heading_deg") +
           (told ? " (" + old(gnss, "heading_age_s") + ")" : "") + "  " +
           said("robot's, less the mounting", gnss, "heading_deg"));
  show_source(out, gnss);
  return out + show_sensors(status, "gnss");
}

std::string show_imu(const Node& status) {
  const auto& imu = at(status, "imu");
  std::string out;
  line(out, "accel", said_vector(imu, "acceleration_mps2"));
  line(out, "gyro", said_vector(imu, "angular_velocity_radps"));
  line(out, "bias",
       said_vector(imu, "gyro_bias_radps") + "  " + said("sigma z", imu, "gyro_bias_sigma_radps"));
  line(out, "attitude", said("roll", imu, "roll_rad") + "  " + said("pitch", imu, "pitch_rad"));
  line(out, "chip",
       said("temperature", imu, "temperature_degC") +
           (yes(at(imu, "saturated")) ? "  SATURATED" : ""));
  show_source(out, imu);
  return out + show_sensors(status, "imu");
}

std::string show_bms(const Node& status) {
  const auto& battery = at(status, "battery");
  std::string out;
  line(out, "charge",
       said(battery, "soc_percent") + "  " + said("remaining", battery, "remaining_Ah") + "  " +
           text(at(battery, "flow")) +
           (yes(at(battery, "charger_connected")) ? "  CHARGER CONNECTED" : ""));
  line(out, "pack", said(battery, "voltage_V") + "  " + said(battery, "current_A") + " into it");
  line(out, "cells",
       said("lowest", battery, "min_cell_V") + "  " + said("highest", battery, "max_cell_V"));
  line(out, "warmth",
       said("cells", battery, "temperature_degC") + "  " + said("switch", battery, "mosfet_degC"));
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
