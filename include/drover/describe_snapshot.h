// What each part of the snapshot holds, said once, as describe.h says it of measurements.
#pragma once

#include "drover/describe.h"
#include "drover/snapshot.h"

namespace drover {

template <class V>
void describe(V& v, const Pose& pose) {
  const auto& [time, x_m, y_m, yaw_rad, vx_mps, wz_radps, vy_mps, position_sigma_m, yaw_sigma_rad] =
      pose;
  v.value("time", time);
  v.value("x_m", x_m, {.decimals = 2});
  v.value("y_m", y_m, {.decimals = 2});
  v.value("yaw_rad", yaw_rad, {.decimals = 4});
  v.value("vx_mps", vx_mps);  // people are shown the worst that anybody says: Snapshot
  v.value("wz_radps", wz_radps, {.decimals = 4});
  v.value("vy_mps", vy_mps, {.decimals = 3});
  v.value("position_sigma_m", position_sigma_m, {.decimals = 3});
  v.value("yaw_sigma_rad", yaw_sigma_rad, {.decimals = 3});
}

template <class V>
void describe(V& v, const NavSnapshot& nav) {
  const auto& [status, locate, obstacle, paused, owner, track, target_id, cross_track_m,
               distance_left_m, asked_speed_mps, metres_left, error_bound_m, owner_timeout_s] = nav;
  v.value("status", status, {});
  v.value("locate", locate, {});
  v.value("obstacle", obstacle, {});
  v.value("paused", paused, {});
  v.value("owner", owner, {});
  v.value("track", track, {});
  v.value("target_id", target_id, {});
  v.value("cross_track_m", cross_track_m, {.decimals = 3});
  v.value("distance_left_m", distance_left_m, {.decimals = 1});
  v.value("asked_speed_mps", asked_speed_mps, {.decimals = 3});
  v.value("metres_left", metres_left, {.decimals = 2});
  v.value("error_bound_m", error_bound_m, {.decimals = 3});
  v.value("owner_timeout_s", owner_timeout_s, {.decimals = 1});
}

template <class V>
void describe(V& v, const ClearanceSnapshot& clearance) {
  const auto& [configured, time, ahead_m, back_m, left_rad, right_rad, along_m, first, unknown,
               broken] = clearance;
  (void)configured;  // there is none where it is not
  v.value("time", time, {.decimals = 3, .as = "age_s"});
  v.value("ahead_m", ahead_m, {.decimals = 2});
  v.value("back_m", back_m, {.decimals = 2});
  v.value("left_rad", left_rad, {.decimals = 3});
  v.value("right_rad", right_rad, {.decimals = 3});
  v.value("along_m", along_m, {.decimals = 2});
  v.value("first", first, {});
  v.value("unknown", unknown, {});
  v.value("broken", broken, {});
}

template <class V>
void describe(V& v, const SourceSnapshot& source) {
  const auto& [reason, samples, bad, overflows] = source;
  v.value("reason", reason, {});
  v.value("samples", samples, {});
  v.value("bad", bad, {});
  v.value("overflows", overflows, {});
}

template <class V>
void describe(V& v, const EstimatorCounters& counters) {
  const auto& [absurd, late, repeated, refused, broken] = counters;
  v.value("absurd", absurd, {});
  v.value("late", late, {});
  v.value("repeated", repeated, {});
  v.value("refused", refused, {});
  v.value("broken", broken, {});
}

template <class V>
void describe(V& v, const LearnedValues& learned) {
  v.value("receiver", learned.receiver);
  v.value("imu", learned.imu);
  v.value("forgotten", learned.forgotten);
  each_learned(learned, [&v](const char* name, const LearnedValue& each) {
    v.inside(name, [&v, &each] {
      v.value("value", each.value);
      v.value("sigma", each.sigma);
    });
  });
}

template <class V>
void describe(V& v, const StreamSnapshot& stream) {
  const auto& [active, accepted, refused, reason] = stream;
  v.value("active", active, {});
  v.value("accepted", accepted, {});
  v.value("refused", refused, {});
  v.value("reason", reason, {});
}

template <class V>
void describe(V& v, const GeodeticPoint& point) {
  const auto& [latitude_deg, longitude_deg, altitude_m] = point;
  v.value("latitude_deg", latitude_deg, {.decimals = 9});
  v.value("longitude_deg", longitude_deg, {.decimals = 9});
  v.value("altitude_m", altitude_m, {.decimals = 3});
}

template <class V>
void describe(V& v, const AxisSnapshot& it) {
  const auto& [motion, last_motion, joint, group, state, fault, error_code, lapsed, powered,
               stops_all, commanded_velocity_radps, stiffness_Nmprad, damping_Nmsprad,
               inverter_degC, motor_degC, bus_V, bus_A, health, source] = it;
  (void)stiffness_Nmprad;  // these two recordings do not hold: what the drive is told is in them
  (void)damping_Nmsprad;
  (void)error_code;  // its words are in the fault
  v.value("joint", joint, {});
  v.value("group", group);  // people are shown its name
  v.inside("motion", [&v, &part = motion] { describe(v, part); });
  v.value("state", state, {});
  v.value("fault", fault, {});
  v.value("lapsed", lapsed);
  v.value("powered", powered);
  v.value("stops_all", stops_all);
  v.value("commanded_velocity_radps", commanded_velocity_radps, {.decimals = 4});
  describe(v, AxisTemperature{0, inverter_degC, motor_degC});
  describe(v, AxisSupply{0, bus_V, bus_A});
  v.value("health", health, {});
  v.inside("source", [&v, &part = source] { describe(v, part); });
  v.value("last_motion", last_motion, {.decimals = 3, .as = "age_s"});
}

template <class V>
void describe(V& v, const GroupSnapshot& group) {
  const auto& [name, owner, state, accepted, refused, limited, reason] = group;
  v.value("name", name, {});
  v.value("owner", owner, {});
  v.value("state", state, {});
  v.value("accepted", accepted, {});
  v.value("refused", refused, {});
  v.value("limited", limited, {});
  v.value("reason", reason, {});
}

template <class V>
void describe(V& v, const BaseSnapshot& base) {
  const auto& [configured, measured, steering_rad, state, fault, commanded, bus_V, bus_A, health,
               source, last_motion] = base;
  (void)configured;  // there is none where it is not
  describe(v, measured);
  v.value("steering_rad", steering_rad, {.decimals = 4});
  v.value("state", state, {});
  v.value("fault", fault, {});
  v.value("commanded_vx_mps", commanded.vx_mps, {.decimals = 3});
  v.value("commanded_wz_radps", commanded.wz_radps, {.decimals = 4});
  describe(v, AxisSupply{0, bus_V, bus_A});
  v.value("health", health, {});
  v.inside("source", [&v, &part = source] { describe(v, part); });
  v.value("last_motion", last_motion, {.decimals = 3, .as = "age_s"});
}

template <class V>
void describe(V& v, const GnssSnapshot& gnss) {
  const auto& [configured, health, source, position, position_time, velocity, velocity_time,
               receiver_heading_deg, heading_deg, heading_time, pose_heading_deg, pose_latitude_deg,
               pose_longitude_deg] = gnss;
  v.value("configured", configured);
  v.value("health", health, {});
  v.inside("source", [&v, &part = source] { describe(v, part); });
  describe_measured(v, "position", position_time, [&v, &part = position] { describe(v, part); });
  v.value("position_time", position_time, {.decimals = 3, .as = "age_s"});
  v.inside("velocity", [&v, &part = velocity] { describe(v, part); });
  v.value("receiver_heading_deg", receiver_heading_deg, {.decimals = 2});
  v.value("heading_deg", heading_deg, {.decimals = 2});
  v.value("heading_time", heading_time, {.decimals = 1, .as = "heading_age_s"});
  v.value("pose_heading_deg", pose_heading_deg);
  v.value("pose_latitude_deg", pose_latitude_deg);
  v.value("pose_longitude_deg", pose_longitude_deg);
}

template <class V>
void describe(V& v, const ImuSnapshot& imu) {
  const auto& [configured, health, source, time, sample, gyro_bias_radps, gyro_bias_sigma_radps,
               roll_rad, pitch_rad, orientation_sigma_rad, angular_velocity_sigma_radps,
               acceleration_sigma_mps2] = imu;
  v.value("configured", configured);
  v.value("health", health, {});
  v.inside("source", [&v, &part = source] { describe(v, part); });
  v.value("time", time, {.decimals = 3, .as = "age_s"});
  describe_measured(v, "sample", time, [&v, &part = sample] { describe(v, part); });
  describe_vector(v, "gyro_bias_radps", gyro_bias_radps, {.decimals = 5},
                  std::isfinite(gyro_bias_sigma_radps));
  v.value("gyro_bias_sigma_radps", gyro_bias_sigma_radps, {.decimals = 5});
  v.value("roll_rad", roll_rad, {.decimals = 4});
  v.value("pitch_rad", pitch_rad, {.decimals = 4});
  v.value("orientation_sigma_rad", orientation_sigma_rad);
  v.value("angular_velocity_sigma_radps", angular_velocity_sigma_radps);
  v.value("acceleration_sigma_mps2", acceleration_sigma_mps2);
}

template <class V>
void describe(V& v, const BatterySnapshot& battery) {
  const auto& [configured, health, source, time, sample, alarms] = battery;
  v.value("configured", configured);
  v.value("health", health, {});
  v.inside("source", [&v, &part = source] { describe(v, part); });
  v.value("time", time, {.decimals = 3, .as = "age_s"});
  describe_measured(v, "sample", time, [&v, &part = sample, &words = alarms] {
    describe(v, part);
    describe_words(v, part, words);
  });
}

template <class V>
void describe(V& v, const SensorSnapshot& sensor) {
  const auto& [kind, name, role, in_use, health, source, time, last, alarms] = sensor;
  v.value("kind", kind, {});
  v.value("name", name, {});
  v.value("role", role, {});
  v.value("in_use", in_use, {});
  v.value("health", health, {});
  v.inside("source", [&v, &part = source] { describe(v, part); });
  v.value("time", time, {.decimals = 3, .as = "age_s"});
  // Its kind does not change, and so not what it has.
  if (const auto* position = std::get_if<GnssPosition>(&last))
    describe_measured(v, "position", time, [&v, position] { describe(v, *position); });
  if (const auto* sample = std::get_if<BatterySample>(&last))
    describe_measured(v, "battery", time, [&v, sample, &words = alarms] {
      describe(v, *sample);
      describe_words(v, *sample, words);
    });
}

template <class V>
void describe(V& v, const ScannerSnapshot& scanner) {
  const auto& [name, health, source, time, turn_Hz, points, returns, nearest_m, nearest_deg] =
      scanner;
  v.value("name", name, {});
  v.value("health", health, {});
  v.inside("source", [&v, &part = source] { describe(v, part); });
  v.value("time", time, {.decimals = 3, .as = "age_s"});
  v.value("turn_Hz", turn_Hz, {.decimals = 1});
  v.value("points", points, {});
  v.value("returns", returns, {});
  v.value("nearest_m", nearest_m, {.decimals = 2});
  v.value("nearest_deg", nearest_deg, {.decimals = 0});
}

template <class V>
void describe(V& v, const LinkSnapshot& link) {
  const auto& [name, is_bus, up, reason, received, sent, dropped, refused, clamped, malformed] =
      link;
  v.value("name", name, {});
  v.value("is_bus", is_bus, {.as = "bus"});
  v.value("up", up, {});
  v.value("reason", reason, {});
  v.value("received", received, {});
  v.value("sent", sent, {});
  v.value("dropped", dropped, {});
  v.value("refused", refused, {});
  v.value("clamped", clamped, {});
  v.value("malformed", malformed, {});
}

}  // namespace drover
