// A drive as functions of time: what the wheels rolled, what the gyro turned, where the antenna
// was.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/calibrate.h"
#include "calibrate/series.h"

namespace drover::calibrate {

/// Neighbours of a series that are farther apart leave a gap.
inline constexpr double kLongestGap_s = 0.25;

struct Track {
  Series left_mps;
  Series right_mps;
  Series gyro_radps;  ///< empty: there is none

  bool has_gyro() const { return !gyro_radps.empty(); }
};

/// As the configuration has it.
Track track_of(const Drive& drive);
/// With what `signs` found put right.
Track track_of(const Drive& drive, const Signs& signs);

struct Point {
  double x_m = 0;
  double y_m = 0;
};
/// The antenna at `time_s`; nothing in a gap of a second and more.
std::optional<Point> antenna_at(const std::vector<PlaceRow>& places, double time_s);
/// The told heading of the antenna line; nothing in such a gap.
std::optional<double> heading_at(const std::vector<ValueRow>& headings, double time_s);

}  // namespace drover::calibrate
