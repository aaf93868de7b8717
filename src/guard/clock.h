// The guard's clock; everything else in it gets the time as an argument.
#pragma once

#include <ctime>

#include "drover/time.h"

namespace drover::guard {

inline Time now() {
  timespec t{};
  ::clock_gettime(CLOCK_MONOTONIC, &t);
  return Time{std::chrono::seconds(t.tv_sec) + Duration(t.tv_nsec)};
}

}  // namespace drover::guard
