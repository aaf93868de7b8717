// The only readers of the system's clocks.
#pragma once

#include <ctime>

#include "drover/time.h"

namespace drover::runtime {

inline Duration read_clock(clockid_t clock) {
  timespec t{};
  ::clock_gettime(clock, &t);
  return std::chrono::seconds(t.tv_sec) + Duration(t.tv_nsec);
}

inline Time monotonic_now() {
  return Time{read_clock(CLOCK_MONOTONIC)};
}

/// What to take off a wall-clock stamp of the kernel to get monotonic time, right now. Who is held
/// up between the clocks reads them again.
inline Duration wall_minus_monotonic() {
  constexpr Duration kHeldUp = std::chrono::microseconds(20);
  Duration before = read_clock(CLOCK_MONOTONIC);
  for (int attempt = 0;; ++attempt) {
    const Duration wall = read_clock(CLOCK_REALTIME);
    const Duration after = read_clock(CLOCK_MONOTONIC);
    if (after - before < kHeldUp || attempt == 2) return wall - (before + (after - before) / 2);
    before = after;
  }
}

/// How long this computer was suspended since it booted.
inline Duration asleep_since_boot() {
  return read_clock(CLOCK_BOOTTIME) - read_clock(CLOCK_MONOTONIC);
}

}  // namespace drover::runtime
