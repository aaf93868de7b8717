// How long to wait before what failed is tried again.
#pragma once

#include <algorithm>

#include "drover/time.h"

namespace drover::runtime {

/// Twice as long after each try, between two limits, for ever: what vanished may come back.
class BackOff final {
 public:
  constexpr BackOff(Duration first, Duration longest) : first_(first), longest_(longest) {}

  bool due(Time now) const { return now >= next_; }
  Time next() const { return next_; }
  /// A try at `now`, or one that failed: unless it succeeds, the next is due after the pause.
  void tried(Time now) {
    pause_ = std::clamp(pause_ * 2, first_, longest_);
    next_ = now + pause_;
  }
  /// The next pause is a first one again.
  void succeeded() { pause_ = {}; }
  /// At once, as if nothing had failed.
  void try_now() { *this = BackOff(first_, longest_); }

 private:
  Duration first_;
  Duration longest_;
  Duration pause_{};
  Time next_ = kNever;
};

}  // namespace drover::runtime
