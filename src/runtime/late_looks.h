// Whether looks around the robot follow each other fast enough to move by, and what to say when
// they do not. Pure: time is an argument.
#pragma once

#include <algorithm>
#include <cstddef>

#include "drover/fixed_text.h"
#include "drover/time.h"

namespace drover::runtime {

/// One that is late makes no word: the robot brakes a little and goes on. Where they are late for
/// long it stands, and somebody has to be told what of.
class LateLooks final {
 public:
  /// As the engine judges them (engine::ClearanceWatch), so that both say it and take it back at
  /// once: an answer that is older than `oldest` moves nothing; `told_after`: so long of such. Who
  /// is in time for no longer than `oldest` may be late again with the next one.
  LateLooks(Duration oldest, Duration told_after) : oldest_(oldest), told_after_(told_after) {}

  /// An answer about `seen` is ready at `now`. Until the next one the one before it counts.
  void note(Time seen, Time now) {
    if (last_ != kNever && now - last_ > oldest_) {
      if (since_ == kNever) {
        since_ = last_ + oldest_;
        longest_ = {};
      }
      longest_ = std::max(longest_, now - last_);
      in_time_since_ = now;
    } else if (since_ != kNever && now - in_time_since_ > oldest_) {
      since_ = kNever;
    }
    last_ = seen;
    now_ = now;
  }
  /// Empty: they are in time, or were until a moment ago.
  Reason words(std::size_t objects, std::size_t constraints) const {
    Reason why;
    if (since_ == kNever || now_ - since_ < told_after_) return why;
    why.format("nobody looked for %.2f s: the scene takes too long (%zu objects, %zu constraints)",
               to_s(longest_), objects, constraints);
    return why;
  }

 private:
  Duration oldest_;
  Duration told_after_;
  Time last_ = kNever;           ///< that the last answer was about
  Time since_ = kNever;          ///< they are late
  Time in_time_since_ = kNever;  ///< the last late one was replaced then
  Time now_ = kNever;
  Duration longest_{0};
};

}  // namespace drover::runtime
