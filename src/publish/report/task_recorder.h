// Collects one task's report from the snapshots and events that the publish thread sees anyway, so
// that the control thread has nothing to do with it.
//
// Memory is bounded whatever the task: figures are sums, the 95th percentile comes from classes of
// a millimetre, and of the places every second one is dropped when there are too many.
#pragma once

#include <optional>
#include <string_view>

#include "publish/command_service.h"
#include "publish/report/task_report.h"

namespace drover::publish {

class TaskRecorder final {
 public:
  static constexpr std::size_t kMostSamples = 8000;
  static constexpr std::size_t kMostPauses = 100;
  static constexpr double kSpacing_m = 0.10;  ///< of the samples, until some are dropped

  TaskRecorder(const GivenTask& task, Time accepted, Duration since_1970);

  /// Those in which no task runs are passed over.
  void take(const Snapshot& seen);
  TaskReport end(Time ended, bool begun, TaskEnded::How how, std::string_view reason);

 private:
  /// Of the last snapshot.
  struct Last {
    Time time = kNever;
    double speed_mps = 0;
  };
  void drive(const Snapshot& seen);
  void compare_with_track(double cross_track_m, double way_m);
  void look_at_bound(const Snapshot& seen, bool moves);
  void look_at_pause(const Snapshot& seen);
  void wait_until(Time now);
  void sample(const Snapshot& seen);
  void add_last_place();
  void thin();
  double percentile_m(double share) const;

  TaskReport report_;
  Time accepted_;
  std::optional<Last> last_;
  std::optional<Time> paused_since_;
  Time waited_until_ = kNever;  ///< of the pause that lasts: counted so far
  bool pause_kept_ = false;
  double spacing_m_ = kSpacing_m;
  ReportSample newest_;  ///< of the last snapshot
  // Beside the track, by way.
  double judged_m_ = 0;
  double squares_m3_ = 0;
  std::vector<double> classes_m_;  ///< way in each millimetre; the last one has all beyond
};

}  // namespace drover::publish
