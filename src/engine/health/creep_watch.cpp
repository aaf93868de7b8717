#include "engine/health/creep_watch.h"

#include <algorithm>
#include <cmath>

#include "engine/still.h"

namespace drover::engine {
namespace {

constexpr double kPatience_s = 0.3;  // drives lag
constexpr double kSeenStanding_s = 1.0;
constexpr double kForgets_s = 5.0;
constexpr double kCreeps_m = 0.1;

}  // namespace

void CreepWatch::begin(Time now) {
  since_ = now;
  way_m_ = heard_s_ = silent_s_ = 0;
}

bool CreepWatch::update(const CreepInput& input, const RimMotion& rims) {
  if (!under_way() || to_s(input.now - since_) < kPatience_s) return false;
  const double dt_s = std::max(to_s(input.dt), 0.0);
  // A loose contact ends nothing: what it goes meanwhile is not known.
  silent_s_ = rims.silent ? silent_s_ + dt_s : 0;
  if (rims.silent) {
    if (silent_s_ > kForgets_s) end();
    return false;
  }
  const double mps = rims.fastest_mps;
  heard_s_ += dt_s;
  way_m_ += mps * dt_s;
  // Where it may roll, what goes down may be the slope's doing, and what is fast is judged by more
  // than its wheels: the count begins anew.
  const bool down = goes_down(rims.ahead, input.falls_ahead) && std::abs(mps) > kStands_mps;
  if (input.may_roll && (down || std::abs(mps) > kTurns_mps)) way_m_ = heard_s_ = 0;
  const bool stood = heard_s_ > kSeenStanding_s && std::abs(way_m_) < kStands_mps * heard_s_;
  if (stood || !input.power || !rims.driven) end();
  const bool sure = !input.may_roll || !input.seen_to_stand;
  return under_way() && std::abs(way_m_) > kCreeps_m && sure;
}

}  // namespace drover::engine
