#include "runtime/supervisor.h"

namespace drover::runtime {

const WatchedThread* Supervisor::stalled(Time now) {
  const Duration pause = looked_ == kNever ? Duration::zero() : now - looked_;
  const Duration own = pause > 3 * kPeriod ? pause - kPeriod : Duration::zero();
  looked_ = now;
  const WatchedThread* found = nullptr;
  for (auto& row : rows_) {
    const auto turns = row.thread.turns->load(std::memory_order_relaxed);
    if (row.moved == kNever || turns != row.turns) {
      row.turns = turns;
      row.moved = now;
    } else {
      row.moved += own;
    }
    if (found == nullptr && now - row.moved > row.thread.limit) found = &row.thread;
  }
  return found;
}

}  // namespace drover::runtime
