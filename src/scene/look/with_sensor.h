// What an obstacle sensor sees, put together with what is known of the surroundings.
#pragma once

#include "drover/clearance.h"
#include "scene/sensor/seen.h"

namespace drover::scene {

/// How a field is met by what the robot is about to do.
struct SensorTerms {
  double margin_m = 0.1;  ///< to be left before what is seen
  /// The track goes on the way that the robot looks: not on one of which it has to turn to first.
  bool track_ahead = false;
  double driven_m = 0;  ///< ahead, since the field was seen
};

/// A field that something is in ends the way ahead there, and along a track that goes on ahead; of
/// other ways it says nothing (with_points.h does), and one that is free says nothing of objects
/// and zones either. Where it does not see, nothing is free.
Clearance with_sensor(Clearance found, const sensor::FieldView& seen, const SensorTerms& terms);

}  // namespace drover::scene
