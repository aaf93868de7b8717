// Option table of an ODrive axis.
#include "drivers/odrive/settings.h"

#include <stdexcept>

#include "drivers/checked_options.h"

namespace drover::odrive {
namespace {

constexpr std::string_view kFirmwares[] = {"0.6", "0.5.6"};

const OptionSpec kOptions[] = {
    {.name = "node",
     .default_value = 0.0,
     .required = true,
     .min = 0,
     .max = kMaxNode,
     .integer = true,
     .text = "node id of the axis on the bus, 0 to 62 (63 is the broadcast)"},
    {.name = "firmware",
     .default_value = std::string("0.6"),
     .choices = kFirmwares,
     .text = "family of the drive's firmware; layouts and error codes differ: \"0.6\" for Pro, S1 "
             "and Micro, \"0.5.6\" for v3 boards"},
    {.name = "gear_ratio",
     .default_value = 1.0,
     .min = 0.001,
     .max = 1000,
     .text = "motor turns per turn of the joint"},
    {.name = "reversed", .default_value = false, .text = "the motor turns against the joint"},
    {.name = "torque_constant_Nm_per_A",
     .default_value = 0.0,
     .min = 0,
     .max = 100,
     .text = "of the motor; 8.27 divided by its KV. 0: unknown, then firmware 0.5.6 gives no "
             "effort"},
    {.name = "velocity_limit_turnps",
     .default_value = 100.0,
     .min = 0.001,
     .max = 2000,
     .text = "of the motor; set points beyond are clamped and counted, a last line behind the "
             "gate's limits"},
    {.name = "watchdog_timeout_s",
     .default_value = 0.0,
     .min = 0,
     .max = 10,
     .text = "the drive's own watchdog (s); 0: it has none and keeps its last velocity for ever. "
             "Without the two end points below it must be saved in the drive beforehand, and this "
             "states so"},
    {.name = "watchdog_enable_endpoint",
     .default_value = 0.0,
     .min = 0,
     .max = 65535,
     .integer = true,
     .text = "firmware 0.6: end point id of axis0.config.enable_watchdog in the "
             "flat_endpoints.json of exactly this firmware; 0: not set by the driver"},
    {.name = "watchdog_timeout_endpoint",
     .default_value = 0.0,
     .min = 0,
     .max = 65535,
     .integer = true,
     .text = "firmware 0.6: end point id of axis0.config.watchdog_timeout; 0: not set by the "
             "driver"},
    {.name = "stale_s",
     .default_value = 0.1,
     .min = 0.01,
     .max = 2,
     .text = "without encoder estimates for longer the axis counts as silent (s); ten of the "
             "drive's default 10 ms periods"},
    {.name = "heartbeat_timeout_s",
     .default_value = 0.3,
     .min = 0.05,
     .max = 5,
     .text =
         "without a heartbeat for longer the drive is gone and is armed only anew (s); three of "
         "the drive's default 100 ms periods"},
    {.name = "setpoint_period_s",
     .default_value = 0.004,
     .min = 0.0005,
     .max = 0.05,
     .text = "set points are not sent closer together (s); a little under the 5 ms tick, so that a "
             "1 kHz tick does not fill a 250 kbit/s bus"},
    {.name = "poll_s",
     .default_value = 0.5,
     .min = 0,
     .max = 60,
     .text = "each of temperature, supply, torque and errors is asked for so often (s); 0: never, "
             "for drives that send them cyclically"},
    {.name = "arming_timeout_s",
     .default_value = 2.0,
     .min = 0.2,
     .max = 30,
     .text = "closed loop not reached by then is a fault (s)"},
};

}  // namespace

std::span<const OptionSpec> option_table() {
  return kOptions;
}

Settings read_settings(const Options& options) {
  const CheckedOptions checked(options, kOptions);
  Settings settings;
  settings.node = static_cast<std::uint8_t>(checked.number("node"));
  settings.firmware = checked.text("firmware") == "0.6" ? Firmware::v0_6 : Firmware::v0_5_6;
  settings.gear_ratio = checked.number("gear_ratio");
  settings.sign = options.flag("reversed") ? -1.0 : 1.0;
  settings.torque_constant_Nm_per_A = checked.number("torque_constant_Nm_per_A");
  settings.velocity_limit_turnps = checked.number("velocity_limit_turnps");
  settings.watchdog_timeout_s = checked.number("watchdog_timeout_s");
  const auto endpoint = [&](std::string_view name) {
    return static_cast<std::uint16_t>(checked.number(name));
  };
  settings.watchdog_enable_endpoint = endpoint("watchdog_enable_endpoint");
  settings.watchdog_timeout_endpoint = endpoint("watchdog_timeout_endpoint");
  const bool one = settings.watchdog_enable_endpoint != 0;
  const bool other = settings.watchdog_timeout_endpoint != 0;
  if (one != other)
    throw std::runtime_error(
        "watchdog_enable_endpoint and watchdog_timeout_endpoint are given together or not at all");
  if (one && settings.firmware != Firmware::v0_6)
    throw std::runtime_error(
        "watchdog_enable_endpoint: firmware 0.5.6 cannot be configured over CAN; save the "
        "watchdog in the drive and state watchdog_timeout_s only");
  if (one && settings.watchdog_timeout_s <= 0)
    throw std::runtime_error("watchdog_timeout_s must be given with the end points");
  if (one && settings.watchdog_enable_endpoint == settings.watchdog_timeout_endpoint)
    throw std::runtime_error("watchdog_timeout_endpoint is the same as watchdog_enable_endpoint");
  settings.stale_after = checked.seconds("stale_s");
  settings.heartbeat_timeout = checked.seconds("heartbeat_timeout_s");
  settings.setpoint_period = checked.seconds("setpoint_period_s");
  settings.poll_period = checked.seconds("poll_s");
  settings.arming_timeout = checked.seconds("arming_timeout_s");
  if (settings.watchdog_timeout_s > 0 &&
      settings.watchdog_timeout_s < 2.5 * to_s(settings.setpoint_period))
    throw std::runtime_error("watchdog_timeout_s is shorter than 2.5 set point periods");
  return settings;
}

}  // namespace drover::odrive
