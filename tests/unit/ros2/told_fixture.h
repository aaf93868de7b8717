// A robot as droverd sees it, told line by line and read again.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "publish/ros2/line.h"
#include "ros2/told.h"

namespace drover::ros2 {

inline constexpr Time kThen{std::chrono::seconds(100)};
/// 28 November 2026, 12:00 UTC.
inline constexpr Duration kWall{std::chrono::seconds(1795867200 - 100)};
inline constexpr Stamp_ns kThen_ns = 1795867200LL * 1'000'000'000;

class AToldRobot : public ::testing::Test {
 protected:
  AToldRobot() {
    seen.time = kThen;
    AxisSnapshot axis;
    axis.joint = "left";
    axis.health = SourceState::fresh;
    axis.last_motion = kThen;
    axis.motion = {0, 1.0 / 3, -0.1, 2.5};
    (void)seen.axes.push_back(axis);
    axis.joint = "right";
    axis.health = SourceState::stale;
    (void)seen.axes.push_back(axis);
  }

  Told tell() {
    const auto line = publish::ros2::state_line(seen, wall, turns, told);
    const auto read = read_told(line);
    EXPECT_TRUE(read.ok()) << line;
    return read.ok() ? *read : Told{};
  }
  /// A while later.
  Told tell_after(Duration time) {
    seen.time += time;
    return tell();
  }

  Snapshot seen;
  Duration wall = kWall;
  std::vector<const scene::sensor::SeenTurn*> turns;
  publish::ros2::Told told;
};

}  // namespace drover::ros2
