// Drives of CiA 402: factories, the simulated drive's options and the line in the registry.
#include "drivers/cia402/entry.h"

#include "drivers/checked_options.h"
#include "drivers/cia402/driver.h"
#include "drivers/cia402/twin.h"

namespace drover {
namespace cia402 {
namespace {

const OptionSpec kTwinOptions[] = {
    {.name = "torque_limit_Nm",
     .default_value = 30.0,
     .min = 0.01,
     .max = 10000,
     .text = "at the joint"},
    {.name = "velocity_gain_Nms_per_rad",
     .default_value = 8.0,
     .min = 0,
     .max = 10000,
     .text = "of the velocity controller, at the joint"},
    {.name = "integrator_gain_Nm_per_rad",
     .default_value = 60.0,
     .min = 0,
     .max = 100000,
     .text = "of the velocity controller, at the joint"},
    {.name = "boot_s",
     .default_value = 0.5,
     .min = 0,
     .max = 60,
     .text = "silence after the supply comes back"},
};

Made make(const Options& options, const MakeContext& context) {
  return make_device<Cia402Driver>(read_settings(options), context.axis(0));
}

std::unique_ptr<CanTwin> make_twin(const Options& options) {
  const CheckedOptions checked(options, kTwinOptions);
  TwinSettings twin;
  twin.torque_limit_Nm = checked.number("torque_limit_Nm");
  twin.velocity_gain_Nms_per_rad = checked.number("velocity_gain_Nms_per_rad");
  twin.integrator_gain_Nm_per_rad = checked.number("integrator_gain_Nm_per_rad");
  twin.boot_time = checked.seconds("boot_s");
  return std::make_unique<Cia402Twin>(read_settings(options), twin);
}

constexpr std::string_view kProducts[] = {"epos4", "ds402"};

}  // namespace
}  // namespace cia402

const DriverEntry kCia402Entry = {
    .name = "cia402",
    .folder = "cia402",
    .options = cia402::option_table(),
    .kind = SlotKind::drive,
    .wire = Wire::can,
    .channels = cia402::kChannels,
    .make = cia402::make,
    .twin_options = cia402::kTwinOptions,
    .make_twin = cia402::make_twin,
    .summary = "a CANopen drive of any maker that speaks CiA 402, in a velocity mode",
    .products = cia402::kProducts,
};

}  // namespace drover
