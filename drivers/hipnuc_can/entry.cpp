#include "drivers/hipnuc_can/entry.h"

#include <array>
#include <memory>

#include "drivers/checked_options.h"
#include "drivers/hipnuc_can/driver.h"
#include "drivers/hipnuc_can/twin.h"
#include "drover/rotation.h"

namespace drover {
namespace {

using namespace hipnuc_can;

constexpr std::array<std::string_view, 2> kDialects{"j1939", "canopen"};

const std::array kOptions{
    OptionSpec{.name = "frames",
               .default_value = std::string("j1939"),
               .choices = kDialects,
               .text = "which frames it is set to send: after J1939 (29-bit ids) or after CANopen"},
    OptionSpec{.name = "node",
               .default_value = 8.0,
               .min = 1,
               .max = 127,
               .integer = true,
               .text = "its node, or source address; 8 from the factory"},
    OptionSpec{.name = "rate_Hz",
               .default_value = 100.0,
               .min = 1,
               .max = 500,
               .text = "samples a second that it is set to send: accelerations and rates that come "
                       "within 0.4 of a period are one sample"},
    OptionSpec{.name = "stale_s",
               .default_value = 0.1,
               .min = 0.02,
               .max = 5,
               .text = "without a whole sample for longer the source is stale (s)"},
    OptionSpec{.name = "acceleration_range_g",
               .default_value = 16.0,
               .min = 1,
               .max = 100,
               .text = "what it measures, as its data sheet says: a reading at the end is no "
                       "measurement (g)"},
    OptionSpec{.name = "rate_range_dps",
               .default_value = 2000.0,
               .min = 50,
               .max = 4000,
               .text = "the same of its rates (degrees a second)"},
    OptionSpec{.name = "mount_roll_deg",
               .default_value = 0.0,
               .min = -180,
               .max = 180,
               .text = "attitude of the sensor's axes in base_link, order Z, Y, X (degrees)"},
    OptionSpec{.name = "mount_pitch_deg",
               .default_value = 0.0,
               .min = -90,
               .max = 90,
               .text = "the same: positive turns its x axis down"},
    OptionSpec{.name = "mount_yaw_deg",
               .default_value = 0.0,
               .min = -180,
               .max = 180,
               .text = "the same: -90 when its Y points ahead and its X to the right"},
};

// Of an ordinary sensor of this kind: as its data sheet says, or worse.
const std::array kTwinOptions{
    OptionSpec{.name = "rate_sigma_dps",
               .default_value = 0.05,
               .min = 0,
               .max = 10,
               .text = "one sigma of the noise of each rate (degrees a second)"},
    OptionSpec{.name = "bias_sigma_dps",
               .default_value = 0.3,
               .min = 0,
               .max = 10,
               .text = "one sigma of the bias of each rate (degrees a second)"},
    OptionSpec{.name = "acceleration_sigma_mps2",
               .default_value = 0.02,
               .min = 0,
               .max = 10,
               .text = "one sigma of the noise of each acceleration (m/s2)"},
    OptionSpec{.name = "acceleration_bias_sigma_mps2",
               .default_value = 0.05,
               .min = 0,
               .max = 5,
               .text = "one sigma of the bias of each acceleration (m/s2)"},
    OptionSpec{.name = "attitude_sigma_deg",
               .default_value = 0.05,
               .min = 0,
               .max = 10,
               .text = "one sigma of the device's own roll and pitch (degrees)"},
};

Settings read_settings(const Options& given) {
  const CheckedOptions options(given, kOptions);
  Settings settings;
  settings.address.dialect =
      options.text("frames") == "canopen" ? Dialect::canopen : Dialect::j1939;
  settings.address.node = static_cast<std::uint8_t>(options.number("node"));
  settings.pair_window = from_s(0.4 / options.number("rate_Hz"));
  settings.stale = options.seconds("stale_s");
  settings.acceleration_range_mps2 = options.number("acceleration_range_g") * kGravity_mps2;
  settings.rate_range_radps = to_rad(options.number("rate_range_dps"));
  settings.mount = from_degrees(options.number("mount_roll_deg"), options.number("mount_pitch_deg"),
                                options.number("mount_yaw_deg"));
  return settings;
}

Made make(const Options& options, const MakeContext&) {
  return make_device<HipnucCanDriver>(read_settings(options));
}

/// It has the options of both.
std::unique_ptr<CanImuTwin> make_twin(const Options& given, std::uint64_t seed) {
  const Settings settings = read_settings(given);
  const CheckedOptions options(given, kTwinOptions);
  TwinSettings own;
  own.period = from_s(1 / given.number("rate_Hz"));
  own.rate_sigma_radps = to_rad(options.number("rate_sigma_dps"));
  own.rate_bias_sigma_radps = to_rad(options.number("bias_sigma_dps"));
  own.acceleration_sigma_mps2 = options.number("acceleration_sigma_mps2");
  own.acceleration_bias_sigma_mps2 = options.number("acceleration_bias_sigma_mps2");
  own.attitude_sigma_rad = to_rad(options.number("attitude_sigma_deg"));
  return std::make_unique<HipnucCanTwin>(settings, own, seed);
}

constexpr std::string_view kHipnucCanProducts[] = {"hipnuc", "hi12", "hi13", "hi14", "ch10"};

}  // namespace

const DriverEntry kHipnucCanEntry{
    .name = "hipnuc_can",
    .folder = "hipnuc_can",
    .options = kOptions,
    .kind = SlotKind::imu,
    .wire = Wire::can,
    .make = make,
    .twin_options = kTwinOptions,
    .make_twin = MakeCanImuTwin{make_twin},
    .summary = "HiPNUC inertial sensor on CAN, frames after J1939 or CANopen",
    .products = kHipnucCanProducts,
};

}  // namespace drover
