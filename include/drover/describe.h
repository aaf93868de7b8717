// What each measurement holds, said once: its recording, its JSON and its text all walk this.
//
// A name ends in its unit. Each struct is taken apart with as many names as it has members, so that
// a member that is added does not compile until it stands here, too.
//
// A visitor has
//   value(name, v)           kept to the bit in recordings, and shown to nobody
//   value(name, v, Shown)    shown to people and programs, too
//   inside(name, visit)      what has parts
// and, when it shows,
//   measured(name, time, visit)        its numbers are none while `time` is kNever
//   vector(name, v, Shown, known)      three numbers as one
//   derived(name, v, Shown)            what people read in place of what is kept
#pragma once

#include <algorithm>
#include <cmath>

#include "drover/fixed_text.h"
#include "drover/measurement.h"

namespace drover {

/// How a value is shown. Programs get all digits, and null for what is absent; people a dash.
struct Shown {
  int decimals = 0;          ///< of a number, for people
  const char* as = nullptr;  ///< by another name than the recording's
  bool first = false;        ///< people read it before the others
  bool hexadecimal = false;  ///< a text such as "0x1000000"
};

/// A visitor that shows nothing takes a vector apart as it does whatever has parts.
template <class V, class Visit>
void describe_measured(V& v, const char* name, Time time, const Visit& visit) {
  if constexpr (requires { v.measured(name, time, visit); }) {
    v.measured(name, time, visit);
  } else {
    v.inside(name, visit);
  }
}
template <class V>
void describe_vector(V& v, const char* name, const Vector3& vector, const Shown& shown,
                     bool known = true) {
  if constexpr (requires { v.vector(name, vector, shown, known); }) {
    v.vector(name, vector, shown, known);
  } else {
    v.inside(name, [&v, &vector] { describe(v, vector); });
  }
}
template <class V>
void describe_derived(V& v, const char* name, double value, const Shown& shown) {
  if constexpr (requires { v.derived(name, value, shown); }) v.derived(name, value, shown);
}

template <class V>
void describe(V& v, const Vector3& vector) {
  const auto& [x, y, z] = vector;
  v.value("x", x);
  v.value("y", y);
  v.value("z", z);
}

template <class V>
void describe(V& v, const Quaternion& quaternion) {
  const auto& [w, x, y, z] = quaternion;
  v.value("w", w);
  v.value("x", x);
  v.value("y", y);
  v.value("z", z);
}

template <class V>
void describe(V& v, const AxisMotion& motion) {
  const auto& [axis, position_rad, velocity_radps, effort_Nm] = motion;
  v.value("axis", axis);
  v.value("position_rad", position_rad, {.decimals = 4});
  v.value("velocity_radps", velocity_radps, {.decimals = 4});
  v.value("effort_Nm", effort_Nm, {.decimals = 3});
}

template <class V>
void describe(V& v, const AxisStatus& status) {
  const auto& [axis, state, error_code, lapsed, powered, stops_all] = status;
  v.value("axis", axis);
  v.value("state", state, {});
  v.value("error_code", error_code, {.hexadecimal = true});
  v.value("lapsed", lapsed);
  v.value("powered", powered);
  v.value("stops_all", stops_all);
}

template <class V>
void describe(V& v, const AxisTemperature& temperature) {
  const auto& [axis, inverter_degC, motor_degC] = temperature;
  (void)axis;  // whose it is stands above it
  v.value("inverter_degC", inverter_degC, {.decimals = 1});
  v.value("motor_degC", motor_degC, {.decimals = 1});
}

template <class V>
void describe(V& v, const AxisSupply& supply) {
  const auto& [axis, bus_V, bus_A] = supply;
  (void)axis;
  v.value("bus_V", bus_V, {.decimals = 2});
  v.value("bus_A", bus_A, {.decimals = 2});
}

template <class V>
void describe(V& v, const GnssPosition& position) {
  const auto& [latitude_deg, longitude_deg, altitude_msl_m, undulation_m, quality, satellites, hdop,
               correction_age_s, sigma_east_m, sigma_north_m, sigma_up_m] = position;
  (void)sigma_up_m;  // nothing on the ground goes by it
  v.value("latitude_deg", latitude_deg, {.decimals = 9});
  v.value("longitude_deg", longitude_deg, {.decimals = 9});
  v.value("altitude_msl_m", altitude_msl_m, {.decimals = 3});
  v.value("undulation_m", undulation_m);
  v.value("quality", quality, {.first = true});
  v.value("satellites", satellites, {});
  v.value("hdop", hdop, {.decimals = 2});
  v.value("correction_age_s", correction_age_s, {.decimals = 1});
  v.value("sigma_east_m", sigma_east_m, {.decimals = 3});
  v.value("sigma_north_m", sigma_north_m, {.decimals = 3});
}

template <class V>
void describe(V& v, const GnssVelocity& velocity) {
  const auto& [speed_mps, course_deg] = velocity;
  v.value("speed_mps", speed_mps, {.decimals = 3});
  v.value("course_deg", course_deg, {.decimals = 1});
}

template <class V>
void describe(V& v, const GnssHeading& heading) {
  const auto& [heading_deg] = heading;
  v.value("heading_deg", heading_deg, {.decimals = 2});
}

template <class V>
void describe(V& v, const LineState& state) {
  const auto& [line, active] = state;
  v.value("line", line, {});
  v.value("active", active, {});
}

/// Roll, pitch and yaw of `q`, as people read an orientation.
template <class V>
void describe_attitude(V& v, const Quaternion& q, bool known) {
  const auto shown = [&v, known](const char* name, double angle_rad) {
    describe_derived(v, name, known ? angle_rad : kAbsent, {.decimals = 4});
  };
  shown("roll_rad", std::atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y)));
  shown("pitch_rad", std::asin(std::clamp(2 * (q.w * q.y - q.z * q.x), -1.0, 1.0)));
  shown("yaw_rad", std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z)));
}

