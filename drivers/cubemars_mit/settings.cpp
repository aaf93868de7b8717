// Option table of a CubeMars motor, and the ranges of its models as the maker's manual has them.
#include "drivers/cubemars_mit/settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "drivers/checked_options.h"

namespace drover::cubemars_mit {
namespace {

struct Model {
  std::string_view name;
  Ranges ranges;
};

/// AK Series Actuator Driver Manual V1.0.8, page 50.
constexpr std::array kModels{
    Model{"AK10-9", {12.5, 50, 65}},  Model{"AK60-6", {12.5, 45, 15}},
    Model{"AK70-10", {12.5, 50, 25}}, Model{"AK80-6", {12.5, 76, 12}},
    Model{"AK80-9", {12.5, 50, 18}},  Model{"AK80-64", {12.5, 8, 144}},
};

constexpr auto kModelNames = [] {
  std::array<std::string_view, kModels.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kModels[i].name;
  return names;
}();

/// 0x7F is the first byte of each damping frame, and 0xFF of those that enable: under its own id an
/// answer, which begins with its id, must be told from them.
constexpr double kLastMotorId = 0x7E;
constexpr double kItsOwnId = -1;
/// The guard plays a stop each 10 ms: one of them may be lost.
constexpr double kShortestTimeout_ms = 20;

const OptionSpec kOptions[] = {
    {.name = "id",
     .default_value = 1.0,
     .required = true,
     .min = 1,
     .max = kLastMotorId,
     .integer = true,
     .text = "the motor's CAN id, 1 to 126: what is sent to it has this id"},
    {.name = "master_id",
     .default_value = kItsOwnId,
     .min = kItsOwnId,
     .max = 0x7FE,
     .integer = true,
     .text = "the id under which it answers; -1: its own, as CubeMars' manual says. The open "
             "firmware answers under 0 as it is delivered: never on a bus with CANopen nodes"},
    {.name = "model",
     .default_value = std::string(kModelNames[0]),
     .required = true,
     .choices = kModelNames,
     .text = "gives the three ranges below, by the maker's manual V1.0.8. Nobody can read them "
             "from the motor, and other firmware has others: look at R-Link"},
    {.name = "p_max_rad",
     .default_value = 0.0,
     .min = 0,
     .max = 1000,
     .text = "end of the position's range; 0: the model's. What differs from the motor's own "
             "scales all that is told and heard, and nothing shows it"},
    {.name = "v_max_radps",
     .default_value = 0.0,
     .min = 0,
     .max = 1000,
     .text = "the same of the velocity"},
    {.name = "t_max_Nm",
     .default_value = 0.0,
     .min = 0,
     .max = 1000,
     .text = "the same of the torque"},
    {.name = "reversed", .default_value = false, .text = "the motor turns against the joint"},
    {.name = "zero_rad",
     .default_value = 0.0,
     .min = -1000,
     .max = 1000,
     .text = "what the motor tells where the joint is at 0"},
    {.name = "timeout_ms",
     .default_value = 0.0,
     .min = 0,
     .max = 10000,
     .integer = true,
     .text = "the time-out that was set in the motor (R-Link, or the open firmware's CAN_TIMEOUT): "
             "left alone for so long it goes limp, and follows the next command again; 0: not "
             "known, so it may follow its last command for ever. It can neither be set nor read "
             "from here"},
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
     .text = "without an answer for longer the motor counts as silent, and is armed only anew (s); "
             "a motor that boots faster than this loses its supply without that anybody notices"},
    {.name = "setpoint_period_s",
     .default_value = 0.004,
     .min = 0.0005,
     .max = 0.02,
     .text = "set points are not sent closer together (s); a little under the 5 ms tick: each is "
             "answered, and eight motors with one each 2 ms would fill a bus of 1 Mbit/s"},
    {.name = "settle_s",
     .default_value = 0.5,
     .min = 0,
     .max = 10,
     .text = "it is not enabled sooner after it is heard first (s)"},
};

}  // namespace

Duration Settings::unfed_after() const {
  const Duration timeout = std::chrono::milliseconds(timeout_ms);
  return timeout_ms > 0 ? std::min(timeout, stale_after) : stale_after;
}

std::span<const OptionSpec> option_table() {
  return kOptions;
}

Settings read_settings(const Options& options) {
  const CheckedOptions checked(options, kOptions);
  Settings settings;
  mit::Joint& joint = settings.joint;
  joint.id = static_cast<std::uint8_t>(checked.number("id"));
  const double master_id = checked.number("master_id");
  settings.master_id = master_id < 0 ? joint.id : static_cast<std::uint32_t>(master_id);
  if (settings.master_id > 0 && settings.master_id <= static_cast<std::uint32_t>(kLastMotorId) &&
      !settings.answers_under_its_own())
    throw std::runtime_error(
        "master_id: 1 to 126 are ids of motors, its answers would command one");

  const std::string& model = checked.text("model");
  const auto* const it = std::find_if(kModels.begin(), kModels.end(),
                                      [&](const Model& each) { return each.name == model; });
  const auto given = [&](std::string_view name, double of_model) {
    const double value = checked.number(name);
    return value > 0 ? value : of_model;
  };
  joint.ranges = {given("p_max_rad", it->ranges.p_max_rad),
                  given("v_max_radps", it->ranges.v_max_radps),
                  given("t_max_Nm", it->ranges.t_max_Nm)};
  joint.nearest_speed = true;
  joint.sign = options.flag("reversed") ? -1.0 : 1.0;
  joint.zero_rad = checked.number("zero_rad");
  if (std::abs(joint.zero_rad) >= joint.ranges.p_max_rad)
    throw std::runtime_error("zero_rad: is outside the position's range, the motor never tells it");
  joint.damping_Nmsprad = checked.number("damping_Nmsprad");
  joint.max_effort_Nm = given("max_effort_Nm", joint.ranges.t_max_Nm);
  if (joint.max_effort_Nm > joint.ranges.t_max_Nm)
    throw std::runtime_error("max_effort_Nm: is beyond the torque's range");

  settings.timeout_ms = static_cast<std::uint32_t>(checked.number("timeout_ms"));
  settings.stale_after = checked.seconds("stale_s");
  settings.setpoint_period = checked.seconds("setpoint_period_s");
  settings.settle = checked.seconds("settle_s");
  const double shortest_ms = std::max(kShortestTimeout_ms, 2.5e3 * to_s(settings.setpoint_period));
  if (settings.timeout_ms != 0 && settings.timeout_ms < shortest_ms)
    throw std::runtime_error(
        "timeout_ms: is below 20 or 2.5 set point periods, a lost frame would let the joint go");
  return settings;
}

}  // namespace drover::cubemars_mit
