#include "engine/health/silent_base.h"

#include <cmath>
#include <utility>

#include "engine/still.h"

namespace drover::engine {
namespace {

// A loose contact that comes and goes gives no base time for another ramp, a supply that was away
// does: what rolls or brakes meanwhile has another speed.
constexpr double kOther_mps = 0.1;

}  // namespace

bool SilentBase::update(const SilenceInput& input) {
  const bool was_unheard = std::exchange(unheard_, input.silent);
  has_a_command_ = unheard_ && (heard_ || input.found_powered);
  back_ = false;
  if (!unheard_) {
    stop_stands_ = keeps_on_ = false;
    if (!input.heard) return false;  // it has no power, and forgets
    back_ = was_unheard && (!heard_ || std::abs(input.fastest_mps - heard_mps_) > kOther_mps);
    heard_ = true;
    heard_mps_ = input.fastest_mps;
    keeps_on_ = input.asked || std::abs(input.fastest_mps) > kTurns_mps;
    return false;
  }
  if (!was_unheard) suspect_ = heard_ ? keeps_on_ : input.found_powered && !stood_;
  stood_ = input.rests || (stood_ && (was_unheard || !heard_));
  // What stands in silence brakes by itself: where it would roll, a stop must not move it.
  const bool stands = input.slope && stood_ && !input.moves;
  if (stands) keeps_on_ = false;
  if (!heard_ && input.found_powered && !stood_) keeps_on_ = true;
  stop_stands_ = stop_stands_ || input.stop_asked;
  // What stood because something was in its way drives on.
  const bool goes_on = suspect_ && stood_ && input.moves;
  const bool stop_now = (stop_stands_ || goes_on) && !stands && (input.stop_asked || !keeps_on_);
  keeps_on_ = keeps_on_ || stop_now;
  return stop_now;
}

}  // namespace drover::engine