template <class V>
void describe(V& v, const ImuSample& sample) {
  const auto& [acceleration_mps2, angular_velocity_radps, has_orientation, orientation,
               has_magnetic_field, magnetic_field, temperature_degC, saturated] = sample;
  describe_vector(v, "acceleration_mps2", acceleration_mps2, {.decimals = 3});
  describe_vector(v, "angular_velocity_radps", angular_velocity_radps, {.decimals = 4});
  v.value("has_orientation", has_orientation);
  v.inside("orientation", [&v, &part = orientation] { describe(v, part); });
  if constexpr (requires { v.derived("", 0.0, Shown{}); })
    describe_attitude(v, orientation, has_orientation);
  v.value("has_magnetic_field", has_magnetic_field);
  v.inside("magnetic_field", [&v, &part = magnetic_field] { describe(v, part); });
  v.value("temperature_degC", temperature_degC, {.decimals = 1});
  v.value("saturated", saturated, {});
}

template <class V>
void describe(V& v, const BatterySample& sample) {
  const auto& [voltage_V, current_A, soc_percent, remaining_Ah, temperature_degC, mosfet_degC,
               min_cell_V, max_cell_V, flow, charger_connected, charges, alarm, alarm_bits] =
      sample;
  v.value("voltage_V", voltage_V, {.decimals = 2});
  v.value("current_A", current_A, {.decimals = 2});
  v.value("soc_percent", soc_percent, {.decimals = 1, .first = true});
  v.value("remaining_Ah", remaining_Ah, {.decimals = 1});
  v.value("temperature_degC", temperature_degC, {.decimals = 1});
  v.value("mosfet_degC", mosfet_degC, {.decimals = 1});
  v.value("min_cell_V", min_cell_V, {.decimals = 3});
  v.value("max_cell_V", max_cell_V, {.decimals = 3});
  v.value("flow", flow, {});
  v.value("charger_connected", charger_connected, {});
  v.value("charges", charges, {});
  v.value("alarm", alarm);
  v.value("alarm_bits", alarm_bits);
}

/// What its device says of it in words, behind it.
template <class V>
void describe_words(V& v, const AxisStatus&, const Reason& words) {
  v.value("fault", words, {});
}
template <class V>
void describe_words(V& v, const BatterySample&, const Reason& words) {
  v.value("alarm_text", words, {.as = "alarm"});
}
template <class V, class T>
void describe_words(V&, const T&, const Reason&) {}

template <class V>
void describe(V& v, const Twist& twist) {
  const auto& [vx_mps, wz_radps, vy_mps] = twist;
  (void)vy_mps;  // what tells or takes a twist does not go sideways
  v.value("vx_mps", vx_mps, {.decimals = 3});
  v.value("wz_radps", wz_radps, {.decimals = 4});
}

template <class V>
void describe(V& v, const BodyMotion& motion) {
  const auto& [twist, vx_var, wz_var, vy_var, known, standing, steering_rad] = motion;
  (void)vy_var;
  describe(v, twist);
  v.value("vx_var", vx_var);
  v.value("wz_var", wz_var);
  v.value("known", known, {});
  v.value("standing", standing, {});
  v.value("steering_rad", steering_rad, {.decimals = 4});
}

template <class V>
void describe(V&, const std::monostate&) {}

/// "axis_motion", "gnss_position", ... as programs tell measurements apart.
struct KindOfMeasurement {
  constexpr const char* operator()(const std::monostate&) const { return ""; }
  constexpr const char* operator()(const AxisMotion&) const { return "axis_motion"; }
  constexpr const char* operator()(const AxisStatus&) const { return "axis_status"; }
  constexpr const char* operator()(const AxisTemperature&) const { return "axis_temperature"; }
  constexpr const char* operator()(const AxisSupply&) const { return "axis_supply"; }
  constexpr const char* operator()(const GnssPosition&) const { return "gnss_position"; }
  constexpr const char* operator()(const GnssVelocity&) const { return "gnss_velocity"; }
  constexpr const char* operator()(const GnssHeading&) const { return "gnss_heading"; }
  constexpr const char* operator()(const LineState&) const { return "line_state"; }
  constexpr const char* operator()(const ImuSample&) const { return "imu_sample"; }
  constexpr const char* operator()(const BatterySample&) const { return "battery"; }
  constexpr const char* operator()(const BodyMotion&) const { return "body_motion"; }
};

}  // namespace drover
