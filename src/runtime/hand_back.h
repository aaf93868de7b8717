// Whether the guard is asked for the bus at once.
#pragma once

#include <algorithm>
#include <cmath>

#include "drover/snapshot.h"

namespace drover::runtime {

/// A base rolls, and is taken back at its own speed; or it rests, and a joint goes on, by its
/// weight maybe: the guard can damp it, and hold it nowhere.
inline bool cannot_wait(const Snapshot& robot, bool base_rests) {
  constexpr double kSinks_radps = 0.05;  // above what feedback at rest is beside
  const auto sinks = [](const AxisSnapshot& axis) {
    return axis.group != 0 && axis.health == SourceState::fresh &&
           std::abs(axis.motion.velocity_radps) > kSinks_radps;
  };
  return robot.hold == HoldState::catching ||
         (base_rests && std::any_of(robot.axes.begin(), robot.axes.end(), sinks));
}

}  // namespace drover::runtime
