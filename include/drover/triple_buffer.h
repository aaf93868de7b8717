// The latest value from one writing to one reading thread, without locks and without tearing.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace drover {

template <class T>
class TripleBuffer {
 public:
  /// Writer only: fill this, then publish().
  T& back() { return slots_[back_]; }
  void publish() {
    const auto old = middle_.exchange(back_ | kNew, std::memory_order_acq_rel);
    back_ = old & kIndex;
  }
  /// Reader only: the newest published value; the reference stays good until the next call.
  const T& latest() {
    if ((middle_.load(std::memory_order_relaxed) & kNew) != 0) {
      const auto old = middle_.exchange(front_, std::memory_order_acq_rel);
      front_ = old & kIndex;
    }
    return slots_[front_];
  }

 private:
  static constexpr std::uint8_t kNew = 4;
  static constexpr std::uint8_t kIndex = 3;
  std::array<T, 3> slots_{};
  std::uint8_t back_ = 0;
  std::uint8_t front_ = 1;
  std::atomic<std::uint8_t> middle_{2};
};

}  // namespace drover
