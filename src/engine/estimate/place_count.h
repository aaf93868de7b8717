// Numbers the stretches of time in which poses can be compared with each other.
#pragma once

#include <cstdint>

#include "engine/estimate/estimator.h"

namespace drover::engine {

/// A new number begins with each origin, when the position or the heading is lost or found, and
/// when the pose goes another way than the base does.
class PlaceCount final {
 public:
  /// Once a cycle. `jumped_at`: when the place changed at rest last, as PlaceWatch has it.
  void update(const Estimate& estimate, Duration dt, Time jumped_at);
  /// Another origin: all places have other numbers.
  void another();
  std::uint32_t number() const { return number_; }

 private:
  bool jumped(const Estimate& estimate, Duration dt) const;

  std::uint32_t number_ = 0;
  bool seen_ = false;  ///< what stands below
  bool has_position_ = false;
  bool has_heading_ = false;
  Pose pose_;
  Time jumped_at_ = kNever;
};

}  // namespace drover::engine
