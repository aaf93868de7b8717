// The simulated chassis behind either wire: two tracks with speed controllers, its stops and its
// faults. Of its shafts the first half drives the left track, the others the right one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "drivers/gt01/settings.h"
#include "drover/options.h"
#include "drover/time.h"
#include "drover/twin.h"
#include "drover/twist.h"

namespace drover::gt01 {

/// Front left, rear left, front right, rear right.
inline constexpr std::size_t kTwinShafts = 4;

struct ChassisSettings {
  double wheel_radius_m = 0.085;
  double track_m = 0.725;
  double torque_limit_Nm = 60;             ///< of a side
  double velocity_gain_Nms_per_rad = 20;   ///< of a side
  double integrator_gain_Nm_per_rad = 80;  ///< of a side
  double acceleration_mps2 = 2;
  Duration boot_time{};
};

std::span<const OptionSpec> chassis_option_table();
ChassisSettings read_chassis_settings(const Options& options);

/// What is wrong with it.
struct ChassisFaults {
  bool silent = false;  ///< it tells nothing, and obeys
  bool deaf = false;    ///< it tells, and hears nothing
  bool bad_sums = false;
  bool stuck_encoder = false;  ///< the speeds that it tells do not change
  bool hard_estop = false;
  bool soft_estop = false;
  bool bumper = false;
  bool remote = false;  ///< somebody drives it by its remote control
  bool over_current = false;
  bool docking = false;  ///< it drives to its charger by itself: it hears no host
  bool operator==(const ChassisFaults&) const = default;
};

class ChassisModel final {
 public:
  ChassisModel(const Settings& settings, const ChassisSettings& chassis)
      : settings_(settings), chassis_(chassis) {}

  void on_twist(const Twist& told, Time now);
  void on_soft_estop(bool on) { faults_.soft_estop = on; }
  void set_power(bool on, Time now);
  bool set_fault(std::string_view name);
  void on_tick(Time now, std::span<Shaft> shafts);

  bool is_up() const { return up_; }
  bool tells() const { return up_ && !faults_.silent; }
  const ChassisFaults& faults() const { return faults_; }
  /// Somebody commands it, and it obeys.
  bool obeys_host() const { return hosted_ && !faults_.remote && !faults_.docking; }
  double left_mps() const { return told_mps_[0]; }
  double right_mps() const { return told_mps_[1]; }
  Twist twist() const;  ///< as it tells it
  static constexpr double kVoltage_V = 51.0;

 private:
  bool stopped() const;
  Twist target(Time now) const;
  void drive(std::span<Shaft> shafts, std::size_t side, double target_mps, double dt_s);

  Settings settings_;
  ChassisSettings chassis_;
  ChassisFaults faults_;
  bool powered_ = true;
  bool up_ = false;
  bool hosted_ = false;       ///< a host's twist is younger than its time-out
  bool rests_first_ = false;  ///< after a stop it obeys again only once it stood
  Time up_at_ = kNever;
  Time last_tick_ = kNever;
  Time last_twist_ = kNever;
  Twist twist_;
  std::array<double, 2> ramped_mps_{};
  std::array<double, 2> integral_Nm_{};
  std::array<double, 2> measured_mps_{};
  std::array<double, 2> told_mps_{};
};

/// The next instant of something that is due in each `period`; a plant that was held up catches up
/// without a burst.
bool is_due(Time& next, Duration period, Time now);

}  // namespace drover::gt01
