// What the ground does that a level, firm one does not: it gives way, slides, and tilts.
#include <cmath>
#include <string_view>

#include "sim/plant/plant_impl.h"

namespace drover::sim {

void Plant::set_slip(std::size_t joint, double share) {
  impl_->wheels[joint].slip = share;
}

bool Plant::is_left(std::size_t joint) const {
  return impl_->model->body_pos[3 * impl_->wheels[joint].body + 1] > 0;
}

void Plant::set_sideslip(double share, double direction_rad) {
  impl_->slides = {share * std::cos(direction_rad), share * std::sin(direction_rad), 0};
}

// Each part of it is turned about its own x, by the share of the tilt that its body's user number
// tells: the slope begins and ends in steps.
bool Plant::set_side_slope(double tilt_rad) {
  const mjModel& m = *impl_->model;
  constexpr std::string_view kName = "side_slope";
  bool found = false;
  for (int body = 0; body < m.nbody; ++body) {
    const char* name = mj_id2name(&m, mjOBJ_BODY, body);
    if (name == nullptr || !std::string_view(name).starts_with(kName)) continue;
    const int mocap = m.body_mocapid[body];
    if (mocap < 0 || m.nuser_body < 1) continue;
    const double part_rad = tilt_rad * m.body_user[m.nuser_body * body];
    mjtNum* turned = impl_->data->mocap_quat + 4 * mocap;
    turned[0] = std::cos(part_rad / 2);
    turned[1] = std::sin(part_rad / 2);
    turned[2] = turned[3] = 0;
    found = true;
  }
  if (found) mj_kinematics(&m, impl_->data.get());
  return found;
}

}  // namespace drover::sim
