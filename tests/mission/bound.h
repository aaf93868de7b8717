// Motion while the robot was farther from where it said than it said that it may be, and how long
// it stood on its way for a reason that it told.
#pragma once

#include "mission/record.h"

namespace drover::mission {

struct BeyondBound {
  double moved_s = 0;
  double worst_m = 0;  ///< beyond it
};

/// By each base_status with a bound (`nav.error_bound_m`), for as long as until the next one.
BeyondBound beyond_bound(const Record& record);

struct Stood {
  double for_s = 0;
  int times = 0;
};

/// While a task ran and had moved: its base stood and turned no more, and `nav.why` said something.
Stood stood_in_task(const Record& record);

}  // namespace drover::mission
