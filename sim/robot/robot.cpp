#include "sim/robot/robot.h"

#include <cmath>
#include <stdexcept>

#include "drover/angle.h"

namespace drover::sim {
Twins make_twins(const Scenario& scenario, std::uint64_t seed) {
  Twins twins;
  twins.seed = seed;
  twins.drives = make_drive_twins(scenario);
  if (scenario.gnss) {
    const auto make = std::get<MakeGnssTwin>(scenario.gnss->driver->make_twin);
    try {
      twins.gnss = make(scenario.gnss->options, seed);
    } catch (const std::exception& error) {
      throw std::runtime_error(std::string("gnss: ") + error.what());
    }
  }
  if (scenario.imu) {
    const DriverEntry& driver = *scenario.imu->driver;
    const Options& options = scenario.imu->options;
    const std::uint64_t own_seed = seed ^ 0x696D75U;  // another stream than the receiver's
    try {
      if (const auto* on_can = std::get_if<MakeCanImuTwin>(&driver.make_twin))
        twins.can_imu = (*on_can)(options, own_seed);
      else
        twins.imu = std::get<MakeImuTwin>(driver.make_twin)(options, own_seed);
    } catch (const std::exception& error) {
      throw std::runtime_error(std::string("imu: ") + error.what());
    }
  }
  if (scenario.battery) {
    const auto make = std::get<MakeRegisterTwin>(scenario.battery->driver->make_twin);
    twins.battery = make(scenario.battery->options, scenario.battery->map);
  }
  if (scenario.lidar) {
    const auto make = std::get<MakeScannerTwin>(scenario.lidar->driver->make_twin);
    try {
      twins.lidar = make(scenario.lidar->options, seed ^ 0x6C69646172U);
    } catch (const std::exception& error) {
      throw std::runtime_error(std::string("lidar: ") + error.what());
    }
  }
  return twins;
}

Robot::Robot(const Scenario& scenario, Twins twins)
    : scenario_(scenario),
      plant_(scenario.world),
      earth_(scenario.origin_latitude_deg, scenario.origin_longitude_deg,
             scenario.origin_altitude_m),
      drives_(scenario, std::move(twins.drives), plant_),
      gnss_(std::move(twins.gnss)),
      imu_(std::move(twins.imu)),
      battery_twin_(std::move(twins.battery)),
      more_(scenario.more, twins.seed) {
  const double steps = to_s(kTick) / plant_.timestep_s();
  steps_per_tick_ = static_cast<int>(std::lround(steps));
  if (steps_per_tick_ < 1 || std::abs(steps - steps_per_tick_) > 1e-9)
    throw std::runtime_error(scenario.world + ": the timestep must divide 5 ms");
  if (twins.can_imu) can_imu_.emplace(std::move(twins.can_imu), scenario.imu->bus.value());
  if (twins.lidar) lidar_.emplace(scenario.lidar.value(), std::move(twins.lidar));
  if (battery_twin_) battery_.emplace(scenario.battery ? scenario.battery->model : BatteryModel{});
  drives_.tell_wheels(plant_, truth_.wheels);
  drives_.tell_arm(plant_, truth_.arm);
  plant_.place(scenario.start_x_m, scenario.start_y_m, to_rad(scenario.start_yaw_deg));
}

void Robot::on_frame(std::size_t bus, const CanFrame& frame, Time now) {
  now_ = now;
  drives_.on_frame(bus, frame, now);
  if (can_imu_) can_imu_->on_frame(bus, frame, now);
  more_.on_frame(bus, frame, now);
}

void Robot::on_drive_bytes(std::size_t drive, std::span<const std::uint8_t> bytes, Time now) {
  drives_.on_bytes(drive, bytes, now);
}

// Answers to what came in and the first mechanical step's frames leave with this tick; frames that
// fall due at a later mechanical step leave with the next one.
void Robot::step(Time now) {
  now_ = now;
  drives_.begin_tick();
  supply_drives();
  sense(now);
  tell_gnss(now);
  imu_size_ = imu_ ? imu_->on_tick(now, truth_.imu, imu_bytes_) : 0;
  if (lidar_) lidar_->step(now, plant_);
  more_.step(now, plant_, earth_, battery_power_W());
  if (can_imu_) {
    can_imu_->step(now, truth_.imu);
    drives_.send_too(can_imu_->bus(), can_imu_->frames());
  }
  more_.send(drives_);
  for (int i = 0; i < steps_per_tick_; ++i) {
    const Time at = now + kTick * i / steps_per_tick_;
    drives_.turn(at, i == 0, plant_);
    move_from_outside(at);
    plant_.step();
    object_record_.note_touches(at + kTick / steps_per_tick_, plant_);
  }
  use_battery();
}

/// Packs in parallel share what the drives take.
double Robot::battery_power_W() const {
  double drives_W = 0;
  for (const Shaft& wheel : truth_.wheels) drives_W += wheel.torque_Nm * wheel.velocity_radps;
  for (const Shaft& joint : truth_.arm) drives_W += joint.torque_Nm * joint.velocity_radps;
  return drives_W / static_cast<double>(more_.batteries() + 1);
}

void Robot::use_battery() {
  if (!battery_) return;
  battery_->step(to_s(kTick), battery_power_W());
  if (now_ < next_battery_) return;
  next_battery_ = now_ + std::chrono::milliseconds(100);
  battery_twin_->set_truth(battery_->truth());
}

void Robot::sense(Time now) {
  truth_.time = now;
  truth_.pose = plant_.pose();
  truth_.velocity = plant_.velocity();
  truth_.free_ahead_m = plant_.free_distance_m(scenario_.zone_width_m);
  object_record_.note_objects(now, plant_);
  drives_.tell_wheels(plant_, truth_.wheels);
  drives_.tell_arm(plant_, truth_.arm);
  sense_motion();
  const auto set = [this](LineName line, bool value) {
    sensed_[static_cast<std::size_t>(line)] = value;
  };
  set(LineName::bumper, plant_.bumper_touched());
  set(LineName::zone_far, truth_.free_ahead_m < scenario_.zone_far_m);
  set(LineName::zone_near, truth_.free_ahead_m < scenario_.zone_near_m);
}

void Robot::sense_motion() {
  Plant::Vector place;
  if (scenario_.imu) place = {scenario_.imu->x_m, scenario_.imu->y_m, scenario_.imu->z_m};
  truth_.imu = imu_truth(plant_, place, sensor_velocity_mps_);
}

void Robot::on_imu_bytes(std::span<const std::uint8_t> bytes, Time now) {
  if (imu_ && !bytes.empty()) imu_->on_bytes(bytes, now);
}

void Robot::tell_gnss(Time now) {
  gnss_size_ = 0;
  if (!gnss_) return;
  gnss_size_ = gnss_->on_tick(now, gnss_truth(plant_, earth_, *scenario_.gnss), gnss_bytes_);
}

// Without supply a drive is silent, and its power stage neither drives nor brakes.
bool Robot::supplied() const {
  const bool pressed = forced_[static_cast<std::size_t>(LineName::estop)].value_or(false);
  return (!scenario_.relay_feeds_drives || relay_closed_) &&
         !(scenario_.estop_cuts_power && pressed) && now_ >= dip_until_;
}

void Robot::supply_drives() {
  truth_.supply = supplied();
  drives_.set_supply(truth_.supply, now_);
}

void Robot::move_from_outside(Time now) {
  make_slip(now);
  if (push_until_ != kNever && now >= push_until_) {
    plant_.push(0, 0);
    push_until_ = kNever;
  }
  if (push_tip_until_ != kNever && now >= push_tip_until_) {
    (void)plant_.push_tip({});
    push_tip_until_ = kNever;
  }
  if (!carry_) return;
  const double share = to_s(now - carry_->begin) / carry_->lasts_s;
  if (share >= 1) {
    plant_.carry(std::nullopt);
    carry_.reset();
    return;
  }
  // Begins and ends gently.
  const double rate = 6 * share * (1 - share) / carry_->lasts_s;
  plant_.carry(
      Plant::CarrySpeed{rate * carry_->ahead_m, rate * carry_->left_m, rate * carry_->turn_rad});
}

bool Robot::active(LineName line) const {
  const auto i = static_cast<std::size_t>(line);
  return forced_[i].value_or(sensed_[i]);
}

bool Robot::line_high(LineName line) const {
  return active(line) == scenario_.lines[static_cast<std::size_t>(line)].active_high;
}

}  // namespace drover::sim
