// Loading and stepping. Names are looked up once; a step allocates nothing.
#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "drover/angle.h"
#include "sim/plant/plant_impl.h"

namespace drover::sim {
namespace {

constexpr int kTerrainGroup = 0;
constexpr int kArmGroup = 1;  // of motors that turn no wheel
constexpr int kTerrainBit = 1;
constexpr int kObstacleBit = 2;
constexpr double kParked_m = -20;  // an obstacle that is not there

std::string name_of(const mjModel& model, int type, int id) {
  const char* name = mj_id2name(&model, type, id);
  return name == nullptr ? "" : name;
}

int need(const mjModel& model, int type, const char* name, const std::string& file) {
  const int id = mj_name2id(&model, type, name);
  if (id < 0) throw std::runtime_error(file + ": the world has no '" + name + "'");
  return id;
}

// MuJoCo ends the process when its arena is too small or the state is not a number; an exception
// carries the reason to the simulator's one place for errors.
void throw_error(const char* text) {
  throw std::runtime_error(std::string("MuJoCo: ") + text);
}

}  // namespace

int Plant::Impl::mocap(std::string_view name) const {
  const int body = mj_name2id(model.get(), mjOBJ_BODY, std::string(name).c_str());
  return body < 0 ? -1 : model->body_mocapid[body];
}

double Plant::Impl::ground_m(double x_m, double y_m) const {
  const std::array<mjtNum, 3> from{x_m, y_m, 50};
  const std::array<mjtNum, 3> down{0, 0, -1};
  std::array<mjtByte, mjNGROUP> groups{};
  groups[kTerrainGroup] = 1;
  int geom = -1;
  const double distance_m =
      mj_ray(model.get(), data.get(), from.data(), down.data(), groups.data(), 1, -1, &geom);
  return distance_m < 0 ? 0 : from[2] - distance_m;
}

bool Plant::Impl::set_mocap(std::string_view name, double x_m, double y_m, double z_m) {
  const int id = mocap(name);
  if (id < 0) return false;
  mjtNum* at = data->mocap_pos + 3 * id;
  at[0] = x_m;
  at[1] = y_m;
  at[2] = z_m;
  mj_kinematics(model.get(), data.get());
  return true;
}

Plant::Plant(const std::string& world_file) : impl_(std::make_unique<Impl>()) {
  mju_user_error = throw_error;
  if (!std::filesystem::exists(world_file))
    throw std::runtime_error(world_file + ": there is no such world");
  std::array<char, 1000> error{};
  impl_->model.reset(mj_loadXML(world_file.c_str(), nullptr, error.data(), error.size()));
  if (!impl_->model) throw std::runtime_error(world_file + ": " + error.data());
  const mjModel& m = *impl_->model;
  impl_->data.reset(mj_makeData(&m));
  impl_->objects.emplace(m);
  impl_->touches.reserve(kMaxBoxes);
  impl_->base = need(m, mjOBJ_BODY, "base", world_file);
  const int free_joint = need(m, mjOBJ_JOINT, "base", world_file);
  impl_->base_qpos = m.jnt_qposadr[free_joint];
  impl_->base_qvel = m.jnt_dofadr[free_joint];
  impl_->bumper = mj_name2id(&m, mjOBJ_GEOM, "bumper");
  if (impl_->bumper >= 0)
    impl_->front_m = m.geom_pos[3 * impl_->bumper] + m.geom_size[3 * impl_->bumper];
  impl_->tip = mj_name2id(&m, mjOBJ_SITE, "tip");
  for (int i = 0; i < m.nu; ++i) {
    impl_->joint_ids.push_back(m.actuator_trnid[2 * i]);
    impl_->joints.push_back(name_of(m, mjOBJ_JOINT, m.actuator_trnid[2 * i]));
    const int hinge = m.actuator_trnid[2 * i];
    const double roller_deg = m.nuser_jnt < 1 ? 0.0 : m.jnt_user[m.nuser_jnt * hinge];
    impl_->wheels.push_back({m.jnt_bodyid[hinge], -1, Tyre{}, to_rad(roller_deg), 0});
    impl_->free_friction.push_back(impl_->friction(impl_->joint_ids.size() - 1));
  }
  for (int geom = 0; geom < m.ngeom; ++geom) {
    const bool of_robot = m.body_rootid[m.geom_bodyid[geom]] == impl_->base;
    if (of_robot && (m.geom_contype[geom] & kTerrainBit) != 0) impl_->feet.push_back(geom);
    for (auto& wheel : impl_->wheels) {
      if (wheel.body != m.geom_bodyid[geom] || (m.geom_contype[geom] & kTerrainBit) == 0) continue;
      wheel.contact_geom = geom;
      impl_->radius_m = m.geom_size[3 * geom];
    }
    const bool solid = (m.geom_contype[geom] & kObstacleBit) != 0;
    if (of_robot && solid) impl_->body_geoms.push_back(geom);
    // The scanner's zones do not see what a scenario puts there: only who is told of it knows it.
    if (!of_robot && solid && m.geom_type[geom] == mjGEOM_BOX && !impl_->objects->owns(geom))
      impl_->boxes.push_back(geom);
  }
  bool drives = false;
  for (std::size_t i = 0; i < impl_->wheels.size(); ++i) {
    if (m.actuator_group[i] == kArmGroup) continue;
    drives = true;
    if (impl_->wheels[i].contact_geom < 0)
      throw std::runtime_error(world_file + ": the wheel of joint '" + impl_->joints[i] +
                               "' has no sphere with contype 1 that touches the ground; when it is "
                               "a joint of an arm, its motor is of group 1");
  }
  if (!drives) throw std::runtime_error(world_file + ": no motor turns a wheel");
  if (impl_->boxes.size() > kMaxBoxes)
    throw std::runtime_error(world_file + ": more than 64 obstacle boxes");
  place(0, 0, 0);
}

Plant::~Plant() = default;
Plant::Plant(Plant&&) noexcept = default;
Plant& Plant::operator=(Plant&&) noexcept = default;

double Plant::timestep_s() const {
  return impl_->model->opt.timestep;
}
double Plant::time_s() const {
  return impl_->data->time;
}
const std::vector<std::string>& Plant::joints() const {
  return impl_->joints;
}

std::size_t Plant::joint(std::string_view name) const {
  std::string known;
  for (std::size_t i = 0; i < impl_->joints.size(); ++i) {
    if (impl_->joints[i] == name) return i;
    known += (known.empty() ? "" : ", ") + impl_->joints[i];
  }
  throw std::runtime_error("no joint '" + std::string(name) + "' in the world; it has " + known);
}

bool Plant::is_wheel(std::size_t joint) const {
  return impl_->wheels[joint].contact_geom >= 0;
}

void Plant::set_torque(std::size_t joint, double torque_Nm) {
  impl_->data->ctrl[joint] = std::isfinite(torque_Nm) ? torque_Nm : 0;
}

// The contacts are those of the step before: one step late, as every force here is.
void Plant::Impl::pull_tyre(Wheel& wheel) {
  const mjModel& m = *model;
  mjData& d = *data;
  std::array<mjtNum, 3> up{};  // the normals, weighted by their loads
  double load_N = 0;
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& contact = d.contact[i];
    const bool second = contact.geom2 == wheel.contact_geom;
    if ((!second && contact.geom1 != wheel.contact_geom) || contact.efc_address < 0) continue;
    std::array<mjtNum, 6> force{};
    mj_contactForce(&m, &d, i, force.data());
    load_N += force[0];
    mju_addToScl3(up.data(), contact.frame, second ? force[0] : -force[0]);
  }
  mjtNum* push = d.xfrc_applied + 6 * wheel.body;
  mju_zero(push, 6);
  if (!(load_N > 0) || mju_normalize3(up.data()) < mjMINVAL) {
    wheel.tyre.reset();
    return;
  }
  const mjtNum* r = d.xmat + 9 * wheel.body;
  const std::array<mjtNum, 3> axle{r[1], r[4], r[7]};
  std::array<mjtNum, 3> ahead{}, left{}, arm{}, rim{};
  mju_cross(ahead.data(), axle.data(), up.data());
  mju_normalize3(ahead.data());
  mju_cross(left.data(), up.data(), ahead.data());
  mju_scl3(arm.data(), up.data(), -radius_m);
  std::array<mjtNum, 6> hub{};  // angular, then linear
  mj_objectVelocity(&m, &d, mjOBJ_XBODY, wheel.body, hub.data(), 0);
  mju_cross(rim.data(), hub.data(), arm.data());
  mju_addTo3(rim.data(), hub.data() + 3);
  const mjtNum hub_mps = mju_dot3(hub.data() + 3, ahead.data());
  const mjtNum rim_mps = mju_dot3(rim.data(), ahead.data());
  // What the ground under it does: it gives way against the rolling, and slides.
  const mjtNum rolled_mps = hub_mps - rim_mps;
  std::array<mjtNum, 3> ground{};
  mju_scl3(ground.data(), slides.data(), std::abs(hub_mps));
  mju_addToScl3(ground.data(), ahead.data(), -wheel.slip * rolled_mps);
  const double slip_ahead_mps = rim_mps - mju_dot3(ground.data(), ahead.data());
  const double slip_left_mps =
      mju_dot3(rim.data(), left.data()) - mju_dot3(ground.data(), left.data());
  const auto grip =
      wheel.roller_rad != 0
          ? wheel.tyre.step_roller(wheel.roller_rad, slip_ahead_mps, slip_left_mps, rolled_mps,
                                   load_N, m.opt.timestep)
          : wheel.tyre.step(slip_ahead_mps, slip_left_mps, hub_mps, load_N, m.opt.timestep);
  mju_addToScl3(push, ahead.data(), grip.ahead_N);
  mju_addToScl3(push, left.data(), grip.left_N);
  mju_cross(push + 3, arm.data(), push);
}

void Plant::step() {
  impl_->objects->advance(*impl_->data, impl_->model->opt.timestep);
  if (impl_->carried) {
    impl_->carry();
  } else {
    impl_->push();
    impl_->push_tip();
    impl_->shove();
    for (auto& wheel : impl_->wheels)
      if (wheel.contact_geom >= 0) impl_->pull_tyre(wheel);
    mj_step(impl_->model.get(), impl_->data.get());
  }
  impl_->feel();
}

bool Plant::set_obstacle(std::string_view name, double x_m, double y_m) {
  return impl_->set_mocap(name, x_m, y_m, impl_->ground_m(x_m, y_m));
}

bool Plant::remove_obstacle(std::string_view name) {
  return impl_->set_mocap(name, 0, 0, kParked_m);
}

}  // namespace drover::sim
