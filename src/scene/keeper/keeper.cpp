// Messages, zones and the store: what is around.
#include "scene/keeper/keeper.h"

#include <algorithm>
#include <utility>

#include "scene/constraint/kinds.h"
#include "scene/keeper/keeper_impl.h"
#include "scene/message/check.h"
#include "scene/message/split.h"
#include "scene/world/map_change.h"
#include "scene/world/words.h"
#include "scene/zone/zone_areas.h"

namespace drover::scene {
namespace {

template <class Shape>
void add_areas(const std::vector<Placed<Shape>>& shapes, std::size_t first, Heights heights,
               std::vector<Area>& areas) {
  for (std::size_t i = first; i < shapes.size(); ++i)
    areas.push_back(area_of(shapes[i].shape, shapes[i].in_map, heights));
}

/// The object's shapes but for the first ones of each kind.
struct From {
  std::size_t primitive = 0;
  std::size_t mesh = 0;
  std::size_t plane = 0;
};
std::vector<Area> areas_of(const Object& object, const From& from, Heights heights) {
  std::vector<Area> areas;
  add_areas(object.primitives, from.primitive, heights, areas);
  add_areas(object.meshes, from.mesh, heights, areas);
  add_areas(object.planes, from.plane, heights, areas);
  return areas;
}

/// Where height is not looked at a plane may be another thing than it seems.
void note_planes(const Object& object, std::size_t first, std::vector<std::string>& notes) {
  for (std::size_t i = first; i < object.planes.size(); ++i) {
    const auto& [plane, arrived, in_map] = object.planes[i];
    const PlaneLies lies = how_it_lies(plane, in_map);
    if (lies == PlaneLies::upright) continue;
    const std::string path = "planes[" + std::to_string(i - first) + "]: ";
    notes.push_back(path + (lies == PlaneLies::level
                                ? "nearly level: as heights are not looked at, it blocks nothing"
                                : "neither upright nor level: as heights are not looked at, it "
                                  "blocks everything"));
  }
}

void note_never(const std::string& list, std::size_t i, std::string_view field, const char* what,
                const std::string& name, std::vector<std::string>& notes) {
  check::note(
      notes, check::member(check::element(list, i), field),
      std::string("the robot has no ") + what + " " + words::quoted(name) + ": it never holds");
}

template <class Constraint>
void note_links(const std::vector<Constraint>& constraints, const std::string& list,
                const RobotModel& robot, std::vector<std::string>& notes) {
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const std::string& link = constraints[i].link_name;
    if (!link_on_base(robot, link)) note_never(list, i, "link_name", "link", link, notes);
  }
}

/// It is valid, and stops the robot until it is taken away: mostly a name that was mistyped.
void note_strangers(const Constraints& set, const KeeperSettings& settings,
                    std::vector<std::string>& notes) {
  for (std::size_t i = 0; i < set.joint_constraints.size(); ++i) {
    const JointConstraint& joint = set.joint_constraints[i];
    const auto& own = settings.joints;
    if (is_of_base(joint) || std::find(own.begin(), own.end(), joint.joint_name) != own.end())
      continue;
    note_never("joint_constraints", i, "joint_name", "joint", joint.joint_name, notes);
  }
  note_links(set.position_constraints, "position_constraints", settings.robot, notes);
  note_links(set.orientation_constraints, "orientation_constraints", settings.robot, notes);
}

}  // namespace

void Keeper::Impl::change() {
  find_problem();
  around.constrained = !world.constraints().empty();
  ++around.number;
}

void Keeper::Impl::find_problem() {
  around.problem.clear();
  const bool is_placed = !zones.empty() || !world.objects().empty() || !world.constraints().empty();
  if (!zones_told) {
    around.problem = "the zones were not read yet";
  } else if (!zones_problem.empty()) {
    around.problem.assign(zones_problem);
  } else if (!scene_told) {
    around.problem = "the scene was not read yet";
  } else if (!scene_problem.empty()) {
    around.problem.assign(scene_problem);
  } else if (origin_is_bad) {
    around.problem = "the origin of the map is no place on earth";
  } else if (is_placed && !world.origin()) {
    around.problem = "the map has no origin yet: zones and objects have no place in it";
  }
}

double Keeper::Impl::place_sigma_m(std::string_view id) const {
  const Object* object = world.object(id);
  return object == nullptr ? 0 : object->place_sigma_m;
}

Area Keeper::Impl::with_error(Area area, double place_sigma_m) const {
  return widened(std::move(area), settings.look.sigmas * place_sigma_m);
}

void Keeper::Impl::on_object(const CollisionObject& message, double sigma_before_m,
                             Applied& applied) {
  changed_objects.insert(message.id);
  const Object* object = world.object(message.id);
  if (object == nullptr) {
    around.field.remove(message.id);
    return change();
  }
  From from;
  std::vector<Area> areas;
  const Area* there = around.field.find(message.id);
  // What an object had before is where it was: it may have thousands of shapes.
  if (applied.effect == Applied::Effect::extended && there != nullptr) {
    from = {object->primitives.size() - message.primitives.size(),
            object->meshes.size() - message.meshes.size(),
            object->planes.size() - message.planes.size()};
    areas.push_back(with_error(*there, object->place_sigma_m - sigma_before_m));
  }
  for (Area& area : areas_of(*object, from, settings.heights))
    areas.push_back(with_error(std::move(area), object->place_sigma_m));
  around.field.put(message.id, union_of(std::move(areas)));
  if (is_height_ignored(settings.heights)) note_planes(*object, from.plane, applied.notes);
  change();
}

