// When a reader's samples came to this computer: where clocks differ nothing else tells it.
#pragma once

#include <atomic>

#include "drover/time.h"

namespace drover::ros2 {

/// Said by a thread of DDS' own at each sample, asked by the loop, which may have been held up.
class Arrivals final {
 public:
  void came(Time now) {
    newest_.store(now);
    Time none = kNever;
    oldest_.compare_exchange_strong(none, now);
  }

  struct Since {
    Time oldest = kNever;
    Time newest = kNever;
  };
  /// Of what came since the last look; to be asked before the samples are taken: then none of them
  /// is taken for younger than it is. What is not said yet has come just now.
  Since look(Time now) {
    const auto or_now = [now](Time at) { return at == kNever ? now : at; };
    return {or_now(oldest_.exchange(kNever)), or_now(newest_.exchange(kNever))};
  }

 private:
  static_assert(std::atomic<Time>::is_always_lock_free);
  std::atomic<Time> oldest_{kNever};
  std::atomic<Time> newest_{kNever};
};

}  // namespace drover::ros2
