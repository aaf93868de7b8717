// ZLAC8015D drives: factories, the simulated drive's options and the line in the registry.
#include "drivers/zlac8015d/entry.h"

#include "drivers/checked_options.h"
#include "drivers/zlac8015d/driver.h"
#include "drivers/zlac8015d/twin.h"

namespace drover {
namespace zlac8015d {
namespace {

const OptionSpec kTwinOptions[] = {
    {.name = "torque_limit_Nm",
     .default_value = 30.0,
     .min = 0.01,
     .max = 10000,
     .text = "of each wheel, at the joint"},
    {.name = "velocity_gain_Nms_per_rad",
     .default_value = 8.0,
     .min = 0,
     .max = 10000,
     .text = "of the velocity controllers, at the joint"},
    {.name = "integrator_gain_Nm_per_rad",
     .default_value = 60.0,
     .min = 0,
     .max = 100000,
     .text = "of the velocity controllers, at the joint"},
    {.name = "boot_s",
     .default_value = 0.5,
     .min = 0,
     .max = 60,
     .text = "silence after the supply comes back"},
};

Made make(const Options& options, const MakeContext& context) {
  return make_device<Zlac8015dDriver>(read_settings(options),
                                      std::array{context.axis(kLeft), context.axis(kRight)});
}

std::unique_ptr<CanTwin> make_twin(const Options& options) {
  return std::make_unique<Zlac8015dTwin>(read_settings(options), read_twin_settings(options));
}

constexpr std::string_view kZlac8015dProducts[] = {"zlac8015"};

}  // namespace

std::span<const OptionSpec> twin_option_table() {
  return kTwinOptions;
}

TwinSettings read_twin_settings(const Options& options) {
  const CheckedOptions checked(options, kTwinOptions);
  TwinSettings twin;
  twin.torque_limit_Nm = checked.number("torque_limit_Nm");
  twin.velocity_gain_Nms_per_rad = checked.number("velocity_gain_Nms_per_rad");
  twin.integrator_gain_Nm_per_rad = checked.number("integrator_gain_Nm_per_rad");
  twin.boot_time = checked.seconds("boot_s");
  return twin;
}

}  // namespace zlac8015d

const DriverEntry kZlac8015dEntry = {
    .name = "zlac8015d",
    .folder = "zlac8015d",
    .options = zlac8015d::option_table(),
    .kind = SlotKind::drive,
    .wire = Wire::can,
    .channels = zlac8015d::kChannels,
    .make = zlac8015d::make,
    .twin_options = zlac8015d::twin_option_table(),
    .make_twin = zlac8015d::make_twin,
    .summary = "ZLAC8015D, two hub motors behind one CANopen node, velocity control",
    .products = zlac8015d::kZlac8015dProducts,
};

}  // namespace drover
