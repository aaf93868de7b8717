// Notices who else commands the drives, also when it only says zero: a second gateway on the bus.
#pragma once

#include <cstdint>

#include "drover/fixed_text.h"
#include "drover/time.h"

namespace drover::gateway {

/// Stop frames on a drive's ids that are not ours. The guard sends the same ones while it holds the
/// bus, so those near its time are taken for its own, and a single frame is nobody's habit.
class ForeignWatch final {
 public:
  /// A stop frame for one of our drives that this gateway did not send.
  void on_stop_frame(std::uint32_t id, std::string_view bus, Time at);
  /// Each cycle. `guard_may_send`: it holds the bus, or is not heard and so may do what it wants.
  void update(Time now, bool guard_may_send);
  /// Who, in words; empty when nobody does.
  const Reason& reason() const { return reason_; }

 private:
  std::uint32_t id_ = 0;
  Name bus_;
  Time since_ = kNever;
  Time last_ = kNever;
  Time guard_at_ = kNever;
  Reason reason_;
};

}  // namespace drover::gateway
