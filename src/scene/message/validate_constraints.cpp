// Constraints: what each of the four kinds needs.
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "scene/message/check.h"
#include "scene/message/validate.h"

namespace drover::scene {
namespace {

using check::Notes;
using check::Problem;

/// Of tolerances, weights and angles: beyond it a number is a mistake.
constexpr double kLargest = 1e9;

/// Any weight counts; 0 is 1. It never switches a constraint off.
Problem check_weight(const std::string& path, double weight) {
  return check::number(check::member(path, "weight"), weight, 0, kLargest);
}

Problem check_joint(const std::string& path, JointConstraint& joint, Notes& notes) {
  if (auto problem = check::name(check::member(path, "joint_name"), joint.joint_name))
    return problem;
  for (const auto& [name, value, least] : {std::tuple{"position", joint.position, -kLargest},
                                           {"tolerance_above", joint.tolerance_above, 0.0},
                                           {"tolerance_below", joint.tolerance_below, 0.0}}) {
    if (auto problem = check::number(check::member(path, name), value, least, kLargest))
      return problem;
  }
  if (joint.tolerance_above == 0 && joint.tolerance_below == 0)
    check::note(notes, path, "both tolerances are 0: a measured joint never holds it");
  return check_weight(path, joint.weight);
}

Problem check_region(const std::string& path, BoundingVolume& region, Notes& notes) {
  if (region.primitives.empty() && region.meshes.empty())
    return Refusal{path, "is empty: it must have primitives or meshes"};
  if (auto problem = check::primitives(check::member(path, "primitives"), region.primitives))
    return problem;
  if (auto problem = check::meshes(check::member(path, "meshes"), region.meshes)) return problem;
  if (auto problem = check::poses(check::member(path, "primitive_poses"), region.primitive_poses,
                                  region.primitives.size(), notes))
    return problem;
  return check::poses(check::member(path, "mesh_poses"), region.mesh_poses, region.meshes.size(),
                      notes);
}

Problem check_position(const std::string& path, PositionConstraint& position, Notes& notes) {
  if (auto problem = check::header(check::member(path, "header"), position.header)) return problem;
  if (auto problem = check::name(check::member(path, "link_name"), position.link_name))
    return problem;
  if (auto problem =
          check::position(check::member(path, "target_point_offset"), position.target_point_offset))
    return problem;
  if (auto problem =
          check_region(check::member(path, "constraint_region"), position.constraint_region, notes))
    return problem;
  return check_weight(path, position.weight);
}

/// A sign says nothing; 0 is what no sensor ever holds.
Problem check_tolerance(const std::string& path, double& tolerance, Notes& notes) {
  if (auto problem = check::number(path, tolerance, -kLargest, kLargest)) return problem;
  if (tolerance == 0)
    check::note(notes, path, "is 0: a measured turn never holds it; pi and more leaves it free");
  if (tolerance < 0) check::note(notes, path, "is negative, taken without its sign");
  tolerance = std::abs(tolerance);
  return std::nullopt;
}

Problem check_turn(const std::string& path, OrientationConstraint& turn, Notes& notes) {
  if (auto problem = check::header(check::member(path, "header"), turn.header)) return problem;
  if (auto problem =
          check::orientation(check::member(path, "orientation"), turn.orientation, notes))
    return problem;
  if (auto problem = check::name(check::member(path, "link_name"), turn.link_name)) return problem;
  for (const auto& [name, tolerance] :
       {std::pair{"absolute_x_axis_tolerance", &turn.absolute_x_axis_tolerance},
        {"absolute_y_axis_tolerance", &turn.absolute_y_axis_tolerance},
        {"absolute_z_axis_tolerance", &turn.absolute_z_axis_tolerance}}) {
    if (auto problem = check_tolerance(check::member(path, name), *tolerance, notes))
      return problem;
  }
  return check_weight(path, turn.weight);
}

Problem check_placed(const std::string& path, PoseStamped& placed, Notes& notes) {
  if (auto problem = check::header(check::member(path, "header"), placed.header)) return problem;
  return check::pose(check::member(path, "pose"), placed.pose, notes);
}

/// What is seen: how large, from how many sides, from which axis of the sensor.
Problem check_view(const std::string& path, VisibilityConstraint& sight, Notes& notes) {
  for (const auto& [name, value, most] :
       {std::tuple{"target_radius", sight.target_radius, kMaxSize_m},
        {"max_view_angle", sight.max_view_angle, kLargest},
        {"max_range_angle", sight.max_range_angle, kLargest}}) {
    if (auto problem = check::number(check::member(path, name), value, 0, most)) return problem;
  }
  if (sight.target_radius == 0 && sight.max_view_angle == 0 && sight.max_range_angle == 0)
    return Refusal{path, "asks for nothing: target_radius and both angles are 0"};
  if (sight.cone_sides > kMaxConeSides)
    return Refusal{check::member(path, "cone_sides"),
                   "is " + std::to_string(sight.cone_sides) + ": at most " +
                       std::to_string(kMaxConeSides) + " are allowed"};
  if (sight.cone_sides < 3) {
    if (sight.target_radius > 0)
      check::note(notes, check::member(path, "cone_sides"), "is below 3, taken as 3");
    sight.cone_sides = 3;
  }
  if (sight.sensor_view_direction <= VisibilityConstraint::SENSOR_X) return std::nullopt;
  return Refusal{check::member(path, "sensor_view_direction"),
                 "is " + std::to_string(sight.sensor_view_direction) +
                     ": it must be SENSOR_Z 0, SENSOR_Y 1 or SENSOR_X 2"};
}

Problem check_sight(const std::string& path, VisibilityConstraint& sight, Notes& notes) {
  if (auto problem = check_view(path, sight, notes)) return problem;
  if (auto problem = check_placed(check::member(path, "target_pose"), sight.target_pose, notes))
    return problem;
  if (auto problem = check_placed(check::member(path, "sensor_pose"), sight.sensor_pose, notes))
    return problem;
  return check_weight(path, sight.weight);
}

template <class Constraint, class Check>
Problem check_each(const std::string& path, std::vector<Constraint>& list, Notes& notes,
                   Check check_one) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (auto problem = check_one(check::element(path, i), list[i], notes)) return problem;
  return std::nullopt;
}

/// Of all of a message, however many regions they are spread over.
Problem check_counts(const Constraints& all) {
  const std::size_t count = all.joint_constraints.size() + all.position_constraints.size() +
                            all.orientation_constraints.size() + all.visibility_constraints.size();
  if (count > kMaxConstraints)
    return Refusal{"", "it has " + std::to_string(count) + " constraints, at most " +
                           std::to_string(kMaxConstraints) + " are allowed in a message"};
  std::size_t triangles = 0;
  for (const PositionConstraint& each : all.position_constraints)
    for (const Mesh& mesh : each.constraint_region.meshes) triangles += mesh.triangles.size();
  if (triangles <= kMaxTriangles) return std::nullopt;
  return Refusal{"position_constraints",
                 "has " + std::to_string(triangles) + " triangles, at most " +
                     std::to_string(kMaxTriangles) + " are allowed in a message"};
}

Problem check_constraints(Constraints& all, Notes& notes) {
  if (auto problem = check::name("name", all.name)) return problem;
  if (auto problem = check_counts(all)) return problem;
  if (auto problem = check_each("joint_constraints", all.joint_constraints, notes, check_joint))
    return problem;
  if (auto problem =
          check_each("position_constraints", all.position_constraints, notes, check_position))
    return problem;
  if (auto problem =
          check_each("orientation_constraints", all.orientation_constraints, notes, check_turn))
    return problem;
  return check_each("visibility_constraints", all.visibility_constraints, notes, check_sight);
}

}  // namespace

Result<Accepted<Constraints>, Refusal> validate(Constraints constraints) {
  Notes notes;
  if (auto problem = check_constraints(constraints, notes)) return *problem;
  return Accepted<Constraints>{std::move(constraints), std::move(notes)};
}

}  // namespace drover::scene
