// Option table of a drive of CiA 402.
#include "drivers/cia402/settings.h"

#include <stdexcept>
#include <string>
#include <type_traits>

#include "drivers/canopen/nmt.h"
#include "drivers/checked_options.h"

namespace drover::cia402 {
namespace {

constexpr std::string_view kProfile = "profile_velocity";
constexpr std::string_view kModes[] = {kProfile, "cyclic_synchronous_velocity"};
constexpr double kExampleRamp = 60000;  // for tests: it has to be told
constexpr double kMostUnsigned = 4294967295.0;

const OptionSpec kOptions[] = {
    {.name = "node",
     .default_value = 0.0,
     .required = true,
     .min = 1,
     .max = canopen::kLastNode,
     .integer = true,
     .text = "node id of the drive on the bus"},
    {.name = "mode",
     .default_value = std::string(kProfile),
     .choices = kModes,
     .text = "object 6060: 3 or 9"},
    {.name = "velocity_units_per_rps",
     .default_value = 0.0,
     .required = true,
     .min = 60,
     .max = 1e8,
     .text = "what 60FF and 606C count, at one turn of the motor a second: 60 where they are rpm, "
             "600 for 0.1 rpm, 60000 for mrpm, the counts of a turn for counts a second"},
    {.name = "counts_per_turn",
     .default_value = 4096.0,
     .min = 6,
     .max = 1e8,
     .text = "what 6064 counts in one turn of the motor"},
    {.name = "gear_ratio",
     .default_value = 0.0,
     .required = true,
     .min = 0.001,
     .max = 1000,
     .text = "motor turns per turn of the joint; hub motors have 1"},
    {.name = "reversed", .default_value = false, .text = "the motor turns against its joint"},
    {.name = "max_rpm",
     .default_value = 3000.0,
     .min = 1,
     .max = 100000,
     .text = "faster set points are clamped (motor, rpm)"},
    {.name = "rated_torque_Nm",
     .default_value = 0.0,
     .min = 0,
     .max = 10000,
     .text = "of the motor, object 6076; 6077 is told in its thousandths. 0: it is not asked for"},
    {.name = "acceleration",
     .default_value = kExampleRamp,
     .required = true,
     .min = 0,
     .max = kMostUnsigned,
     .integer = true,
     .text =
         "object 6083, in the drive's own unit, mostly that of 60FF a second; 0: as it is in the "
         "drive. In profile_velocity the drive's ramps rule: they must be faster than limits"},
    {.name = "deceleration",
     .default_value = kExampleRamp,
     .required = true,
     .min = 0,
     .max = kMostUnsigned,
     .integer = true,
     .text = "object 6084, the same"},
    {.name = "quick_stop_deceleration",
     .default_value = 0.0,
     .min = 0,
     .max = kMostUnsigned,
     .integer = true,
     .text = "object 6085, the same: how fast it stops by itself"},
    {.name = "quick_stop_option",
     .default_value = 6.0,
     .min = 5,
     .max = 8,
     .integer = true,
     .text = "object 605A: 5 by 6084, 6 by 6085, 7 and 8 at a limit; all hold after it. Those that "
             "let go, 0 to 4, are not taken"},
    {.name = "silence_ms",
     .default_value = 200.0,
     .min = 0,
     .max = 65535,
     .integer = true,
     .text = "object 1016:01: without the gateway's heartbeat for longer the drive stops. 0: it "
             "keeps its last speed for ever"},
    {.name = "gateway_node",
     .default_value = 127.0,
     .min = 1,
     .max = canopen::kLastNode,
     .integer = true,
     .text = "node id under which the gateway sends its heartbeat; no device of the bus may have "
             "it"},
    {.name = "no_consumer_heartbeat",
     .default_value = false,
     .text = "the drive has no object 1016: it is left out, and the drive does not stop by itself"},
    {.name = "no_abort_option",
     .default_value = false,
     .text = "the drive has no object 6007: it is left out, and what the drive does without a "
             "heartbeat is its maker's"},
    {.name = "heartbeat_ms",
     .default_value = 100.0,
     .min = 20,
     .max = 1000,
     .integer = true,
     .text = "object 1017, period of the drive's heartbeat; set and read back"},
    {.name = "stale_s",
     .default_value = 0.1,
     .min = 0.02,
     .max = 2,
     .text = "without a status for longer the drive counts as silent (s); ten periods"},
    {.name = "heartbeat_timeout_s",
     .default_value = 0.3,
     .min = 0.05,
     .max = 5,
     .text = "without a heartbeat for longer the drive is gone and is armed only anew (s); three "
             "periods"},
    {.name = "setpoint_period_s",
     .default_value = 0.004,
     .min = 0.0005,
     .max = 0.05,
     .text = "set points are not sent closer together (s); a little under the 5 ms tick"},
    {.name = "arming_timeout_s",
     .default_value = 2.0,
     .min = 0.2,
     .max = 30,
     .text = "not enabled by then is a fault (s)"},
};

}  // namespace

std::span<const OptionSpec> option_table() {
  return kOptions;
}

Settings read_settings(const Options& options) {
  const CheckedOptions checked(options, kOptions);
  Settings settings;
  const auto take = [&](auto& into, std::string_view name) {
    into = static_cast<std::remove_reference_t<decltype(into)>>(checked.number(name));
  };
  take(settings.node, "node");
  take(settings.gateway_node, "gateway_node");
  settings.mode = checked.text("mode") == kProfile ? 3 : 9;
  take(settings.units_per_rps, "velocity_units_per_rps");
  take(settings.counts_per_turn, "counts_per_turn");
  take(settings.gear_ratio, "gear_ratio");
  settings.sign = options.flag("reversed") ? -1 : 1;
  take(settings.max_rpm, "max_rpm");
  take(settings.rated_torque_Nm, "rated_torque_Nm");
  take(settings.acceleration, "acceleration");
  take(settings.deceleration, "deceleration");
  take(settings.quick_deceleration, "quick_stop_deceleration");
  take(settings.quick_stop_option, "quick_stop_option");
  take(settings.silence_ms, "silence_ms");
  take(settings.heartbeat_ms, "heartbeat_ms");
  settings.has_consumer = !options.flag("no_consumer_heartbeat");
  settings.has_abort_option = !options.flag("no_abort_option");
  settings.stale_after = checked.seconds("stale_s");
  settings.heartbeat_timeout = checked.seconds("heartbeat_timeout_s");
  settings.setpoint_period = checked.seconds("setpoint_period_s");
  settings.arming_timeout = checked.seconds("arming_timeout_s");
  if (settings.gateway_node == settings.node)
    throw std::runtime_error("gateway_node is the drive's own node");
  if (settings.silence_ms > 0 && settings.silence_ms < 50)
    throw std::runtime_error(
        "silence_ms is shorter than 50: the gateway's heartbeat would be late");
  if (settings.max_rpm / 60 * settings.units_per_rps > 2147483647.0)
    throw std::runtime_error("max_rpm is more than object 60FF holds in this unit");
  if (to_s(settings.heartbeat_timeout) < 2.5 * settings.heartbeat_ms / 1000.0)
    throw std::runtime_error("heartbeat_timeout_s is shorter than 2.5 heartbeat_ms");
  return settings;
}

}  // namespace drover::cia402
