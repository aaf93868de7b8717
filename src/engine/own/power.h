// The enable relay: when the drives have power, and in which order it is taken from them.
#pragma once

#include <span>

#include "drover/snapshot.h"

namespace drover::engine {

struct PowerInput {
  bool cut = false;     ///< to be taken until a reset
  bool estop = false;   ///< pressed, or not known to be free
  bool waits = false;   ///< for the e-stop's line, because the drives held before a restart
  bool closed = false;  ///< as the relay was found
};

/// A braking motor gives its energy back to the battery, and has nowhere to put it once the relay
/// is open: so a cut is zero first, then drives idle, then the relay. Only the e-stop, whose
/// hardware does not wait, opens it at once. After a restart a relay that was kept closed stays so
/// until the e-stop's line tells of itself, and none is closed before it does.
class PowerSwitch final {
 public:
  /// Before the first cycle: what is cut has no power.
  void recall(bool cut) { opened_ = cut; }

  void step(Time now, const PowerInput& input, std::span<const AxisSnapshot> axes);
  /// By that cut the drives have no power any more.
  bool opened() const { return opened_; }
  /// Level of the relay: true has power.
  bool closed() const { return closed_; }

 private:
  bool opened_ = false;  ///< of that cut, the last step is done
  bool closed_ = false;
  Time since_ = kNever;
};

}  // namespace drover::engine
