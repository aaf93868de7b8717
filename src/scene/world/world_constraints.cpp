// Constraints by name.
#include <algorithm>

#include "scene/message/check.h"
#include "scene/message/frames.h"
#include "scene/world/map_change.h"
#include "scene/world/words.h"
#include "scene/world/world.h"

namespace drover::scene {
namespace {

std::optional<Refusal> refused_frames(const Constraints& set, const RobotModel& robot) {
  const auto of = [&robot](const Header& header, const std::string& list, std::size_t i,
                           std::string_view name) {
    return frame_refusal(header.frame_id, robot, check::member(check::element(list, i), name));
  };
  for (std::size_t i = 0; i < set.position_constraints.size(); ++i) {
    if (auto refused = of(set.position_constraints[i].header, "position_constraints", i, "header"))
      return refused;
  }
  for (std::size_t i = 0; i < set.orientation_constraints.size(); ++i) {
    if (auto refused =
            of(set.orientation_constraints[i].header, "orientation_constraints", i, "header"))
      return refused;
  }
  for (std::size_t i = 0; i < set.visibility_constraints.size(); ++i) {
    const VisibilityConstraint& visibility = set.visibility_constraints[i];
    const std::string list = "visibility_constraints";
    if (auto refused = of(visibility.target_pose.header, list, i, "target_pose.header"))
      return refused;
    if (auto refused = of(visibility.sensor_pose.header, list, i, "sensor_pose.header"))
      return refused;
  }
  return std::nullopt;
}

/// base/x, base/y and base/theta are of `map`, too.
bool is_of_map(const JointConstraint& joint) {
  return joint.joint_name.starts_with("base/");
}
bool is_of_map(const PositionConstraint& position) {
  return is_global_frame(position.header.frame_id);
}
bool is_of_map(const OrientationConstraint& orientation) {
  return is_global_frame(orientation.header.frame_id);
}
bool is_of_map(const VisibilityConstraint& visibility) {
  return is_global_frame(visibility.target_pose.header.frame_id) ||
         is_global_frame(visibility.sensor_pose.header.frame_id);
}

template <class Kind>
bool any_of_map(const std::vector<Kind>& list) {
  return std::ranges::any_of(list, [](const Kind& one) { return is_of_map(one); });
}

bool needs_map(const Constraints& set) {
  return any_of_map(set.joint_constraints) || any_of_map(set.position_constraints) ||
         any_of_map(set.orientation_constraints) || any_of_map(set.visibility_constraints);
}

}  // namespace

Result<Applied, Refusal> World::apply(const Constraints& message, const RobotModel& robot) {
  return put(message, robot, origin_);
}

Result<Applied, Refusal> World::restore(const Constraints& message, const RobotModel& robot,
                                        const GeodeticPoint& origin) {
  if (!is_origin(origin)) return Refusal{"", "it was kept under an origin that is no place"};
  return put(message, robot, origin);
}

/// `origin`: of the map that the message is in.
Result<Applied, Refusal> World::put(const Constraints& message, const RobotModel& robot,
                                    const std::optional<GeodeticPoint>& origin) {
  if (message.name.empty()) return Refusal{"name", "empty: constraints are kept by their name"};
  const auto old = std::ranges::find(
      constraints_, message.name,
      [](const ConstraintSet& set) -> const std::string& { return set.message.name; });
  const bool is_new = old == constraints_.end();
  const Amount others = is_new ? amount_ : without(amount_, amount_of(old->message));
  const Amount more = amount_of(message);
  if (more.constraints == 0) {
    if (is_new) return Refusal{"name", "there are no constraints " + words::quoted(message.name)};
    amount_ = others;
    constraints_.erase(old);
    return changed(Applied::Effect::removed);
  }
  if (auto refused = refused_frames(message, robot)) return *refused;
  ConstraintSet set;
  set.message = message;
  if (needs_map(message)) {
    if (!origin) return Refusal{"", "map has no origin yet: nothing in it can be constrained"};
    set.origin = origin;
  }
  if (auto refused = too_much(others, more)) return *refused;

  const Applied applied = changed(is_new ? Applied::Effect::added : Applied::Effect::replaced);
  amount_ = sum(others, more);
  set.revision = applied.revision;
  if (is_new) {
    constraints_.push_back(std::move(set));
  } else {
    *old = std::move(set);
  }
  return applied;
}

const ConstraintSet* World::constraint_set(std::string_view name) const {
  for (const ConstraintSet& set : constraints_) {
    if (set.message.name == name) return &set;
  }
  return nullptr;
}

}  // namespace drover::scene
