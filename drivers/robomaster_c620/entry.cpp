// RoboMaster motors: factories, the simulated motors' options and the line in the registry.
#include "drivers/robomaster_c620/entry.h"

#include "drivers/checked_options.h"
#include "drivers/robomaster_c620/driver.h"
#include "drivers/robomaster_c620/twin.h"

namespace drover {
namespace robomaster {
namespace {

const OptionSpec kTwinOptions[] = {
    {.name = "silence_s",
     .default_value = 0.0,
     .min = 0,
     .max = 60,
     .text = "without a command for longer there is no current; 0: the last one stands for ever"},
    {.name = "feedback_Hz",
     .default_value = 1000.0,
     .min = 10,
     .max = 1000,
     .text = "frames of each motor, one in each step of the simulator at the most"},
    {.name = "winding_ohm", .default_value = 0.17, .min = 0, .max = 10, .text = "what heats it"},
    {.name = "thermal_resistance_KpW",
     .default_value = 1.5,
     .min = 0.01,
     .max = 100,
     .text = "from the winding to the air"},
    {.name = "thermal_capacity_JpK",
     .default_value = 150.0,
     .min = 1,
     .max = 10000,
     .text = "of the winding"},
    {.name = "ambient_degC", .default_value = 25.0, .min = -40, .max = 80, .text = "of the air"},
    {.name = "current_noise_A",
     .default_value = 0.0,
     .min = 0,
     .max = 5,
     .text = "at most, of the current that it tells, of its motor none"},
    {.name = "tells_temperature", .default_value = true, .text = "false: as a C610"},
    {.name = "boot_s",
     .default_value = 0.5,
     .min = 0,
     .max = 60,
     .text = "silence after the supply comes back"},
};

Made make(const Options& options, const MakeContext& context) {
  return make_device<RobomasterDriver>(
      read_settings(options), std::array<AxisId, kMotors>{context.axis(0), context.axis(1),
                                                          context.axis(2), context.axis(3)});
}

std::unique_ptr<CanTwin> make_twin(const Options& options) {
  return std::make_unique<RobomasterTwin>(read_settings(options), read_twin_settings(options));
}

constexpr std::string_view kRobomasterC620Products[] = {"m3508", "m2006", "c610", "c620",
                                                        "robomaster"};

}  // namespace

std::span<const OptionSpec> twin_option_table() {
  return kTwinOptions;
}

TwinSettings read_twin_settings(const Options& options) {
  const CheckedOptions checked(options, kTwinOptions);
  TwinSettings twin;
  twin.silence = checked.seconds("silence_s");
  twin.period = from_s(1 / checked.number("feedback_Hz"));
  twin.winding_ohm = checked.number("winding_ohm");
  twin.thermal_resistance_KpW = checked.number("thermal_resistance_KpW");
  twin.thermal_capacity_JpK = checked.number("thermal_capacity_JpK");
  twin.ambient_degC = checked.number("ambient_degC");
  twin.current_noise_A = checked.number("current_noise_A");
  twin.tells_temperature = options.flag("tells_temperature");
  twin.boot_time = checked.seconds("boot_s");
  return twin;
}

}  // namespace robomaster

const DriverEntry kRobomasterC620Entry = {
    .name = "robomaster_c620",
    .folder = "robomaster_c620",
    .options = robomaster::option_table(),
    .kind = SlotKind::drive,
    .wire = Wire::can,
    .channels = robomaster::kChannels,
    .make = robomaster::make,
    .twin_options = robomaster::twin_option_table(),
    .make_twin = robomaster::make_twin,
    .summary = "RoboMaster C620 or C610, four motors told their currents, speed loop of its own",
    .products = robomaster::kRobomasterC620Products,
};

}  // namespace drover
