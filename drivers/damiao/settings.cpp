// Option table of a DAMIAO motor, and the ranges that its models have when they leave the factory.
#include "drivers/damiao/settings.h"

#include <array>
#include <stdexcept>

#include "drivers/checked_options.h"

namespace drover::damiao {
namespace {

using mit::Model;

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

constexpr auto kModelNames = mit::names_of(kModels);

constexpr double kLastMotorId = 15;
/// The guard plays a stop each 10 ms: two of them may be lost.
constexpr unsigned kShortestTimeout_ms = 30;

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
    mit::range_row(
        "p_max_rad",
        "end of the position's range (its register 21, PMAX); 0: the model's. What differs "
        "from the motor's own is a fault: all would be scaled wrongly"),
    mit::range_row("v_max_radps", "the same of the velocity (register 22, VMAX)"),
    mit::range_row("t_max_Nm", "the same of the torque (register 23, TMAX)"),
    mit::reversed_row(),
    mit::zero_row(),
    mit::timeout_row(
        100.0,
        "the motor lets go when no command came for so long (its register 9, TIMEOUT; set at "
        "each arming and read back), 30 and more; 0: it has none and follows its last command "
        "for ever"),
    mit::damping_row(),
    mit::max_effort_row(),
    mit::stale_row(
        "without an answer for longer the motor counts as silent, and is armed only anew (s)"),
    mit::setpoint_period_row(),
    mit::settle_row(
        1.0,
        "it is not enabled sooner after it is heard first: its maker asks for a pause after "
        "its supply came (s)"),
    {.name = "arming_timeout_s",
     .default_value = 1.0,
     .min = 0.2,
     .max = 30,
     .text = "not enabled by then, from the first attempt, is a fault (s)"},
};

}  // namespace

std::span<const OptionSpec> option_table() {
  return kOptions;
}

Settings read_settings(const Options& options) {
  const CheckedOptions checked(options, kOptions);
  Settings settings{mit::read_settings(options, kOptions, kModels, kShortestTimeout_ms)};
  settings.master_id = static_cast<std::uint32_t>(checked.number("master_id"));
  if (settings.master_id == 0) settings.master_id = settings.joint.id + 0x10U;
  if (settings.master_id <= static_cast<std::uint32_t>(kLastMotorId))
    throw std::runtime_error("master_id: 1 to 15 are ids of motors, its answers would command one");
  settings.arming_timeout = checked.seconds("arming_timeout_s");
  return settings;
}

}  // namespace drover::damiao
