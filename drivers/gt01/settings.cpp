#include "drivers/gt01/settings.h"

#include <stdexcept>

#include "drivers/checked_options.h"

namespace drover::gt01 {

CommonOptions common_options(double silence_s) {
  return {{
      {.name = "silence_s",
       .default_value = silence_s,
       .min = 0,
       .max = 10,
       .text = "without commands for longer the chassis stops by itself (s). The maker gives no "
               "number: measure it. 0: it keeps its last command"},
      {.name = "zero_holds",
       .default_value = false,
       .text = "a chassis that is told zero holds on a slope. The maker does not say: try it"},
      {.name = "speed_scale",
       .default_value = 1.0,
       .min = 0.5,
       .max = 2,
       .text = "metres that it really drives for each that it is told, and tells"},
      {.name = "turn_scale",
       .default_value = 1.0,
       .min = 0.5,
       .max = 2,
       .text = "radians that it really turns for each that it is told, and tells, on ground where "
               "it does not skid"},
      {.name = "max_speed_mps",
       .default_value = 1.0,
       .min = 0.01,
       .max = 5,
       .text = "faster set points are clamped"},
      {.name = "max_turn_radps",
       .default_value = 1.5,
       .min = 0.01,
       .max = 10,
       .text = "faster turns are clamped"},
      {.name = "command_period_s",
       .default_value = 0.019,
       .min = 0.004,
       .max = 0.1,
       .text = "twists are not sent closer together (s), but for a stop; a little under four ticks "
               "of 5 ms"},
      {.name = "stale_s",
       .default_value = 0.1,
       .min = 0.03,
       .max = 2,
       .text = "without its speed for longer the chassis counts as silent (s); five periods"},
      {.name = "gone_s",
       .default_value = 0.3,
       .min = 0.05,
       .max = 5,
       .text = "silent for longer it is commanded only after a new request (s)"},
      {.name = "obeys_within_s",
       .default_value = 0.5,
       .min = 0.1,
       .max = 10,
       .text = "a chassis that does not obey by then is not in command: a fault (s)"},
  }};
}

Settings read_settings(const Options& options, std::span<const OptionSpec> specs) {
  const CheckedOptions checked(options, specs);
  Settings settings;
  settings.silence = checked.seconds("silence_s");
  settings.zero_holds = options.flag("zero_holds");
  settings.speed_scale = checked.number("speed_scale");
  settings.turn_scale = checked.number("turn_scale");
  settings.max_speed_mps = checked.number("max_speed_mps");
  settings.max_turn_radps = checked.number("max_turn_radps");
  settings.command_period = checked.seconds("command_period_s");
  settings.stale_after = checked.seconds("stale_s");
  settings.gone_after = checked.seconds("gone_s");
  settings.obeys_within = checked.seconds("obeys_within_s");
  if (settings.gone_after < settings.stale_after)
    throw std::runtime_error("gone_s is shorter than stale_s");
  if (settings.silence > Duration{} && 2 * settings.silence < 5 * settings.command_period)
    throw std::runtime_error("silence_s is shorter than 2.5 command_period_s");
  return settings;
}

}  // namespace drover::gt01
