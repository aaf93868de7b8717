// The speed that is published: of what wheels and receiver say the worse.
#include "engine/health/worst_speed.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {
namespace {

constexpr double kAlike_mps = 0.2;  // two speeds of one motion, with their noise
constexpr Duration kSpread = std::chrono::milliseconds(200);  // over which a receiver smooths

}  // namespace

double WorstSpeed::fastest_since(Time from) const {
  double fastest_mps = 0;
  for (const Slice& slice : slices_) {
    if (slice.begin == kNever || slice.begin + kSlice < from) continue;
    fastest_mps = std::max(fastest_mps, slice.fastest_mps);
  }
  return fastest_mps;
}

double WorstSpeed::update(const SpeedInput& input) {
  if (!std::isfinite(input.wheels_mps)) return input.wheels_mps;
  if (slices_[newest_].begin == kNever || input.now - slices_[newest_].begin >= kSlice) {
    newest_ = (newest_ + 1) % slices_.size();
    slices_[newest_] = {input.now, 0};
  }
  // Written so that a rim that is not a number explains nothing.
  double& fastest_mps = slices_[newest_].fastest_mps;
  for (const double mps : {std::abs(input.wheels_mps), input.fastest_rim_mps})
    if (mps > fastest_mps) fastest_mps = mps;
  if (input.receiver_at == kNever) return input.wheels_mps;
  const double explained_mps = fastest_since(input.receiver_at - kSpread);
  if (!(input.receiver_mps > explained_mps + kAlike_mps)) return input.wheels_mps;
  // Wheels that nearly stand tell no direction, and a receiver never does.
  const bool wheels_tell = std::abs(input.wheels_mps) > kAlike_mps;
  const double direction = wheels_tell ? input.wheels_mps : input.direction;
  return direction < 0 ? -input.receiver_mps : input.receiver_mps;
}

}  // namespace drover::engine
