// Places a receiver's UTC on the monotonic line, so that late bytes do not make late measurements.
#pragma once

#include "drover/time.h"

namespace drover::nmea0183 {

/// Epochs come from the receiver at an even pace, but their bytes may be held up on the way (a busy
/// line, an adapter's latency timer, a scheduler). The earliest arrival, relative to UTC, is the
/// one that was held up least: later epochs are placed by it. What is held up for good, such as a
/// receiver that lags by a second, thereby gets an honest, old time.
class TimeAnchor final {
 public:
  /// The clocks of receiver and computer may drift apart by this much.
  static constexpr double kMaxDrift = 500e-6;
  /// After such a silence the receiver may have been restarted: UTC is placed anew.
  static constexpr Duration kMaxGap = std::chrono::seconds(10);

  /// When the first byte of the epoch of `utc_of_day` was due; never later than `first_byte`.
  /// UTC that runs backwards (a leap second, a corrected leap count) is placed anew.
  Time due(Duration utc_of_day, Time first_byte);
  void reset() { valid_ = false; }

 private:
  bool valid_ = false;
  Duration utc_of_day_{};
  Time first_byte_ = kNever;
  Time due_ = kNever;
};

/// From `from` to `to`, both since midnight, across midnight if that is shorter.
Duration step_of_day(Duration from, Duration to);

}  // namespace drover::nmea0183
