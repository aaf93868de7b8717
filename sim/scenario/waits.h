// When the robot waited on its way for what was in it, as it told itself.
#pragma once

#include <string>
#include <vector>

#include "drover/time.h"
#include "sim/scenario/robot_report.h"

namespace drover::sim {

class Waits {
 public:
  struct Wait {
    Time begin = kNever;
    Time end = kNever;  ///< kNever: it waits still
    std::string why;    ///< as it was told first
  };
  /// With each base_status. Returns a sentence when it begins to wait and when that is over, or
  /// nothing.
  std::string look(Time now, const RobotReport& report);
  const std::vector<Wait>& all() const { return waits_; }

 private:
  std::vector<Wait> waits_;
};

}  // namespace drover::sim
