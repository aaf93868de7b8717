// How an arm and its base truly moved.
#pragma once

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

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

/// What `drover status --json` said, the only one that was asked in this mission.
inline nlohmann::json asked_status(const Record& log) {
  std::ifstream file(log.folder / "drover.log");
  std::string line;
  std::getline(file, line);
  return nlohmann::json::parse(line).at("status");
}

}  // namespace drover::mission
