#include "engine/health/rim_motion.h"

#include <algorithm>
#include <cmath>

#include "engine/health/heard.h"

namespace drover::engine {
namespace {

constexpr double kOnTheSpot = 0.25;  // what goes by less of its turn goes neither ahead nor back

}  // namespace

RimReader::RimReader(const EngineConfig& config)
    : stale_(from_s(config.health.drive_stale_s)),
      base_(kinematics_of(config.base)),
      driven_(joints_of(base_)) {}

RimMotion RimReader::told(std::span<const AxisSnapshot> axes, Time now) const {
  RimMotion rims;
  Told told;
  told.joints.resize(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!driven_[i]) continue;
    const AxisSnapshot& axis = axes[i];
    const double mps = rim_mps(base_, axis.motion.velocity_radps);
    if (!tells_motion(axis, now, stale_) || !std::isfinite(mps)) {
      rims.silent = true;
      continue;
    }
    rims.heard = true;
    if (axis.state == AxisState::running) rims.driven = true;
    told.joints[i] = {axis.motion.velocity_radps, now};
    if (std::abs(mps) > std::abs(rims.fastest_mps)) rims.fastest_mps = mps;
  }
  set_direction(rims, told, now);
  return rims;
}

RimMotion RimReader::asked(std::span<const AxisSnapshot> axes, Time now) const {
  RimMotion rims;
  Told told;
  told.joints.resize(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!driven_[i]) continue;
    told.joints[i] = {axes[i].commanded_velocity_radps, now};
    const double mps = rim_mps(base_, axes[i].commanded_velocity_radps);
    if (std::abs(mps) > std::abs(rims.fastest_mps)) rims.fastest_mps = mps;
  }
  set_direction(rims, told, now);
  return rims;
}

BodyMotion RimReader::motion_of(const Told& told, Time now) const {
  if (!takes_twist(base_)) return body_motion(base_, told, now, Duration::zero());
  BodyMotion body;
  JointVelocities mps;
  mps.resize(told.joints.size());
  body.known = true;
  for (std::size_t i = 0; i < told.joints.size(); ++i) {
    if (!driven_[i]) continue;
    body.known = body.known && told.joints[i].at == now;
    mps[i] = told.joints[i].velocity_radps;
  }
  body.twist = twist_of_edges(base_, mps);
  return body;
}

void RimReader::set_direction(RimMotion& rims, const Told& told, Time now) const {
  const BodyMotion body = motion_of(told, now);
  if (!body.known) return;
  const double goes_mps = fastest_mps(base_, {body.twist.vx_mps, 0});
  const double turns_mps = fastest_mps(base_, {0, body.twist.wz_radps});
  // Aside is neither ahead nor a turn, whatever little of those is in it.
  if (fastest_mps(base_, {0, 0, body.twist.vy_mps}) > std::max(goes_mps, turns_mps)) return;
  if (goes_mps > kOnTheSpot * turns_mps) rims.ahead = std::copysign(1.0, body.twist.vx_mps);
  if (turns_mps > goes_mps) rims.turn = std::copysign(1.0, body.twist.wz_radps);
}

}  // namespace drover::engine
