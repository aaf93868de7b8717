// Events between where they arise and the cycle that hands them out: fixed size, in order.
#pragma once

#include <array>
#include <cstdint>

#include "drover/event.h"
#include "drover/fixed_vector.h"

namespace drover::engine {

/// Answers to commands and returned paths must arrive, so half of the queue is theirs alone:
/// notices are dropped (and counted) when it is half full.
class EventQueue final {
 public:
  template <class Body>
  void push(Time time, const Body& body) {
    if (size_ == kCapacity) {
      ++dropped_;
      return;
    }
    Event& event = events_[(first_ + size_++) % kCapacity];
    event.time = time;
    event.body = body;
  }
  void notice(Time time, Notice::Level level, const Reason& text) {
    if (size_ >= kCapacity / 2) {
      ++dropped_;
      return;
    }
    push(time, Notice{level, text});
  }
  /// Moves as many as fit, oldest first.
  template <std::size_t N>
  void drain(FixedVector<Event, N>& out) {
    while (size_ > 0 && out.push_back(events_[first_])) {
      first_ = (first_ + 1) % kCapacity;
      --size_;
    }
  }
  std::size_t size() const { return size_; }
  std::uint64_t dropped() const { return dropped_; }

 private:
  static constexpr std::size_t kCapacity = 256;
  std::array<Event, kCapacity> events_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace drover::engine
