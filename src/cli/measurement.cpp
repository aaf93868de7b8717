#include "cli/measurement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "json/json_text.h"
#include "publish/names.h"

namespace drover::cli {

namespace {

using publish::word;

/// Suffix of a value's name, and how people write that unit.
constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kUnits{{
    {"_deg", "deg"},
    {"_m", "m"},
    {"_s", "s"},
    {"_mps", "m/s"},
    {"_mps2", "m/s2"},
    {"_rad", "rad"},
    {"_radps", "rad/s"},
    {"_V", "V"},
    {"_A", "A"},
    {"_Nm", "Nm"},
    {"_Ah", "Ah"},
    {"_degC", "C"},
}};

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  char out[64];
  std::snprintf(out, sizeof out, "%.*f", decimals, value);
  // What rounds to zero is zero.
  const bool zero = std::string_view(out).find_first_of("123456789") == std::string_view::npos;
  return zero && out[0] == '-' ? out + 1 : out;
}

/// The unit that the value's name ends in; takes it off the name.
std::string unit_of(std::string_view& key) {
  for (const auto& [suffix, unit] : kUnits) {
    if (!key.ends_with(suffix)) continue;
    key.remove_suffix(suffix.size());
    return " " + std::string(unit);
  }
  return "";
}

class AsText final {
 public:
  void number(std::string_view key, double value, int decimals) {
    const auto unit = unit_of(key);
    words(key, std::isfinite(value) ? fixed(value, decimals) + unit : "");
  }
  void vector(std::string_view key, const Vector3& v, int decimals) {
    const auto unit = unit_of(key);
    words(key,
          fixed(v.x, decimals) + " " + fixed(v.y, decimals) + " " + fixed(v.z, decimals) + unit);
  }
  void words(std::string_view key, std::string_view value) {
    std::string label(key);
    std::replace(label.begin(), label.end(), '_', ' ');
    out_ += "  " + label + " " + (value.empty() ? "-" : std::string(value));
  }
  void flag(std::string_view key, bool value) { words(key, value ? "yes" : "no"); }
  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

class AsJson final {
 public:
  explicit AsJson(json::JsonText& out) : out_(out) {}
  void number(std::string_view key, double value, int) {
    out_.key(key);
    put(value);
  }
  void vector(std::string_view key, const Vector3& v, int) {
    out_.key(key).open('[');
    for (const double each : {v.x, v.y, v.z}) put(each);
    out_.close(']');
  }
  void words(std::string_view key, std::string_view value) { out_.key(key).text(value); }
  void flag(std::string_view key, bool value) { out_.key(key).boolean(value); }

