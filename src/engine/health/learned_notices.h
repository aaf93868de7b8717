// What the estimate learned of the robot while it drove, said once to who maintains it.
#pragma once

#include "drover/time.h"
#include "engine/config.h"
#include "engine/estimate/estimator.h"
#include "engine/event_queue.h"

namespace drover::engine {

/// Each is said again only when it became quite another value.
class LearnedNotices final {
 public:
  /// `antenna`: of the receiver that steers.
  void tell(Time now, const Estimate& estimate, const AntennaConfig& antenna, EventQueue& events);
  /// What a task begins without, each time.
  static void tell_unknown(Time now, const Estimate& estimate, EventQueue& events);

 private:
  /// What was said of one of them; NaN: nothing.
  using Said = double;
  static bool anew(Said& said, double value, double step);

  void tell_mounting(Time now, const Estimate& estimate, const AntennaConfig& antenna,
                     EventQueue& events);
  void tell_delays(Time now, const Estimate& estimate, EventQueue& events);
  void tell_arm(Time now, const Estimate& estimate, const AntennaConfig& antenna,
                EventQueue& events);
  void tell_shove(Time now, const Estimate& estimate, EventQueue& events);

  Said mounting_rad_ = kAbsent;
  Said late_s_ = kAbsent;
  Said heading_late_s_ = kAbsent;
  Said arm_ahead_m_ = kAbsent;
  Said arm_left_m_ = kAbsent;
  Said scale_ = kAbsent;
  Time scale_since_ = kNever;
  Time shoved_ = kNever;
};

}  // namespace drover::engine
