// The options that motors in MIT mode have in common, whoever makes them.
#include "drivers/mit/settings.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "drivers/checked_options.h"

namespace drover::mit {
namespace {

const Ranges& ranges_of(std::span<const Model> models, std::string_view name) {
  const auto model = std::find_if(models.begin(), models.end(),
                                  [&](const Model& each) { return each.name == name; });
  return model->ranges;  // one of the choices
}

Joint read_joint(const Options& options, const CheckedOptions& checked, const Ranges& of_model) {
  // What is not stated is 0.
  const auto stated = [&](std::string_view name, double otherwise) {
    const double value = checked.number(name);
    return value > 0 ? value : otherwise;
  };
  Joint joint;
  joint.id = static_cast<std::uint8_t>(checked.number("id"));
  joint.ranges = {stated("p_max_rad", of_model.p_max_rad),
                  stated("v_max_radps", of_model.v_max_radps),
                  stated("t_max_Nm", of_model.t_max_Nm)};
  joint.sign = options.flag("reversed") ? -1.0 : 1.0;
  joint.zero_rad = checked.number("zero_rad");
  if (std::abs(joint.zero_rad) >= joint.ranges.p_max_rad)
    throw std::runtime_error("zero_rad: is outside the position's range, the motor never tells it");
  joint.damping_Nmsprad = checked.number("damping_Nmsprad");
  joint.max_effort_Nm = stated("max_effort_Nm", joint.ranges.t_max_Nm);
  if (joint.max_effort_Nm > joint.ranges.t_max_Nm)
    throw std::runtime_error("max_effort_Nm: is beyond the torque's range");
  return joint;
}

}  // namespace

OptionSpec range_row(std::string_view name, std::string_view text) {
  return {.name = name, .default_value = 0.0, .min = 0, .max = 1000, .text = text};
}

OptionSpec reversed_row() {
  return {.name = "reversed", .default_value = false, .text = "the motor turns against the joint"};
}

OptionSpec zero_row() {
  return {.name = "zero_rad",
          .default_value = 0.0,
          .min = -1000,
          .max = 1000,
          .text = "what the motor tells where the joint is at 0"};
}

OptionSpec timeout_row(double default_ms, std::string_view text) {
  return {.name = "timeout_ms",
          .default_value = default_ms,
          .min = 0,
          .max = 10000,
          .integer = true,
          .text = text};
}

OptionSpec damping_row() {
  return {.name = "damping_Nmsprad",
          .default_value = 1.0,
          .min = 0.01,
          .max = 4.9,
          .text = "how hard a stop brakes; a weight W (Nm) sinks at W divided by this (rad/s)"};
}

OptionSpec max_effort_row() {
  return {.name = "max_effort_Nm",
          .default_value = 0.0,
          .min = 0,
          .max = 1000,
          .text =
              "the effort of a set point beyond is clamped and counted, a last line behind the "
              "gate's limits; what stiffness and damping add is not in it; 0: the end of its "
              "range"};
}

OptionSpec stale_row(std::string_view text) {
  return {.name = "stale_s", .default_value = 0.1, .min = 0.03, .max = 2, .text = text};
}

OptionSpec setpoint_period_row() {
  return {.name = "setpoint_period_s",
          .default_value = 0.004,
          .min = 0.0005,
          .max = 0.02,
          .text =
              "set points are not sent closer together (s); a little under the 5 ms tick: each "
              "is answered, and eight motors with one each 2 ms would fill a bus of 1 Mbit/s"};
}

OptionSpec settle_row(double default_s, std::string_view text) {
  return {.name = "settle_s", .default_value = default_s, .min = 0, .max = 10, .text = text};
}

Settings read_settings(const Options& options, std::span<const OptionSpec> table,
                       std::span<const Model> models, unsigned shortest_timeout_ms) {
  const CheckedOptions checked(options, table);
  Settings settings;
  settings.joint = read_joint(options, checked, ranges_of(models, checked.text("model")));
  settings.timeout_ms = static_cast<std::uint32_t>(checked.number("timeout_ms"));
  settings.stale_after = checked.seconds("stale_s");
  settings.setpoint_period = checked.seconds("setpoint_period_s");
  settings.settle = checked.seconds("settle_s");
  const double shortest_ms =
      std::max<double>(shortest_timeout_ms, 2.5e3 * to_s(settings.setpoint_period));
  if (settings.timeout_ms != 0 && settings.timeout_ms < shortest_ms)
    throw std::runtime_error("timeout_ms: is below " + std::to_string(shortest_timeout_ms) +
                             " or 2.5 set point periods, a lost frame would let the joint go");
  return settings;
}

}  // namespace drover::mit
