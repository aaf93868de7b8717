// What was recorded of a drive, and what the robot is configured to believe of itself. Times are
// seconds on one time line, each row's the instant at which it is said to have been true.
#pragma once

#include <vector>

namespace drover::calibrate {

/// Speed over ground of the rims of each side, by the configured wheel radius; ahead positive. Of a
/// base that tells a twist its edges, by the configured track.
struct RimRow {
  double time_s = 0;
  double left_mps = 0;
  double right_mps = 0;
};

/// One value: rad/s about the base's z (left turns positive), or m/s.
struct ValueRow {
  double time_s = 0;
  double value = 0;
};

/// The antenna by an RTK fix, metres east and north of anything.
struct PlaceRow {
  double time_s = 0;
  double east_m = 0;
  double north_m = 0;
};

/// In the order of their times. Only `rims` and `places` have to be there.
struct Drive {
  std::vector<RimRow> rims;
  std::vector<ValueRow> gyro_radps;
  std::vector<PlaceRow> places;        ///< RTK fixed only
  std::vector<ValueRow> headings_rad;  ///< of the antenna line, counter-clockwise from east
  std::vector<ValueRow> receiver_mps;  ///< its own speed over ground, never negative
  std::vector<RimRow> commands;        ///< what the rims were told; each holds until the next
};

/// Field names are keys of the configuration where there is such a key.
struct Configured {
  double wheel_radius_m = 0.165;
  double track_m = 0.6;
  double yaw_slip_factor = 1;
  double antenna_x_m = 0;
  double antenna_y_m = 0;
  double heading_baseline_offset_deg = 0;  ///< of the antenna line from ahead, clockwise
  double drive_lag_s = 0.12;
  bool skids = false;  ///< wheels that skid in a turn: about which point, no drive shows
};

}  // namespace drover::calibrate
