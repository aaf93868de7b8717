// The robot's state as one line of JSON for drover-ros2: everything that its topics need, as the
// snapshot has it, with full precision. What a topic makes of it is drover-ros2's.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "drover/snapshot.h"
#include "publish/aimrt/messages.h"
#include "scene/sensor/near_things.h"

namespace drover::publish::ros2 {

/// What was told already: each sample goes out once.
struct Told {
  Time joints = kNever;
  Time imu = kNever;
  Time fix = kNever;
  Time battery = kNever;
  std::int64_t battery_ns = 0;  ///< its stamp: the same again, however the clocks drift
  Time odometry = kNever;
  Time battery_at = kNever;      ///< when it was told, also that it is silent
  Time diagnostics_at = kNever;  ///< likewise
  aimrt::TouchPace touch;
  std::array<Time, kMaxOfKind> turns{};  ///< by scanner, the end of the last one
  Quaternion orientation;                ///< of the last sample
};

/// The whole of what is new since `told`. Stamps are wall-clock nanoseconds (`*_ns`), absent values
/// null; other names are the snapshot's. `turns`: the scanners' latest ones.
std::string state_line(const Snapshot& seen, Duration wall_minus_monotonic,
                       std::span<const scene::sensor::SeenTurn* const> turns, Told& told);

}  // namespace drover::publish::ros2
