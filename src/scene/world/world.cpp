// Objects: ADD, REMOVE, APPEND and MOVE.
#include "scene/world/world.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "scene/message/check.h"
#include "scene/message/frames.h"
#include "scene/world/map_change.h"
#include "scene/world/words.h"
#include "text/number.h"

namespace drover::scene {
namespace {

using Effect = Applied::Effect;

template <class Shape>
const Shape& shape_of(const Shape& shape) {
  return shape;
}
template <class Shape>
const Shape& shape_of(const Placed<Shape>& placed) {
  return placed.shape;
}

/// The worst place of all shapes counts for the object; the first that is too far off is named.
template <class Shape>
std::optional<Refusal> anchor_shapes(const std::vector<Shape>& shapes,
                                     const std::vector<Pose>& poses, std::string_view list,
                                     const Ground& ground, std::vector<Anchor>& anchors,
                                     double& sigma_m) {
  if (auto refused = anchor_all(poses, list, ground, anchors)) return refused;
  const Sighting& seen = ground.seen;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const bool turns = seen.yaw_sigma_rad != 0;
    const double reach_m =
        turns ? farthest_m(shape_of(shapes[i]), anchors[i].pose, seen.from) : 0.0;
    const auto sigma = sigma_of_place(seen, reach_m);
    if (!sigma.ok()) return Refusal{check::element(std::string(list), i), sigma.error()};
    sigma_m = std::max(sigma_m, *sigma);
  }
  return std::nullopt;
}

/// Without one of their own the last shapes are where the header's frame is.
template <class Shape>
std::optional<Refusal> place_shapes(const std::vector<Shape>& shapes, std::vector<Pose> poses,
                                    std::string_view list, const Ground& ground,
                                    std::vector<Placed<Shape>>& placed, double& sigma_m) {
  if (poses.size() > shapes.size())
    return Refusal{std::string(list), text::counted(poses.size(), "pose", "poses") + " for " +
                                          text::counted(shapes.size(), "shape", "shapes") +
                                          "; allowed: at most one for each"};
  poses.resize(shapes.size());
  std::vector<Anchor> anchors;
  if (auto refused = anchor_shapes(shapes, poses, list, ground, anchors, sigma_m)) return refused;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    placed.push_back({shapes[i], anchors[i], anchors[i].pose});
  return std::nullopt;
}

template <class Shape>
void set_places(std::vector<Placed<Shape>>& placed, const std::vector<Anchor>& anchors) {
  for (std::size_t i = 0; i < placed.size(); ++i) {
    placed[i].arrived = anchors[i];
    placed[i].in_map = anchors[i].pose;
  }
}

template <class Shape>
void put_under(std::vector<Placed<Shape>>& placed, const GeodeticPoint& origin) {
  for (Placed<Shape>& one : placed)
    one.in_map = moved(one.arrived.pose, one.arrived.origin, origin);
}

void put_under(Object& object, const GeodeticPoint& origin) {
  put_under(object.primitives, origin);
  put_under(object.meshes, origin);
  put_under(object.planes, origin);
}

template <class Shape>
void take_over(std::vector<Placed<Shape>>& to, std::vector<Placed<Shape>>& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

Refusal unknown_id(std::string_view id) {
  return {"id", "there is no object " + words::quoted(id)};
}

std::optional<Refusal> count_refusal(std::size_t poses, std::size_t shapes, std::string_view list,
                                     std::string_view kind) {
  if (poses == shapes) return std::nullopt;
  return Refusal{std::string(list), text::counted(poses, "pose", "poses") + " for " +
                                        std::to_string(shapes) + " " + std::string(kind) +
                                        ": a MOVE carries one for each shape of the object"};
}

/// Where everything of the object is from now on.
struct NewPlaces {
  std::vector<Anchor> primitives;
  std::vector<Anchor> meshes;
  std::vector<Anchor> planes;
  double sigma_m = 0;
};

std::optional<Refusal> find_places(const CollisionObject& message, const Object& object,
                                   const Ground& ground, NewPlaces& places) {
  const auto& [header, id, type, primitives, primitive_poses, meshes, mesh_poses, planes,
               plane_poses, operation] = message;
  if (!primitives.empty()) return Refusal{"primitives", "a MOVE carries no geometry"};
  if (!meshes.empty()) return Refusal{"meshes", "a MOVE carries no geometry"};
  if (!planes.empty()) return Refusal{"planes", "a MOVE carries no geometry"};
  for (const auto& refused :
       {count_refusal(primitive_poses.size(), object.primitives.size(), "primitive_poses",
                      "primitives"),
        count_refusal(mesh_poses.size(), object.meshes.size(), "mesh_poses", "meshes"),
        count_refusal(plane_poses.size(), object.planes.size(), "plane_poses", "planes")}) {
    if (refused) return refused;
  }
  if (auto refused = anchor_shapes(object.primitives, primitive_poses, "primitive_poses", ground,
                                   places.primitives, places.sigma_m))
    return refused;
  if (auto refused = anchor_shapes(object.meshes, mesh_poses, "mesh_poses", ground, places.meshes,
                                   places.sigma_m))
    return refused;
  return anchor_shapes(object.planes, plane_poses, "plane_poses", ground, places.planes,
                       places.sigma_m);
}

/// The header's frame under the origin in force.
Result<Ground, Refusal> ground_of(const Header& header, const Placement& placement,
                                  const std::optional<GeodeticPoint>& origin) {
  const auto frame = frame_in_map(header, placement);
  if (!frame) return frame.error();
  if (!origin)
    return Refusal{"header.frame_id", "map has no origin yet: nothing can be placed before"};
  return Ground{frame->in_map, *origin, frame->seen};
}

Result<Object, Refusal> placed(const CollisionObject& message, const Ground& ground) {
  Object object;
  object.id = message.id;
  object.type = message.type;
  if (auto refused = place_shapes(message.primitives, message.primitive_poses, "primitive_poses",
                                  ground, object.primitives, object.place_sigma_m))
    return *refused;
  if (auto refused = place_shapes(message.meshes, message.mesh_poses, "mesh_poses", ground,
                                  object.meshes, object.place_sigma_m))
    return *refused;
  if (auto refused = place_shapes(message.planes, message.plane_poses, "plane_poses", ground,
                                  object.planes, object.place_sigma_m))
    return *refused;
  if (object.primitives.empty() && object.meshes.empty() && object.planes.empty())
    return Refusal{"primitives", "no shape: an object has primitives, meshes or planes"};
  return object;
}

}  // namespace

Result<Applied, Refusal> World::apply(const CollisionObject& message, const Placement& placement) {
  if (message.id.empty()) return Refusal{"id", "empty: every operation needs the id of one object"};
  if (message.operation == CollisionObject::REMOVE) return remove(message);
  if (message.operation > CollisionObject::MOVE)
    return Refusal{"operation", std::to_string(message.operation) +
                                    "; allowed: 0 ADD, 1 REMOVE, 2 APPEND, 3 MOVE"};
  if (message.operation == CollisionObject::MOVE && find_object(message.id) == nullptr)
    return unknown_id(message.id);
  const auto ground = ground_of(message.header, placement, origin_);
  if (!ground) return ground.error();
  switch (message.operation) {
    case CollisionObject::APPEND: return append(message, *ground);
    case CollisionObject::MOVE: return move(message, *ground);
    default: return add(message, *ground);
  }
}

Result<Applied, Refusal> World::restore(const CollisionObject& message, const GeodeticPoint& origin,
                                        double place_sigma_m) {
  if (message.id.empty()) return Refusal{"id", "empty: an object is kept by its id"};
  const bool appends = message.operation == CollisionObject::APPEND;
  if (!appends && message.operation != CollisionObject::ADD)
    return Refusal{"operation", "what is kept is an ADD or an APPEND"};
  if (!is_global_frame(message.header.frame_id))
    return Refusal{"header.frame_id", "what is kept is in map"};
  if (!is_origin(origin)) return Refusal{"", "it was kept under an origin that is no place"};
  if (!std::isfinite(place_sigma_m) || place_sigma_m < 0)
    return Refusal{"", "it was kept with a place that is not known"};
  const Ground ground{{}, origin, {{}, place_sigma_m, 0}};
  auto applied = appends ? append(message, ground) : add(message, ground);
  if (applied && origin_) put_under(*find_object(message.id), *origin_);
  return applied;
}

// The old object goes only when the new one was found good.
Result<Applied, Refusal> World::add(const CollisionObject& message, const Ground& ground) {
  auto object = placed(message, ground);
  if (!object) return object.error();
  Object* old = find_object(message.id);
  const Amount others = old != nullptr ? without(amount_, amount_of(*old)) : amount_;
  const Amount more = amount_of(*object);
  if (auto refused = too_much(others, more)) return *refused;

  const Applied applied = changed(old != nullptr ? Effect::replaced : Effect::added);
  amount_ = sum(others, more);
  object.value().revision = applied.revision;
  if (old != nullptr) {
    *old = std::move(object.value());
  } else {
    objects_.push_back(std::move(object.value()));
  }
  return applied;
}

// New shapes are where the message's own header says, whatever frame the object came in.
Result<Applied, Refusal> World::append(const CollisionObject& message, const Ground& ground) {
  Object* there = find_object(message.id);
  if (there == nullptr) return add(message, ground);
  auto more = placed(message, ground);
  if (!more) return more.error();
  const Amount added = amount_of_shapes(*more);
  if (auto refused = too_much(amount_, added)) return *refused;

  amount_ = sum(amount_, added);
  take_over(there->primitives, more.value().primitives);
  take_over(there->meshes, more.value().meshes);
  take_over(there->planes, more.value().planes);
  there->place_sigma_m = std::max(there->place_sigma_m, more->place_sigma_m);
  const Applied applied = changed(Effect::extended);
  there->revision = applied.revision;
  return applied;
}

Result<Applied, Refusal> World::move(const CollisionObject& message, const Ground& ground) {
  Object* object = find_object(message.id);
  NewPlaces places;
  if (auto refused = find_places(message, *object, ground, places)) return *refused;

  set_places(object->primitives, places.primitives);
  set_places(object->meshes, places.meshes);
  set_places(object->planes, places.planes);
  object->place_sigma_m = places.sigma_m;
  const Applied applied = changed(Effect::moved);
  object->revision = applied.revision;
  return applied;
}

// It needs no place: what is gone may be said under any frame.
Result<Applied, Refusal> World::remove(const CollisionObject& message) {
  const Object* object = find_object(message.id);
  if (object == nullptr) return unknown_id(message.id);
  amount_ = without(amount_, amount_of(*object));
  objects_.erase(objects_.begin() + (object - objects_.data()));
  return changed(Effect::removed);
}

bool World::move_origin(const GeodeticPoint& origin) {
  if (!is_origin(origin)) return false;
  if (origin_ && same_origin(*origin_, origin)) return true;
  origin_ = origin;
  ++revision_;
  for (Object& object : objects_) {
    put_under(object, origin);
    object.revision = revision_;
  }
  for (ConstraintSet& set : constraints_) {
    if (set.origin) set.revision = revision_;
  }
  return true;
}

Object* World::find_object(std::string_view id) {
  const auto it = std::ranges::find(objects_, id, &Object::id);
  return it == objects_.end() ? nullptr : &*it;
}

const Object* World::object(std::string_view id) const {
  const auto it = std::ranges::find(objects_, id, &Object::id);
  return it == objects_.end() ? nullptr : &*it;
}

void World::clear() {
  objects_.clear();
  constraints_.clear();
  amount_ = {};
  ++revision_;
}

}  // namespace drover::scene