 private:
  void put(double value) {
    if (std::isfinite(value)) {
      out_.number(value);
    } else {
      out_.null();
    }
  }
  json::JsonText& out_;
};

template <class V>
void visit(V& v, const AxisMotion& m) {
  v.number("position_rad", m.position_rad, 4);
  v.number("velocity_radps", m.velocity_radps, 4);
  v.number("effort_Nm", m.effort_Nm, 3);
}
template <class V>
void visit(V& v, const AxisStatus& m) {
  v.words("state", word(m.state));
  char code[24];
  std::snprintf(code, sizeof code, "0x%llX", static_cast<unsigned long long>(m.error_code));
  v.words("error_code", code);
  v.words("fault", m.reason.view());
}
template <class V>
void visit(V& v, const AxisTemperature& m) {
  v.number("inverter_degC", m.inverter_degC, 1);
  v.number("motor_degC", m.motor_degC, 1);
}
template <class V>
void visit(V& v, const AxisSupply& m) {
  v.number("bus_V", m.bus_V, 2);
  v.number("bus_A", m.bus_A, 2);
}
template <class V>
void visit(V& v, const GnssPosition& m) {
  v.words("quality", word(m.quality));
  v.number("latitude_deg", m.latitude_deg, 9);
  v.number("longitude_deg", m.longitude_deg, 9);
  v.number("altitude_msl_m", m.altitude_msl_m, 3);
  v.number("satellites", m.satellites, 0);
  v.number("hdop", m.hdop, 2);
  v.number("correction_age_s", m.correction_age_s, 1);
  v.number("sigma_east_m", m.sigma_east_m, 3);
  v.number("sigma_north_m", m.sigma_north_m, 3);
}
template <class V>
void visit(V& v, const GnssVelocity& m) {
  v.number("speed_mps", m.speed_mps, 3);
  v.number("course_deg", m.course_deg, 1);
}
template <class V>
void visit(V& v, const GnssHeading& m) {
  v.number("heading_deg", m.heading_deg, 2);
}
template <class V>
void visit(V& v, const LineState& m) {
  v.words("line", word(m.line));
  v.flag("active", m.active);
}
template <class V>
void visit(V& v, const ImuSample& m) {
  v.vector("acceleration_mps2", m.acceleration_mps2, 3);
  v.vector("angular_velocity_radps", m.angular_velocity_radps, 4);
  const auto& q = m.orientation;
  const bool known = m.has_orientation;
  v.number(
      "roll_rad",
      known ? std::atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y)) : kAbsent,
      4);
  v.number("pitch_rad",
           known ? std::asin(std::clamp(2 * (q.w * q.y - q.z * q.x), -1.0, 1.0)) : kAbsent, 4);
  v.number(
      "yaw_rad",
      known ? std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z)) : kAbsent,
      4);
  v.number("temperature_degC", m.temperature_degC, 1);
  v.flag("saturated", m.saturated);
}
template <class V>
void visit(V& v, const BatterySample& m) {
  v.number("soc_percent", m.soc_percent, 1);
  v.number("voltage_V", m.voltage_V, 2);
  v.number("current_A", m.current_A, 2);
  v.number("remaining_Ah", m.remaining_Ah, 1);
  v.number("temperature_degC", m.temperature_degC, 1);
  v.number("mosfet_degC", m.mosfet_degC, 1);
  v.number("min_cell_V", m.min_cell_V, 3);
  v.number("max_cell_V", m.max_cell_V, 3);
  v.words("flow", word(m.flow));
  v.flag("charger_connected", m.charger_connected);
  v.words("alarm", m.alarm_text.view());
}
template <class V>
void visit(V& v, const BodyMotion& m) {
  v.number("vx_mps", m.twist.vx_mps, 3);
  v.number("wz_radps", m.twist.wz_radps, 4);
  v.flag("known", m.known);
  v.flag("standing", m.standing);
}
template <class V>
void visit(V&, const std::monostate&) {}

struct Kind {
  std::string_view operator()(const std::monostate&) const { return ""; }
  std::string_view operator()(const AxisMotion&) const { return "axis_motion"; }
  std::string_view operator()(const AxisStatus&) const { return "axis_status"; }
  std::string_view operator()(const AxisTemperature&) const { return "axis_temperature"; }
  std::string_view operator()(const AxisSupply&) const { return "axis_supply"; }
  std::string_view operator()(const GnssPosition&) const { return "gnss_position"; }
  std::string_view operator()(const GnssVelocity&) const { return "gnss_velocity"; }
  std::string_view operator()(const GnssHeading&) const { return "gnss_heading"; }
  std::string_view operator()(const LineState&) const { return "line_state"; }
  std::string_view operator()(const ImuSample&) const { return "imu_sample"; }
  std::string_view operator()(const BatterySample&) const { return "battery"; }
  std::string_view operator()(const BodyMotion&) const { return "body_motion"; }
};

}  // namespace

std::string_view kind_of(const Measurement& measurement) {
  return std::visit(Kind{}, measurement.value);
}

std::string measurement_text(const Measurement& measurement, const Place& place) {
  AsText out;
  std::visit([&](const auto& value) { visit(out, value); }, measurement.value);
  std::string head = fixed(place.value, place.decimals);
  if (head.size() < 8) head.insert(0, 8 - head.size(), ' ');
  if (!place.who.empty()) head += "  " + place.who;
  return head + "  " + std::string(kind_of(measurement)) + out.take();
}

std::string measurement_json(const Measurement& measurement, const Place& place) {
  json::JsonText out;
  out.open('{').key("ok").boolean(true).key(place.key);
  if (place.decimals == 0) {
    out.integer(static_cast<std::int64_t>(place.value));
  } else {
    out.number(place.value);
  }
  if (!place.who.empty()) out.key("device").text(place.who);
  out.key("kind").text(kind_of(measurement));
  AsJson values(out);
  std::visit([&](const auto& value) { visit(values, value); }, measurement.value);
  out.close('}');
  return out.take();
}

}  // namespace drover::cli
