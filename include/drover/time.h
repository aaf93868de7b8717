// Monotonic time as a value: nanoseconds that only the runtime may read from a clock.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

namespace drover {

/// The monotonic time line. It has no `now()` on purpose: below `src/runtime` time is an argument.
struct MonotonicClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<MonotonicClock, duration>;
  static constexpr bool is_steady = true;
};

using Duration = std::chrono::nanoseconds;
using Time = MonotonicClock::time_point;

/// "Never": older than anything that can happen, without overflowing when subtracted.
inline constexpr Time kNever{Duration{INT64_MIN / 4}};

constexpr double to_s(Duration d) {
  return static_cast<double>(d.count()) * 1e-9;
}
constexpr double to_s(Time t) {
  return to_s(t.time_since_epoch());
}
inline Duration from_s(double s) {
  return Duration{std::llround(s * 1e9)};
}

}  // namespace drover
