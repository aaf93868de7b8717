// What a calibration found, for people and for programs, and as a change of drover.json to review.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibrate.h"
#include "config/load.h"

namespace drover::cli {

/// Where the configuration has what is found.
struct CalibrationKeys {
  bool twist_base = false;  ///< it has no wheels that anybody sees
  std::string receiver;     ///< name of the device; empty: none
  /// Of each antenna key, whether it stands at the receiver; otherwise it is of `estimate`.
  bool x_at_receiver = false;
  bool y_at_receiver = false;
  bool heading_at_receiver = false;
  std::optional<double> latency_s;  ///< the receiver's option; nothing: it has none
  /// Stamps are those of droverd, so that a lateness is its latency_s that is wrong.
  bool own_stamps = false;
  // One sigma of where the antenna is, how its line is mounted and how late it tells, as
  // configured.
  double antenna_sigma_m = 0;
  double heading_mount_sigma_deg = 0;
  double gnss_late_sigma_s = 0;
};
CalibrationKeys calibration_keys(const config::Loaded& loaded, bool own_stamps);
/// As wheel_radius_m: with "way_scale" in its place for a base that tells a twist.
const char* name_of(calibrate::Quantity what, bool twist_base);

/// A merge patch (RFC 7396) of what is off by more than its interval, and of how well the antenna
/// is known now where that is better than configured; empty: there is neither.
std::string calibration_patch(const calibrate::Calibration& it, const CalibrationKeys& keys);
/// What is the wrong way round, and what to do: a sentence each; none when the signs are right.
std::vector<std::string> sign_notes(const calibrate::Signs& signs, bool twist_base);
/// What no key says, and what a person has to look at: a sentence each.
std::vector<std::string> calibration_notes(const calibrate::Calibration& it,
                                           const CalibrationKeys& keys);

/// Lines.
std::string show_calibration(const calibrate::Calibration& it, const CalibrationKeys& keys);
/// One JSON object, without a line end.
std::string calibration_json(const calibrate::Calibration& it, const CalibrationKeys& keys);

}  // namespace drover::cli
