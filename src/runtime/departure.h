// Whether frames may still leave: asked just before the system call that sends them.
#pragma once

#include "drover/time.h"

namespace drover::runtime {

/// When something was looked at, and whether the guard had the bus then.
struct BusMoment {
  Time time = kNever;
  bool guard_holds = false;
};

/// False when the frames were decided more than two cycles ago, or when the guard has taken the bus
/// since: then they were not judged as frames beside a guard that holds. One batch may slip between
/// this and the call; the guard's next frame follows within 10 ms.
constexpr bool may_leave(const BusMoment& decided, const BusMoment& leaving, Duration cycle) {
  if (leaving.guard_holds && !decided.guard_holds) return false;
  return leaving.time - decided.time <= 2 * cycle;
}

}  // namespace drover::runtime
