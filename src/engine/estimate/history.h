// A short, sorted record of inputs, each with the state after it, so that a late input can be put
// where it belongs and what came after applied again. Fixed size.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>

#include "engine/estimate/imu_intake.h"
#include "engine/estimate/model_gnss.h"
#include "engine/estimate/state.h"

namespace drover::engine::estimate {

/// What the base told of its motion within one slot of time, and the turn that began in it.
struct MotionInput {
  JointSet present;
  FixedVector<double, kMaxAxes> joints_radps;  ///< by AxisId, of those present
  std::optional<BodyMotion> body;
  std::optional<TurnRate> turn;
};

struct YawInput {
  double yaw_rad = 0;
  std::uint8_t receiver = 0;  ///< whose
};

/// In the order in which inputs of one instant are applied: a position needs the heading of its
/// own epoch for the lever arm.
using Input = std::variant<MotionInput, YawInput, AntennaPosition>;

struct Entry {
  Time time = kNever;
  Input input;
  State after;
};

class History final {
 public:
  static constexpr std::size_t kCapacity = 256;

  std::size_t size() const { return size_; }
  bool full() const { return size_ == kCapacity; }
  Entry& at(std::size_t i) { return entries_[(first_ + i) % kCapacity]; }
  const Entry& at(std::size_t i) const { return entries_[(first_ + i) % kCapacity]; }
  /// The state before the oldest entry.
  const State& base() const { return base_; }
  /// The state before entry `i`; before(size()) is the newest.
  const State& before(std::size_t i) const { return i == 0 ? base_ : at(i - 1).after; }
  /// Entries from here on have no valid state yet.
  std::size_t dirty() const { return dirty_; }
  void mark_clean() { dirty_ = size_; }
  void mark_dirty(std::size_t i) { dirty_ = i < dirty_ ? i : dirty_; }

  /// Index of the entry of this very time and kind, or size().
  std::size_t find(Time time, std::size_t kind) const {
    for (std::size_t i = size_; i > 0 && at(i - 1).time >= time; --i) {
      if (at(i - 1).time == time && at(i - 1).input.index() == kind) return i - 1;
    }
    return size_;
  }
  /// Puts an input in its place by time, then kind. Not when full.
  void insert(Time time, const Input& input) {
    std::size_t i = size_++;
    for (; i > 0 && later(at(i - 1), time, input.index()); --i) at(i) = at(i - 1);
    at(i).time = time;
    at(i).input = input;
    mark_dirty(i);
  }
  /// Whether entry `i` belongs before its neighbour `i - 1`.
  bool out_of_order(std::size_t i) const {
    return later(at(i - 1), at(i).time, at(i).input.index());
  }
  void swap_back(std::size_t i) {
    std::swap(at(i), at(i - 1));
    mark_dirty(i - 1);
  }
  /// Forgets the oldest entry; its state must be valid.
  void drop_oldest() {
    base_ = at(0).after;
    first_ = (first_ + 1) % kCapacity;
    --size_;
    if (dirty_ > 0) --dirty_;
  }
  /// Forgets all, and goes on from `base`.
  void restart(const State& base) {
    base_ = base;
    first_ = size_ = dirty_ = 0;
  }

 private:
  static bool later(const Entry& entry, Time time, std::size_t kind) {
    return entry.time > time || (entry.time == time && entry.input.index() > kind);
  }

  std::array<Entry, kCapacity> entries_{};
  State base_;
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  std::size_t dirty_ = 0;
};

}  // namespace drover::engine::estimate
