// Stops on their way to the control thread: two counters, so that no flood fills the path, nobody
// waits for it, and any thread may ask. Several that came within a cycle are one.
#pragma once

#include <atomic>
#include <cstdint>

namespace drover::runtime {

/// How often each was asked for since the start.
struct StopCounts {
  std::uint64_t cancels = 0;  ///< orderly stops: what an owner does ends with a ramp
  std::uint64_t stops = 0;    ///< emergency stops: zero at once, latched

  /// Every request of `other` is among these.
  bool include(const StopCounts& other) const {
    return cancels >= other.cancels && stops >= other.stops;
  }
};

class StopRequests final {
 public:
  // Any thread. Returns what must be obeyed before the request is.
  StopCounts ask_cancel() {
    cancels_.fetch_add(1, std::memory_order_release);
    return asked();
  }
  StopCounts ask_stop() {
    stops_.fetch_add(1, std::memory_order_release);
    return asked();
  }
  StopCounts asked() const {
    return {cancels_.load(std::memory_order_acquire), stops_.load(std::memory_order_acquire)};
  }

  /// Control thread: they are carried out.
  void set_obeyed(const StopCounts& counts) {
    obeyed_cancels_.store(counts.cancels, std::memory_order_release);
    obeyed_stops_.store(counts.stops, std::memory_order_release);
  }
  StopCounts obeyed() const {
    return {obeyed_cancels_.load(std::memory_order_acquire),
            obeyed_stops_.load(std::memory_order_acquire)};
  }

 private:
  std::atomic<std::uint64_t> cancels_{0};
  std::atomic<std::uint64_t> stops_{0};
  std::atomic<std::uint64_t> obeyed_cancels_{0};
  std::atomic<std::uint64_t> obeyed_stops_{0};
};

}  // namespace drover::runtime
