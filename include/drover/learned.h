// What drives taught a robot of itself: it outlives the program.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
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
  std::uint8_t imu = 0;          ///< whose gyro, likewise
  std::uint32_t forgotten = 0;   ///< how often a person had it forgotten, since the start
  LearnedValue mounting_rad;     ///< of the antenna line, counterclockwise
  LearnedValue antenna_ahead_m;  ///< farther ahead than configured
  LearnedValue antenna_left_m;   ///< and to the left
  LearnedValue late_s;           ///< of positions, after their stamps
  LearnedValue heading_late_s;   ///< of headings
  LearnedValue wheel_scale;      ///< true speed over the one that the base tells
  LearnedValue turn_gain;        ///< true turn over the wheels': 1 / yaw_slip_factor
  LearnedValue gyro_scale;       ///< true turn over the measured one
};

/// How many values there are, each with its name: it ends in the unit.
inline constexpr std::size_t kLearnedCount = 8;
template <class Values, class Visit>
void each_learned(Values& learned, const Visit& visit) {
  auto& [receiver, imu, forgotten, mounting_rad, antenna_ahead_m, antenna_left_m, late_s,
         heading_late_s, wheel_scale, turn_gain, gyro_scale] = learned;
  (void)receiver;
  (void)imu;
  (void)forgotten;
  visit("mounting_rad", mounting_rad);
  visit("antenna_ahead_m", antenna_ahead_m);
  visit("antenna_left_m", antenna_left_m);
  visit("late_s", late_s);
  visit("heading_late_s", heading_late_s);
  visit("wheel_scale", wheel_scale);
  visit("turn_gain", turn_gain);
  visit("gyro_scale", gyro_scale);
}

/// Each value of the one with the same of the other.
template <class Values, class Visit>
void each_learned_of_both(Values& one, const LearnedValues& other, const Visit& visit) {
  std::array<const LearnedValue*, kLearnedCount> others{};
  std::size_t count = 0;
  each_learned(other, [&](const char*, const LearnedValue& value) { others[count++] = &value; });
  count = 0;
  each_learned(one, [&](const char*, auto& value) { visit(value, *others[count++]); });
}

inline bool knows_any(const LearnedValues& learned) {
  bool any = false;
  each_learned(learned, [&any](const char*, const LearnedValue& value) { any |= value.known(); });
  return any;
}

}  // namespace drover
