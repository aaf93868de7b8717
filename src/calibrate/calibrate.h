// The robot's own numbers from a drive: wheel radii, track, signs, lever arm, heading offset,
// lateness of the receiver and of the drives, each with its interval, or why not. Pure.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "calibrate/drive.h"

namespace drover::calibrate {

enum class Quantity {
  wheel_radius_m,
  left_radius_m,
  right_radius_m,
  yaw_slip_factor,  ///< with the track as configured: only their product is seen
  antenna_x_m,
  antenna_y_m,
  heading_offset_deg,
  position_late_s,  ///< what it tells was true so long before its stamp
  heading_late_s,
  gyro_scale,       ///< true turn over the measured one
  gyro_bias_radps,  ///< to be taken off what it measures
  drive_lag_s,      ///< from a command to the rims
  speed_late_s,     ///< of the receiver's own speed
};
inline constexpr std::size_t kQuantities = 13;

/// One of them. Either told, or refused with what to drive.
struct Found {
  Quantity what{};
  double value = 0;
  double interval = 0;  ///< 95 %: the truth is within value +- interval
  double configured = 0;
  bool has_configured = false;
  std::string refused;  ///< why it cannot be told, and what to do; empty: it is told
};

/// Which way round things are, as the configuration has them.
struct Signs {
  bool left_reversed = false;   ///< what is called the left side tells backwards
  bool right_reversed = false;  ///< likewise
  bool swapped = false;         ///< what is called left is on the right
  bool gyro_reversed = false;
  bool heading_opposite = false;  ///< the antenna line points the other way round
  std::string refused;            ///< why they cannot be told; empty: they are
  bool contradict = false;        ///< nothing else can be told before that is put right
  bool wrong() const {
    return left_reversed || right_reversed || swapped || gyro_reversed || heading_opposite;
  }
};

/// Where the receiver's speed comes from.
enum class SpeedSource { unknown, own, positions };

/// What the drive was, and how well all fits.
struct DriveFacts {
  double duration_s = 0;
  double way_m = 0;
  double straight_m = 0;
  double left_rad = 0;           ///< turned to the left, in all
  double right_rad = 0;          ///< likewise to the right
  double speed_changes_mps = 0;  ///< sum of all changes of speed
  std::size_t places = 0;
  std::size_t outliers = 0;  ///< places and headings that do not fit
  double place_white_m = 0;  ///< one sigma of what remains, from place to place
  double place_slow_m = 0;   ///< one sigma of the error that stays for half a minute
  double heading_white_rad = 0;
};

struct Calibration {
  std::string refused;  ///< the drive as a whole; empty: it is of use
  DriveFacts facts;
  Signs signs;
  std::vector<Found> found;  ///< each Quantity once, in their order; none when refused
  SpeedSource speed_source = SpeedSource::unknown;
  std::string speed_source_refused;  ///< why it is unknown

  const Found& of(Quantity what) const { return found[static_cast<std::size_t>(what)]; }
};

/// All of it. What is as wrong as a side that is reversed is put right first, and told in `signs`.
Calibration calibrate(const Drive& drive, const Configured& configured);

/// Which way round things are, of a drive that is too short for the rest.
Signs signs_of(const Drive& drive, const Configured& configured);

/// What another round of the drive may tell, and this one did not: not what no sensor tells.
std::vector<Quantity> worth_driving_for(const Calibration& it, const Drive& drive);

/// Longest drive that is looked at, s: one longer is refused.
inline constexpr double kLongestDrive_s = 1800;

}  // namespace drover::calibrate
