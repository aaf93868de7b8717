// Whether the robot is in the corridor of its track, or may be outside.
#include "engine/navigate/corridor.h"

#include <cmath>

namespace drover::engine {

Reason left_corridor(const OnTrack& on) {
  Reason why;
  const NavigateConfig& limits = on.config.navigate;
  const double off_m = std::abs(on.progress.cross_track_m);
  const double allowed_m =
      on.progress.joined ? limits.corridor_m : limits.start_distance_m + limits.corridor_m;
  if (!(off_m <= allowed_m))
    why.format("the robot left the corridor: %.2f m beside the track", off_m);
  return why;
}

double unbelieved_m(const OnTrack& on) {
  const Estimate& estimate = on.estimate;
  if (estimate.unbelieved_error_m == 0) return 0;
  Pose other = estimate.pose;
  other.x_m += estimate.unbelieved_x_m;
  other.y_m += estimate.unbelieved_y_m;
  return on.tracker.beside_m(other) + estimate.unbelieved_error_m;
}

/// Of two places one is right, and nobody knows which: both have to be inside the corridor. So has
/// the one where it is when wheels slipped before a turn, and nobody saw it.
Reason may_be_outside(const OnTrack& on) {
  const Estimate& estimate = on.estimate;
  Reason why;
  if (!on.progress.joined) {
    // There is no corridor yet.
    if (estimate.disputed && !(estimate.predicted_error_m <= on.config.estimate.bound_run_m))
      why = estimate.reason;
    return why;
  }
  const double off_m = std::abs(on.progress.cross_track_m);
  const double corridor_m = on.config.navigate.corridor_m;
  // On a straight it is behind, on its line: on the way back, in whichever gear, it would leave the
  // track at its end.
  const double past_m = on.progress.backwards ? estimate.unseen_behind_m : estimate.unseen_ahead_m;
  const bool slipped_past = !(past_m <= corridor_m);
  const bool slipped_out = slipped_past || !(off_m + estimate.unseen_aside_m <= corridor_m);
  const bool other_out = estimate.disputed && !(off_m + estimate.predicted_error_m <= corridor_m);
  const double unbelieved_off_m = unbelieved_m(on);
  const bool unbelieved_out = !(unbelieved_off_m <= corridor_m);
  if (!slipped_out && !other_out && !unbelieved_out) return why;
  if (estimate.disputed) return estimate.reason;
  if (unbelieved_out) {
    why.format(
        "%.2f m beside the track here, had no wheel slipped while the RTK fix was lost; if the map "
        "shows the robot where it stands: drover position accept",
        unbelieved_off_m);
    return why;
  }
  why.format("%.1f m driven without an RTK fix: %.2f m %s the track here, had the wheels slipped",
             estimate.unseen_way_m, slipped_past ? past_m : estimate.unseen_aside_m,
             slipped_past ? "past the end of" : "beside");
  return why;
}

}  // namespace drover::engine
