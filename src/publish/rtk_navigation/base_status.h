// The `base_status` topic: the snapshot in the document's words.
//
// RTK navigation protocol, "状态反馈 base_status". Every field is always there and of the
// document's type; where a value is unknown the last one stays, 0 before the first.
#pragma once

#include <cstdint>
#include <string>

#include "drover/heading.h"
#include "drover/snapshot.h"

namespace drover::publish {

using drover::angle_deg_from_compass;
using drover::HeadingConvention;

/// What `robot.power` carries.
enum class PowerUnit : std::uint8_t { percent, volts };

/// What `robot.vz` carries, to the left positive: how fast the robot turns, or of one that steers
/// the angle of a front wheel in the middle, also at rest.
enum class TurnShown : std::uint8_t { yaw_rate, steering_angle };

/// Field names are the configuration file's keys.
struct RtkConfig {
  HeadingConvention heading = HeadingConvention::clockwise_from_north;
  PowerUnit power = PowerUnit::percent;
  TurnShown vz = TurnShown::yaw_rate;
};

/// `bms.error`, which the document leaves open: 0 all is well, 1 nothing is known now, 2 the pack
/// warns, 3 the pack will switch off or has.
int bms_error(const BatterySnapshot& battery);
/// `bms.status`, which the document leaves open: 0 idle or unknown, 1 charging, 2 discharging; 4 is
/// added while a charger is connected.
int bms_status(const BatterySnapshot& battery);

/// The document knows 0, 1, 2, 4, 5. PPS counts as single; estimated, manual and simulated
/// positions are no fix.
int rtk_status(FixQuality quality);
/// Bits of the GT01's status word: 0 hard e-stop, 2 soft e-stop, 3 remote control offline (always:
/// there is none yet), 4 front bumper.
int robot_status(const Snapshot& snapshot);

/// Keeps what stays when a value becomes unknown, hence a class.
class BaseStatus final {
 public:
  explicit BaseStatus(const RtkConfig& config) : config_(config) {}

  /// One message, of a snapshot as it is seen now. Added to the document: bms.valid, robot.valid
  /// (whether the speeds are of now), nav.owner, nav.why (a list of texts, the cause first, empty
  /// when all is well).
  std::string text(const Snapshot& snapshot);

 private:
  /// `value` when it is finite, otherwise what it last was.
  static double keep(double& last, double value);
  double power(const Snapshot& snapshot);

  RtkConfig config_;
  // Of the battery, the last that was known.
  double current_A_ = 0;
  double voltage_V_ = 0;
  double soc_percent_ = 0;
  double remaining_Ah_ = 0;
  double temperature_degC_ = 0;
  double x_m_ = 0;
  double y_m_ = 0;
  double yaw_rad_ = 0;
  double vx_mps_ = 0;
  double vy_mps_ = 0;
  double turn_ = 0;
  double latitude_deg_ = 0;
  double longitude_deg_ = 0;
  double angle_deg_ = 0;
  double bus_V_ = 0;
};

}  // namespace drover::publish
