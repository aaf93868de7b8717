#include "engine/health/creep_watch.h"

#include <algorithm>
#include <cmath>

#include "engine/still.h"

namespace drover::engine {
namespace {

constexpr double kPatience_s = 0.3;  // drives lag
constexpr double kConfirm_s = 1.0;
constexpr double kCreeps_m = 0.1;

}  // namespace

void CreepWatch::begin(Time now) {
  since_ = now;
  way_m_ = 0;
}

bool CreepWatch::update(const CreepInput& input, const RimMotion& rims) {
  if (since_ == kNever) return false;
  const double since_s = to_s(input.now - since_) - kPatience_s;
  // A loose contact ends nothing: what it goes meanwhile is not known.
  if (since_s < 0 || rims.silent) return false;
  way_m_ += rims.fastest_mps * std::max(to_s(input.dt), 0.0);
  // What goes down may be the slope's doing, and what is fast is judged by more than its wheels.
  const bool down = goes_down(rims.ahead, input.falls_ahead);
  if (input.may_roll && (down || std::abs(rims.fastest_mps) > kTurns_mps)) way_m_ = 0;
  const bool stood = since_s > kConfirm_s && std::abs(way_m_) < kStands_mps * since_s;
  if (stood || !input.power || !rims.driven) end();
  const bool sure = !input.may_roll || !input.seen_to_stand;
  return since_ != kNever && std::abs(way_m_) > kCreeps_m && sure;
}

}  // namespace drover::engine
