// How the robot moved of late, by its own measure: no map, no position, no jumps.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "drover/time.h"
#include "drover/twist.h"
#include "scene/plane/point.h"

namespace drover::scene::sensor {

/// The last two seconds, in a frame of its own that begins somewhere. It drifts as wheels and gyro
/// do: good for what was seen a few metres ago.
class OwnWay final {
 public:
  static constexpr Duration kReach = std::chrono::seconds(2);
  /// A longer pause is a way that nobody knows.
  static constexpr Duration kPause = std::chrono::milliseconds(500);
  /// So long the newest place stands for what comes after it.
  static constexpr Duration kAhead = std::chrono::milliseconds(100);

  /// It moves so; `fastest_mps`: ahead, the most that it may have, say because it is told to.
  /// Numbers that are none: the way is not known any more.
  void note(Time t, const Twist& moves, double fastest_mps);

  /// Nothing: not known. What is newer than the last note is there still.
  std::optional<Pose2> pose(Time t) const;
  /// The newest one.
  std::optional<Pose2> pose() const;
  /// Ahead from then to the last note, never less than was driven.
  double ahead_m(Time since) const;
  /// Another one: places before and after cannot be compared.
  std::uint32_t frame() const { return frame_; }

 private:
  struct Mark {
    Time t = kNever;
    Pose2 pose;
    double ahead_m = 0;
    Twist moves;
    double fastest_mps = 0;
  };
  void forget();

  std::deque<Mark> marks_;  ///< in the order of time
  std::uint32_t frame_ = 0;
};

}  // namespace drover::scene::sensor
