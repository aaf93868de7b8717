// Motion while the robot was farther from where it said than it said that it may be.
#pragma once

#include "mission/record.h"

namespace drover::mission {

struct BeyondBound {
  double moved_s = 0;
  double worst_m = 0;  ///< beyond it
};

/// By each base_status with a bound (`nav.error_bound_m`), for as long as until the next one.
BeyondBound beyond_bound(const Record& record);

}  // namespace drover::mission
