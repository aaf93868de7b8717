// Whether the wheels of a base that steers are where they are told to be.
#include "engine/health/steering_watch.h"

#include <cmath>

#include "drover/angle.h"

namespace drover::engine {
namespace {

constexpr double kFollowsIn_s = 0.15;
const double kSteeredAside_rad = to_rad(6.0);

}  // namespace

SteeringWatch::SteeringWatch(const EngineConfig& config)
    : limit_s_(config.health.follow_timeout_s),
      wheelbase_m_(steered_wheelbase_m(kinematics_of(config.base))) {}

void SteeringWatch::update(Time now, Duration dt, const Twist& commanded, double measured_rad) {
  reason_.clear();
  if (!(wheelbase_m_ > 0)) return;
  if (!drives(commanded) || !std::isfinite(measured_rad)) {
    if (std::isfinite(measured_rad)) followed_rad_ = measured_rad;
    astray_since_ = kNever;
    return;
  }
  const double told_rad = steering_rad(wheelbase_m_, commanded.wz_radps / commanded.vx_mps);
  followed_rad_ += (told_rad - followed_rad_) * to_s(dt) / (kFollowsIn_s + to_s(dt));
  if (!(std::abs(measured_rad - followed_rad_) > kSteeredAside_rad)) {
    astray_since_ = kNever;
    return;
  }
  if (astray_since_ == kNever) astray_since_ = now;
  if (to_s(now - astray_since_) < limit_s_) return;
  reason_.format("the steering does not follow: told %+.0f degrees, it is at %+.0f",
                 to_deg(told_rad), to_deg(measured_rad));
}

}  // namespace drover::engine
