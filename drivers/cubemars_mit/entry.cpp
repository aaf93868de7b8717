// CubeMars motors in MIT mode: factories, the simulated motor's options and the line in the
// registry.
#include "drivers/cubemars_mit/entry.h"

#include "drivers/checked_options.h"
#include "drivers/cubemars_mit/driver.h"
#include "drivers/cubemars_mit/twin.h"

namespace drover {
namespace cubemars_mit {
namespace {

const OptionSpec kTwinOptions[] = {
    {.name = "saved_timeout_ms",
     .default_value = 0.0,
     .min = 0,
     .max = 10000,
     .integer = true,
     .text = "time-out in its flash; 0: what the driver's options state, and none if they do not"},
    {.name = "saved_t_max_Nm",
     .default_value = 0.0,
     .min = 0,
     .max = 1000,
     .text = "end of its torque's range, and the most that it gives; 0: what the driver's options "
             "state. Another one is noticed by nobody"},
    {.name = "mute_while_off",
     .default_value = false,
     .text = "while it is off it answers only the frames that enable and disable it"},
    {.name = "short_answers",
     .default_value = false,
     .text = "it answers with six bytes, as the open firmware: no temperature, no error"},
    mit::time_constant_row(),
    mit::ambient_row(),
    mit::boot_row(),
};

Made make(const Options& options, const MakeContext& context) {
  return make_device<CubemarsDriver>(read_settings(options), context.axis(0));
}

std::unique_ptr<CanTwin> make_twin(const Options& options) {
  const Settings settings = read_settings(options);
  return std::make_unique<CubemarsTwin>(settings, read_twin_settings(options, settings));
}

constexpr std::string_view kCubemarsMitProducts[] = {"cubemars", "ak10", "ak60", "ak70", "ak80"};

}  // namespace

std::span<const OptionSpec> twin_option_table() {
  return kTwinOptions;
}

TwinSettings read_twin_settings(const Options& options, const Settings& settings) {
  const CheckedOptions checked(options, kTwinOptions);
  TwinSettings twin;
  twin.ranges = settings.joint.ranges;
  const double t_max_Nm = checked.number("saved_t_max_Nm");
  if (t_max_Nm > 0) twin.ranges.t_max_Nm = t_max_Nm;
  twin.timeout_ms = checked.number("saved_timeout_ms");
  if (twin.timeout_ms == 0) twin.timeout_ms = settings.timeout_ms;
  twin.mute_while_off = options.flag("mute_while_off");
  twin.short_answers = options.flag("short_answers");
  mit::read_twin(options, kTwinOptions, twin);
  return twin;
}

}  // namespace cubemars_mit

const DriverEntry kCubemarsMitEntry = {
    .name = "cubemars_mit",
    .folder = "cubemars_mit",
    .options = cubemars_mit::option_table(),
    .kind = SlotKind::drive,
    .wire = Wire::can,
    .channels = cubemars_mit::kChannels,
    .make = cubemars_mit::make,
    .twin_options = cubemars_mit::twin_option_table(),
    .make_twin = cubemars_mit::make_twin,
    .summary =
        "CubeMars AK motor on CAN in MIT mode: position, velocity, effort, stiffness, damping",
    .products = cubemars_mit::kCubemarsMitProducts,
};

}  // namespace drover
