// When a motor is told something: it answers each frame, and both fill its bus.
#pragma once

#include "drover/actuator.h"
#include "drover/driver_out.h"
#include "drover/time.h"

namespace drover::mit {

/// `last` is that long ago, or was never.
constexpr bool is_due(Time last, Duration period, Time now) {
  return last == kNever || now - last >= period;
}

class Talk final {
 public:
  explicit Talk(Duration setpoint_period) : setpoint_period_(setpoint_period) {}

  /// Nothing was sent, on this link.
  void begin() { *this = Talk(setpoint_period_); }
  /// What is followed: not sooner than a set point's period after what was sent last, but for a
  /// stop of what moves it.
  void command(const CanFrame& frame, FrameEffect effect, Time now, DriverOut& out);
  /// What moves nothing, now.
  void send(const CanFrame& frame, Time now, DriverOut& out);

  Time last() const { return last_; }

 private:
  Duration setpoint_period_;
  Time last_ = kNever;
  bool moves_ = false;  ///< what was sent last was no stop
};

}  // namespace drover::mit
