// What can be read from the plant: poses, velocities, contacts and the free distance ahead.
#include <array>
#include <cmath>

#include "drover/angle.h"
#include "drover/fixed_vector.h"
#include "sim/plant/plant_impl.h"
#include "sim/plant/zones.h"

namespace drover::sim {
namespace {

constexpr double kScannerTop_m = 1.0;  // a box wholly above this, from axle height, is not seen

}  // namespace

WheelState Plant::wheel(std::size_t joint) const {
  const mjModel& m = *impl_->model;
  const int id = impl_->joint_ids[joint];
  return {impl_->data->qpos[m.jnt_qposadr[id]], impl_->data->qvel[m.jnt_dofadr[id]]};
}

std::optional<Plant::Vector> Plant::tip_m() const {
  if (impl_->tip < 0) return std::nullopt;
  const mjtNum* at = impl_->data->site_xpos + 3 * impl_->tip;
  return Vector{at[0], at[1], at[2]};
}

BasePose Plant::pose() const {
  const mjtNum* p = impl_->data->qpos + impl_->base_qpos;
  std::array<mjtNum, 9> r{};
  mju_quat2Mat(r.data(), p + 3);
  BasePose pose;
  pose.x_m = p[0];
  pose.y_m = p[1];
  pose.z_m = p[2];
  pose.roll_rad = std::atan2(r[7], r[8]);
  pose.pitch_rad = std::atan2(-r[6], std::hypot(r[7], r[8]));
  pose.yaw_rad = wrap_rad(std::atan2(r[3], r[0]));
  return pose;
}

BaseVelocity Plant::velocity() const {
  const mjtNum* p = impl_->data->qpos + impl_->base_qpos;
  const mjtNum* v = impl_->data->qvel + impl_->base_qvel;
  std::array<mjtNum, 9> r{};
  mju_quat2Mat(r.data(), p + 3);
  BaseVelocity out;
  out.vx_mps = r[0] * v[0] + r[3] * v[1] + r[6] * v[2];
  out.vy_mps = r[1] * v[0] + r[4] * v[1] + r[7] * v[2];
  out.vz_mps = r[2] * v[0] + r[5] * v[1] + r[8] * v[2];
  out.wx_radps = v[3];
  out.wy_radps = v[4];
  out.wz_radps = v[5];
  return out;
}

Plant::Vector Plant::point_m(const Vector& in_base_m) const {
  const mjtNum* p = impl_->data->qpos + impl_->base_qpos;
  const std::array<mjtNum, 3> arm{in_base_m.x, in_base_m.y, in_base_m.z};
  std::array<mjtNum, 3> turned{};
  mju_rotVecQuat(turned.data(), arm.data(), p + 3);
  return {p[0] + turned[0], p[1] + turned[1], p[2] + turned[2]};
}

Plant::Vector Plant::point_velocity_mps(const Vector& in_base_m) const {
  const mjtNum* p = impl_->data->qpos + impl_->base_qpos;
  const mjtNum* v = impl_->data->qvel + impl_->base_qvel;
  const std::array<mjtNum, 3> arm{in_base_m.x, in_base_m.y, in_base_m.z};
  std::array<mjtNum, 3> spin{};
  std::array<mjtNum, 3> turned{};
  mju_cross(spin.data(), v + 3, arm.data());
  mju_rotVecQuat(turned.data(), spin.data(), p + 3);
  return {v[0] + turned[0], v[1] + turned[1], v[2] + turned[2]};
}

Quaternion Plant::orientation() const {
  const mjtNum* q = impl_->data->qpos + impl_->base_qpos + 3;
  return {q[0], q[1], q[2], q[3]};
}

Plant::Vector Plant::in_base_axes(const Vector& in_world) const {
  const mjtNum* q = impl_->data->qpos + impl_->base_qpos + 3;
  const std::array<mjtNum, 3> from{in_world.x, in_world.y, in_world.z};
  std::array<mjtNum, 4> back{};
  std::array<mjtNum, 3> turned{};
  mju_negQuat(back.data(), q);
  mju_rotVecQuat(turned.data(), from.data(), back.data());
  return {turned[0], turned[1], turned[2]};
}

bool Plant::bumper_touched() const {
  const mjData& d = *impl_->data;
  for (int i = 0; i < d.ncon; ++i)
    if (d.contact[i].geom1 == impl_->bumper || d.contact[i].geom2 == impl_->bumper) return true;
  return false;
}

double Plant::free_distance_m(double width_m) const {
  const mjModel& m = *impl_->model;
  const mjData& d = *impl_->data;
  const BasePose base = pose();
  const double c = std::cos(base.yaw_rad);
  const double s = std::sin(base.yaw_rad);
  FixedVector<Footprint, kMaxBoxes> boxes;
  for (const int geom : impl_->boxes) {
    const mjtNum* at = d.geom_xpos + 3 * geom;
    const mjtNum* size = m.geom_size + 3 * geom;
    const double bottom_m = at[2] - size[2] - base.z_m;
    if (bottom_m > kScannerTop_m || at[2] + size[2] < base.z_m) continue;
    const mjtNum* r = d.geom_xmat + 9 * geom;
    const double dx = at[0] - base.x_m;
    const double dy = at[1] - base.y_m;
    (void)boxes.push_back({c * dx + s * dy, -s * dx + c * dy, std::atan2(r[3], r[0]) - base.yaw_rad,
                           size[0], size[1]});
  }
  return sim::free_distance_m(std::span<const Footprint>(boxes.data(), boxes.size()),
                              impl_->front_m, width_m);
}

}  // namespace drover::sim
