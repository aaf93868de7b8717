// What tells a sensor that works from one that only talks: readings that stand still, the pace, and
// gravity on an axis where it cannot be.
#pragma once

#include <array>
#include <cstdint>

#include "drover/measurement.h"
#include "drover/time.h"

namespace drover::witmotion {

/// Every word of a sample: acceleration, rate, angles or quaternion.
using Fingerprint = std::array<std::int16_t, 10>;

/// Readings that repeat in every channel. The rate alone may stand at zero (the device has a dead
/// band), the acceleration has noise and does not repeat for long.
class FrozenWatch final {
 public:
  explicit FrozenWatch(int samples) : samples_(samples) {}
  /// True while the readings stand still.
  bool add(const Fingerprint& words) {
    same_ = words == last_ ? same_ + 1 : 0;
    last_ = words;
    return frozen();
  }
  bool frozen() const { return same_ >= samples_; }

 private:
  int samples_;
  int same_ = 0;
  Fingerprint last_{};
};

/// How often samples come, over windows of at least a second.
class PaceWatch final {
 public:
  void add(Time at);
  void reset();
  /// Of the last whole window; absent before the first.
  double pace_Hz() const { return pace_Hz_; }

 private:
  Time from_ = kNever;
  Time last_ = kNever;
  int count_ = 0;
  double pace_Hz_ = kAbsent;
};

/// Where gravity is while the sensor rests, in base_link. A robot stands on no slope as steep as
/// the angle that a wrong mounting makes.
class GravityWatch final {
 public:
  void add(Time at, const Vector3& acceleration_mps2, const Vector3& rate_radps);
  void reset() { *this = GravityWatch(); }
  bool wrong_axis() const { return wrong_; }
  /// The mean that was judged.
  Vector3 mean_mps2() const { return mean_; }

 private:
  Time from_ = kNever;
  int count_ = 0;
  Vector3 sum_;
  Vector3 mean_;
  bool wrong_ = false;
};

}  // namespace drover::witmotion
