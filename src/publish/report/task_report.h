// What became of one task: figures by the robot's own estimate, and the way that it drove.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "drover/event.h"
#include "drover/path.h"
#include "drover/snapshot.h"

namespace drover::publish {

/// Of receivers' words; the last one is for a receiver that was not heard.
inline constexpr std::size_t kQualities = 10;
inline constexpr std::uint8_t kNotHeard = 9;

/// One place on the way.
struct ReportSample {
  double x_m = 0;
  double y_m = 0;
  double way_m = 0;
  double cross_track_m = 0;
  double speed_mps = 0;
  double error_bound_m = kAbsent;
  std::uint8_t quality = kNotHeard;
};

struct ReportPause {
  std::string reason;  ///< what `nav.why` said first
  double after_s = 0;  ///< since the task was accepted
  double lasted_s = 0;
  double x_m = 0;
  double y_m = 0;
  double way_m = 0;
};

struct TaskReport {
  // What was asked.
  std::string track;
  std::int64_t target_id = 0;  ///< as the operator counts
  double asked_mps = 0;
  Duration began_since_1970{};
  // What became of it.
  bool begun = false;  ///< false: it was accepted and could not begin to move
  TaskEnded::How how = TaskEnded::How::failed;
  std::string reason;
  double time_s = 0;    ///< from accepted to ended
  double moving_s = 0;  ///< of it, faster than 1 cm/s
  double paused_s = 0;
  double way_m = 0;
  double left_m = kAbsent;  ///< along the track, at the end
  /// Beside the track, as a share of the way, from where the robot was first within 0.2 m of it;
  /// absent: it never was.
  double joined_m = kAbsent;  ///< the way until then
  double rms_m = kAbsent;
  double p95_m = kAbsent;
  double worst_m = kAbsent;
  double mean_mps = kAbsent;  ///< while it moved
  double fastest_mps = 0;
  std::array<double, kQualities> way_by_quality_m{};
  double worst_bound_m = kAbsent;         ///< of `nav.error_bound_m`
  double worst_bound_moving_m = kAbsent;  ///< while it moved
  std::vector<ReportPause> pauses;
  std::uint64_t pauses_left_out = 0;
  std::vector<PathPoint> line;  ///< of the track, thinned for a drawing
  std::vector<ReportSample> samples;
};

}  // namespace drover::publish
