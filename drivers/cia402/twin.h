// A simulated drive of CiA 402: a CANopen node, one velocity controller, one shaft.
//
// It starts pre-operational, off, without a mapping. When the heartbeat that it watches ceases it
// does what 6007 says: a quick stop, after which it holds, or a fault, which lets go.
#pragma once

#include "drivers/canopen/cia402.h"
#include "drivers/canopen/twin_node.h"
#include "drivers/cia402/settings.h"

namespace drover::cia402 {

/// The simulated device's own numbers, at the joint.
struct TwinSettings {
  double torque_limit_Nm = 30;
  double velocity_gain_Nms_per_rad = 8;
  double integrator_gain_Nm_per_rad = 60;
  Duration boot_time{};
};

class Cia402Twin final : public CanTwin {
 public:
  Cia402Twin(const Settings& settings, const TwinSettings& twin);

  void on_frame(const CanFrame& frame, Time now, TwinFrames& out) override;
  void on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) override;
  void set_power(bool on, Time now) override;
  /// Known: "over_temperature" (with its emergency message), "silent" (sends nothing, still
  /// obeys), "dead" (as without power, until it is cleared).
  bool set_fault(std::string_view name, Time now) override;

 private:
  void boot(Time now, TwinFrames& out);
  void fail(std::uint16_t code);
  void on_controlword(std::uint16_t word);
  double torque(double dt_s);
  void measure(const Shaft& shaft);

  Settings settings_;
  TwinSettings twin_;
  canopen::TwinNode node_;
  canopen::DriveState drive_ = canopen::DriveState::switch_on_disabled;
  bool powered_ = true;
  bool booted_ = false;
  bool silent_ = false;
  bool dead_ = false;
  Time boot_at_ = kNever;
  Time last_tick_ = kNever;
  std::uint16_t controlword_ = 0;
  std::uint16_t emergency_ = 0;  ///< to be told
  double ramped_ = 0;            ///< in units of 60FF
  double measured_radps_ = 0;    ///< of the joint, as the motor turns
  double power_on_rad_ = 0;
  double integral_Nm_ = 0;
};

}  // namespace drover::cia402
