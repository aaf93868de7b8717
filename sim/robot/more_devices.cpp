#include "sim/robot/more_devices.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "drover/angle.h"

namespace drover::sim {

GnssTruth gnss_truth(const Plant& plant, const GeographicLib::LocalCartesian& earth,
                     const GnssSpec& spec) {
  const Plant::Vector arm{spec.antenna_x_m, spec.antenna_y_m, spec.antenna_z_m};
  const auto at = plant.point_m(arm);
  const auto speed = plant.point_velocity_mps(arm);
  GnssTruth truth;
  earth.Reverse(at.x, at.y, at.z, truth.latitude_deg, truth.longitude_deg, truth.altitude_m);
  truth.ahead_deg = compass_deg_from_yaw_rad(plant.pose().yaw_rad);
  truth.heading_deg = wrap_deg(truth.ahead_deg + spec.heading_offset_deg);
  truth.speed_mps = std::hypot(speed.x, speed.y);
  truth.course_deg = compass_deg_from_yaw_rad(std::atan2(speed.y, speed.x));
  return truth;
}

// The specific force is the change of the sensor's velocity over the last tick, which averages what
// happened in it as a sensor's filter does, and gravity.
ImuTruth imu_truth(const Plant& plant, const Plant::Vector& place,
                   std::optional<Plant::Vector>& before) {
  constexpr double kGravity_mps2 = 9.80665;
  constexpr double kTick_s = 0.005;
  const auto velocity = plant.point_velocity_mps(place);
  const auto old = before.value_or(velocity);
  before = velocity;
  const auto force =
      plant.in_base_axes({(velocity.x - old.x) / kTick_s, (velocity.y - old.y) / kTick_s,
                          (velocity.z - old.z) / kTick_s + kGravity_mps2});
  const BaseVelocity turn = plant.velocity();
  ImuTruth truth;
  truth.specific_force_mps2 = {force.x, force.y, force.z};
  truth.angular_velocity_radps = {turn.wx_radps, turn.wy_radps, turn.wz_radps};
  truth.orientation = plant.orientation();
  return truth;
}

MoreDevices::MoreDevices(const std::vector<MoreSpec>& specs, std::uint64_t seed) {
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const MoreSpec& spec = specs[i];
    // A stream of noise for each.
    const std::uint64_t own_seed = seed ^ (0x6D6F7265U + 0x9E3779B97F4A7C15U * (i + 1));
    Device device;
    device.spec = spec;
    try {
      if (spec.gnss)
        device.gnss =
            std::get<MakeGnssTwin>(spec.gnss->driver->make_twin)(spec.gnss->options, own_seed);
      if (spec.imu && spec.imu->bus)
        device.can_imu.emplace(
            std::get<MakeCanImuTwin>(spec.imu->driver->make_twin)(spec.imu->options, own_seed),
            *spec.imu->bus);
      else if (spec.imu)
        device.imu =
            std::get<MakeImuTwin>(spec.imu->driver->make_twin)(spec.imu->options, own_seed);
      if (spec.battery) {
        device.registers = std::get<MakeRegisterTwin>(spec.battery->driver->make_twin)(
            spec.battery->options, spec.battery->map);
        device.battery.emplace(spec.battery->model);
      }
    } catch (const std::exception& error) {
      throw std::runtime_error("more." + spec.name + ": " + error.what());
    }
    devices_.push_back(std::move(device));
  }
}

std::size_t MoreDevices::batteries() const {
  return static_cast<std::size_t>(
      std::count_if(devices_.begin(), devices_.end(),
                    [](const Device& device) { return device.battery.has_value(); }));
}

void MoreDevices::step(Time now, const Plant& plant, const GeographicLib::LocalCartesian& earth,
                       double wheels_W) {
  for (Device& device : devices_) {
    const MoreSpec& spec = device.spec;
    if (device.gnss)
      device.size = device.gnss->on_tick(now, gnss_truth(plant, earth, *spec.gnss), device.bytes);
    if (spec.imu) {
      const Plant::Vector place{spec.imu->x_m, spec.imu->y_m, spec.imu->z_m};
      const ImuTruth truth = imu_truth(plant, place, device.velocity_mps);
      if (device.can_imu)
        device.can_imu->step(now, truth);
      else
        device.size = device.imu->on_tick(now, truth, device.bytes);
    }
    if (!device.battery) continue;
    device.battery->step(0.005, wheels_W);
    if (now < device.next_battery) continue;
    device.next_battery = now + std::chrono::milliseconds(100);
    device.registers->set_truth(device.battery->truth());
  }
}

int MoreDevices::baud(std::size_t i) const {
  return devices_[i].imu ? static_cast<int>(devices_[i].imu->baud()) : 0;
}

void MoreDevices::on_bytes(std::size_t i, std::span<const std::uint8_t> bytes, Time now) {
  if (devices_[i].imu && !bytes.empty()) devices_[i].imu->on_bytes(bytes, now);
}

void MoreDevices::on_frame(std::size_t bus, const CanFrame& frame, Time now) {
  for (Device& device : devices_)
    if (device.can_imu) device.can_imu->on_frame(bus, frame, now);
}

void MoreDevices::send(Drives& drives) const {
  for (const Device& device : devices_)
    if (device.can_imu) drives.send_too(device.can_imu->bus(), device.can_imu->frames());
}

std::optional<std::string> MoreDevices::command(std::string_view kind, std::string_view name,
                                                std::string_view what, std::string_view value,
                                                Time now) {
  const auto it = std::find_if(devices_.begin(), devices_.end(), [&](const Device& device) {
    return device.spec.name == name && device.spec.kind() == kind;
  });
  if (it == devices_.end()) return std::nullopt;
  if (it->gnss && it->gnss->set_state(what, now)) return "ok";
  if (it->imu && it->imu->set_state(what == "well" ? "" : what, now)) return "ok";
  if (it->can_imu && it->can_imu->command(what, now)) return "ok";
  if (it->battery) {
    double percent = -1;
    const auto end = value.data() + value.size();
    const bool number = std::from_chars(value.data(), end, percent).ptr == end;
    if (what == "charger" && (value == "plug" || value == "unplug")) {
      it->battery->set_charger(value == "plug");
      return "ok";
    }
    if (what == "soc" && number && percent >= 0 && percent <= 100) {
      it->battery->set_soc(percent);
      return "ok";
    }
  }
  return "error: " + std::string(name) + " knows no '" + std::string(what) + "'";
}

}  // namespace drover::sim
