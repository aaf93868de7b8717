// What the drives of tests/mission/scenes are, for who makes them and for who judges them.
#pragma once

#include <cstddef>

namespace drover::mission {

/// The way of one drive; the next one begins where it ends.
inline constexpr double kDrive_m = 6;
/// From a point of the track to the next.
inline constexpr double kSpacing_m = 0.5;

/// How far along the track a target lies; targets count from 1.
constexpr double target_at_m(std::size_t target) {
  return kSpacing_m * static_cast<double>(target - 1);
}

}  // namespace drover::mission
