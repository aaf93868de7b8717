// Watches measurements that the gate refuses: a single one is an outlier, a second of them means
// that the receiver and the wheels contradict each other.
#pragma once

#include "drover/time.h"

namespace drover::engine::estimate {

class JumpWatch final {
 public:
  void accepted() { *this = JumpWatch{}; }
  /// A refused measurement at `at`. `same_place`: the robot stands and this one repeats the place
  /// that the run of refused ones began with; otherwise the place to repeat begins anew here.
  void refused(Time at, bool same_place, bool moving = false) {
    if (run_since_ == kNever) {
      run_since_ = at;
      began_moving_ = moving;
    }
    if (place_since_ == kNever || !same_place) place_since_ = at;
    last_ = at;
  }
  bool running() const { return run_since_ != kNever; }
  Time since() const { return run_since_; }  ///< kNever: none
  /// Nothing but refused ones for `duration`.
  bool disagrees(Duration duration) const { return running() && last_ - run_since_ >= duration; }
  /// The run began while the robot moved: standing afterwards shows nothing.
  bool began_moving() const { return running() && began_moving_; }
  /// The same new place for `duration` while standing, also when it appeared: it may be believed.
  bool settled(Duration duration) const {
    return place_since_ != kNever && !began_moving_ && last_ - place_since_ >= duration;
  }
  /// True when the present one begins the place to repeat.
  bool new_place() const { return place_since_ == last_; }

 private:
  Time run_since_ = kNever;
  Time place_since_ = kNever;
  Time last_ = kNever;
  bool began_moving_ = false;
};

}  // namespace drover::engine::estimate
