#include "sim/robot/drives.h"

#include <algorithm>
#include <stdexcept>

namespace drover::sim {
namespace {

// Of a spring-applied brake: its coil lets go, and its spring presses, after these times.
constexpr Duration kBrakeReleases = std::chrono::milliseconds(30);
constexpr Duration kBrakeEngages = std::chrono::milliseconds(50);
constexpr double kHolding_Nm = 40;  // at the wheel; more than its tyre's grip

AnyDriveTwin make_twin(const DriveSpec& drive) {
  if (const auto* make = std::get_if<MakeByteDriveTwin>(&drive.driver->make_twin))
    return (*make)(drive.options);
  return std::get<MakeCanTwin>(drive.driver->make_twin)(drive.options);
}

/// What people call it.
const std::string& name_of(const DriveSpec& drive) {
  return drive.name.empty() ? drive.joints.front() : drive.name;
}

std::vector<std::string_view> split_at_commas(std::string_view list) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at <= list.size();) {
    const auto end = std::min(list.find(',', at), list.size());
    words.push_back(list.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

}  // namespace

std::vector<AnyDriveTwin> make_drive_twins(const Scenario& scenario) {
  std::vector<AnyDriveTwin> twins;
  for (const auto& drive : scenario.drives) {
    try {
      twins.push_back(make_twin(drive));
    } catch (const std::exception& error) {
      throw std::runtime_error("drive '" + name_of(drive) + "': " + error.what());
    }
  }
  return twins;
}

Drives::Drives(const Scenario& scenario, std::vector<AnyDriveTwin> twins, const Plant& plant)
    : specs_(scenario.drives),
      brake_(scenario.brake),
      worm_gear_(scenario.worm_gear),
      sent_(scenario.buses.size()),
      waiting_(scenario.buses.size()) {
  if (twins.size() != specs_.size())
    throw std::runtime_error("the scenario's drives and their twins differ in number");
  for (std::size_t i = 0; i < specs_.size(); ++i) {
    Drive drive;
    drive.bus = specs_[i].bus;
    drive.own_supply = specs_[i].own_supply;
    drive.twin = std::move(twins[i]);
    drive.device =
        std::visit([](const auto& twin) -> DriveTwin* { return twin.get(); }, drive.twin);
    for (const auto& joint : specs_[i].joints) {
      Wheel wheel;
      wheel.joint = plant.joint(joint);
      wheel.of_arm = !plant.is_wheel(wheel.joint);
      drive.wheels.push_back(wheel);
    }
    drive.shafts.resize(drive.wheels.size());
    drives_.push_back(std::move(drive));
  }
}

void Drives::on_frame(std::size_t bus, const CanFrame& frame, Time now) {
  if (frame.error) return;
  for (auto& drive : drives_) {
    const auto* const twin = std::get_if<std::unique_ptr<CanTwin>>(&drive.twin);
    if (twin == nullptr || drive.bus != bus || !drive.powered) continue;
    frames_.clear();
    (*twin)->on_frame(frame, now, frames_);
    waiting_[bus].insert(waiting_[bus].end(), frames_.begin(), frames_.end());
  }
}

void Drives::send_too(std::size_t bus, std::span<const CanFrame> frames) {
  sent_[bus].insert(sent_[bus].end(), frames.begin(), frames.end());
}

void Drives::on_bytes(std::size_t drive, std::span<const std::uint8_t> bytes, Time now) {
  const auto* const twin = std::get_if<std::unique_ptr<ByteDriveTwin>>(&drives_[drive].twin);
  if (twin != nullptr && drives_[drive].powered && !bytes.empty()) (*twin)->on_bytes(bytes, now);
}

void Drives::begin_tick() {
  for (std::size_t bus = 0; bus < sent_.size(); ++bus) {
    sent_[bus].clear();
    sent_[bus].swap(waiting_[bus]);
  }
  for (Drive& drive : drives_) {
    drive.sent.clear();
    drive.sent.swap(drive.waiting);
  }
}

/// What it says; its torques are in its shafts then.
void Drives::speak(Drive& drive, Time now, bool first) {
  if (const auto* const twin = std::get_if<std::unique_ptr<CanTwin>>(&drive.twin)) {
    frames_.clear();
    (*twin)->on_tick(now, drive.shafts, frames_);
    if (!drive.powered) return;
    auto& out = first ? sent_[drive.bus] : waiting_[drive.bus];
    out.insert(out.end(), frames_.begin(), frames_.end());
  } else {
    auto& line = *std::get<std::unique_ptr<ByteDriveTwin>>(drive.twin);
    const std::size_t size = line.on_tick(now, drive.shafts, bytes_);
    if (drive.powered) (first ? drive.sent : drive.waiting).append(bytes_.data(), size);
  }
}

void Drives::turn(Time now, bool first, Plant& plant) {
  for (Drive& drive : drives_) {
    for (std::size_t i = 0; i < drive.wheels.size(); ++i) {
      const WheelState wheel = plant.wheel(drive.wheels[i].joint);
      drive.shafts[i].position_rad = wheel.position_rad;
      drive.shafts[i].velocity_radps = wheel.velocity_radps;
      drive.shafts[i].energized = false;
    }
    speak(drive, now, first);
    for (std::size_t i = 0; i < drive.wheels.size(); ++i) {
      Shaft& shaft = drive.shafts[i];
      // What the turning motor gives back without supply has nowhere to go.
      if (!drive.powered) shaft.torque_Nm = 0;
      plant.set_torque(drive.wheels[i].joint, shaft.torque_Nm);
      hold(drive.wheels[i], drive.powered && shaft.energized, now, plant);
    }
  }
}

void Drives::hold(Wheel& wheel, bool energized, Time now, Plant& plant) const {
  if (wheel.of_arm || (!brake_ && !worm_gear_)) return;
  if (energized != wheel.energized || wheel.energized_since == kNever) {
    // A robot that was just switched on has stood with its brakes on.
    wheel.energized_since = wheel.energized_since == kNever ? now - kBrakeEngages : now;
    wheel.energized = energized;
  }
  const Duration age = now - wheel.energized_since;
  const bool braked = brake_ && (energized ? age < kBrakeReleases : age >= kBrakeEngages);
  const bool held = braked || (worm_gear_ && !energized);
  const double holding_Nm = held ? kHolding_Nm : 0;
  if (holding_Nm != wheel.holding_Nm) plant.set_holding_torque(wheel.joint, holding_Nm);
  wheel.holding_Nm = holding_Nm;
}

void Drives::supply(Drive& drive, Time now) const {
  const bool on = (supply_ || drive.own_supply) && drive.switched_on;
  if (on == drive.powered) return;
  drive.powered = on;
  drive.device->set_power(on, now);
}

void Drives::set_supply(bool on, Time now) {
  supply_ = on;
  for (Drive& drive : drives_) supply(drive, now);
}

void Drives::tell(const Plant& plant, bool wheels, std::vector<Shaft>& shafts) const {
  shafts.clear();
  for (const Drive& drive : drives_) {
    for (std::size_t i = 0; i < drive.wheels.size(); ++i) {
      if (drive.wheels[i].of_arm == wheels) continue;
      const WheelState wheel = plant.wheel(drive.wheels[i].joint);
      shafts.push_back({wheel.position_rad, wheel.velocity_radps, drive.shafts[i].torque_Nm});
    }
  }
}

std::vector<std::string> Drives::arm_joints() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < drives_.size(); ++i)
    for (std::size_t j = 0; j < drives_[i].wheels.size(); ++j)
      if (drives_[i].wheels[j].of_arm) names.push_back(specs_[i].joints[j]);
  return names;
}

std::string Drives::command(std::string_view list, std::string_view verb, std::string_view value,
                            Time now) {
  const bool power = verb == "power" && (value == "on" || value == "off");
  if (!power && (verb != "fault" || value.empty()))
    return "error: say: drive JOINT power on|off, or fault NAME|none";
  const auto words = split_at_commas(list);
  const auto is_meant = [&](const DriveSpec& spec) {
    return list == "all" ||
           std::any_of(words.begin(), words.end(), [&](auto word) { return spec.is_called(word); });
  };
  for (const auto word : words)
    if (list != "all" && std::none_of(specs_.begin(), specs_.end(),
                                      [&](const auto& spec) { return spec.is_called(word); }))
      return "error: no drive '" + std::string(word) + "'";
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (!is_meant(specs_[i])) continue;
    if (power) {
      drives_[i].switched_on = value == "on";
      supply(drives_[i], now);
    } else if (!drives_[i].device->set_fault(value == "none" ? "" : value, now)) {
      return "error: the drive knows no fault '" + std::string(value) + "'";
    }
  }
  return "ok";
}

}  // namespace drover::sim
