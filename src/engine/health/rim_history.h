// How the driven wheels have turned lately: since when they turn, and whether they get slower.
#pragma once

#include "engine/health/rim_motion.h"

namespace drover::engine {

class RimHistory final {
 public:
  /// Once in each cycle, before what asks whether they turn now.
  void note_turning(const RimMotion& rims, Time now);
  /// After it; `is_due`: they should rest.
  void note_braking(const RimMotion& rims, bool is_due, Time now);

  bool turns() const { return turns_; }
  /// Of the fastest, with its sign.
  double mps() const { return mps_; }
  /// They turn one way for longer than a drive swings its wheel while it is being armed.
  bool rolls(Time now) const;
  /// Since when they get no slower though they should rest.
  Time steady_since() const { return steady_since_; }
  /// The same while a drive is in closed loop: what rolled before is given the time to get slower.
  Time drives_on_since() const { return drives_on_since_; }

 private:
  bool turns_ = false;
  double mps_ = 0;
  Time turns_since_ = kNever;  ///< in this direction
  Time steady_since_ = kNever;
  double slowest_mps_ = 0;
  Time drives_on_since_ = kNever;
};

}  // namespace drover::engine
