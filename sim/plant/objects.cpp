#include "sim/plant/objects.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace drover::sim {
namespace {

constexpr double kBelow_m = -20;
constexpr int kRing = 16;  // corners of a convex body's mesh, below and above

bool is_convex_kind(Solid::Kind kind) {
  return kind == Solid::Kind::cone || kind == Solid::Kind::prism;
}

/// Corner `i` of the ring: of a polygon with fewer corners the last one counts several times.
std::array<double, 2> ring_corner(const Solid& solid, int i) {
  if (solid.kind == Solid::Kind::prism)
    return solid.corners_m[std::min(static_cast<std::size_t>(i), solid.corners_m.size() - 1)];
  const double angle_rad = 2 * mjPI * i / kRing;
  return {solid.radius_m * std::cos(angle_rad), solid.radius_m * std::sin(angle_rad)};
}

}  // namespace

Objects::Objects(const mjModel& model) {
  for (int body = 0; body < model.nbody; ++body) {
    const char* name = mj_id2name(&model, mjOBJ_BODY, body);
    const std::string_view text = name == nullptr ? "" : name;
    const bool convex = text.starts_with("convex_");
    if (!convex && !text.starts_with("object_")) continue;
    if (model.body_mocapid[body] < 0 || model.body_geomnum[body] != 1) continue;
    Slot slot;
    slot.geom = model.body_geomadr[body];
    slot.mocap = model.body_mocapid[body];
    if (convex) slot.mesh = model.geom_dataid[slot.geom];
    if (convex && (slot.mesh < 0 || model.mesh_vertnum[slot.mesh] != 2 * kRing)) continue;
    slots_.push_back(slot);
  }
}

const Objects::Slot* Objects::find(std::string_view name) const {
  const auto it = std::find_if(slots_.begin(), slots_.end(),
                               [name](const Slot& slot) { return slot.name == name; });
  return name.empty() || it == slots_.end() ? nullptr : &*it;
}

const Objects::Slot* Objects::slot_of(int geom) const {
  const auto it = std::find_if(slots_.begin(), slots_.end(),
                               [geom](const Slot& slot) { return slot.geom == geom; });
  return it == slots_.end() ? nullptr : &*it;
}

std::string_view Objects::name_of(int geom) const {
  const auto* const slot = slot_of(geom);
  return slot == nullptr ? std::string_view() : std::string_view(slot->name);
}

Objects::Slot* Objects::free_slot(bool convex) {
  const auto it = std::find_if(slots_.begin(), slots_.end(), [convex](const Slot& slot) {
    return slot.name.empty() && (slot.mesh >= 0) == convex;
  });
  return it == slots_.end() ? nullptr : &*it;
}

std::string Objects::put(mjModel& model, mjData& data, std::string_view name, const Solid& solid) {
  if (name.empty()) return "it has no name";
  if (auto problem = problem_of(solid); !problem.empty()) return problem;
  if (auto* const old = find(name); old != nullptr) park(data, *old);
  auto* const slot = free_slot(is_convex_kind(solid.kind));
  if (slot == nullptr)
    return slots_.empty() ? "this world has no bodies for it (objects.xml)"
                          : "all bodies of the world are in use";
  slot->name = name;
  slot->solid = solid;
  shape(model, *slot);
  show(data, *slot);
  mj_kinematics(&model, &data);
  return "";
}

bool Objects::move(std::string_view name, double x_m, double y_m, double speed_mps) {
  auto* const slot = find(name);
  if (slot == nullptr) return false;
  slot->journey = Journey{x_m, y_m, speed_mps};
  return true;
}

bool Objects::remove(mjData& data, std::string_view name) {
  auto* const slot = find(name);
  if (slot == nullptr) return false;
  park(data, *slot);
  return true;
}

