// Option table of a CubeMars motor, and the ranges of its models as the maker's manual has them.
#include "drivers/cubemars_mit/settings.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "drivers/checked_options.h"

namespace drover::cubemars_mit {
namespace {

using mit::Model;

/// AK Series Actuator Driver Manual V1.0.8, page 50.
constexpr std::array kModels{
    Model{"AK10-9", {12.5, 50, 65}},  Model{"AK60-6", {12.5, 45, 15}},
    Model{"AK70-10", {12.5, 50, 25}}, Model{"AK80-6", {12.5, 76, 12}},
    Model{"AK80-9", {12.5, 50, 18}},  Model{"AK80-64", {12.5, 8, 144}},
};

constexpr auto kModelNames = mit::names_of(kModels);

/// 0x7F is the first byte of each damping frame, and 0xFF of those that enable: under its own id an
/// answer, which begins with its id, must be told from them.
constexpr double kLastMotorId = 0x7E;
constexpr double kItsOwnId = -1;
/// The guard plays a stop each 10 ms: one of them may be lost.
constexpr unsigned kShortestTimeout_ms = 20;

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
    mit::range_row("p_max_rad",
                   "end of the position's range; 0: the model's. What differs from the motor's own "
                   "scales all that is told and heard, and nothing shows it"),
    mit::range_row("v_max_radps", "the same of the velocity"),
    mit::range_row("t_max_Nm", "the same of the torque"),
    mit::reversed_row(),
    mit::zero_row(),
    mit::timeout_row(
        0.0,
        "the time-out that was set in the motor (R-Link, or the open firmware's CAN_TIMEOUT): "
        "left alone for so long it goes limp, and follows the next command again; 0: not "
        "known, so it may follow its last command for ever. It can neither be set nor read "
        "from here"),
    mit::damping_row(),
    mit::max_effort_row(),
    mit::stale_row(
        "without an answer for longer the motor counts as silent, and is armed only anew (s); "
        "a motor that boots faster than this loses its supply without that anybody notices"),
    mit::setpoint_period_row(),
    mit::settle_row(0.5, "it is not enabled sooner after it is heard first (s)"),
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
  Settings settings{mit::read_settings(options, kOptions, kModels, kShortestTimeout_ms)};
  settings.joint.nearest_speed = true;
  const double master_id = checked.number("master_id");
  settings.master_id = master_id < 0 ? settings.joint.id : static_cast<std::uint32_t>(master_id);
  if (settings.master_id > 0 && settings.master_id <= static_cast<std::uint32_t>(kLastMotorId) &&
      !settings.answers_under_its_own())
    throw std::runtime_error(
        "master_id: 1 to 126 are ids of motors, its answers would command one");
  return settings;
}

}  // namespace drover::cubemars_mit
