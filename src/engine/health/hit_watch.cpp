#include "engine/health/hit_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace drover::engine {
namespace {

constexpr double kLasting_s = 0.3;  // longer than a knock, shorter than a braking
constexpr double kStale_s = 0.5;
constexpr double kAtOnce_s = 0.015;  // a hit takes 10 to 50 ms
constexpr Duration kHeld = std::chrono::seconds(1);

}  // namespace

void HitWatch::on_sample(const ImuSample& sample, Time at) {
  const Vector3& force = sample.acceleration_mps2;
  if (limit_mps2_ <= 0 || !std::isfinite(force.x) || !std::isfinite(force.y)) return;
  const double dt_s = sample_at_ == kNever ? -1 : to_s(at - sample_at_);
  sample_at_ = at;
  if (!(dt_s >= 0 && dt_s < kStale_s)) {
    lasting_x_mps2_ = force.x;
    lasting_y_mps2_ = force.y;
    above_ = false;
    return;
  }
  const double knock_mps2 = std::hypot(force.x - lasting_x_mps2_, force.y - lasting_y_mps2_);
  const bool was_above = std::exchange(above_, knock_mps2 > limit_mps2_);
  if (above_ && !was_above && dt_s < kAtOnce_s) return;
  if (above_) {
    // One hit rings for a while: told once, with its hardest.
    const bool same = hit_at_ != kNever && at - hit_at_ < kHeld;
    hardest_mps2_ = std::max(same ? hardest_mps2_ : 0.0, knock_mps2);
    hit_at_ = at;
    reason_.format("the robot was hit: %.0f m/s2 across the ground", hardest_mps2_);
    return;  // what knocks does not last
  }
  const double share = dt_s / (kLasting_s + dt_s);
  lasting_x_mps2_ += share * (force.x - lasting_x_mps2_);
  lasting_y_mps2_ += share * (force.y - lasting_y_mps2_);
}

const Reason& HitWatch::reason(Time now) {
  if (hit_at_ != kNever && now - hit_at_ >= kHeld) {
    hit_at_ = kNever;
    reason_.clear();
  }
  return reason_;
}

}  // namespace drover::engine