void Objects::advance(mjData& data, double dt_s) {
  for (auto& slot : slots_) {
    if (!slot.journey) continue;
    const double dx_m = slot.journey->x_m - slot.solid.x_m;
    const double dy_m = slot.journey->y_m - slot.solid.y_m;
    const double left_m = std::hypot(dx_m, dy_m);
    const double step_m = slot.journey->speed_mps * dt_s;
    if (left_m <= step_m) {
      slot.solid.x_m = slot.journey->x_m;
      slot.solid.y_m = slot.journey->y_m;
      slot.journey.reset();
    } else {
      slot.solid.x_m += dx_m / left_m * step_m;
      slot.solid.y_m += dy_m / left_m * step_m;
    }
    show(data, slot);
  }
}

std::vector<Objects::Placed> Objects::placed() const {
  std::vector<Placed> placed;
  for (const auto& slot : slots_)
    if (!slot.name.empty()) placed.push_back({slot.name, slot.solid, slot.journey.has_value()});
  return placed;
}

void Objects::shape(mjModel& model, const Slot& slot) {
  const Solid& solid = slot.solid;
  mjtNum* size = model.geom_size + 3 * slot.geom;
  switch (solid.kind) {
    case Solid::Kind::box:
      model.geom_type[slot.geom] = mjGEOM_BOX;
      size[0] = solid.length_m / 2;
      size[1] = solid.width_m / 2;
      size[2] = solid.height_m / 2;
      model.geom_rbound[slot.geom] = mju_norm3(size);
      return;
    case Solid::Kind::cylinder:
      model.geom_type[slot.geom] = mjGEOM_CYLINDER;
      size[0] = solid.radius_m;
      size[1] = solid.height_m / 2;
      size[2] = 0;
      model.geom_rbound[slot.geom] = std::hypot(size[0], size[1]);
      return;
    case Solid::Kind::sphere:
      model.geom_type[slot.geom] = mjGEOM_SPHERE;
      size[0] = solid.radius_m;
      size[1] = size[2] = 0;
      model.geom_rbound[slot.geom] = solid.radius_m;
      return;
    case Solid::Kind::cone:
    case Solid::Kind::prism: return shape_mesh(model, slot);
  }
}

// The mesh's own place in its body and the graph of its corners were those of the world's file:
// the one becomes none, and without the other MuJoCo looks at every corner.
void Objects::shape_mesh(mjModel& model, const Slot& slot) {
  const Solid& solid = slot.solid;
  float* const corners = model.mesh_vert + 3 * model.mesh_vertadr[slot.mesh];
  double farthest_m = 0;
  for (int i = 0; i < 2 * kRing; ++i) {
    const bool above = i >= kRing;
    const double share = above && solid.kind == Solid::Kind::cone ? 0 : 1;
    const auto corner = ring_corner(solid, i % kRing);
    corners[3 * i] = static_cast<float>(share * corner[0]);
    corners[3 * i + 1] = static_cast<float>(share * corner[1]);
    corners[3 * i + 2] = static_cast<float>((above ? 0.5 : -0.5) * solid.height_m);
    farthest_m = std::max(farthest_m, std::hypot(corner[0], corner[1], solid.height_m / 2));
  }
  model.mesh_graphadr[slot.mesh] = -1;
  model.geom_sameframe[slot.geom] = 0;
  mju_zero3(model.geom_pos + 3 * slot.geom);
  mju_unit4(model.geom_quat + 4 * slot.geom);
  model.geom_rbound[slot.geom] = farthest_m;
}

void Objects::show(mjData& data, const Slot& slot) {
  const std::array<mjtNum, 3> up{0, 0, 1};
  mju_copy3(data.mocap_pos + 3 * slot.mocap,
            std::array<mjtNum, 3>{slot.solid.x_m, slot.solid.y_m, slot.solid.z_m}.data());
  mju_axisAngle2Quat(data.mocap_quat + 4 * slot.mocap, up.data(), slot.solid.yaw_rad);
}

void Objects::park(mjData& data, Slot& slot) {
  slot.name.clear();
  slot.journey.reset();
  mju_copy3(data.mocap_pos + 3 * slot.mocap, std::array<mjtNum, 3>{0, 0, kBelow_m}.data());
}

}  // namespace drover::sim
