#include "publish/status/status.h"

#include "drover/describe_snapshot.h"
#include "json/json_text.h"
#include "publish/names.h"
#include "publish/shown_json.h"

namespace drover::publish {

namespace {

using json::JsonText;

/// A part of the snapshot as an object; null where there is none.
template <class Part>
void object(JsonText& out, std::string_view key, const Part& part, Time now, bool there = true) {
  out.key(key);
  if (!there) {
    out.null();
    return;
  }
  ShownJson members(out, now);
  out.open('{');
  describe(members, part);
  out.close('}');
}

template <class Parts>
void list(JsonText& out, std::string_view key, const Parts& parts, Time now) {
  out.key(key).open('[');
  for (const auto& part : parts) {
    ShownJson members(out, now);
    out.open('{');
    describe(members, part);
    out.close('}');
  }
  out.close(']');
}

void axes(JsonText& out, const Snapshot& s) {
  out.key("axes").open('[');
  for (const AxisSnapshot& axis : s.axes) {
    ShownJson members(out, s.time);
    out.open('{');
    describe(members, axis);
    // Of the base there is none.
    if (axis.group > 0 && axis.group <= s.groups.size())
      members.value("group", s.groups[axis.group - 1].name, {});
    members.value("stiffness_Nmprad", axis.stiffness_Nmprad, {});
    members.value("damping_Nmsprad", axis.damping_Nmsprad, {});
    out.close('}');
  }
  out.close(']');
}

void pose(JsonText& out, const Snapshot& s) {
  ShownJson members(out, s.time);
  out.key("pose").open('{');
  describe(members, s.pose);
  members.value("vx_mps", s.worst_vx_mps, {});
  out.close('}');
}

void lines(JsonText& out, const Snapshot& s) {
  ShownJson members(out, s.time);
  out.key("lines").open('{');
  for (std::size_t i = 0; i < kLineCount; ++i) {
    if (!s.line_configured[i]) continue;
    out.key(word(static_cast<Line>(i))).open('{');
    members.value("active", s.line_active[i], {});
    members.value("health", s.line_health[i], {});
    describe(members, s.line_source[i]);
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

void count(JsonText& out, std::string_view key, std::uint64_t value) {
  out.key(key).integer(static_cast<std::int64_t>(value));
}

void cmd_vel(JsonText& out, const Snapshot& s) {
  ShownJson members(out, s.time);
  out.key("cmd_vel").open('{');
  describe(members, s.cmd_vel);
  out.close('}');
}

void joint_commands(JsonText& out, const Snapshot& s, const DaemonStatus& daemon) {
  ShownJson members(out, s.time);
  out.key("joint_commands").open('{');
  describe(members, s.joint_command);
  count(out, "unread", daemon.joint_commands_unread);
  count(out, "of_rivals", daemon.joint_commands_of_rivals);
  out.key("rivals").text(daemon.joint_commands_rivals);
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
  count(out, "scene_messages_unanswered", daemon.scene_messages_unanswered);
  out.close('}');
  if (daemon.ros2.configured) {
    out.key("ros2").open('{');
    out.key("connected").boolean(daemon.ros2.connected);
    out.key("mode").text(daemon.ros2.mode);
    out.key("network").text(daemon.ros2.network);
    out.key("unused").text(daemon.ros2.unused);
    out.key("reason").text(daemon.ros2.reason);
    out.key("readers").integer(daemon.ros2.readers);
    out.key("incompatible").integer(daemon.ros2.incompatible);
    out.key("scene").open('{');
    count(out, "done", daemon.ros2.scene_done);
    count(out, "refused", daemon.ros2.scene_refused);
    count(out, "unanswered", daemon.ros2.scene_unanswered);
    out.key("refusal").text(daemon.ros2.scene_refusal).close('}');
    out.close('}');
  }
  out.key("storage").open('{');
  out.key("stop_kept").boolean(daemon.stop_trouble.empty());
  out.key("reason").text(daemon.stop_trouble);
  out.close('}');
  out.key("cycle").open('{');
  count(out, "count", s.cycle.cycles);
  count(out, "overruns", s.cycle.overruns);
  count(out, "late_frames", s.cycle.late_frames);
  out.key("longest_step_s").number(to_s(s.cycle.longest_step));
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
  ShownJson members(out, daemon.now);
  members.value("uptime_s", daemon.uptime_s, {});
  members.value("time_s", to_s(s.time), {});
  members.value("time", s.time, {.as = "age_s"});
  out.key("stopped_until_told").boolean(s.stop_latched);
  out.key("hold").text(word(s.hold));
  out.key("why").open('[');
  for (const auto& reason : s.why) out.text(reason.view());
  if (const auto more = more_reasons(s); !more.empty()) out.text("and " + more);
  out.close(']');
  object(out, "nav", s.nav, s.time);
  cmd_vel(out, s);
  joint_commands(out, s, daemon);
  pose(out, s);
  object(out, "origin", s.origin, s.time, s.origin_set);
  // Of what the robot goes by; all that there are stand under "sensors".
  object(out, "gnss", s.gnss, s.time, s.gnss.configured);
  object(out, "imu", s.imu, s.time, s.imu.configured);
  object(out, "battery", s.battery, s.time, s.battery.configured);
  list(out, "sensors", s.sensors, s.time);
  list(out, "scanners", s.scanners, daemon.now);
  axes(out, s);
  list(out, "groups", s.groups, s.time);
  object(out, "base", s.base, s.time, s.base.configured);
  object(out, "clearance", s.clearance, s.time, s.clearance.configured);
  lines(out, s);
  outputs(out, s);
  list(out, "links", s.links, s.time);
  object(out, "estimator", s.estimator, s.time);
  daemon_part(out, s, daemon);
  out.close('}');
  return out.take();
}

}  // namespace drover::publish
