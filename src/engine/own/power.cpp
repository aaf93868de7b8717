// The enable relay: when the drives have power, and in which order it is taken from them.
#include "engine/own/power.h"

#include <algorithm>

namespace drover::engine {
namespace {

/// A drive that does not go idle by then, or says nothing, does not keep the power on. It is asked
/// to go idle once it is slow, and after a second in any case.
constexpr Duration kLongestIdling = std::chrono::milliseconds(1500);

bool has_let_go(const AxisSnapshot& axis) {
  return axis.health != SourceState::fresh || axis.state == AxisState::idle ||
         (axis.state == AxisState::fault && !axis.powered);
}

}  // namespace

void PowerSwitch::step(Time now, const PowerInput& input, std::span<const AxisSnapshot> axes) {
  if (!input.cut) {
    since_ = kNever;
    opened_ = false;
  } else if (!opened_) {
    if (since_ == kNever) since_ = now;
    // One cycle at least: what they reported before they were asked says nothing of it.
    const bool asked = now > since_;
    opened_ = (asked && std::all_of(axes.begin(), axes.end(), has_let_go)) ||
              now - since_ > kLongestIdling;
  }
  closed_ = !opened_ && (input.waits ? input.closed : !input.estop);
}

}  // namespace drover::engine
