// Where the robot was a moment ago: what a sensor saw then is placed by it.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "drover/result.h"
#include "drover/time.h"
#include "scene/world/planar_pose.h"

namespace drover::scene {

/// A pose, and how well it was known.
struct KnownPose {
  Pose2 pose;
  double position_sigma_m = 0;
  double yaw_sigma_rad = 0;
};

/// A ring of the last two seconds. What is older is refused, not guessed.
class PoseHistory final {
 public:
  /// A sensor and its program take less; a stamp that is older comes from a clock that is wrong or
  /// from a queue that was stuck.
  static constexpr Duration kReach = std::chrono::seconds(2);
  /// Poses that are nearer to each other tell nothing new, and the ring holds the reach at any rate
  /// of control.
  static constexpr Duration kSpacing = std::chrono::milliseconds(4);
  /// Longer pauses are a place that was not known.
  static constexpr Duration kPause = std::chrono::milliseconds(250);
  /// So long the newest pose stands for what comes after it: two turns of the scene worker.
  static constexpr Duration kAhead = std::chrono::milliseconds(100);

  /// A place that is known worse than this places nothing.
  static constexpr double kMostSigma_m = 0.3;

  /// In the order of time; what is not finite, or not newer, is left out. Without a heading (an
  /// absent sigma; the yaw may be any number then) it is remembered that there was none.
  void add(Time time, const Pose2& pose, double position_sigma_m = 0, double yaw_sigma_rad = 0);
  /// When the map moved, or the place was lost: older poses are of another map.
  void clear() { size_ = 0; }
  /// Interpolated by the shorter turn, as well known as the worse of both. `arrived` is when the
  /// question came; the error says how old it is and how far back is known.
  Result<KnownPose, std::string> at(Time when, Time arrived) const;

 private:
  struct Known {
    Time time = kNever;
    KnownPose at;
    bool has_heading = true;
  };
  static constexpr std::size_t kCapacity = 512;
  static_assert(kCapacity * kSpacing > kReach);

  /// Why nothing can be placed by it; empty: it can.
  static std::string problem_of(const Known& known);
  const Known& known(std::size_t i) const { return ring_[(first_ + i) % kCapacity]; }
  const Known& newest() const { return known(size_ - 1); }

  std::array<Known, kCapacity> ring_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace drover::scene
