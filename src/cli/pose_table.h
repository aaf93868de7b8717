// Poses as a table (CSV): what `drover estimate` writes.
#pragma once

#include <ostream>
#include <string>

#include "drover/snapshot.h"

namespace drover::cli {

/// What is absent is an empty cell.
struct PoseRow {
  Pose pose;
  double predicted_error_m = kAbsent;  ///< two sigma, and what lies between sources that disagree
  double error_bound_m = kAbsent;
  double latitude_deg = kAbsent;  ///< of the antenna
  double longitude_deg = kAbsent;
  bool has_quality = false;
  FixQuality quality = FixQuality::none;  ///< of the last position
  std::string notice;
  std::string reason;
};

std::string pose_head();
/// `time_s` is its own column: a pose may be of a moment before.
std::string pose_line(double time_s, const PoseRow& row);

}  // namespace drover::cli
