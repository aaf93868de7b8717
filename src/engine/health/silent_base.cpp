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
  found_powered_ = input.found_powered;
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
  if (!was_unheard) stood_ = input.rests;
  if (!heard_ && found_powered_) keeps_on_ = true;
  // What stood when it fell silent brakes by itself: where it would roll, a stop must not move it.
  const bool stands = stood_ && input.slope && input.rests;
  stop_stands_ = stop_stands_ || input.stop_asked;
  const bool stop_now = stop_stands_ && !stands && (input.stop_asked || !keeps_on_);
  keeps_on_ = keeps_on_ || stop_now;
  return stop_now;
}

}  // namespace drover::engine
