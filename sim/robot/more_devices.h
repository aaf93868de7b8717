// Further receivers, inertial sensors and batteries of a robot, each with a name: beside the first
// of each kind, which the scenario has under "gnss", "imu" and "battery".
#pragma once

#include <GeographicLib/LocalCartesian.hpp>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drover/twin.h"
#include "sim/plant/plant.h"
#include "sim/robot/can_imu.h"
#include "sim/robot/drives.h"
#include "sim/robot/scenario.h"

namespace drover::sim {

/// What the receiver at this antenna would measure without an error.
GnssTruth gnss_truth(const Plant& plant, const GeographicLib::LocalCartesian& earth,
                     const GnssSpec& spec);
/// The same of an inertial sensor at `place`. `before`: its velocity a tick ago, which is renewed.
ImuTruth imu_truth(const Plant& plant, const Plant::Vector& place,
                   std::optional<Plant::Vector>& before);

class MoreDevices {
 public:
  /// Throws std::runtime_error naming the device and its option.
  MoreDevices(const std::vector<MoreSpec>& specs, std::uint64_t seed);

  /// One tick; `wheels_W` is what the wheels take of each battery.
  void step(Time now, const Plant& plant, const GeographicLib::LocalCartesian& earth,
            double wheels_W);

  std::size_t size() const { return devices_.size(); }
  std::size_t batteries() const;
  /// What it said at this tick, not yet paced; of a battery nothing.
  std::string_view bytes(std::size_t i) const {
    return {devices_[i].bytes.data(), devices_[i].size};
  }
  int baud(std::size_t i) const;  ///< at which an inertial sensor speaks now; 0: as the line
  void on_bytes(std::size_t i, std::span<const std::uint8_t> bytes, Time now);
  /// A frame on a bus (index into the scenario's).
  void on_frame(std::size_t bus, const CanFrame& frame, Time now);
  /// What those on buses said at this tick, beside the drives.
  void send(Drives& drives) const;
  const RegisterTwin* registers(std::size_t i) const { return devices_[i].registers.get(); }

  /// "gnss NAME STATE", "imu NAME STATE|well", "battery NAME soc P", "battery NAME charger plug".
  /// Nothing: there is no such device.
  std::optional<std::string> command(std::string_view kind, std::string_view name,
                                     std::string_view what, std::string_view value, Time now);

 private:
  struct Device {
    MoreSpec spec;
    std::unique_ptr<GnssTwin> gnss;
    std::unique_ptr<ImuTwin> imu;
    std::optional<CanImu> can_imu;  ///< in place of `imu`
    std::unique_ptr<RegisterTwin> registers;
    std::optional<Battery> battery;
    Time next_battery = kNever;
    std::optional<Plant::Vector> velocity_mps;  ///< of an inertial sensor, a tick ago
    std::array<char, 8192> bytes{};
    std::size_t size = 0;
  };
  std::vector<Device> devices_;
};

}  // namespace drover::sim
