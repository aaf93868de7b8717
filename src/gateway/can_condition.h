// What a CAN controller's error frames say about its bus (linux/can/error.h).
#pragma once

#include <cstdint>
#include <string_view>

#include "drover/can_frame.h"
#include "drover/fixed_text.h"
#include "drover/time.h"

namespace drover::gateway {

/// Pure: frames in, condition out. One for each time an interface is opened.
class CanCondition final {
 public:
  enum class State : std::uint8_t {
    active,   ///< takes part without restriction
    warning,  ///< an error counter reached 96
    passive,  ///< an error counter reached 128: it may no longer tell others of errors
    off,      ///< bus-off: it sends and hears nothing; send() succeeds all the same
  };

  /// A frame with `error` set. What it does not speak of stays as it was.
  void on_error_frame(const CanFrame& frame, Time received);
  /// Any other frame: who hears one is not bus-off.
  void on_frame(Time received);

  State state() const { return state_; }
  /// "can0 is bus-off: ...", for an operator; empty when all is well.
  Reason text(std::string_view bus, Time now) const;

 private:
  void enter(State state);

  State state_ = State::active;
  bool counted_ = false;  ///< the counters below are known
  unsigned transmit_errors_ = 0;
  unsigned receive_errors_ = 0;
  Time last_frame_ = kNever;
  Time errors_since_ = kNever;  ///< without a frame in between
  Time last_error_ = kNever;
};

}  // namespace drover::gateway
