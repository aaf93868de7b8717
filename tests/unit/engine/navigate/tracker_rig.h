// The tracker on a robot that lags and skids.
#pragma once

#include "engine/navigate/tracker.h"
#include "support/track_drive.h"

namespace drover::engine {

using test::Drive;
using test::DriveSetup;
using test::figure_eight;
using test::Pen;
using test::Points;
using test::record;
using test::rows;
using test::square;

/// Drives until arrival and one second more, at 200 Hz.
inline Drive drive(const Path& path, std::uint32_t target, const DriveSetup& setup) {
  test::Plant2d plant({}, setup.plant, setup.x_m, setup.y_m, setup.yaw_rad);
  Tracker tracker(setup.navigate, setup.limits);
  tracker.begin(path, target, setup.speed_mps, plant.estimate());
  return test::drive(path, target, setup, plant, [&](const Pose& pose, double dt_s) {
    const TrackProgress progress = tracker.locate(pose);
    return test::Steered{tracker.follow(pose, progress, setup.cap_mps, from_s(dt_s)),
                         progress.arrived};
  });
}

}  // namespace drover::engine
