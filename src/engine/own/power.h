// The enable relay: when the drives have power, and in which order it is taken from them.
#pragma once

#include <span>

#include "drover/snapshot.h"

namespace drover::engine {

struct PowerInput {
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
  /// Takes the drives' power until `reset`; outlives the program.
  void cut() { cut_ = true; }
  void recall(bool cut) { cut_ = opened_ = cut; }
  void reset() { cut_ = opened_ = false; }

  void step(Time now, const PowerInput& input, std::span<const AxisSnapshot> axes);
  /// The drives are to go idle, or have no power.
  bool is_cut() const { return cut_; }
  /// By that cut the drives have no power any more.
  bool opened() const { return opened_; }
  /// Level of the relay: true has power.
  bool closed() const { return closed_; }

 private:
  bool cut_ = false;
  bool opened_ = false;  ///< of that cut, the last step is done
  bool closed_ = false;
  Time since_ = kNever;
};

}  // namespace drover::engine
