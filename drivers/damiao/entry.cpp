// DAMIAO motors: factories, the simulated motor's options and the line in the registry.
#include "drivers/damiao/entry.h"

#include "drivers/checked_options.h"
#include "drivers/damiao/driver.h"
#include "drivers/damiao/twin.h"

namespace drover {
namespace damiao {
namespace {

const OptionSpec kTwinOptions[] = {
    {.name = "saved_p_max_rad",
     .default_value = 0.0,
     .min = 0,
     .max = 1000,
     .text = "end of the position's range in the simulated motor's register; 0: what the driver's "
             "options state"},
    {.name = "saved_v_max_radps",
     .default_value = 0.0,
     .min = 0,
     .max = 1000,
     .text = "the same of the velocity"},
    {.name = "saved_t_max_Nm",
     .default_value = 0.0,
     .min = 0,
     .max = 1000,
     .text = "the same of the torque, and the most that it gives"},
    {.name = "saved_mode",
     .default_value = 1.0,
     .min = 1,
     .max = 4,
     .integer = true,
     .text = "control mode in its flash: 1 MIT, 2 position, 3 velocity, 4 force"},
    {.name = "saved_timeout_ms",
     .default_value = 0.0,
     .min = 0,
     .max = 10000,
     .integer = true,
     .text = "time-out in its flash; 0: none"},
    mit::time_constant_row(),
    mit::ambient_row(),
    mit::boot_row(),
};

Made make(const Options& options, const MakeContext& context) {
  return make_device<DamiaoDriver>(read_settings(options), context.axis(0));
}

std::unique_ptr<CanTwin> make_twin(const Options& options) {
  const Settings settings = read_settings(options);
  return std::make_unique<DamiaoTwin>(settings, read_twin_settings(options, settings));
}

constexpr std::string_view kDamiaoProducts[] = {"dm",     "dmj",    "dm4310", "dm4340",
                                                "dm6006", "dm8006", "dm8009"};

}  // namespace

std::span<const OptionSpec> twin_option_table() {
  return kTwinOptions;
}

TwinSettings read_twin_settings(const Options& options, const Settings& settings) {
  const CheckedOptions checked(options, kTwinOptions);
  TwinSettings twin;
  const auto saved = [&](std::string_view name, double stated) {
    const double value = checked.number(name);
    return value > 0 ? value : stated;
  };
  twin.ranges = {saved("saved_p_max_rad", settings.joint.ranges.p_max_rad),
                 saved("saved_v_max_radps", settings.joint.ranges.v_max_radps),
                 saved("saved_t_max_Nm", settings.joint.ranges.t_max_Nm)};
  twin.saved_mode = static_cast<std::uint32_t>(checked.number("saved_mode"));
  twin.saved_timeout_ms = static_cast<std::uint32_t>(checked.number("saved_timeout_ms"));
  mit::read_twin(options, kTwinOptions, twin);
  return twin;
}

}  // namespace damiao

const DriverEntry kDamiaoEntry = {
    .name = "damiao",
    .folder = "damiao",
    .options = damiao::option_table(),
    .kind = SlotKind::drive,
    .wire = Wire::can,
    .channels = damiao::kChannels,
    .make = damiao::make,
    .twin_options = damiao::twin_option_table(),
    .make_twin = damiao::make_twin,
    .summary = "DAMIAO motor on CAN in MIT mode: position, velocity, effort, stiffness, damping",
    .products = damiao::kDamiaoProducts,
};

}  // namespace drover
