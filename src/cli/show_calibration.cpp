#include "cli/show_calibration.h"

#include <array>
#include <cstdio>

#include "cli/shown_text.h"
#include "drover/angle.h"
#include "json/json_text.h"

namespace drover::cli {
namespace {

using calibrate::Calibration;
using calibrate::DriveFacts;
using calibrate::Found;
using calibrate::kQuantities;
using calibrate::SpeedSource;

struct Named {
  const char* name;
  int decimals;
};
/// By Quantity.
constexpr std::array<Named, kQuantities> kNamed{{{"wheel_radius_m", 5},
                                                 {"left_wheel_radius_m", 5},
                                                 {"right_wheel_radius_m", 5},
                                                 {"yaw_slip_factor", 3},
                                                 {"antenna_x_m", 3},
                                                 {"antenna_y_m", 3},
                                                 {"heading_baseline_offset_deg", 2},
                                                 {"position_late_s", 3},
                                                 {"heading_late_s", 3},
                                                 {"gyro_scale", 4},
                                                 {"gyro_bias_radps", 5},
                                                 {"drive_lag_s", 3},
                                                 {"receiver_speed_late_s", 3}}};

/// Of a base that tells a twist, whose edges stand for wheels of a metre.
constexpr std::array<Named, 3> kNamedOfTwist{
    {{"way_scale", 4}, {"left_way_scale", 4}, {"right_way_scale", 4}}};

const Named& named(const Found& found, bool twist) {
  const auto which = static_cast<std::size_t>(found.what);
  return twist && which < kNamedOfTwist.size() ? kNamedOfTwist[which] : kNamed[which];
}

const char* name_of(SpeedSource source) {
  switch (source) {
    case SpeedSource::own: return "own";
    case SpeedSource::positions: return "positions";
    case SpeedSource::unknown: break;
  }
  return "unknown";
}

std::string facts_text(const DriveFacts& facts) {
  return "drive     " + fixed(facts.duration_s, 0) + " s  way " + fixed(facts.way_m, 1) +
         " m, of it straight " + fixed(facts.straight_m, 1) + " m  turned left " +
         fixed(to_deg(facts.left_rad), 0) + " deg, right " + fixed(to_deg(facts.right_rad), 0) +
         " deg\nreceiver  positions " + std::to_string(facts.places) + "  scatter " +
         fixed(100 * facts.place_white_m, 1) + " cm, slowly " + fixed(100 * facts.place_slow_m, 1) +
         " cm  outliers " + std::to_string(facts.outliers) + "\n";
}

std::string line_of(const Found& found, bool twist) {
  const auto& [name, decimals] = named(found, twist);
  char text[160];
  const std::string was = found.has_configured ? fixed(found.configured, decimals) : "";
  if (!found.refused.empty()) {
    std::snprintf(text, sizeof text, "%-28s %9s    %9s  %9s  ", name, "-", "", was.c_str());
    return text + found.refused + "\n";
  }
  std::snprintf(text, sizeof text, "%-28s %9s +- %9s  %9s\n", name,
                fixed(found.value, decimals).c_str(), fixed(found.interval, decimals).c_str(),
                was.c_str());
  return text;
}

std::string signs_text(const calibrate::Signs& signs) {
  if (!signs.refused.empty()) return "signs     unknown: " + signs.refused + "\n";
  return signs.wrong() ? "signs     WRONG, see below; the values are those with it put right\n"
                       : "signs     right\n";
}

void write_facts(json::JsonText& out, const DriveFacts& facts) {
  out.key("drive").open('{');
  out.key("duration_s").number(facts.duration_s, 1).key("way_m").number(facts.way_m, 2);
  out.key("straight_m").number(facts.straight_m, 2);
  out.key("left_deg").number(to_deg(facts.left_rad), 0);
  out.key("right_deg").number(to_deg(facts.right_rad), 0);
  out.key("positions").integer(static_cast<std::int64_t>(facts.places));
  out.key("outliers").integer(static_cast<std::int64_t>(facts.outliers));
  out.key("position_scatter_m").number(facts.place_white_m, 4);
  out.key("position_slow_m").number(facts.place_slow_m, 4).close('}');
}

void write_signs(json::JsonText& out, const calibrate::Signs& signs) {
  out.key("signs").open('{').key("known").boolean(signs.refused.empty());
  if (!signs.refused.empty()) out.key("reason").text(signs.refused);
  out.key("left_reversed").boolean(signs.left_reversed);
  out.key("right_reversed").boolean(signs.right_reversed);
  out.key("swapped").boolean(signs.swapped);
  out.key("gyro_reversed").boolean(signs.gyro_reversed);
  out.key("heading_opposite").boolean(signs.heading_opposite).close('}');
}

void write_found(json::JsonText& out, const Found& found, bool twist) {
  const auto& [name, decimals] = named(found, twist);
  out.key(name).open('{');
  if (found.refused.empty()) {
    out.key("value").number(found.value, decimals + 1);
    out.key("interval").number(found.interval, decimals + 1);
  } else {
    out.key("value").null().key("interval").null().key("reason").text(found.refused);
  }
  if (found.has_configured) out.key("configured").number(found.configured);
  out.close('}');
}

}  // namespace

const char* name_of(calibrate::Quantity what, bool twist_base) {
  Found found;
  found.what = what;
  return named(found, twist_base).name;
}

std::string show_calibration(const Calibration& it, const CalibrationKeys& keys) {
  std::string text = facts_text(it.facts) + signs_text(it.signs);
  text += "                                 found     interval  configured\n";
  for (const Found& found : it.found) text += line_of(found, keys.twist_base);
  text += std::string("speed     ");
  if (it.speed_source == SpeedSource::unknown) {
    text += "whether the receiver measures it by itself is not known: " + it.speed_source_refused;
  } else {
    text += it.speed_source == SpeedSource::own ? "the receiver's own" : "made of positions";
  }
  text += "\n";
  for (const auto& note : calibration_notes(it, keys)) text += "look      " + note + "\n";
  const auto patch = calibration_patch(it, keys);
  return text + (patch.empty() ? "patch     nothing is off by more than its interval\n"
                               : "patch     of drover.json, to be reviewed:\n" + patch + "\n");
}

std::string calibration_json(const Calibration& it, const CalibrationKeys& keys) {
  json::JsonText out;
  out.open('{').key("ok").boolean(true);
  write_facts(out, it.facts);
  write_signs(out, it.signs);
  out.key("values").open('{');
  for (const Found& found : it.found) write_found(out, found, keys.twist_base);
  out.close('}').key("receiver_speed").text(name_of(it.speed_source));
  out.key("notes").open('[');
  for (const auto& note : calibration_notes(it, keys)) out.text(note);
  out.close(']');
  const auto patch = calibration_patch(it, keys);
  return out.take() + ",\"patch\":" + (patch.empty() ? "{}" : patch) + "}";
}

}  // namespace drover::cli
