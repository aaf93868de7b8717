// The minimum filter over arrival minus UTC, written as a prediction of the next arrival.
#include "drivers/nmea0183/time_anchor.h"

#include <algorithm>

namespace drover::nmea0183 {

Duration step_of_day(Duration from, Duration to) {
  constexpr Duration kDay = std::chrono::hours(24);
  const Duration step = to - from;
  if (step > kDay / 2) return step - kDay;
  if (step <= -kDay / 2) return step + kDay;
  return step;
}

Time TimeAnchor::due(Duration utc_of_day, Time first_byte) {
  const Duration step = step_of_day(utc_of_day_, utc_of_day);
  const Duration elapsed = first_byte - first_byte_;
  if (!valid_ || step < Duration::zero() || elapsed > kMaxGap) {
    due_ = first_byte;
  } else {
    const auto drift = Duration(static_cast<Duration::rep>(
        static_cast<double>(std::max(elapsed, Duration::zero()).count()) * kMaxDrift));
    due_ = std::min(first_byte, due_ + step + drift);
  }
  valid_ = true;
  utc_of_day_ = utc_of_day;
  first_byte_ = first_byte;
  return due_;
}

}  // namespace drover::nmea0183
