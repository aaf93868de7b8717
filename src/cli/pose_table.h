// Poses as a table (CSV): what `drover estimate` writes.
#pragma once

#include <optional>
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
  std::optional<FixQuality> quality;  ///< of the last position
  std::string notice;
  std::string reason;
};

/// Which moments of a run get a row. They may come as far apart as they like: no burst of rows
/// makes up for a gap.
class RowTimes final {
 public:
  explicit RowTimes(double rate_Hz) : apart_(from_s(1 / rate_Hz)) {}
  /// The first row is the next one that is asked about.
  void begin(Time first) { next_ = first; }
  bool is_due(Time now);

 private:
  Duration apart_;
  Time next_ = kNever;
};

std::string pose_head();
/// `time_s` is its own column: a pose may be of a moment before.
std::string pose_line(double time_s, const PoseRow& row);

}  // namespace drover::cli
