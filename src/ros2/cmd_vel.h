// What comes on /cmd_vel: the newest that the robot may be told, or why it is told nothing.
#pragma once

#include <dds/dds.h>

#include <string>

#include "drover/time.h"
#include "ros2/twist_writers.h"
#include "ros2/twists_heard.h"

namespace drover::ros2 {

/// How old a message may be by the clock of this computer, which its writer shares.
inline constexpr Duration kOldestTwist = std::chrono::milliseconds(300);

class CmdVel final {
 public:
  /// `reader`: of Twist or, `stamped`, TwistStamped, which goes with its participant. `one_clock`:
  /// all writers are on this computer, so that a message that was held up is told by its age.
  CmdVel(dds_entity_t reader, bool stamped, bool one_clock)
      : reader_(reader), stamped_(stamped), one_clock_(one_clock) {}

  /// `wall`: UTC now, since 1970. `came`: when the newest has, where clocks differ.
  TwistsHeard take(Time now, Duration wall, Time came);

 private:
  void hear(const void* sample, const dds_sample_info_t& info, Time now, Duration wall, Time came,
            TwistsHeard& heard);

  dds_entity_t reader_;
  bool stamped_;
  bool one_clock_;
  TwistWriters writers_;
};

}  // namespace drover::ros2
