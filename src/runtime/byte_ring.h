// A bounded ring of bytes between one producing and one consuming thread, without locks.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace drover::runtime {

class ByteRing final {
 public:
  /// `size` is a power of two. The memory is touched now, not when it is first used.
  explicit ByteRing(std::size_t size) : bytes_(size, 0) {}

  /// Producer only. Both parts, one after the other, or nothing: false when there is no room.
  [[nodiscard]] bool push(std::span<const std::uint8_t> head, std::span<const std::uint8_t> body) {
    const auto tail = tail_.load(std::memory_order_relaxed);
    const auto used = tail - head_.load(std::memory_order_acquire);
    if (head.size() + body.size() > bytes_.size() - used) return false;
    copy_in(tail, head);
    copy_in(tail + head.size(), body);
    tail_.store(tail + head.size() + body.size(), std::memory_order_release);
    return true;
  }

  /// Consumer only: all that is in it now goes to `use` in one or two spans, then out.
  template <class Use>
  void drain(std::size_t until, const Use& use) {
    const auto head = head_.load(std::memory_order_relaxed);
    const auto begin = head & (bytes_.size() - 1);
    const auto first = std::min(until - head, bytes_.size() - begin);
    if (first > 0) use(std::span<const std::uint8_t>(bytes_.data() + begin, first));
    const auto rest = until - head - first;
    if (rest > 0) use(std::span<const std::uint8_t>(bytes_.data(), rest));
    head_.store(until, std::memory_order_release);
  }
  /// Consumer only: for `drain`.
  std::size_t filled_until() const { return tail_.load(std::memory_order_acquire); }

 private:
  void copy_in(std::size_t at, std::span<const std::uint8_t> from) {
    const auto begin = at & (bytes_.size() - 1);
    const auto first = std::min(from.size(), bytes_.size() - begin);
    std::copy_n(from.data(), first, bytes_.data() + begin);
    std::copy_n(from.data() + first, from.size() - first, bytes_.data());
  }

  std::vector<std::uint8_t> bytes_;
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace drover::runtime
