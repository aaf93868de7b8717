// Numbers the stretches of time in which poses can be compared with each other.
#include "engine/estimate/place_count.h"

#include <cmath>

#include "drover/angle.h"

namespace drover::engine {
namespace {

// Of one cycle, beyond the way driven in it. Corrections by a receiver with RTK are centimetres.
constexpr double kJump_m = 0.1;
const double kJump_rad = to_rad(5.0);

}  // namespace

void PlaceCount::another() {
  ++number_;
  seen_ = false;
}

bool PlaceCount::jumped(const Estimate& estimate, Duration dt) const {
  const Pose& pose = estimate.pose;
  const double dt_s = to_s(dt);
  const double way_m = std::hypot(pose.x_m - pose_.x_m, pose.y_m - pose_.y_m);
  const double turn_rad = std::abs(wrap_rad(pose.yaw_rad - pose_.yaw_rad));
  const bool moved = way_m > kJump_m + std::hypot(pose.vx_mps, pose.vy_mps) * dt_s;
  const bool turned = turn_rad > kJump_rad + std::abs(pose.wz_radps) * dt_s;
  return (has_position_ && moved) || (has_heading_ && turned);
}

void PlaceCount::update(const Estimate& estimate, Duration dt, Time jumped_at) {
  const bool other = estimate.has_position != has_position_ ||
                     estimate.has_heading != has_heading_ || jumped_at != jumped_at_;
  if (seen_ && (other || jumped(estimate, dt))) ++number_;
  seen_ = true;
  has_position_ = estimate.has_position;
  has_heading_ = estimate.has_heading;
  pose_ = estimate.pose;
  jumped_at_ = jumped_at;
}

}  // namespace drover::engine
