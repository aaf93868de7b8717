// The kernel stamps CAN frames with the wall clock: where such a stamp lies on the monotonic line.
#pragma once

#include <cstdint>
#include <optional>

#include "drover/time.h"

namespace drover::link {

/// For one drain.
struct StampWindow {
  Time previous_drain = kNever;
  Time now = kNever;
  Duration wall_minus_monotonic{};
  /// The distance of the clocks before somebody set one since the previous drain; none: nobody did.
  std::optional<Duration> before_step{};
};

/// A frame of this drain came in between the previous one and now. With the clock set in that time
/// it is the distance that puts the stamp there that is believed; a stamp that neither puts there
/// is clamped, and counted.
inline Time monotonic_stamp(Duration wall, const StampWindow& window, std::uint64_t& clamped) {
  // The two clocks are read one after the other.
  constexpr Duration kSlack = std::chrono::microseconds(1);
  const auto fits = [&](Time time) {
    return time >= window.previous_drain && time <= window.now + kSlack;
  };
  Time time{wall - window.wall_minus_monotonic};
  if (!fits(time) && window.before_step && fits(Time{wall - *window.before_step}))
    time = Time{wall - *window.before_step};
  if (!fits(time)) ++clamped;
  return time < window.previous_drain ? window.previous_drain
         : time > window.now          ? window.now
                                      : time;
}

}  // namespace drover::link
