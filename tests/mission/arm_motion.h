// How an arm and its base truly moved.
#pragma once

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

#include "mission/arm_wire.h"
#include "mission/support.h"

namespace drover::mission {

inline constexpr std::size_t kBaseYaw = 0;
inline constexpr std::size_t kShoulder = 1;
inline constexpr std::size_t kElbow = 2;

inline double arm_at(const Record& log, std::size_t joint, Time time) {
  const auto after = std::find_if(log.truth.begin(), log.truth.end(),
                                  [time](const TruthLine& line) { return line.time >= time; });
  if (after == log.truth.end()) throw std::runtime_error("no true motion then");
  return after->arm_rad.at(joint);
}

/// How far a joint moved from where it was at `begin`.
inline double strayed(const Record& log, std::size_t joint, Time begin, Time end) {
  const double from = arm_at(log, joint, begin);
  double most = 0;
  for (const TruthLine& line : log.truth)
    if (line.time >= begin && line.time <= end)
      most = std::max(most, std::abs(line.arm_rad.at(joint) - from));
  return most;
}

/// How fast the base moves then, m/s.
inline double speed_at(const Record& log, Time time) {
  return std::abs(log.truth_at(time).vx_mps);
}

/// From `begin` to `end` a motor is told to keep a place, more than so many times.
inline void expect_stiff(const Record& log, std::size_t joint, Time begin, Time end,
                         std::size_t times = 50) {
  const auto told = arm_set_points(log, joint, begin, end);
  EXPECT_GT(told.size(), times) << joint;
  for (const ArmSetPoint& one : told)
    ASSERT_GT(one.told.stiffness, 0) << "joint " << joint << " at " << seconds(one.time);
}

/// What `drover status --json` said when it was asked for the n-th time in this mission.
inline nlohmann::json asked_status(const Record& log, std::size_t n = 1) {
  std::ifstream file(log.folder / "drover.log");
  for (std::string line; std::getline(file, line);) {
    const auto said = nlohmann::json::parse(line, nullptr, false);
    if (said.is_object() && said.contains("status") && --n == 0) return said.at("status");
  }
  throw std::runtime_error("drover status --json did not answer so often");
}

}  // namespace drover::mission
