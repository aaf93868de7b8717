// What a recording holds of a cycle's output, and a replay compares: every value that is not a
// frame, byte or event, each with its name. The parts describe themselves (drover/describe*.h);
// here stands the whole, in the order in which a recording numbers it.
#pragma once

#include <algorithm>
#include <span>

#include "drover/describe_snapshot.h"
#include "gateway/gateway.h"

namespace drover::gateway {

template <class V, class List>
void visit_values(V& v, const char* name, const List& list) {
  for (std::size_t i = 0; i < list.size(); ++i)
    v.inside(name, i, [&v, &list, i] { v.value("", list[i]); });
}

template <class V>
void visit_fields(V& v, const Snapshot& snapshot) {
  const auto& [time, pose, odometry, worst_vx_mps, nav, gnss, imu, battery, sensors, scanners,
               cmd_vel, joint_command, axes, groups, base, clearance, line_active, line_health,
               line_configured, line_source, output_configured, output_on, links, stop_latched,
               hold, guard_alive, guard_has_bus, origin_set, origin, why, why_untold, cycle,
               estimator, learned, notices_dropped] = snapshot;
  (void)odometry;  // nobody decides by it
  (void)links;     // those two are the loop's
  (void)cycle;
  (void)scanners;    // and the gateway hears none
  (void)why_untold;  // recordings of before it hold none
  v.value("time", time);
  v.inside("pose", [&v, &part = pose] { describe(v, part); });
  v.value("worst_vx_mps", worst_vx_mps);
  v.inside("nav", [&v, &part = nav] { describe(v, part); });
  v.inside("gnss", [&v, &part = gnss] { describe(v, part); });
  v.inside("imu", [&v, &part = imu] { describe(v, part); });
  v.inside("battery", [&v, &part = battery] { describe(v, part); });
  for (std::size_t i = 0; i < sensors.size(); ++i)
    v.inside("sensors", i, [&v, &part = sensors[i]] { describe(v, part); });
  v.inside("cmd_vel", [&v, &part = cmd_vel] { describe(v, part); });
  v.inside("joint_command", [&v, &part = joint_command] { describe(v, part); });
  for (std::size_t i = 0; i < axes.size(); ++i)
    v.inside("axes", i, [&v, &part = axes[i]] { describe(v, part); });
  for (std::size_t i = 0; i < groups.size(); ++i)
    v.inside("groups", i, [&v, &part = groups[i]] { describe(v, part); });
  // It is there or not from the start on: a recording numbers its fields.
  if (base.configured) v.inside("base", [&v, &part = base] { describe(v, part); });
  if (clearance.configured) v.inside("clearance", [&v, &part = clearance] { describe(v, part); });
  visit_values(v, "line_active", line_active);
  visit_values(v, "line_health", line_health);
  visit_values(v, "line_configured", line_configured);
  for (std::size_t i = 0; i < line_source.size(); ++i)
    v.inside("line_source", i, [&v, &part = line_source[i]] { describe(v, part); });
  visit_values(v, "output_configured", output_configured);
  visit_values(v, "output_on", output_on);
  v.value("stop_latched", stop_latched);
  v.value("hold", hold);
  v.value("guard_alive", guard_alive);
  v.value("guard_has_bus", guard_has_bus);
  v.value("origin_set", origin_set);
  v.inside("origin", [&v, &part = origin] { describe(v, part); });
  // Always as many fields: a recording numbers them.
  static constexpr Reason kNone;
  for (std::size_t i = 0; i < why.capacity(); ++i)
    v.inside("why", i, [&v, &part = i < why.size() ? why[i] : kNone] { v.value("", part); });
  v.inside("estimator", [&v, &part = estimator] { describe(v, part); });
  v.value("notices_dropped", notices_dropped);
  v.inside("learned", [&v, &part = learned] { describe(v, part); });
}

inline constexpr std::size_t kFewestSlowed = 16;

/// What the engine wants of the drives and outputs; `events` are told apart.
template <class V>
void visit_fields(V& v, const engine::EngineOutput& output, const Snapshot& snapshot) {
  const auto& [axes, base, outputs, events, motion_permitted, slowing_permitted, joint_may_move,
               unsettled, remembered] = output;
  const auto& joints = snapshot.axes;
  const std::size_t axis_count = joints.size();
  (void)events;
  for (std::size_t i = 0; i < axis_count; ++i) {
    const bool beside_base = joints[i].group != 0;
    v.inside("commands", i, [&v, &part = axes[i], beside_base, may_move = joint_may_move[i]] {
      const auto& [request, velocity_radps, impedance, held] = part;
      (void)held;  // `remembered` tells as much
      v.value("request", request);
      v.value("velocity_radps", velocity_radps);
      if (!beside_base) return;
      const auto& [position_rad, effort_Nm, stiffness_Nmprad, damping_Nmsprad] = impedance;
      v.value("position_rad", position_rad);
      v.value("effort_Nm", effort_Nm);
      v.value("stiffness_Nmprad", stiffness_Nmprad);
      v.value("damping_Nmsprad", damping_Nmsprad);
      v.value("may_move", may_move);
    });
  }
  if (snapshot.base.configured) {  // it takes a twist, and has no joint
    v.inside("command", [&v, &part = base] {
      const auto& [request, twist, base_may_slow] = part;
      v.value("request", request);
      v.value("vx_mps", twist.vx_mps);
      v.value("wz_radps", twist.wz_radps);
      (void)base_may_slow;
    });
  }
  visit_values(v, "outputs", outputs);
  v.value("motion_permitted", motion_permitted);
  // The base's device behind the joints: the first of all where there are none.
  std::array<bool, kMaxAxes + 1> slowing{};
  std::copy_n(slowing_permitted.begin(), axis_count, slowing.begin());
  slowing[axis_count] = base.slowing_permitted;
  const std::size_t slowed = axis_count + (snapshot.base.configured ? 1 : 0);
  // So many at the least were always there.
  visit_values(v, "slowing_permitted", std::span(slowing).first(std::max(slowed, kFewestSlowed)));
  v.value("unsettled", unsettled);
  v.inside("remembered", [&v, &part = remembered] {
    const auto& [stop, stop_at_robot, power_cut, holding, released, task, proved, joints_wait,
                 at_rest, ran_away, place] = part;
    v.value("stop", stop);
    v.value("stop_at_robot", stop_at_robot);
    v.value("power_cut", power_cut);
    v.value("holding", holding);
    v.value("released", released);
    v.value("task", task);
    v.value("mechanics_proved", proved);
    v.value("joints_wait", joints_wait);
    v.value("at_rest", at_rest);
    v.value("ran_away", ran_away);
    v.inside("place", [&v, &where = place] {
      const auto& [known, doubted, doubt_cm, x_m, y_m, yaw_rad, position_sigma_m, yaw_sigma_rad,
                   latitude_deg, longitude_deg] = where;
      v.value("known", known);
      v.value("doubted", doubted);
      v.value("doubt_cm", doubt_cm);
      v.value("x_m", x_m);
      v.value("y_m", y_m);
      v.value("yaw_rad", yaw_rad);
      v.value("position_sigma_m", position_sigma_m);
      v.value("yaw_sigma_rad", yaw_sigma_rad);
      v.value("origin_latitude_deg", latitude_deg);
      v.value("origin_longitude_deg", longitude_deg);
    });
  });
}

template <class V>
void visit_fields(V& v, const Gateway& gateway) {
  const Snapshot& snapshot = gateway.snapshot();
  visit_fields(v, snapshot);
  visit_fields(v, gateway.output().engine, snapshot);
}

}  // namespace drover::gateway
