// Option table of a DAMIAO motor, and the ranges that its models have when they leave the factory.
#include "drivers/damiao/settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "drivers/checked_options.h"

namespace drover::damiao {
namespace {

struct Model {
  std::string_view name;
  Ranges ranges;
};

/// By the maker's library (Limit_Param) and enactic/openarm_can. Of the DM4340 the first has 8
/// rad/s where all others have 10.
constexpr std::array kModels{
    Model{"DM4310", {12.5, 30, 10}},   Model{"DM4310_48V", {12.5, 50, 10}},
    Model{"DM4340", {12.5, 10, 28}},   Model{"DM6006", {12.5, 45, 20}},
    Model{"DM8006", {12.5, 45, 40}},   Model{"DM8009", {12.5, 45, 54}},
    Model{"DM10010", {12.5, 20, 200}}, Model{"DM10010L", {12.5, 25, 200}},
    Model{"DM3507", {12.5, 50, 5}},    Model{"DMH6215", {12.5, 45, 10}},
    Model{"DMG6220", {12.5, 45, 10}},  Model{"DM6248P", {12.566, 20, 120}},
};

constexpr auto kModelNames = [] {
  std::array<std::string_view, kModels.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kModels[i].name;
  return names;
}();

constexpr double kLastMotorId = 15;
/// The guard plays a stop each 10 ms: two of them may be lost.
constexpr double kShortestTimeout_ms = 30;

const OptionSpec kOptions[] = {
    {.name = "id",
     .default_value = 1.0,
     .required = true,
     .min = 1,
     .max = kLastMotorId,
     .integer = true,
     .text = "the motor's own id (its register 8), 1 to 15: its answers tell only four bits of it"},
    {.name = "master_id",
     .default_value = 0.0,
     .min = 0,
     .max = 0x7FE,
     .integer = true,
     .text = "the id under which it answers (its register 7), from 16 on and its own on the bus; "
             "0: 16 more than `id`, as people set it. A motor as it is delivered may answer under "
             "0: set that first"},
    {.name = "model",
     .default_value = std::string(),
     .required = true,
     .choices = kModelNames,
     .text = "which motor it is: gives the three ranges below, as the maker delivers it"},
    {.name = "p_max_rad",
     .default_value = 0.0,
     .min = 0,
     .max = 1000,
     .text = "end of the position's range (its register 21, PMAX); 0: the model's. What differs "
             "from the motor's own is a fault: all would be scaled wrongly"},
    {.name = "v_max_radps",
     .default_value = 0.0,
     .min = 0,
     .max = 1000,
     .text = "the same of the velocity (register 22, VMAX)"},
    {.name = "t_max_Nm",
     .default_value = 0.0,
     .min = 0,
     .max = 1000,
     .text = "the same of the torque (register 23, TMAX)"},
    {.name = "reversed", .default_value = false, .text = "the motor turns against the joint"},
    {.name = "zero_rad",
     .default_value = 0.0,
     .min = -1000,
     .max = 1000,
     .text = "what the motor tells where the joint is at 0"},
    {.name = "timeout_ms",
     .default_value = 100.0,
     .min = 0,
     .max = 10000,
     .integer = true,
     .text = "the motor lets go when no command came for so long (its register 9, TIMEOUT; set at "
             "each arming and read back), 30 and more; 0: it has none and follows its last command "
             "for ever"},
    {.name = "damping_Nmsprad",
     .default_value = 1.0,
     .min = 0.01,
     .max = 4.9,
     .text = "how hard a stop brakes; a weight W (Nm) sinks at W divided by this (rad/s)"},
    {.name = "max_effort_Nm",
     .default_value = 0.0,
     .min = 0,
     .max = 1000,
     .text = "the effort of a set point beyond is clamped and counted, a last line behind the "
             "gate's limits; what stiffness and damping add is not in it; 0: the end of its range"},
    {.name = "stale_s",
     .default_value = 0.1,
     .min = 0.03,
     .max = 2,
     .text = "without an answer for longer the motor counts as silent, and is armed only anew (s)"},
    {.name = "setpoint_period_s",
     .default_value = 0.004,
     .min = 0.0005,
     .max = 0.02,
     .text = "set points are not sent closer together (s); a little under the 5 ms tick: each is "
             "answered, and eight motors with one each 2 ms would fill a bus of 1 Mbit/s"},
    {.name = "settle_s",
     .default_value = 1.0,
     .min = 0,
     .max = 10,
     .text = "it is not enabled sooner after it is heard first: its maker asks for a pause after "
             "its supply came (s)"},
    {.name = "arming_timeout_s",
     .default_value = 1.0,
     .min = 0.2,
     .max = 30,
     .text = "not enabled by then, from the first attempt, is a fault (s)"},
};

const Ranges& ranges_of(std::string_view model) {
  const auto* const it = std::find_if(kModels.begin(), kModels.end(),
                                      [&](const Model& each) { return each.name == model; });
  return it->ranges;  // one of the choices
}

}  // namespace

std::span<const OptionSpec> option_table() {
  return kOptions;
}

Settings read_settings(const Options& options) {
  const CheckedOptions checked(options, kOptions);
  Settings settings;
  settings.id = static_cast<std::uint8_t>(checked.number("id"));
  settings.master_id = static_cast<std::uint32_t>(checked.number("master_id"));
  if (settings.master_id == 0) settings.master_id = settings.id + 0x10U;
  if (settings.master_id <= static_cast<std::uint32_t>(kLastMotorId))
    throw std::runtime_error("master_id: 1 to 15 are ids of motors, its answers would command one");
  settings.ranges = ranges_of(checked.text("model"));
  const auto override = [&](std::string_view name, double& value) {
    const double given = checked.number(name);
    if (given > 0) value = given;
  };
  override("p_max_rad", settings.ranges.p_max_rad);
  override("v_max_radps", settings.ranges.v_max_radps);
  override("t_max_Nm", settings.ranges.t_max_Nm);
  settings.sign = options.flag("reversed") ? -1.0 : 1.0;
  settings.zero_rad = checked.number("zero_rad");
  if (std::abs(settings.zero_rad) >= settings.ranges.p_max_rad)
    throw std::runtime_error("zero_rad: is outside the position's range, the motor never tells it");
  settings.timeout_ms = static_cast<std::uint32_t>(checked.number("timeout_ms"));
  settings.damping_Nmsprad = checked.number("damping_Nmsprad");
  settings.max_effort_Nm = checked.number("max_effort_Nm");
  if (settings.max_effort_Nm > settings.ranges.t_max_Nm)
    throw std::runtime_error("max_effort_Nm: is beyond the torque's range");
  if (settings.max_effort_Nm == 0) settings.max_effort_Nm = settings.ranges.t_max_Nm;
  settings.stale_after = checked.seconds("stale_s");
  settings.setpoint_period = checked.seconds("setpoint_period_s");
  settings.settle = checked.seconds("settle_s");
  settings.arming_timeout = checked.seconds("arming_timeout_s");
  const double shortest_ms = std::max(kShortestTimeout_ms, 2.5e3 * to_s(settings.setpoint_period));
  if (settings.timeout_ms != 0 && settings.timeout_ms < shortest_ms)
    throw std::runtime_error(
        "timeout_ms: is below 30 or 2.5 set point periods, a lost frame would let the joint go");
  return settings;
}

}  // namespace drover::damiao
