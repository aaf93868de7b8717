// A shove: a force on the base that follows a smooth way, however much the tyres resist.
#include <array>
#include <cmath>
#include <vector>

#include "drover/angle.h"
#include "sim/plant/plant_impl.h"

namespace drover::sim {
namespace {

// How hard it is held to its way: the tyres' whole grip displaces it by a millimetre.
constexpr double kHold_radps = 100;

// From 0 to 1 without a jump of the acceleration; the most of that is 5.8 / lasts_s^2.
struct Profile {
  double way = 0;
  double rate = 0;
  double acceleration = 0;
};

Profile profile(double share, double lasts_s) {
  const double u = share;
  return {u * u * u * (10 + u * (6 * u - 15)), 30 * u * u * (1 - u) * (1 - u) / lasts_s,
          60 * u * (1 - u) * (1 - 2 * u) / (lasts_s * lasts_s)};
}

}  // namespace

void Plant::shove(const Shove& shove) {
  const mjModel& m = *impl_->model;
  const mjtNum* q = impl_->data->qpos + impl_->base_qpos;
  const BaseVelocity velocity = this->velocity();
  const double yaw_rad = pose().yaw_rad;
  // Of everything that moves with the base.
  std::vector<mjtNum> inertia(static_cast<std::size_t>(m.nv) * static_cast<std::size_t>(m.nv));
  mj_fullM(&m, inertia.data(), impl_->data->qM);
  const auto diagonal = [&](int dof) {
    return inertia[static_cast<std::size_t>(dof) * static_cast<std::size_t>(m.nv + 1)];
  };
  ShoveState state;
  state.shove = shove;
  state.begin_s = impl_->data->time;
  state.ahead = {std::cos(yaw_rad), std::sin(yaw_rad)};
  state.start = {q[0], q[1], yaw_rad};
  state.speed = {velocity.vx_mps, velocity.vy_mps, velocity.wz_radps};
  state.mass_kg = diagonal(impl_->base_qvel);
  state.inertia_kgm2 = diagonal(impl_->base_qvel + 5);
  impl_->shoved = state;
}

// After push(), which has set the base's force anew.
void Plant::Impl::shove() {
  if (!shoved) return;
  const ShoveState& s = *shoved;
  const double past_s = data->time - s.begin_s;
  if (past_s >= s.shove.lasts_s) {
    shoved.reset();
    return;
  }
  const Profile at = profile(past_s / s.shove.lasts_s, s.shove.lasts_s);
  const mjtNum* q = data->qpos + base_qpos;
  const mjtNum* v = data->qvel + base_qvel;
  const auto pull = [&](double total, double began_mps, double way, double speed) {
    const double way_error = began_mps * past_s + total * at.way - way;
    const double speed_error = began_mps + total * at.rate - speed;
    return total * at.acceleration + kHold_radps * (kHold_radps * way_error + 2 * speed_error);
  };
  const double dx = q[0] - s.start[0];
  const double dy = q[1] - s.start[1];
  const auto& [c, n] = s.ahead;
  double ahead_N = 0;
  double left_N = 0;
  if (s.shove.ahead_m != 0)
    ahead_N = s.mass_kg * pull(s.shove.ahead_m, s.speed[0], c * dx + n * dy, c * v[0] + n * v[1]);
  if (s.shove.left_m != 0)
    left_N = s.mass_kg * pull(s.shove.left_m, s.speed[1], c * dy - n * dx, c * v[1] - n * v[0]);
  const double yaw_rad = std::atan2(rotation()[3], rotation()[0]);
  const double turned_rad = wrap_rad(yaw_rad - s.start[2]);
  mjtNum* force = data->xfrc_applied + 6 * base;
  force[0] += c * ahead_N - n * left_N;
  force[1] += n * ahead_N + c * left_N;
  force[5] += s.inertia_kgm2 * pull(s.shove.turn_rad, s.speed[2], turned_rad, v[5]);
}

}  // namespace drover::sim
