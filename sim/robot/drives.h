// The robot's simulated drives: each on its wire, with the shafts that it turns, its supply, and
// what holds its wheels without it.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "drover/twin.h"
#include "sim/plant/plant.h"
#include "sim/robot/scenario.h"

namespace drover::sim {

/// A drive's simulated device, by its wire.
using AnyDriveTwin = std::variant<std::unique_ptr<CanTwin>, std::unique_ptr<ByteDriveTwin>>;

/// From the registry. Throws std::runtime_error naming the drive and its option.
std::vector<AnyDriveTwin> make_drive_twins(const Scenario& scenario);

class Drives {
 public:
  /// Throws std::runtime_error (joints). `twins` in the scenario's order.
  Drives(const Scenario& scenario, std::vector<AnyDriveTwin> twins, const Plant& plant);

  /// A frame on a bus (index into the scenario's), heard by all drives on it.
  void on_frame(std::size_t bus, const CanFrame& frame, Time now);
  /// What was written to a drive's serial line (index into the scenario's drives).
  void on_bytes(std::size_t drive, std::span<const std::uint8_t> bytes, Time now);

  /// Of all of them but those with one of their own; each has its own switch, too.
  void set_supply(bool on, Time now);
  /// What leaves with this tick is what was said since the last one.
  void begin_tick();
  /// One mechanical step: torques and brakes for `plant`. What falls due at the tick's `first` step
  /// leaves with this tick, later things with the next one.
  void turn(Time now, bool first, Plant& plant);

  /// What another device on a bus says: it leaves with this tick.
  void send_too(std::size_t bus, std::span<const CanFrame> frames);

  /// At this tick; on a serial line not yet paced.
  const std::vector<CanFrame>& frames(std::size_t bus) const { return sent_[bus]; }
  std::string_view bytes(std::size_t drive) const { return drives_[drive].sent; }
  /// Of all drives' wheels, in their order. Position and velocity are the plant's.
  void tell_wheels(const Plant& plant, std::vector<Shaft>& wheels) const {
    tell(plant, true, wheels);
  }
  /// The same of an arm's joints.
  void tell_arm(const Plant& plant, std::vector<Shaft>& arm) const { tell(plant, false, arm); }
  /// In the same order.
  std::vector<std::string> arm_joints() const;

  /// "power on", "power off", "fault NAME" for the drives in `list`: "all", or names of drives or
  /// joints with commas between them. Returns "ok" or "error: ...".
  std::string command(std::string_view list, std::string_view verb, std::string_view value,
                      Time now);

 private:
  struct Wheel {
    std::size_t joint = 0;
    bool of_arm = false;
    /// Since when its power stage has been as it is: a brake follows later.
    bool energized = false;
    Time energized_since = kNever;
    double holding_Nm = 0;
  };
  struct Drive {
    AnyDriveTwin twin;
    DriveTwin* device = nullptr;  ///< the same
    std::vector<Wheel> wheels;
    std::vector<Shaft> shafts;  ///< one for each wheel
    std::size_t bus = 0;
    std::string sent;     ///< bytes for this tick
    std::string waiting;  ///< bytes for the next one
    bool own_supply = false;
    bool switched_on = true;
    bool powered = true;
  };
  void tell(const Plant& plant, bool wheels, std::vector<Shaft>& shafts) const;
  void speak(Drive& drive, Time now, bool first);
  void hold(Wheel& wheel, bool energized, Time now, Plant& plant) const;
  void supply(Drive& drive, Time now) const;

  std::vector<DriveSpec> specs_;
  std::vector<Drive> drives_;
  bool brake_ = false;
  bool worm_gear_ = false;
  bool supply_ = true;
  std::vector<std::vector<CanFrame>> sent_;     // by bus: for this tick
  std::vector<std::vector<CanFrame>> waiting_;  // by bus: for the next one
  TwinFrames frames_;                           // of one call
  std::array<char, 1024> bytes_{};              // of one call
};

}  // namespace drover::sim
