#include "cli/show.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/layout.h"
#include "cli/show_sensors.h"
#include "drover/angle.h"

namespace drover::cli {

namespace {

using json::Node;

void show_why(std::string& out, const Node& status) {
  const auto* why = at(status, "why").list();
  if (why == nullptr) return;
  for (std::size_t i = 0; i < why->size(); ++i) line(out, i == 0 ? "why" : "", text((*why)[i]));
}

void show_nav(std::string& out, const Node& status) {
  const auto& nav = at(status, "nav");
  std::string task = text(at(nav, "status"));
  if (yes(at(nav, "paused"))) task += ", paused";
  if (yes(at(nav, "obstacle"))) task += ", obstacle";
  if (!text(at(nav, "track")).empty()) {
    task += "  track \"" + text(at(nav, "track")) + "\" to point " +
            quantity(at(nav, "target_id"), "%.0f") + ", " +
            quantity(at(nav, "distance_left_m"), "%.1f m left") + ", " +
            quantity(at(nav, "cross_track_m"), "%.3f m beside it");
  }
  line(out, "task", task);
  std::string owner = text(at(nav, "owner"));
  // Of the others nobody sends messages: their time-out is the gateway's own.
  if ((owner == "joint_command" || owner == "cmd_vel") && at(nav, "owner_timeout_s").number())
    owner += quantity(at(nav, "owner_timeout_s"), ", stops %.1f s after its last message");
  line(out, "owner", owner);
  line(out, "located", text(at(nav, "locate")));
}

/// A source that was never heard has no values, whatever stands in their place.
bool never_heard(const Node& source) {
  return text(at(source, "health")) == "never heard";
}

/// What is said instead of the values: "-  never heard  no line to it".
std::string nothing_heard(const Node& source) {
  const auto reason = text(at(source, "reason"));
  return "-  never heard" + (reason.empty() ? "" : "  " + reason);
}

/// " (gripper)": whose joint a reason names; nothing where that is one of the base, or none.
std::string group_named(const Node& status, const std::string& reason) {
  const auto* axes = at(status, "axes").list();
  if (axes == nullptr) return "";
  for (const auto& axis : *axes) {
    const auto group = text(at(axis, "group"));
    if (!group.empty() && reason.starts_with("joint '" + text(at(axis, "joint")) + "'"))
      return " (" + group + ")";
  }
  return "";
}

/// A stream that a program drives by: nothing where nobody ever sent one. `of`: whose messages are
/// refused here.
void show_stream(std::string& out, const Node& status, const char* name, const char* key,
                 const std::string& of = ", ") {
  const Node& stream = at(status, key);
  const auto some = [&](const char* which) { return at(stream, which).number().value_or(0) > 0; };
  if (!some("accepted") && !some("refused") && !some("unread")) return;
  std::string value = yes(at(stream, "active")) ? "heard" : "silent";
  value += quantity(at(stream, "accepted"), ", %.0f followed") + of +
           quantity(at(stream, "refused"), "%.0f refused");
  if (some("unread")) value += quantity(at(stream, "unread"), ", %.0f of a flood not read");
  if (some("of_rivals")) value += quantity(at(stream, "of_rivals"), ", %.0f of a second program");
  const auto reason = text(at(stream, "reason"));
  if (!reason.empty()) value += ", last" + group_named(status, reason) + ": " + reason;
  line(out, name, value);
}

/// Those of a group's joints that nobody could follow are refused before it is looked whose they
/// are, and counted with the wheels'.
void show_joint_commands(std::string& out, const Node& status) {
  if (count(at(status, "groups")) > 0)
    show_stream(out, status, "wheels", "joint_commands", "; of all joints ");
  else
    show_stream(out, status, "joints", "joint_commands");
}

/// A yaw that nobody knows yet is no number.
std::string shown_yaw(const Node& pose) {
  constexpr double kKnown_rad = 0.5;  // of one sigma
  const auto sigma_rad = at(pose, "yaw_sigma_rad").number();
  return sigma_rad && *sigma_rad < kKnown_rad ? quantity(at(pose, "yaw_rad"), "%.3f rad") : "-";
}

/// To the left, of a base that goes there just now.
std::string aside(const Node& pose) {
  const double mps = at(pose, "vy_mps").number().value_or(0);
  return std::abs(mps) < 0.005 ? "" : quantity(at(pose, "vy_mps"), "  aside %.2f m/s");
}

void show_place(std::string& out, const Node& status) {
  const auto& pose = at(status, "pose");
  // Before the first fix the pose counts from where droverd was started: that is no place.
  if (at(pose, "position_sigma_m").number().has_value()) {
    line(out, "pose",
         quantity(at(pose, "x_m"), "x %.2f m") + quantity(at(pose, "y_m"), "  y %.2f m") +
             "  yaw " + shown_yaw(pose) + quantity(at(pose, "position_sigma_m"), "  +- %.3f m"));
  } else {
    line(out, "pose", "-");
  }
  line(out, "speed",
       quantity(at(pose, "vx_mps"), "%.2f m/s") + "  " +
           quantity(at(pose, "wz_radps"), "%.2f rad/s") + aside(pose));
  const auto& gnss = at(status, "gnss");
  if (gnss.object() == nullptr) return;
  if (never_heard(gnss)) return line(out, "gnss", nothing_heard(gnss));
  line(out, "gnss",
       text(at(gnss, "quality")) + ", " + text(at(gnss, "health")) + "  " +
           quantity(at(gnss, "latitude_deg"), "%.9f") + " " +
           quantity(at(gnss, "longitude_deg"), "%.9f") +
           quantity(at(gnss, "satellites"), "  %.0f satellites") + "  " +
           quantity(at(gnss, "age_s"), "%.2f s old"));
}

/// Only where somebody looks around.
void show_clearance(std::string& out, const Node& status) {
  const auto& free = at(status, "clearance");
  if (free.object() == nullptr) return;
  const auto degrees = [&](const char* key) {
    const auto rad = at(free, key).number();
    char text[16];
    std::snprintf(text, sizeof text, "%.0f deg", to_deg(rad.value_or(0)));
    return std::string(rad ? text : "-");
  };
  std::string value;
  if (!text(at(free, "unknown")).empty()) {
    value = "not known: " + text(at(free, "unknown"));
  } else {
    value = quantity(at(free, "ahead_m"), "%.2f m ahead, ") +
            quantity(at(free, "back_m"), "%.2f m back, ") + degrees("left_rad") + " left, " +
            degrees("right_rad") + " right";
    if (at(free, "along_m").number())
      value += quantity(at(free, "along_m"), ", %.2f m on its track");
    if (!text(at(free, "first")).empty()) value += "; " + text(at(free, "first"));
  }
  line(out, "free", value);
  if (!text(at(free, "broken")).empty()) line(out, "", text(at(free, "broken")));
}

void show_battery(std::string& out, const Node& status) {
  const auto& battery = at(status, "battery");
  if (battery.object() == nullptr) return;
  if (never_heard(battery)) return line(out, "battery", nothing_heard(battery));
  std::string value = quantity(at(battery, "soc_percent"), "%.1f %%") + "  " +
                      quantity(at(battery, "voltage_V"), "%.2f V") + "  " +
                      quantity(at(battery, "current_A"), "%.1f A") + "  " +
                      quantity(at(battery, "temperature_degC"), "%.0f C") + "  " +
                      text(at(battery, "flow")) + "  " + text(at(battery, "health"));
  if (yes(at(battery, "charger_connected"))) value += "  CHARGER";
  for (const auto* key : {"alarm", "reason"})
    if (!text(at(battery, key)).empty()) value += "  " + text(at(battery, key));
  line(out, "battery", value);
}

/// Where there are several of a kind, which of them the lines above are of; and the scanners.
void show_others(std::string& out, const Node& status) {
  for (const auto* kind : {"gnss", "imu", "battery"}) out += show_sensors(status, kind);
  out += show_scanners(status);
}

/// Wide enough for the longest, and a blank.
std::size_t column(const std::vector<Node>& rows, const char* key, std::size_t least) {
  std::size_t width = least;
  for (const auto& row : rows) width = std::max(width, text(at(row, key)).size() + 1);
  return width;
}

/// What holds a joint outside the base now, whoever asked for it.
std::string in_force(const Node& axis) {
  if (!at(axis, "stiffness_Nmprad").number()) return "";
  return quantity(at(axis, "stiffness_Nmprad"), "%.4g Nm/rad") + "  " +
         quantity(at(axis, "damping_Nmsprad"), "%.4g Nms/rad") + "  ";
}

/// Where a joint outside the base is; a wheel's turns are no place.
std::string place_of(const Node& axis) {
  if (text(at(axis, "group")).empty()) return std::string(14, ' ');
  return quantity(at(axis, "position_rad"), "%8.3f rad") + "  ";
}

void show_axes(std::string& out, const Node& status) {
  const bool places = count(at(status, "groups")) > 0;
  const auto* axes = at(status, "axes").list();
  if (axes == nullptr) return;
  const std::size_t width = column(*axes, "joint", 14);
  for (const auto& axis : *axes) {
    std::string value = padded(text(at(axis, "joint")), width);
    if (never_heard(axis)) {
      value += nothing_heard(axis);
    } else {
      value += padded(text(at(axis, "state")), 9) + (places ? place_of(axis) : "") +
               quantity(at(axis, "velocity_radps"), "%7.2f rad/s") + "  " +
               quantity(at(axis, "effort_Nm"), "%6.2f Nm") + "  " + in_force(axis) +
               quantity(at(axis, "motor_degC"), "%.0f C") + "  " +
               quantity(at(axis, "bus_V"), "%.1f V") + "  " + text(at(axis, "health"));
      if (!text(at(axis, "fault")).empty()) value += "  " + text(at(axis, "fault"));
    }
    line(out, &axis == &axes->front() ? "axes" : "", value);
  }
}

/// Joints outside the base, with what they do.
void show_groups(std::string& out, const Node& status) {
  const auto* groups = at(status, "groups").list();
  if (groups == nullptr) return;
  for (const auto& group : *groups) {
    std::string value = text(at(group, "state"));
    const auto owner = text(at(group, "owner"));
    if (owner != "nobody" && !owner.empty()) value += "  owner " + owner;
    const auto some = [&](const char* key) { return at(group, key).number().value_or(0) > 0; };
    if (some("accepted") || some("refused"))
      value += quantity(at(group, "accepted"), "  %.0f followed") +
               quantity(at(group, "refused"), ", %.0f refused");
    if (some("limited"))
      value += quantity(at(group, "limited"), ", held by a limit in %.0f cycles");
    if (const auto why = text(at(group, "reason")); !why.empty()) value += "  " + why;
    line(out, text(at(group, "name")), value);
  }
}

/// One that takes a twist.
void show_base(std::string& out, const Node& status) {
  const auto& base = at(status, "base");
  if (base.object() == nullptr) return;
  std::string value;
  if (never_heard(base)) {
    value = nothing_heard(base);
  } else {
    value = padded(text(at(base, "state")), 9) + quantity(at(base, "vx_mps"), "%6.2f m/s") + "  " +
            quantity(at(base, "wz_radps"), "%6.2f rad/s") + "  " +
            quantity(at(base, "bus_V"), "%.1f V") + "  " + text(at(base, "health"));
    for (const auto* key : {"fault", "reason"})
      if (!text(at(base, key)).empty()) value += "  " + text(at(base, key));
  }
  line(out, "base", value);
}

void show_ros2(std::string& out, const Node& ros2) {
  if (ros2.object() == nullptr) return;
  if (!yes(at(ros2, "connected"))) return line(out, "ros2", "drover-ros2 does not ask");
  const auto reason = text(at(ros2, "reason"));
  const auto mode = text(at(ros2, "mode"));
  const auto network = text(at(ros2, "network"));
  const auto unused = text(at(ros2, "unused"));
  std::string value = mode + "  ";
  if (mode == "network" && reason.empty())
    value += (network.empty() ? "NONE IS THERE: this computer only" : network) + "  ";
  value += reason.empty() ? quantity(at(ros2, "readers"), "%.0f readers") : reason;
  if (!unused.empty()) value += "  NOT ON " + unused;
  if (at(ros2, "incompatible").number().value_or(0) > 0)
    value += quantity(at(ros2, "incompatible"), "  %.0f ASK FOR ANOTHER QUALITY");
  line(out, "ros2", value);
  const Node& scene = at(ros2, "scene");
  const double refused = at(scene, "refused").number().value_or(0);
  if (refused + at(scene, "done").number().value_or(0) == 0) return;
  value = quantity(at(scene, "done"), "%.0f done");
  if (refused > 0)
    value += quantity(at(scene, "refused"), "  %.0f refused, last ") + text(at(scene, "refusal"));
  line(out, "ros2 scene", value);
}

void show_devices(std::string& out, const Node& status) {
  if (const auto* lines = at(status, "lines").object()) {
    std::string value;
    for (const auto& member : *lines)
      value += member.key +
               (never_heard(member.node)         ? " -"
                : yes(at(member.node, "active")) ? " ACTIVE"
                                                 : " clear") +
               "  ";
    line(out, "lines", value);
  }
  if (const auto* links = at(status, "links").list()) {
    const std::size_t width = column(*links, "name", 8);
    for (const auto& link : *links) {
      std::string value = padded(text(at(link, "name")), width);
      value += yes(at(link, "up")) ? quantity(at(link, "received"), "up  in %.0f") +
                                         quantity(at(link, "sent"), "  out %.0f") +
                                         quantity(at(link, "dropped"), "  dropped %.0f") +
                                         quantity(at(link, "refused"), "  refused %.0f") + "  " +
                                         text(at(link, "reason"))
                                   : "down  " + text(at(link, "reason"));
      line(out, &link == &links->front() ? "links" : "", value);
    }
  }
  const auto& guard = at(status, "guard");
  if (const auto hold = text(at(status, "hold")); !hold.empty())
    line(out, "drives", hold + (count(at(status, "groups")) > 0 ? " (those of the base)" : ""));
  line(out, "guard",
       !yes(at(guard, "alive"))    ? "does not answer"
       : yes(at(guard, "has_bus")) ? "holds the drives"
                                   : "watches");
  const auto& broker = at(status, "broker");
  std::string link = yes(at(broker, "connected")) ? "connected" : text(at(broker, "reason"));
  if (at(broker, "answers_lost").number().value_or(0) > 0)
    link += quantity(at(broker, "answers_lost"), "  %.0f ANSWERS LOST");
  line(out, "broker", link);
  show_ros2(out, at(status, "ros2"));
  const auto not_kept = text(at(at(status, "storage"), "reason"));
  if (!not_kept.empty())
    line(out, "storage", "the stop will be FORGOTTEN over a boot: " + not_kept);
}

}  // namespace

std::string show_status(const Node& status) {
  std::string out;
  line(out, "robot",
       text(at(status, "robot")) + "  droverd " + text(at(status, "version")) +
           quantity(at(status, "uptime_s"), "  up %.0f s"));
  show_nav(out, status);
  show_stream(out, status, "cmd_vel", "cmd_vel");
  show_joint_commands(out, status);
  show_why(out, status);
  show_place(out, status);
  show_clearance(out, status);
  show_battery(out, status);
  show_others(out, status);
  show_axes(out, status);
  show_groups(out, status);
  show_base(out, status);
  show_devices(out, status);
  return out;
}

std::string show_tracks(const Node& tracks) {
  const auto* list = tracks.list();
  if (list == nullptr || list->empty())
    return "no track is saved: an operator's program sends them over MQTT "
           "(src/publish/README.md)\n";
  std::string out;
  for (const auto& track : *list) {
    out += padded(text(at(track, "name")), 32) + quantity(at(track, "points"), "%6.0f points") +
           quantity(at(track, "length_m"), "  %8.1f m") + "\n";
  }
  return out;
}

std::string show_track(const Node& track) {
  std::string out = "  id      latitude       longitude     angle         x         y\n";
  const auto* points = at(track, "data").list();
  if (points == nullptr) return out;
  std::size_t id = 0;
  for (const auto& point : *points) {
    char number[16];
    std::snprintf(number, sizeof number, "%4zu", ++id);
    out += number + quantity(at(point, "latitude"), " %14.9f") +
           quantity(at(point, "longitude"), " %14.9f") + quantity(at(point, "angle"), " %7.2f") +
           quantity(at(point, "x"), " %10.3f") + quantity(at(point, "y"), " %10.3f") + "\n";
  }
  return out;
}

}  // namespace drover::cli
