// Whether the robot is in the corridor of its track, and whether it may be outside without that
// anybody sees it.
#pragma once

#include "engine/config.h"
#include "engine/health/health.h"
#include "engine/navigate/tracker.h"

namespace drover::engine {

/// Where it is held to be on its way, and what that is worth.
struct OnTrack {
  const Estimate& estimate;
  const TrackProgress& progress;
  const Tracker& tracker;
  const EngineConfig& config;
};

/// Why it has left the corridor; empty: it has not.
Reason left_corridor(const OnTrack& on);

/// How far beside the track the place may be that was not believed, m; 0: there is none.
double unbelieved_m(const OnTrack& on);

/// Why it may be outside of the corridor; empty: it may not.
Reason may_be_outside(const OnTrack& on);

}  // namespace drover::engine