void Keeper::Impl::place_zones() {
  around.keep_out.clear();
  around.keep_in.clear();
  around.keep_in_names.clear();
  if (!world.origin()) return;
  std::vector<MapZone> placed;
  for (const Zone& zone : zones) placed.push_back(project(zone, *world.origin()));
  for (const MapZone& zone : placed) {
    if (zone.kind != Zone::Kind::keep_out) continue;
    std::vector<Area> areas{keep_out_area(zone)};
    if (const Area* same = around.keep_out.find(zone.name)) areas.push_back(*same);
    around.keep_out.put(zone.name, union_of(std::move(areas)));
  }
  KeepIn keep_in = keep_in_areas(placed);
  around.keep_in = std::move(keep_in.areas);
  around.keep_in_names = std::move(keep_in.names);
}

void Keeper::Impl::place_all() {
  place_zones();
  around.field.clear();
  for (const Object& object : world.objects())
    around.field.put(object.id, with_error(union_of(areas_of(object, {}, settings.heights)),
                                           object.place_sigma_m));
  change();
}

Keeper::Keeper(KeeperSettings settings) : impl_(std::make_unique<Impl>(std::move(settings))) {
  impl_->find_problem();
}
Keeper::~Keeper() = default;
Keeper::Keeper(Keeper&&) noexcept = default;
Keeper& Keeper::operator=(Keeper&&) noexcept = default;

void Keeper::set_zones(std::vector<Zone> zones, const std::string& problem) {
  impl_->zones = std::move(zones);
  impl_->zones_told = true;
  impl_->zones_problem = problem;
  impl_->place_zones();
  impl_->change();
}

void Keeper::set_scene_problem(const std::string& problem) {
  impl_->scene_told = true;
  impl_->scene_problem = problem;
  impl_->change();
}

Result<Applied, Refusal> Keeper::apply(const CollisionObject& message, const Arrived& arrived) {
  const Placement placement{impl_->settings.robot, impl_->poses, arrived.at, arrived.wall_ahead,
                            arrived.late};
  const double before_m = impl_->place_sigma_m(message.id);
  auto applied = impl_->world.apply(message, placement);
  if (applied) impl_->on_object(message, before_m, applied.value());
  return applied;
}

Result<Applied, Refusal> Keeper::apply(const Constraints& message, const Arrived& /*arrived*/) {
  auto applied = impl_->world.apply(message, impl_->settings.robot);
  if (!applied) return applied;
  note_strangers(message, impl_->settings, applied.value().notes);
  impl_->changed_sets.insert(message.name);
  impl_->change();
  return applied;
}

Result<Applied, Refusal> Keeper::restore(const CollisionObject& message,
                                         const GeodeticPoint& origin, double place_sigma_m) {
  const bool is_stored = !impl_->changed_objects.contains(message.id);
  const double before_m = impl_->place_sigma_m(message.id);
  auto applied = impl_->world.restore(message, origin, place_sigma_m);
  if (!applied) return applied;
  impl_->on_object(message, before_m, applied.value());
  if (is_stored) impl_->changed_objects.erase(message.id);
  return applied;
}

Result<Applied, Refusal> Keeper::restore(const Constraints& message, const GeodeticPoint& origin) {
  auto applied = impl_->world.restore(message, impl_->settings.robot, origin);
  if (applied) impl_->change();
  return applied;
}

void Keeper::forget(std::string_view id) {
  CollisionObject gone;
  gone.operation = CollisionObject::REMOVE;
  gone.id = id;
  const bool is_stored = !impl_->changed_objects.contains(id);
  if (!apply(gone, {})) return;
  if (is_stored) impl_->changed_objects.erase(gone.id);
}

void Keeper::clear() {
  for (const Object& object : impl_->world.objects()) impl_->changed_objects.insert(object.id);
  for (const ConstraintSet& set : impl_->world.constraints())
    impl_->changed_sets.insert(set.message.name);
  impl_->world.clear();
  impl_->around.field.clear();
  impl_->change();
}

const World& Keeper::world() const {
  return impl_->world;
}

const std::vector<Zone>& Keeper::zones() const {
  return impl_->zones;
}

std::uint64_t Keeper::number() const {
  return impl_->around.number;
}

std::vector<std::string> Keeper::take_changed_objects() {
  const auto names = std::exchange(impl_->changed_objects, {});
  return {names.begin(), names.end()};
}

std::vector<std::string> Keeper::take_changed_sets() {
  const auto names = std::exchange(impl_->changed_sets, {});
  return {names.begin(), names.end()};
}

std::optional<StoredObject> Keeper::stored_object(std::string_view id) const {
  const Object* object = impl_->world.object(id);
  if (object == nullptr) return std::nullopt;
  return StoredObject{in_messages(as_message(*object)),
                      impl_->world.origin().value_or(GeodeticPoint{}), object->place_sigma_m};
}

std::optional<StoredSet> Keeper::stored_set(std::string_view name) const {
  const ConstraintSet* set = impl_->world.constraint_set(name);
  if (set == nullptr) return std::nullopt;
  // One without an origin is of the robot's frames only: any will do.
  return StoredSet{set->message,
                   set->origin.value_or(impl_->world.origin().value_or(GeodeticPoint{}))};
}

}  // namespace drover::scene
