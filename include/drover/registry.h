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

/// What a device is to the robot.
enum class SlotKind : std::uint8_t { drive, gnss, imu, battery, line, scanner };

/// What a link carries, and so which face a device on it has.
enum class Wire : std::uint8_t { can, bytes, registers, levels };

/// What a driver is told of its place, beside its options.
struct MakeContext {
  SlotKind kind = SlotKind::drive;
  /// Of what moves something: its joints, by channel.
  FixedVector<AxisId, kMaxChannels> axes = {};
  Line line = Line::estop;                 ///< of a line
  const RegisterMap* registers = nullptr;  ///< of a device that names a map; else nullptr

  /// The joint of a channel. Who only looks what a driver is like names none: then they count from
  /// 0.
  AxisId axis(std::size_t channel) const {
    return channel < axes.size() ? axes[channel] : static_cast<AxisId>(channel);
  }
};

/// Throws std::runtime_error naming the option; only at start-up.
using MakeDevice = Made (*)(const Options&, const MakeContext&);

using MakeCanTwin = std::unique_ptr<CanTwin> (*)(const Options&);
using MakeByteDriveTwin = std::unique_ptr<ByteDriveTwin> (*)(const Options&);
/// `seed` is the only source of the twin's randomness.
using MakeGnssTwin = std::unique_ptr<GnssTwin> (*)(const Options&, std::uint64_t seed);
using MakeImuTwin = std::unique_ptr<ImuTwin> (*)(const Options&, std::uint64_t seed);
using MakeCanImuTwin = std::unique_ptr<CanImuTwin> (*)(const Options&, std::uint64_t seed);
using MakeScannerTwin = std::unique_ptr<ScannerTwin> (*)(const Options&, std::uint64_t seed);
using MakeRegisterTwin = std::unique_ptr<RegisterTwin> (*)(const Options&, const RegisterMap&);

struct DriverEntry {
  std::string_view name;    ///< as written in the configuration
  std::string_view folder;  ///< below drivers/
  std::span<const OptionSpec> options;
  SlotKind kind = SlotKind::drive;  ///< what its device is to the robot
  Wire wire = Wire::can;            ///< what it hangs on
  /// Speeds at which it speaks on a serial line, usual one first. Empty: any.
  std::span<const int> bauds = {};
  /// What its devices move, in the order in which they are told. Empty: nothing.
  std::span<const Channel> channels = {};
  MakeDevice make = nullptr;
  /// Options of the simulated device; its factory gets these and the driver's in one Options.
  std::span<const OptionSpec> twin_options;
  std::variant<std::monostate, MakeCanTwin, MakeGnssTwin, MakeImuTwin, MakeRegisterTwin,
               MakeByteDriveTwin, MakeCanImuTwin, MakeScannerTwin>
      make_twin;
  std::string_view summary;  ///< one line for people
  /// What people call its devices who do not know the driver's name: small letters and digits.
  std::span<const std::string_view> products = {};
  /// Shafts that the simulated device turns, in the order of its README. 0: one for each channel.
  std::size_t twin_shafts = 0;
  /// What takes its twist steers: it turns on curves only, tells the angle of its wheels
  /// (BodyMotion::steering_rad), and the shafts of its twin behind the first two are steered.
  bool steers = false;
};

/// Its devices are told how the whole base shall move, and so have no joints.
inline bool takes_twist(const DriverEntry& entry) {
  return !entry.channels.empty() && entry.channels[0].mode == ChannelMode::twist;
}

std::span<const DriverEntry> driver_registry();
/// nullptr when there is none of that name.
const DriverEntry* find_driver(std::string_view name);
/// The same, and nullptr when its device is something else.
const DriverEntry* find_driver(std::string_view name, SlotKind kind);
/// The driver that speaks with what somebody calls so: a product, or a maker ("ZED-F9P",
/// "daly_bms"). nullptr: none is known to.
const DriverEntry* find_by_product(std::string_view product);
/// It is asked for now and then, and no driver speaks with it.
bool is_spoken_by_none(std::string_view product);

}  // namespace drover
