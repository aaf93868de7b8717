// A bounded ring between one producing and one consuming thread, without locks.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <utility>

namespace drover {

template <class T, std::size_t N>
class SpscRing {
  static_assert((N & (N - 1)) == 0, "the size is a power of two");

 public:
  /// Producer only; false when full (the caller counts or refuses aloud): then `value` is
  /// untouched.
  template <class U>
  [[nodiscard]] bool push(U&& value) {
    const auto tail = tail_.load(std::memory_order_relaxed);
    if (tail - head_.load(std::memory_order_acquire) == N) return false;
    items_[tail & (N - 1)] = std::forward<U>(value);
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }
  /// Consumer only; false when empty.
  [[nodiscard]] bool pop(T& value) {
    const auto head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return false;
    value = std::move(items_[head & (N - 1)]);
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

 private:
  std::array<T, N> items_{};
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace drover
