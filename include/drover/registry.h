// The table of drivers: a line each, in drivers/registry.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <variant>

#include "drover/driver.h"
#include "drover/options.h"
#include "drover/register_map.h"
#include "drover/twin.h"

namespace drover {

using MakeCanDriver = std::unique_ptr<CanDriver> (*)(const Options&, AxisId axis);
using MakeByteDriver = std::unique_ptr<ByteDriver> (*)(const Options&);
using MakeRegisterDriver = std::unique_ptr<RegisterDriver> (*)(const Options&, const RegisterMap&);
using MakeLineDriver = std::unique_ptr<LineDriver> (*)(const Options&, Line line);
using MakeCanTwin = std::unique_ptr<CanTwin> (*)(const Options&);
/// `seed` is the only source of the twin's randomness.
using MakeGnssTwin = std::unique_ptr<GnssTwin> (*)(const Options&, std::uint64_t seed);
using MakeImuTwin = std::unique_ptr<ImuTwin> (*)(const Options&, std::uint64_t seed);
using MakeRegisterTwin = std::unique_ptr<RegisterTwin> (*)(const Options&, const RegisterMap&);

/// What a driver's device is to the robot: the section of the configuration it may stand in.
enum class Device : std::uint8_t { drive, gnss, imu, battery, line };

/// Factories throw std::runtime_error naming the option; only at start-up.
struct DriverEntry {
  std::string_view name;    ///< as written in the configuration
  std::string_view folder;  ///< below drivers/
  std::span<const OptionSpec> options;
  Device device = Device::drive;
  std::variant<MakeCanDriver, MakeByteDriver, MakeLineDriver, MakeRegisterDriver> make;
  /// Options of the simulated device; its factory gets these and the driver's in one Options.
  std::span<const OptionSpec> twin_options;
  std::variant<std::monostate, MakeCanTwin, MakeGnssTwin, MakeImuTwin, MakeRegisterTwin> make_twin;
  std::string_view summary;  ///< one line for people
};

std::span<const DriverEntry> driver_registry();
/// nullptr when there is none of that name.
const DriverEntry* find_driver(std::string_view name);

}  // namespace drover
