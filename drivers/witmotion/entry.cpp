// Options of the WitMotion driver and its twin, and its line in the registry.
#include "drivers/witmotion/entry.h"

#include <memory>

#include "drivers/checked_options.h"
#include "drivers/witmotion/driver.h"
#include "drivers/witmotion/twin.h"

namespace drover {
namespace witmotion {
namespace {

constexpr std::string_view kOrientations[] = {"angles", "quaternion", "none"};
constexpr std::string_view kProtocols[] = {"standard", "combined"};

const OptionSpec kOptions[] = {
    {.name = "rate_Hz",
     .default_value = 100.0,
     .min = 0.2,
     .max = 200.0,
     .text = "samples a second: 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 125 or 200"},
    {.name = "baud",
     .default_value = 115200.0,
     .min = 4800.0,
     .max = 921600.0,
     .integer = true,
     .text = "speed of the line (bit/s), as the link is opened with; the device is set to it"},
    {.name = "stale_s",
     .default_value = 0.0,
     .min = 0.0,
     .max = 30.0,
     .text = "without a good sample for longer the source is stale (s); 0: five periods, at least "
             "0.05"},
    {.name = "orientation",
     .default_value = std::string("angles"),
     .choices = kOrientations,
     .text = "what the device's own attitude is asked for as; cheap models know angles only"},
    {.name = "magnetic_field", .default_value = false, .text = "ask for the magnetic field too"},
    {.name = "use_magnetic_yaw",
     .default_value = false,
     .text = "the device's nine-axis algorithm, yaw from the magnetometer; off: six axes, yaw from "
             "an arbitrary start. Motors and steel bend the field: leave it off on a vehicle"},
    {.name = "magnetic_yaw_offset_deg",
     .default_value = 0.0,
     .min = -180.0,
     .max = 180.0,
     .text = "with use_magnetic_yaw: counter-clockwise from east to the device's yaw 0 (degrees)"},
    {.name = "mount_roll_deg",
     .default_value = 0.0,
     .min = -180.0,
     .max = 180.0,
     .text = "attitude of the sensor's axes in base_link, order Z, Y, X (degrees)"},
    {.name = "mount_pitch_deg",
     .default_value = 0.0,
     .min = -90.0,
     .max = 90.0,
     .text = "the same: positive turns its x axis down"},
    {.name = "mount_yaw_deg",
     .default_value = 0.0,
     .min = -180.0,
     .max = 180.0,
     .text = "the same: -90 when the label's Y points ahead and its X to the right"},
    {.name = "bandwidth_Hz",
     .default_value = 0.0,
     .min = 0.0,
     .max = 256.0,
     .text = "the device's own filter: 5, 10, 21, 44, 94, 184 or 256 Hz, the next above; 0: the "
             "least that is not below rate_Hz"},
    {.name = "configure",
     .default_value = true,
     .text = "set rate, content, bandwidth, algorithm and speed of a device that differs, and save "
             "them in it; off: nothing is ever written to it"},
    {.name = "frozen_samples",
     .default_value = 10.0,
     .min = 3.0,
     .max = 1000.0,
     .integer = true,
     .text = "so many samples with the same numbers in every channel are a fault"},
    {.name = "protocol",
     .default_value = std::string("standard"),
     .choices = kProtocols,
     .text = "standard: frames of 11 bytes; combined: 20 bytes, as units with Bluetooth send them "
             "on USB (never configured by this driver)"},
};

const OptionSpec kTwinOptions[] = {
    {.name = "factory",
     .default_value = false,
     .text = "starts as it is shipped: 9600, 10 Hz, nine axes"},
    {.name = "rate_sigma_dps",
     .default_value = 0.05,
     .min = 0.0,
     .max = 10.0,
     .text = "one sigma of the noise of each rate (degrees a second)"},
    {.name = "bias_sigma_dps",
     .default_value = 0.3,
     .min = 0.0,
     .max = 10.0,
     .text = "one sigma of the bias of each rate at the start (degrees a second)"},
    {.name = "bias_walk_dps_per_sqrt_s",
     .default_value = 0.0005,
     .min = 0.0,
     .max = 1.0,
     .text = "how that bias wanders"},
    {.name = "acceleration_sigma_mps2",
     .default_value = 0.02,
     .min = 0.0,
     .max = 10.0,
     .text = "one sigma of the noise of each acceleration (m/s2)"},
    {.name = "acceleration_bias_sigma_mps2",
     .default_value = 0.05,
     .min = 0.0,
     .max = 5.0,
     .text = "one sigma of the bias of each acceleration (m/s2)"},
    {.name = "attitude_sigma_deg",
     .default_value = 0.05,
     .min = 0.0,
     .max = 10.0,
     .text = "one sigma of the device's own roll and pitch (degrees)"},
    {.name = "temperature_degC",
     .default_value = 31.0,
     .min = -40.0,
     .max = 85.0,
     .text = "of the chip"},
    {.name = "magnetic_error_deg",
     .default_value = 12.0,
     .min = -180.0,
     .max = 180.0,
     .text = "what steel near by does to the yaw of nine axes (degrees)"},
};

Made make(const Options& options, const MakeContext&) {
  return make_device<WitmotionDriver>(all_checked(options, kOptions));
}
/// It has the options of both.
std::unique_ptr<ImuTwin> make_twin(const Options& options, std::uint64_t seed) {
  return std::make_unique<WitmotionTwin>(all_checked(all_checked(options, kOptions), kTwinOptions),
                                         seed);
}

constexpr std::string_view kWitmotionProducts[] = {"wt901", "hwt905", "hwt906",
                                                   "wt61",  "jy901",  "wtgahrs"};

}  // namespace
}  // namespace witmotion

// Constant, so that the table that copies it is right whichever file starts first.
constinit const DriverEntry kWitmotionEntry{
    .name = "witmotion",
    .folder = "witmotion",
    .options = witmotion::kOptions,
    .kind = SlotKind::imu,
    .wire = Wire::bytes,
    .make = witmotion::make,
    .twin_options = witmotion::kTwinOptions,
    .make_twin = MakeImuTwin{witmotion::make_twin},
    .summary =
        "inertial sensor of WitMotion (WT901, HWT901, HWT905, JY901 and others) on a serial "
        "line",
    .products = witmotion::kWitmotionProducts,
};

}  // namespace drover
