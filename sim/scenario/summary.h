// What a drive was like, from the robot's true motion and the track.
#pragma once

#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "sim/scenario/track.h"

namespace drover::sim {

/// One line of truth.csv.
struct TruthSample {
  double time_s = 0;
  double x_m = 0;
  double y_m = 0;
};
/// Columns are found by their names in the header; throws std::runtime_error when one is missing
/// or a line is no numbers. A last line that was cut short is left out.
std::vector<TruthSample> read_truth(std::istream& csv);

/// What the robot touched, each once, by the lines of objects.log (see object_record.h). Nothing:
/// nobody watched, as in a world without such things.
std::optional<std::vector<std::string>> read_touches(std::istream& log);

struct DriveFigures {
  double time_s = 0;
  double distance_m = 0;
  /// Each sample counts by the way driven since the last: standing still proves nothing.
  double cross_track_rms_m = 0;
  double cross_track_max_m = 0;
  double goal_distance_m = 0;  ///< at the end
};
/// Over the samples from `begin_s` to `end_s`; `goal` is an index into the track.
DriveFigures measure_drive(const std::vector<TruthSample>& truth,
                           const std::vector<TrackPose>& track, std::size_t goal, double begin_s,
                           double end_s);

}  // namespace drover::sim
