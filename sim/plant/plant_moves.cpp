// What is done to the robot from outside: put down, shoved, pushed, carried, held by its brakes.
#include <algorithm>
#include <array>
#include <cmath>

#include "sim/plant/plant_impl.h"

namespace drover::sim {
namespace {

// Wheels on one axle, or in one line, say nothing about the slope across it.
double slope(double sum_hx, double sum_xx) {
  return sum_xx > 1e-9 ? sum_hx / sum_xx : 0;
}

}  // namespace

// A plane through the ground under what the robot stands on.
Footing Plant::Impl::footing(double x_m, double y_m, double yaw_rad) const {
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  const auto count = static_cast<double>(feet_m.size());
  double mean_h = 0, mean_x = 0, mean_y = 0;
  for (const auto& foot : feet_m) {
    mean_h += ground_m(x_m + c * foot[0] - s * foot[1], y_m + s * foot[0] + c * foot[1]) / count;
    mean_x += foot[0] / count;
    mean_y += foot[1] / count;
  }
  double sum_hx = 0, sum_hy = 0, sum_xx = 0, sum_yy = 0;
  for (const auto& foot : feet_m) {
    const double h =
        ground_m(x_m + c * foot[0] - s * foot[1], y_m + s * foot[0] + c * foot[1]) - mean_h;
    sum_hx += h * (foot[0] - mean_x);
    sum_hy += h * (foot[1] - mean_y);
    sum_xx += (foot[0] - mean_x) * (foot[0] - mean_x);
    sum_yy += (foot[1] - mean_y) * (foot[1] - mean_y);
  }
  const double slope_x = slope(sum_hx, sum_xx);
  const double slope_y = slope(sum_hy, sum_yy);
  Footing footing;
  footing.pitch_rad = -std::atan(slope_x);
  footing.roll_rad = std::atan(slope_y);
  footing.z_m = mean_h - slope_x * mean_x - slope_y * mean_y +
                radius_m / (std::cos(footing.pitch_rad) * std::cos(footing.roll_rad));
  return footing;
}

void Plant::Impl::set_pose(double x_m, double y_m, double yaw_rad) {
  const Footing at = footing(x_m, y_m, yaw_rad);
  mjtNum* q = data->qpos + base_qpos;
  q[0] = x_m;
  q[1] = y_m;
  q[2] = at.z_m;
  const double cy = std::cos(yaw_rad / 2), sy = std::sin(yaw_rad / 2);
  const double cp = std::cos(at.pitch_rad / 2), sp = std::sin(at.pitch_rad / 2);
  const double cr = std::cos(at.roll_rad / 2), sr = std::sin(at.roll_rad / 2);
  q[3] = cr * cp * cy + sr * sp * sy;
  q[4] = sr * cp * cy - cr * sp * sy;
  q[5] = cr * sp * cy + sr * cp * sy;
  q[6] = cr * cp * sy - sr * sp * cy;
}

void Plant::place(double x_m, double y_m, double yaw_rad) {
  const mjModel& m = *impl_->model;
  mjData& d = *impl_->data;
  // Obstacles stay where a scenario has put them.
  const std::vector<mjtNum> mocap(d.mocap_pos, d.mocap_pos + 3 * m.nmocap);
  const std::vector<mjtNum> turned(d.mocap_quat, d.mocap_quat + 4 * m.nmocap);
  mj_resetData(&m, &d);
  std::copy(mocap.begin(), mocap.end(), d.mocap_pos);
  std::copy(turned.begin(), turned.end(), d.mocap_quat);
  mj_kinematics(&m, &d);
  for (auto& wheel : impl_->wheels) wheel.tyre.reset();
  impl_->carried.reset();
  impl_->shoved.reset();
  impl_->push_N = {};
  impl_->tip_push_N = {};
  // The model's own pose is level, so the feet need not be turned.
  impl_->feet_m.clear();
  for (const int geom : impl_->feet) {
    const mjtNum* at = d.geom_xpos + 3 * geom;
    const mjtNum* base = d.xpos + 3 * impl_->base;
    impl_->feet_m.push_back({at[0] - base[0], at[1] - base[1]});
  }
  impl_->set_pose(x_m, y_m, yaw_rad);
  mj_forward(&m, &d);
}

void Plant::kick(double vx_mps, double vy_mps) {
  const mjtNum* r = impl_->rotation();
  mjtNum* v = impl_->data->qvel + impl_->base_qvel;
  for (int i = 0; i < 3; ++i) v[i] += r[3 * i] * vx_mps + r[3 * i + 1] * vy_mps;
}

void Plant::push(double ahead_N, double left_N) {
  impl_->push_N = {ahead_N, left_N, 0};
}

void Plant::Impl::push() {
  mjtNum* force = data->xfrc_applied + 6 * base;
  mju_mulMatVec(force, rotation(), push_N.data(), 3, 3);
  mju_zero(force + 3, 3);  // a shove that is over turns nothing
}

bool Plant::push_tip(const Vector& force_N) {
  impl_->tip_push_N = {force_N.x, force_N.y, force_N.z};
  return impl_->tip >= 0;
}

// MuJoCo takes a force at a body's centre of mass, and what it turns beside.
void Plant::Impl::push_tip() {
  if (tip < 0) return;
  const int body = model->site_bodyid[tip];
  mjtNum* force = data->xfrc_applied + 6 * body;
  std::array<mjtNum, 3> arm{};
  mju_sub3(arm.data(), data->site_xpos + 3 * tip, data->xipos + 3 * body);
  mju_copy3(force, tip_push_N.data());
  mju_cross(force + 3, arm.data(), tip_push_N.data());
}

void Plant::carry(const std::optional<CarrySpeed>& speed) {
  if (impl_->carried && !speed) mju_zero(impl_->data->qvel, impl_->model->nv);
  impl_->carried = speed;
}

// The wheels stand on what carries them: nothing turns, and the ground pulls at nothing.
void Plant::Impl::carry() {
  const double dt_s = model->opt.timestep;
  mjtNum* q = data->qpos + base_qpos;
  std::array<mjtNum, 9> r{};
  mju_quat2Mat(r.data(), q + 3);
  const double yaw_rad = std::atan2(r[3], r[0]);
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  const std::array<double, 3> before{q[0], q[1], q[2]};
  set_pose(q[0] + dt_s * (c * carried->vx_mps - s * carried->vy_mps),
           q[1] + dt_s * (s * carried->vx_mps + c * carried->vy_mps),
           yaw_rad + dt_s * carried->wz_radps);
  mju_zero(data->qvel, model->nv);
  mjtNum* v = data->qvel + base_qvel;
  for (std::size_t i = 0; i < 3; ++i) v[i] = (q[i] - before[i]) / dt_s;
  v[5] = carried->wz_radps;
  for (auto& wheel : wheels) {
    wheel.tyre.reset();
    mju_zero(data->xfrc_applied + 6 * wheel.body, 6);
  }
  mju_zero(data->xfrc_applied + 6 * base, 6);
  data->time += dt_s;
  mj_forward(model.get(), data.get());
}

Friction Plant::Impl::friction(std::size_t joint) const {
  const int dof = model->jnt_dofadr[joint_ids[joint]];
  Friction friction{model->dof_frictionloss[dof], {}, {}};
  mju_copy(friction.reference.data(), model->dof_solref + mjNREF * dof, mjNREF);
  mju_copy(friction.impedance.data(), model->dof_solimp + mjNIMP * dof, mjNIMP);
  return friction;
}

void Plant::Impl::set_friction(std::size_t joint, const Friction& friction) {
  const int dof = model->jnt_dofadr[joint_ids[joint]];
  model->dof_frictionloss[dof] = friction.torque_Nm;
  mju_copy(model->dof_solref + mjNREF * dof, friction.reference.data(), mjNREF);
  mju_copy(model->dof_solimp + mjNIMP * dof, friction.impedance.data(), mjNIMP);
}

// A brake is dry friction. The solver lets friction creep under a load unless it insists: as the
// model has it, a brake would give way by some millimetres a second on a slope.
void Plant::set_holding_torque(std::size_t joint, double torque_Nm) {
  Friction friction = impl_->free_friction[joint];
  if (torque_Nm > 0) {
    friction.torque_Nm += torque_Nm;
    friction.reference[0] = 2 * impl_->model->opt.timestep;
    friction.impedance[0] = friction.impedance[1] = 0.9999;
  }
  impl_->set_friction(joint, friction);
}

}  // namespace drover::sim
