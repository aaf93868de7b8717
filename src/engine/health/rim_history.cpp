#include "engine/health/rim_history.h"

#include <cmath>

#include "engine/still.h"

namespace drover::engine {
namespace {

// A drive that is being armed swings its wheel to and fro: that is no rolling.
constexpr double kRollHeld_s = 0.2;
constexpr double kSlower_mps = 0.05;

}  // namespace

void RimHistory::note_turning(const RimMotion& rims, Time now) {
  turns_ = std::abs(rims.fastest_mps) > kTurns_mps;
  const bool swings = turns_ && rims.fastest_mps * mps_ < 0;
  if (!turns_ || swings) turns_since_ = kNever;
  if (turns_ && turns_since_ == kNever) turns_since_ = now;
  mps_ = rims.fastest_mps;
}

void RimHistory::note_braking(const RimMotion& rims, bool is_due, Time now) {
  const double mps = std::abs(rims.fastest_mps);
  const bool begins = rims.driven && drives_on_since_ == kNever;
  if (begins || !is_due || steady_since_ == kNever || mps < slowest_mps_ - kSlower_mps) {
    steady_since_ = now;
    slowest_mps_ = mps;
  }
  drives_on_since_ = rims.driven ? steady_since_ : kNever;
}

bool RimHistory::rolls(Time now) const {
  return turns_ && now - turns_since_ >= from_s(kRollHeld_s);
}

}  // namespace drover::engine
