// A robot in a yard that is judged by one set of constraints.
#pragma once

#include <gmock/gmock.h>

#include <string>
#include <utility>

#include "scene/constraint/evaluate.h"
#include "scene/world/map_change.h"
#include "unit/scene/world/yard.h"

namespace drover::scene::yard {

/// The robot has a base 0.9 x 0.7 m and 0.5 m high, a lidar and a mast behind.
struct Judged : Yard {
  RobotState state;
  Terms terms;

  Judged() {
    RobotBody hull{box(0.9, 0.7, 0.5), at(0, 0, 0.25)};
    robot.links.push_back({"base_link", {}, {hull}});
    SolidPrimitive pole;
    pole.type = SolidPrimitive::CYLINDER;
    pole.dimensions = {1.5, 0.03};
    robot.links.push_back({"mast", at(-0.4, 0, 0.75), {{pole, {}}}});
    state.tilt = Tilt{};
  }
  void keep(Constraints set) {
    if (set.name.empty()) set.name = "set";
    EXPECT_THAT(apply(set), testing::AnyOf("added", "replaced"));
  }
  void keep(const JointConstraint& joint) {
    Constraints set;
    set.joint_constraints = {joint};
    keep(set);
  }
  void keep(const PositionConstraint& position) {
    Constraints set;
    set.position_constraints = {position};
    keep(set);
  }
  void keep(const OrientationConstraint& orientation) {
    Constraints set;
    set.orientation_constraints = {orientation};
    keep(set);
  }
  void keep(const VisibilityConstraint& visibility) {
    Constraints set;
    set.visibility_constraints = {visibility};
    keep(set);
  }
  std::vector<Verdict> verdicts() const { return evaluate(world, robot, state, terms); }
  bool holds() const { return all_hold(verdicts()); }
  bool holds_at(const Pose2& base) {
    state.base = base;
    return holds();
  }
  /// Of the verdict that weighs most.
  std::string why() const { return verdicts().front().why; }
};

inline JointConstraint joint(const std::string& name, double position, double below, double above) {
  JointConstraint constraint;
  constraint.joint_name = name;
  constraint.position = position;
  constraint.tolerance_below = below;
  constraint.tolerance_above = above;
  return constraint;
}

/// base_link inside of a box about the origin, in `map`.
inline PositionConstraint inside(const SolidPrimitive& shape, const Pose& pose = {}) {
  PositionConstraint position;
  position.header.frame_id = "map";
  position.link_name = "base_link";
  position.constraint_region.primitives = {shape};
  position.constraint_region.primitive_poses = {pose};
  return position;
}

}  // namespace drover::scene::yard
