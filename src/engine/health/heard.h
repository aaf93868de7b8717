// Whether a drive is heard.
#pragma once

#include "drover/snapshot.h"

namespace drover::engine {

/// It told its motion within `stale`: what it said holds now. What its driver thinks of it
/// (`axis.health`) is another question: a wheel that runs away is judged by all that comes.
inline bool tells_motion(const AxisSnapshot& axis, Time now, Duration stale) {
  return axis.last_motion != kNever && now - axis.last_motion < stale;
}

}  // namespace drover::engine
