#include "publish/status/status.h"

#include <cmath>

#include "json/json_text.h"
#include "publish/names.h"
#include "publish/rtk_navigation/spelling.h"

namespace drover::publish {

namespace {

using json::JsonText;

void number(JsonText& out, std::string_view key, double value) {
  out.key(key);
  if (std::isfinite(value)) {
    out.number(value);
  } else {
    out.null();
  }
}

void age(JsonText& out, std::string_view key, Time now, Time then) {
  number(out, key, then == kNever ? kAbsent : to_s(now - then));
}

void pose(JsonText& out, const Snapshot& s) {
  out.key("pose").open('{');
  number(out, "x_m", s.pose.x_m);
  number(out, "y_m", s.pose.y_m);
  number(out, "yaw_rad", s.pose.yaw_rad);
  number(out, "vx_mps", s.worst_vx_mps);
  number(out, "wz_radps", s.pose.wz_radps);
  number(out, "position_sigma_m", s.pose.position_sigma_m);
  number(out, "yaw_sigma_rad", s.pose.yaw_sigma_rad);
  out.close('}');
}

void nav(JsonText& out, const Snapshot& s) {
  out.key("nav").open('{');
  out.key("status").text(spelling(s.nav.status));
  out.key("locate").text(spelling(s.nav.locate));
  out.key("obstacle").boolean(s.nav.obstacle);
  out.key("paused").boolean(s.nav.paused);
  out.key("owner").text(word(s.nav.owner));
  number(out, "owner_timeout_s", s.nav.owner_timeout_s);
  out.key("track").text(s.nav.track.view());
  out.key("target_id").integer(s.nav.target_id);
  number(out, "cross_track_m", s.nav.cross_track_m);
  number(out, "distance_left_m", s.nav.distance_left_m);
  number(out, "asked_speed_mps", s.nav.asked_speed_mps);
  number(out, "metres_left", s.nav.metres_left);
  out.close('}');
}

void source(JsonText& out, const SourceSnapshot& from) {
  out.key("reason").text(from.reason.view());
  out.key("samples").integer(static_cast<std::int64_t>(from.samples));
  out.key("bad").integer(static_cast<std::int64_t>(from.bad));
  out.key("overflows").integer(static_cast<std::int64_t>(from.overflows));
}

void vector(JsonText& out, std::string_view key, const Vector3& v) {
  out.key(key).open('[');
  for (const double each : {v.x, v.y, v.z}) {
    if (std::isfinite(each)) {
      out.number(each);
    } else {
      out.null();
    }
  }
  out.close(']');
}

void gnss(JsonText& out, const Snapshot& s) {
  out.key("gnss");
  if (!s.gnss.configured) {
    out.null();
    return;
  }
  out.open('{');
  out.key("health").text(word(s.gnss.health));
  out.key("quality").text(word(s.gnss.position.quality));
  number(out, "latitude_deg", s.gnss.position.latitude_deg);
  number(out, "longitude_deg", s.gnss.position.longitude_deg);
  number(out, "altitude_msl_m", s.gnss.position.altitude_msl_m);
  number(out, "sigma_east_m", s.gnss.position.sigma_east_m);
  number(out, "sigma_north_m", s.gnss.position.sigma_north_m);
  number(out, "speed_mps", s.gnss.velocity.speed_mps);
  number(out, "course_deg", s.gnss.velocity.course_deg);
  number(out, "receiver_heading_deg", s.gnss.receiver_heading_deg);
  number(out, "heading_deg", s.gnss.heading_deg);
  age(out, "heading_age_s", s.time, s.gnss.heading_time);
  number(out, "satellites", s.gnss.position_time == kNever ? kAbsent : s.gnss.position.satellites);
  number(out, "hdop", s.gnss.position.hdop);
  number(out, "correction_age_s", s.gnss.position.correction_age_s);
  age(out, "age_s", s.time, s.gnss.position_time);
  source(out, s.gnss.source);
  out.close('}');
}

void imu(JsonText& out, const Snapshot& s) {
  out.key("imu");
  if (!s.imu.configured) {
    out.null();
    return;
  }
  // Before the first sample its numbers are nothing, not zero.
  constexpr Vector3 kNothing{kAbsent, kAbsent, kAbsent};
  const ImuSample& sample = s.imu.sample;
  const bool heard = s.imu.time != kNever;
  const bool learned = std::isfinite(s.imu.gyro_bias_sigma_radps);
  out.open('{');
  out.key("health").text(word(s.imu.health));
  vector(out, "acceleration_mps2", heard ? sample.acceleration_mps2 : kNothing);
  vector(out, "angular_velocity_radps", heard ? sample.angular_velocity_radps : kNothing);
  vector(out, "gyro_bias_radps", learned ? s.imu.gyro_bias_radps : kNothing);
  number(out, "gyro_bias_sigma_radps", s.imu.gyro_bias_sigma_radps);
  number(out, "roll_rad", s.imu.roll_rad);
  number(out, "pitch_rad", s.imu.pitch_rad);
  number(out, "temperature_degC", sample.temperature_degC);
  out.key("saturated").boolean(sample.saturated);
  age(out, "age_s", s.time, s.imu.time);
  source(out, s.imu.source);
  out.close('}');
}

void battery(JsonText& out, const Snapshot& s) {
  out.key("battery");
  if (!s.battery.configured) {
    out.null();
    return;
  }
  const BatterySample& sample = s.battery.sample;
  out.open('{');
  out.key("health").text(word(s.battery.health));
  number(out, "soc_percent", sample.soc_percent);
  number(out, "voltage_V", sample.voltage_V);
  number(out, "current_A", sample.current_A);
  number(out, "remaining_Ah", sample.remaining_Ah);
  number(out, "temperature_degC", sample.temperature_degC);
  number(out, "mosfet_degC", sample.mosfet_degC);
  number(out, "min_cell_V", sample.min_cell_V);
  number(out, "max_cell_V", sample.max_cell_V);
  out.key("flow").text(word(sample.flow));
  out.key("charger_connected").boolean(sample.charger_connected);
  out.key("alarm").text(sample.alarm_text.view());
  age(out, "age_s", s.time, s.battery.time);
  source(out, s.battery.source);
  out.close('}');
}

/// All of them, also those whose values stand under "gnss", "imu" and "battery".
void sensors(JsonText& out, const Snapshot& s) {
  out.key("sensors").open('[');
  for (const auto& sensor : s.sensors) {
    out.open('{');
    out.key("kind").text(word(sensor.kind));
    out.key("name").text(sensor.name.view());
    out.key("role").text(word(sensor.role));
    out.key("in_use").boolean(sensor.in_use);
    out.key("health").text(word(sensor.health));
    const bool heard = sensor.time != kNever;
    if (const auto* position = std::get_if<GnssPosition>(&sensor.last)) {
      out.key("quality").text(word(position->quality));
      number(out, "latitude_deg", position->latitude_deg);
      number(out, "longitude_deg", position->longitude_deg);
      number(out, "satellites", heard ? position->satellites : kAbsent);
      number(out, "correction_age_s", position->correction_age_s);
    }
    if (const auto* sample = std::get_if<BatterySample>(&sensor.last)) {
      number(out, "soc_percent", sample->soc_percent);
      number(out, "voltage_V", sample->voltage_V);
      number(out, "current_A", sample->current_A);
      number(out, "temperature_degC", sample->temperature_degC);
      out.key("charger_connected").boolean(sample->charger_connected);
      out.key("alarm").text(sample->alarm_text.view());
    }
    age(out, "age_s", s.time, sensor.time);
    source(out, sensor.source);
    out.close('}');
  }
  out.close(']');
}

void axes(JsonText& out, const Snapshot& s) {
  out.key("axes").open('[');
  for (const auto& axis : s.axes) {
    out.open('{');
    out.key("joint").text(axis.joint.view());
    out.key("state").text(word(axis.state));
    out.key("health").text(word(axis.health));
    out.key("fault").text(axis.fault.view());
    number(out, "position_rad", axis.motion.position_rad);
    number(out, "velocity_radps", axis.motion.velocity_radps);
    number(out, "commanded_velocity_radps", axis.commanded_velocity_radps);
    number(out, "effort_Nm", axis.motion.effort_Nm);
    number(out, "inverter_degC", axis.inverter_degC);
    number(out, "motor_degC", axis.motor_degC);
    number(out, "bus_V", axis.bus_V);
    number(out, "bus_A", axis.bus_A);
    age(out, "age_s", s.time, axis.last_motion);
    source(out, axis.source);
    out.close('}');
  }
  out.close(']');
}

/// A base that takes a twist.
void base(JsonText& out, const Snapshot& s) {
  out.key("base");
  if (!s.base.configured) {
    out.null();
    return;
  }
  out.open('{');
  out.key("state").text(word(s.base.state));
  out.key("health").text(word(s.base.health));
  out.key("fault").text(s.base.fault.view());
  number(out, "vx_mps", s.base.measured.vx_mps);
  number(out, "wz_radps", s.base.measured.wz_radps);
  number(out, "commanded_vx_mps", s.base.commanded.vx_mps);
  number(out, "commanded_wz_radps", s.base.commanded.wz_radps);
  number(out, "bus_V", s.base.bus_V);
  number(out, "bus_A", s.base.bus_A);
  age(out, "age_s", s.time, s.base.last_motion);
  source(out, s.base.source);
  out.close('}');
}

void lines(JsonText& out, const Snapshot& s) {
  out.key("lines").open('{');
  for (std::size_t i = 0; i < kLineCount; ++i) {
    if (!s.line_configured[i]) continue;
    out.key(word(static_cast<Line>(i))).open('{');
    out.key("active").boolean(s.line_active[i]);
    out.key("health").text(word(s.line_health[i]));
    source(out, s.line_source[i]);
    out.close('}');
  }
  out.close('}');
}

void outputs(JsonText& out, const Snapshot& s) {
  out.key("outputs").open('{');
  for (std::size_t i = 0; i < kOutputCount; ++i) {
    if (!s.output_configured[i]) continue;
    out.key(word(static_cast<Output>(i))).boolean(s.output_on[i]);
  }
  out.close('}');
}

void links(JsonText& out, const Snapshot& s) {
  out.key("links").open('[');
  for (const auto& link : s.links) {
    out.open('{');
    out.key("name").text(link.name.view());
    out.key("bus").boolean(link.is_bus);
    out.key("up").boolean(link.up);
    out.key("reason").text(link.reason.view());
    out.key("received").integer(static_cast<std::int64_t>(link.received));
    out.key("sent").integer(static_cast<std::int64_t>(link.sent));
    out.key("dropped").integer(static_cast<std::int64_t>(link.dropped));
    out.key("refused").integer(static_cast<std::int64_t>(link.refused));
    out.key("clamped").integer(static_cast<std::int64_t>(link.clamped));
    out.key("malformed").integer(static_cast<std::int64_t>(link.malformed));
    out.close('}');
  }
  out.close(']');
}

void origin(JsonText& out, const Snapshot& s) {
  out.key("origin");
  if (!s.origin_set) {
    out.null();
    return;
  }
  out.open('{');
  number(out, "latitude_deg", s.origin.latitude_deg);
  number(out, "longitude_deg", s.origin.longitude_deg);
  number(out, "altitude_m", s.origin.altitude_m);
  out.close('}');
}

void count(JsonText& out, std::string_view key, std::uint64_t value) {
  out.key(key).integer(static_cast<std::int64_t>(value));
}

void joint_commands(JsonText& out, const JointCommandSnapshot& s, const DaemonStatus& daemon) {
  out.key("joint_commands").open('{');
  out.key("active").boolean(s.active);
  count(out, "accepted", s.accepted);
  count(out, "refused", s.refused);
  count(out, "unread", daemon.joint_commands_unread);
  count(out, "of_rivals", daemon.joint_commands_of_rivals);
  out.key("rivals").text(daemon.joint_commands_rivals);
  out.key("reason").text(s.reason.view());
  out.close('}');
}

void estimator(JsonText& out, const EstimatorCounters& counters) {
  out.key("estimator").open('{');
  count(out, "absurd", counters.absurd);
  count(out, "late", counters.late);
  count(out, "repeated", counters.repeated);
  count(out, "refused", counters.refused);
  count(out, "broken", counters.broken);
  out.close('}');
}

void daemon_part(JsonText& out, const Snapshot& s, const DaemonStatus& daemon) {
  out.key("guard").open('{');
  out.key("alive").boolean(s.guard_alive);
  out.key("has_bus").boolean(s.guard_has_bus);
  out.close('}');
  out.key("broker").open('{');
  out.key("connected").boolean(daemon.broker_connected);
  out.key("reason").text(daemon.broker_text);
  count(out, "dropped", daemon.telemetry_dropped);
  count(out, "answers_lost", daemon.answers_lost);
  out.close('}');
  out.key("storage").open('{');
  out.key("stop_kept").boolean(daemon.stop_trouble.empty());
  out.key("reason").text(daemon.stop_trouble);
  out.close('}');
  out.key("cycle").open('{');
  out.key("count").integer(static_cast<std::int64_t>(s.cycle.cycles));
  out.key("overruns").integer(static_cast<std::int64_t>(s.cycle.overruns));
  out.key("late_frames").integer(static_cast<std::int64_t>(s.cycle.late_frames));
  number(out, "longest_step_s", to_s(s.cycle.longest_step));
  count(out, "events_lost", daemon.events_lost);
  count(out, "notices_dropped", s.notices_dropped);
  out.close('}');
}

}  // namespace

std::string status_json(const Snapshot& s, const DaemonStatus& daemon) {
  JsonText out;
  out.open('{');
  out.key("robot").text(daemon.robot);
  out.key("version").text(DROVER_VERSION);
  number(out, "uptime_s", daemon.uptime_s);
  number(out, "time_s", to_s(s.time));
  number(out, "age_s", s.time == kNever ? kAbsent : to_s(daemon.now - s.time));
  out.key("stopped_until_told").boolean(s.stop_latched);
  out.key("hold").text(word(s.hold));
  out.key("why").open('[');
  for (const auto& reason : s.why) out.text(reason.view());
  out.close(']');
  nav(out, s);
  joint_commands(out, s.joint_command, daemon);
  pose(out, s);
  origin(out, s);
  gnss(out, s);
  imu(out, s);
  sensors(out, s);
  battery(out, s);
  axes(out, s);
  base(out, s);
  lines(out, s);
  outputs(out, s);
  links(out, s);
  estimator(out, s.estimator);
  daemon_part(out, s, daemon);
  out.close('}');
  return out.take();
}

}  // namespace drover::publish
