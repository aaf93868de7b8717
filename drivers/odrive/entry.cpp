// ODrive axes: factories, the simulated drive's options and the line in the registry.
#include "drivers/odrive/entry.h"

#include "drivers/checked_options.h"
#include "drivers/odrive/driver.h"
#include "drivers/odrive/twin.h"

namespace drover {
namespace odrive {
namespace {

const OptionSpec kTwinOptions[] = {
    {.name = "torque_limit_Nm",
     .default_value = 40.0,
     .min = 0.01,
     .max = 10000,
     .text = "at the joint"},
    {.name = "velocity_gain_Nms_per_rad",
     .default_value = 8.0,
     .min = 0,
     .max = 10000,
     .text = "of the velocity controller, at the joint; fits a wheel that carries a quarter of "
             "60 kg on a radius of 0.165 m"},
    {.name = "integrator_gain_Nm_per_rad",
     .default_value = 60.0,
     .min = 0,
     .max = 100000,
     .text = "of the velocity controller, at the joint: what holds on a slope gives way by torque "
             "divided by this"},
    {.name = "encoder_counts_per_turn",
     .default_value = 16384.0,
     .min = 1,
     .max = 1e8,
     .text = "of the motor"},
    {.name = "motor_time_constant_s",
     .default_value = 0.002,
     .min = 0,
     .max = 1,
     .text = "from wanted to actual torque"},
    {.name = "estimator_time_constant_s",
     .default_value = 0.002,
     .min = 0,
     .max = 1,
     .text = "of the velocity estimate"},
    {.name = "phase_resistance_ohm", .default_value = 0.1, .min = 0, .max = 100, .text = "heats"},
    {.name = "thermal_resistance_KpW",
     .default_value = 1.5,
     .min = 0.001,
     .max = 1000,
     .text = "motor to air"},
    {.name = "thermal_capacity_JpK",
     .default_value = 300.0,
     .min = 0.1,
     .max = 1e6,
     .text = "of the motor"},
    {.name = "ambient_degC", .default_value = 25.0, .min = -60, .max = 100, .text = "air"},
    {.name = "motor_limit_degC",
     .default_value = 100.0,
     .min = 0,
     .max = 300,
     .text = "the drive disarms above"},
    {.name = "has_thermistor",
     .default_value = true,
     .text = "false: the motor temperature is sent as not a number, as drives do"},
    {.name = "bus_V", .default_value = 48.0, .min = 1, .max = 1000, .text = "supply"},
    {.name = "boot_s",
     .default_value = 0.5,
     .min = 0,
     .max = 60,
     .text = "silence after the supply comes back"},
    {.name = "saved_watchdog_s",
     .default_value = -1.0,
     .min = -1,
     .max = 10,
     .text = "time-out in the simulated drive's flash; 0: none; -1: what the driver's options "
             "state"},
};

Made make(const Options& options, const MakeContext& context) {
  return make_device<OdriveDriver>(read_settings(options), context.axis(0));
}

std::unique_ptr<CanTwin> make_twin(const Options& options) {
  return std::make_unique<OdriveTwin>(read_settings(options), read_twin_settings(options));
}

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
  twin.encoder_counts_per_turn = checked.number("encoder_counts_per_turn");
  twin.motor_time_constant_s = checked.number("motor_time_constant_s");
  twin.estimator_time_constant_s = checked.number("estimator_time_constant_s");
  twin.phase_resistance_ohm = checked.number("phase_resistance_ohm");
  twin.thermal_resistance_KpW = checked.number("thermal_resistance_KpW");
  twin.thermal_capacity_JpK = checked.number("thermal_capacity_JpK");
  twin.ambient_degC = checked.number("ambient_degC");
  twin.motor_limit_degC = checked.number("motor_limit_degC");
  twin.has_thermistor = options.flag("has_thermistor");
  twin.bus_V = checked.number("bus_V");
  twin.boot_time = checked.seconds("boot_s");
  const double saved_s = checked.number("saved_watchdog_s");
  if (saved_s >= 0) twin.saved_watchdog_s = saved_s;
  return twin;
}

}  // namespace odrive

const DriverEntry kOdriveEntry = {
    .name = "odrive",
    .folder = "odrive",
    .options = odrive::option_table(),
    .kind = SlotKind::drive,
    .wire = Wire::can,
    .channels = odrive::kChannels,
    .make = odrive::make,
    .twin_options = odrive::twin_option_table(),
    .make_twin = odrive::make_twin,
    .summary = "ODrive axis on CAN (CANSimple), firmware 0.6 or 0.5.6, velocity control",
};

}  // namespace drover
