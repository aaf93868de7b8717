// What was so at some instants of the last second, for measurements that come late: each is
// compared with what was so at its own instant.
#pragma once

#include <array>
#include <cstddef>

#include "drover/measurement.h"

namespace drover::engine {

/// `Mark` has a time `at`, which is kNever while it is empty.
template <class Mark>
class MarkRing final {
 public:
  void clear() {
    marks_.fill({});
    next_ = 0;
  }
  /// Of those that come faster than kEach the first is kept.
  void remember(const Mark& mark) {
    const Mark& before = marks_[(next_ + marks_.size() - 1) % marks_.size()];
    if (before.at != kNever && mark.at - before.at < kEach) return;
    marks_[next_] = mark;
    next_ = (next_ + 1) % marks_.size();
  }
  /// What was so at `at`; nullptr when it is too long ago, or nothing was known then.
  const Mark* at(Time at) const {
    const auto apart = [at](const Mark& m) { return m.at > at ? m.at - at : at - m.at; };
    const Mark* best = nullptr;
    for (const Mark& mark : marks_) {
      if (mark.at == kNever || !(apart(mark) < 2 * kEach)) continue;
      if (best == nullptr || apart(mark) < apart(*best)) best = &mark;
    }
    return best;
  }

 private:
  static constexpr Duration kEach = std::chrono::milliseconds(10);

  std::array<Mark, 128> marks_{};
  std::size_t next_ = 0;
};

}  // namespace drover::engine
