// What drives taught a robot of itself: it outlives the program.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "drover/measurement.h"

namespace drover {

/// A number with one sigma; absent as long as it is not known well enough to be used again.
struct LearnedValue {
  double value = kAbsent;
  double sigma = kAbsent;

  bool known() const { return std::isfinite(value) && std::isfinite(sigma); }
};

/// Beside what is configured, so that it holds for that configuration only.
struct LearnedValues {
  std::uint8_t receiver = 0;     ///< whose antennas, in the configuration's order
  std::uint32_t forgotten = 0;   ///< how often a person had it forgotten, since the start
  LearnedValue mounting_rad;     ///< of the antenna line, counterclockwise
  LearnedValue late_s;           ///< of positions, after their stamps
  LearnedValue heading_late_s;   ///< of headings
  LearnedValue antenna_ahead_m;  ///< farther ahead than configured
  LearnedValue antenna_left_m;   ///< and to the left
  LearnedValue wheel_scale;      ///< true speed over the one that the base tells
  LearnedValue turn_gain;   ///< true turn over the one that the wheels tell: 1 / yaw_slip_factor
  LearnedValue gyro_scale;  ///< true turn over the measured one
};

/// Each value with its name, for those who write it down or show it: the name ends in the unit.
template <class Values, class Visit>
void each_learned(Values& learned, const Visit& visit) {
  auto& [receiver, forgotten, mounting_rad, late_s, heading_late_s, antenna_ahead_m, antenna_left_m,
         wheel_scale, turn_gain, gyro_scale] = learned;
  (void)receiver;
  (void)forgotten;
  visit("mounting_rad", mounting_rad);
  visit("late_s", late_s);
  visit("heading_late_s", heading_late_s);
  visit("antenna_ahead_m", antenna_ahead_m);
  visit("antenna_left_m", antenna_left_m);
  visit("wheel_scale", wheel_scale);
  visit("turn_gain", turn_gain);
  visit("gyro_scale", gyro_scale);
}

inline bool knows_any(const LearnedValues& learned) {
  bool any = false;
  each_learned(learned, [&any](const char*, const LearnedValue& value) { any |= value.known(); });
  return any;
}

}  // namespace drover
