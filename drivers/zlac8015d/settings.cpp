// Option table of a ZLAC8015D.
#include "drivers/zlac8015d/settings.h"

#include <stdexcept>

#include "drivers/canopen/nmt.h"
#include "drivers/checked_options.h"

namespace drover::zlac8015d {
namespace {

const OptionSpec kOptions[] = {
    {.name = "node",
     .default_value = 1.0,
     .min = 1,
     .max = canopen::kLastNode,
     .integer = true,
     .text = "node id on the bus; the maker's default is 1"},
    {.name = "left_reversed",
     .default_value = false,
     .text = "the left motor turns against its joint"},
    {.name = "right_reversed",
     .default_value = true,
     .text = "the right motor turns against its joint: so it is when both are mounted alike, each "
             "on its side"},
    {.name = "gear_ratio",
     .default_value = 1.0,
     .min = 0.001,
     .max = 1000,
     .text = "motor turns per turn of the joint; hub motors have 1"},
    {.name = "encoder_lines",
     .default_value = 1024.0,
     .min = 1,
     .max = 65535,
     .integer = true,
     .text = "of the motor's encoder, each four counts; the maker's default is 1024"},
    {.name = "max_rpm",
     .default_value = 300.0,
     .min = 1,
     .max = 1000,
     .text = "faster set points are clamped (motor, rpm); the drive takes 1000"},
    {.name = "steps_per_rpm",
     .default_value = 10.0,
     .min = 1,
     .max = 10,
     .integer = true,
     .text = "object 2026:05, resolution of a target; set and read back. 10: 0.1 rpm"},
    {.name = "silence_ms",
     .default_value = 200.0,
     .min = 0,
     .max = 32767,
     .integer = true,
     .text = "object 2000, the drive's own time-out without commands; set and read back. 0: none, "
             "then it keeps its last speed for ever"},
    {.name = "silence_holds",
     .default_value = false,
     .text =
         "a drive whose time-out fired holds on a slope. The maker does not say: try it. false: "
         "it lets go of its wheels"},
    {.name = "heartbeat_ms",
     .default_value = 100.0,
     .min = 20,
     .max = 1000,
     .integer = true,
     .text = "object 1017, period of the drive's heartbeat; set and read back"},
    {.name = "acceleration_ms",
     .default_value = 100.0,
     .min = 0,
     .max = 32767,
     .integer = true,
     .text = "object 6083; the gateway ramps by itself"},
    {.name = "deceleration_ms",
     .default_value = 100.0,
     .min = 0,
     .max = 32767,
     .integer = true,
     .text = "object 6084: how fast it stops by itself too"},
    {.name = "stale_s",
     .default_value = 0.1,
     .min = 0.02,
     .max = 2,
     .text = "without velocities for longer both wheels count as silent (s); ten periods"},
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
  const auto word = [&](std::string_view name) {
    return static_cast<std::uint16_t>(checked.number(name));
  };
  Settings settings;
  settings.node = static_cast<std::uint8_t>(checked.number("node"));
  settings.sign[kLeft] = options.flag("left_reversed") ? -1 : 1;
  settings.sign[kRight] = options.flag("right_reversed") ? -1 : 1;
  settings.gear_ratio = checked.number("gear_ratio");
  settings.counts_per_turn = 4 * checked.number("encoder_lines");
  settings.max_rpm = checked.number("max_rpm");
  settings.steps_per_rpm = static_cast<int>(checked.number("steps_per_rpm"));
  settings.silence_ms = word("silence_ms");
  settings.silence_holds = options.flag("silence_holds");
  settings.heartbeat_ms = word("heartbeat_ms");
  settings.acceleration_ms = word("acceleration_ms");
  settings.deceleration_ms = word("deceleration_ms");
  settings.stale_after = checked.seconds("stale_s");
  settings.heartbeat_timeout = checked.seconds("heartbeat_timeout_s");
  settings.setpoint_period = checked.seconds("setpoint_period_s");
  settings.arming_timeout = checked.seconds("arming_timeout_s");
  const auto too_short = [](double limit_s, double period_s) { return limit_s < 2.5 * period_s; };
  if (too_short(to_s(settings.heartbeat_timeout), settings.heartbeat_ms / 1000.0))
    throw std::runtime_error("heartbeat_timeout_s is shorter than 2.5 heartbeat_ms");
  if (settings.silence_ms > 0 &&
      too_short(settings.silence_ms / 1000.0, to_s(settings.setpoint_period)))
    throw std::runtime_error("silence_ms is shorter than 2.5 set point periods");
  return settings;
}

}  // namespace drover::zlac8015d
