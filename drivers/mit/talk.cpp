#include "drivers/mit/talk.h"

namespace drover::mit {

void Talk::command(const CanFrame& frame, FrameEffect effect, Time now, DriverOut& out) {
  const bool stops = effect == FrameEffect::stop;
  const bool at_once = stops && moves_;
  if (!at_once && !is_due(last_, setpoint_period_, now)) return;
  last_ = now;
  moves_ = !stops;
  out.send(frame);
}

void Talk::send(const CanFrame& frame, Time now, DriverOut& out) {
  last_ = now;
  moves_ = false;
  out.send(frame);
}

}  // namespace drover::mit
