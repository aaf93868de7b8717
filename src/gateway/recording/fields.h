// Every value of a cycle's output that is not a frame, byte or event, each with its name: what a
// recording holds of it, and what a replay compares.
//
// Each struct is taken apart with as many names as it has members, so that a member that is added
// does not compile until it stands here, too.
#pragma once

#include "gateway/gateway.h"

namespace drover::gateway {

/// A visitor has `value(name, v)` for numbers, flags, enums, times and texts, and
/// `inside(name, visit)` and `inside(name, index, visit)` for what has parts.
template <class V>
void visit_fields(V& v, const Pose& pose) {
  const auto& [time, x_m, y_m, yaw_rad, vx_mps, wz_radps, position_sigma_m, yaw_sigma_rad] = pose;
  v.value("time", time);
  v.value("x_m", x_m);
  v.value("y_m", y_m);
  v.value("yaw_rad", yaw_rad);
  v.value("vx_mps", vx_mps);
  v.value("wz_radps", wz_radps);
  v.value("position_sigma_m", position_sigma_m);
  v.value("yaw_sigma_rad", yaw_sigma_rad);
}

template <class V>
void visit_fields(V& v, const NavSnapshot& nav) {
  const auto& [status, locate, obstacle, paused, owner, track, target_id, cross_track_m,
               distance_left_m, asked_speed_mps, metres_left, owner_timeout_s] = nav;
  v.value("status", status);
  v.value("locate", locate);
  v.value("obstacle", obstacle);
  v.value("paused", paused);
  v.value("owner", owner);
  v.value("track", track);
  v.value("target_id", target_id);
  v.value("cross_track_m", cross_track_m);
  v.value("distance_left_m", distance_left_m);
  v.value("asked_speed_mps", asked_speed_mps);
  v.value("metres_left", metres_left);
  v.value("owner_timeout_s", owner_timeout_s);
}

template <class V>
void visit_fields(V& v, const SourceSnapshot& source) {
  const auto& [reason, samples, bad, overflows] = source;
  v.value("reason", reason);
  v.value("samples", samples);
  v.value("bad", bad);
  v.value("overflows", overflows);
}

template <class V>
void visit_fields(V& v, const EstimatorCounters& counters) {
  const auto& [absurd, late, repeated, refused, broken] = counters;
  v.value("absurd", absurd);
  v.value("late", late);
  v.value("repeated", repeated);
  v.value("refused", refused);
  v.value("broken", broken);
}

template <class V>
void visit_fields(V& v, const AxisMotion& motion) {
  const auto& [axis, position_rad, velocity_radps, effort_Nm] = motion;
  v.value("axis", axis);
  v.value("position_rad", position_rad);
  v.value("velocity_radps", velocity_radps);
  v.value("effort_Nm", effort_Nm);
}

template <class V>
void visit_fields(V& v, const AxisSnapshot& it) {
  const auto& [joint, motion, state, fault, lapsed, powered, commanded_velocity_radps,
               inverter_degC, motor_degC, bus_V, bus_A, health, source, last_motion] = it;
  v.value("joint", joint);
  v.inside("motion", [&v, &part = motion] { visit_fields(v, part); });
  v.value("state", state);
  v.value("fault", fault);
  v.value("lapsed", lapsed);
  v.value("powered", powered);
  v.value("commanded_velocity_radps", commanded_velocity_radps);
  v.value("inverter_degC", inverter_degC);
  v.value("motor_degC", motor_degC);
  v.value("bus_V", bus_V);
  v.value("bus_A", bus_A);
  v.value("health", health);
  v.inside("source", [&v, &part = source] { visit_fields(v, part); });
  v.value("last_motion", last_motion);
}

template <class V>
void visit_fields(V& v, const GnssPosition& position) {
  const auto& [latitude_deg, longitude_deg, altitude_msl_m, undulation_m, quality, satellites, hdop,
               correction_age_s, sigma_east_m, sigma_north_m] = position;
  v.value("latitude_deg", latitude_deg);
  v.value("longitude_deg", longitude_deg);
  v.value("altitude_msl_m", altitude_msl_m);
  v.value("undulation_m", undulation_m);
  v.value("quality", quality);
  v.value("satellites", satellites);
  v.value("hdop", hdop);
  v.value("correction_age_s", correction_age_s);
  v.value("sigma_east_m", sigma_east_m);
  v.value("sigma_north_m", sigma_north_m);
}

template <class V>
void visit_fields(V& v, const GnssVelocity& velocity) {
  const auto& [speed_mps, course_deg] = velocity;
  v.value("speed_mps", speed_mps);
  v.value("course_deg", course_deg);
}

template <class V>
void visit_fields(V& v, const GnssSnapshot& gnss) {
  const auto& [configured, health, source, position, position_time, velocity, receiver_heading_deg,
               heading_deg, heading_time, pose_heading_deg, pose_latitude_deg, pose_longitude_deg] =
      gnss;
  v.value("configured", configured);
  v.value("health", health);
  v.inside("source", [&v, &part = source] { visit_fields(v, part); });
  v.inside("position", [&v, &part = position] { visit_fields(v, part); });
  v.value("position_time", position_time);
  v.inside("velocity", [&v, &part = velocity] { visit_fields(v, part); });
  v.value("receiver_heading_deg", receiver_heading_deg);
  v.value("heading_deg", heading_deg);
  v.value("heading_time", heading_time);
  v.value("pose_heading_deg", pose_heading_deg);
  v.value("pose_latitude_deg", pose_latitude_deg);
  v.value("pose_longitude_deg", pose_longitude_deg);
}

template <class V>
void visit_fields(V& v, const Vector3& vector) {
  const auto& [x, y, z] = vector;
  v.value("x", x);
  v.value("y", y);
  v.value("z", z);
}

template <class V>
void visit_fields(V& v, const Quaternion& quaternion) {
  const auto& [w, x, y, z] = quaternion;
  v.value("w", w);
  v.value("x", x);
  v.value("y", y);
  v.value("z", z);
}

template <class V>
void visit_fields(V& v, const ImuSample& sample) {
  const auto& [acceleration_mps2, angular_velocity_radps, has_orientation, orientation,
               has_magnetic_field, magnetic_field, temperature_degC, saturated] = sample;
  v.inside("acceleration_mps2", [&v, &part = acceleration_mps2] { visit_fields(v, part); });
  v.inside("angular_velocity_radps",
           [&v, &part = angular_velocity_radps] { visit_fields(v, part); });
  v.value("has_orientation", has_orientation);
  v.inside("orientation", [&v, &part = orientation] { visit_fields(v, part); });
  v.value("has_magnetic_field", has_magnetic_field);
  v.inside("magnetic_field", [&v, &part = magnetic_field] { visit_fields(v, part); });
  v.value("temperature_degC", temperature_degC);
  v.value("saturated", saturated);
}

template <class V>
void visit_fields(V& v, const ImuSnapshot& imu) {
  const auto& [configured, health, source, time, sample, gyro_bias_radps, gyro_bias_sigma_radps,
               roll_rad, pitch_rad, orientation_sigma_rad, angular_velocity_sigma_radps,
               acceleration_sigma_mps2] = imu;
  v.value("configured", configured);
  v.value("health", health);
  v.inside("source", [&v, &part = source] { visit_fields(v, part); });
  v.value("time", time);
  v.inside("sample", [&v, &part = sample] { visit_fields(v, part); });
  v.inside("gyro_bias_radps", [&v, &part = gyro_bias_radps] { visit_fields(v, part); });
  v.value("gyro_bias_sigma_radps", gyro_bias_sigma_radps);
  v.value("roll_rad", roll_rad);
  v.value("pitch_rad", pitch_rad);
  v.value("orientation_sigma_rad", orientation_sigma_rad);
  v.value("angular_velocity_sigma_radps", angular_velocity_sigma_radps);
  v.value("acceleration_sigma_mps2", acceleration_sigma_mps2);
}

template <class V>
void visit_fields(V& v, const BatterySample& sample) {
  const auto& [voltage_V, current_A, soc_percent, remaining_Ah, temperature_degC, mosfet_degC,
               min_cell_V, max_cell_V, flow, charger_connected, alarm, alarm_bits, alarm_text] =
      sample;
  v.value("voltage_V", voltage_V);
  v.value("current_A", current_A);
  v.value("soc_percent", soc_percent);
  v.value("remaining_Ah", remaining_Ah);
  v.value("temperature_degC", temperature_degC);
  v.value("mosfet_degC", mosfet_degC);
  v.value("min_cell_V", min_cell_V);
  v.value("max_cell_V", max_cell_V);
  v.value("flow", flow);
  v.value("charger_connected", charger_connected);
  v.value("alarm", alarm);
  v.value("alarm_bits", alarm_bits);
  v.value("alarm_text", alarm_text);
}

template <class V>
void visit_fields(V& v, const BatterySnapshot& battery) {
  const auto& [configured, health, source, time, sample] = battery;
  v.value("configured", configured);
  v.value("health", health);
  v.inside("source", [&v, &part = source] { visit_fields(v, part); });
  v.value("time", time);
  v.inside("sample", [&v, &part = sample] { visit_fields(v, part); });
}

template <class V>
void visit_fields(V& v, const SensorSnapshot& sensor) {
  const auto& [kind, name, role, in_use, health, source, time, last] = sensor;
  v.value("kind", kind);
  v.value("name", name);
  v.value("role", role);
  v.value("in_use", in_use);
  v.value("health", health);
  v.inside("source", [&v, &part = source] { visit_fields(v, part); });
  v.value("time", time);
  // Its kind does not change, and so not what it has.
  if (const auto* position = std::get_if<GnssPosition>(&last))
    v.inside("position", [&v, position] { visit_fields(v, *position); });
  if (const auto* sample = std::get_if<BatterySample>(&last))
    v.inside("battery", [&v, sample] { visit_fields(v, *sample); });
}

template <class V>
void visit_fields(V& v, const JointCommandSnapshot& stream) {
  const auto& [active, accepted, refused, reason] = stream;
  v.value("active", active);
  v.value("accepted", accepted);
  v.value("refused", refused);
  v.value("reason", reason);
}

template <class V>
void visit_fields(V& v, const GeodeticPoint& point) {
  const auto& [latitude_deg, longitude_deg, altitude_m] = point;
  v.value("latitude_deg", latitude_deg);
  v.value("longitude_deg", longitude_deg);
  v.value("altitude_m", altitude_m);
}

template <class V, class List>
void visit_values(V& v, const char* name, const List& list) {
  for (std::size_t i = 0; i < list.size(); ++i)
    v.inside(name, i, [&v, &list, i] { v.value("", list[i]); });
}

template <class V>
void visit_fields(V& v, const BaseSnapshot& base) {
  const auto& [configured, measured, state, fault, commanded, bus_V, bus_A, health, source,
               last_motion] = base;
  (void)configured;
  v.value("vx_mps", measured.vx_mps);
  v.value("wz_radps", measured.wz_radps);
  v.value("state", state);
  v.value("fault", fault);
  v.value("commanded_vx_mps", commanded.vx_mps);
  v.value("commanded_wz_radps", commanded.wz_radps);
  v.value("bus_V", bus_V);
  v.value("bus_A", bus_A);
  v.value("health", health);
  v.inside("source", [&v, &part = source] { visit_fields(v, part); });
  v.value("last_motion", last_motion);
}

template <class V>
void visit_fields(V& v, const Snapshot& snapshot) {
  const auto& [time, pose, worst_vx_mps, nav, gnss, imu, battery, sensors, joint_command, axes,
               base, line_active, line_health, line_configured, line_source, output_configured,
               output_on, links, stop_latched, hold, guard_alive, guard_has_bus, origin_set, origin,
               why, cycle, estimator, notices_dropped] = snapshot;
  (void)links;  // those two are the loop's
  (void)cycle;
  v.value("time", time);
  v.inside("pose", [&v, &part = pose] { visit_fields(v, part); });
  v.value("worst_vx_mps", worst_vx_mps);
  v.inside("nav", [&v, &part = nav] { visit_fields(v, part); });
  v.inside("gnss", [&v, &part = gnss] { visit_fields(v, part); });
  v.inside("imu", [&v, &part = imu] { visit_fields(v, part); });
  v.inside("battery", [&v, &part = battery] { visit_fields(v, part); });
  for (std::size_t i = 0; i < sensors.size(); ++i)
    v.inside("sensors", i, [&v, &part = sensors[i]] { visit_fields(v, part); });
  v.inside("joint_command", [&v, &part = joint_command] { visit_fields(v, part); });
  for (std::size_t i = 0; i < axes.size(); ++i)
    v.inside("axes", i, [&v, &part = axes[i]] { visit_fields(v, part); });
  // It is there or not from the start on: a recording numbers its fields.
  if (base.configured) v.inside("base", [&v, &part = base] { visit_fields(v, part); });
  visit_values(v, "line_active", line_active);
  visit_values(v, "line_health", line_health);
  visit_values(v, "line_configured", line_configured);
  for (std::size_t i = 0; i < line_source.size(); ++i)
    v.inside("line_source", i, [&v, &part = line_source[i]] { visit_fields(v, part); });
  visit_values(v, "output_configured", output_configured);
  visit_values(v, "output_on", output_on);
  v.value("stop_latched", stop_latched);
  v.value("hold", hold);
  v.value("guard_alive", guard_alive);
  v.value("guard_has_bus", guard_has_bus);
  v.value("origin_set", origin_set);
  v.inside("origin", [&v, &part = origin] { visit_fields(v, part); });
  // Always as many fields: a recording numbers them.
  static constexpr Reason kNone;
  for (std::size_t i = 0; i < why.capacity(); ++i)
    v.inside("why", i, [&v, &part = i < why.size() ? why[i] : kNone] { v.value("", part); });
  v.inside("estimator", [&v, &part = estimator] { visit_fields(v, part); });
  v.value("notices_dropped", notices_dropped);
}

/// What the engine wants of the drives and outputs; `events` are told apart.
template <class V>
void visit_fields(V& v, const engine::EngineOutput& output, std::size_t axis_count) {
  const auto& [axes, base, outputs, events, motion_permitted, slowing_permitted, unsettled,
               remembered] = output;
  (void)events;
  for (std::size_t i = 0; i < axis_count; ++i) {
    v.inside("commands", i, [&v, &part = axes[i]] {
      const auto& [request, velocity_radps] = part;
      v.value("request", request);
      v.value("velocity_radps", velocity_radps);
    });
  }
  if (axis_count == 0) {  // a base that takes a twist has none
    v.inside("command", [&v, &part = base] {
      const auto& [request, twist] = part;
      v.value("request", request);
      v.value("vx_mps", twist.vx_mps);
      v.value("wz_radps", twist.wz_radps);
    });
  }
  visit_values(v, "outputs", outputs);
  v.value("motion_permitted", motion_permitted);
  visit_values(v, "slowing_permitted", slowing_permitted);
  v.value("unsettled", unsettled);
  v.inside("remembered", [&v, &part = remembered] {
    const auto& [stop, stop_at_robot, power_cut, holding, released, task, proved, joints_wait] =
        part;
    v.value("stop", stop);
    v.value("stop_at_robot", stop_at_robot);
    v.value("power_cut", power_cut);
    v.value("holding", holding);
    v.value("released", released);
    v.value("task", task);
    v.value("mechanics_proved", proved);
    v.value("joints_wait", joints_wait);
  });
}

template <class V>
void visit_fields(V& v, const Gateway& gateway) {
  const Snapshot& snapshot = gateway.snapshot();
  visit_fields(v, snapshot);
  visit_fields(v, gateway.output().engine, snapshot.axes.size());
}

}  // namespace drover::gateway
