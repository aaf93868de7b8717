#include "ros2/read_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "drover/rotation.h"
#include "ros2/scene_text.h"
#include "text/number.h"

namespace drover::ros2 {
namespace {

constexpr std::uint8_t kRemove = 1;
constexpr std::uint8_t kMove = 3;
/// Of a quaternion's length, as droverd takes it.
constexpr double kMostError = 1e-3;

using PoseOnTheWire = geometry_msgs_msg_dds__Pose_;

struct Placed {
  Vector3 position;
  Quaternion turn;
};

template <class Xyz>
void vector(SceneText& out, std::string_view name, const Xyz& vector) {
  out.object(name, [&] {
    out.number("x", vector.x_);
    out.number("y", vector.y_);
    out.number("z", vector.z_);
  });
}

void quaternion(SceneText& out, std::string_view name,
                const geometry_msgs_msg_dds__Quaternion_& turn) {
  out.object(name, [&] {
    out.number("x", turn.x_);
    out.number("y", turn.y_);
    out.number("z", turn.z_);
    out.number("w", turn.w_);
  });
}

void pose(SceneText& out, const PoseOnTheWire& pose) {
  out.object([&] {
    vector(out, "position", pose.position_);
    quaternion(out, "orientation", pose.orientation_);
  });
}

void header(SceneText& out, const std_msgs_msg_dds__Header_& header) {
  out.object("header", [&] {
    out.object("stamp", [&] {
      out.integer("sec", header.stamp_.sec_);
      out.integer("nanosec", header.stamp_.nanosec_);
    });
    out.text("frame_id", header.frame_id_);
  });
}

/// Who sets nothing moves nothing; a NaN does.
bool is_no_move(const PoseOnTheWire& pose) {
  const auto& at = pose.position_;
  const auto& turn = pose.orientation_;
  return at.x_ == 0 && at.y_ == 0 && at.z_ == 0 && turn.x_ == 0 && turn.y_ == 0 && turn.z_ == 0 &&
         std::isfinite(turn.w_);
}

/// To be composed, so its numbers are judged here, by the words that droverd has for them.
Placed placed(SceneText& out, const PoseOnTheWire& pose) {
  const auto finite = [&out](std::string_view name, double value) {
    if (!std::isfinite(value)) out.refuse("is no finite number", name);
  };
  const auto& at = pose.position_;
  const auto& turn = pose.orientation_;
  finite("position.x", at.x_);
  finite("position.y", at.y_);
  finite("position.z", at.z_);
  finite("orientation.x", turn.x_);
  finite("orientation.y", turn.y_);
  finite("orientation.z", turn.z_);
  finite("orientation.w", turn.w_);
  Placed placed{{at.x_, at.y_, at.z_}, {turn.w_, turn.x_, turn.y_, turn.z_}};
  const double length = std::hypot(std::hypot(turn.w_, turn.x_), std::hypot(turn.y_, turn.z_));
  if (length == 0) {
    placed.turn = {};
  } else if (!(std::abs(length - 1) <= kMostError)) {
    out.refuse(
        "has the length " + text::number_text(length) + ": a quaternion's must be 1, within 0.001",
        "orientation");
  } else {
    placed.turn = normalised(placed.turn);
  }
  return placed;
}

PoseOnTheWire composed(const Placed& object, const Placed& shape) {
  const Vector3 at = object.position + rotate(object.turn, shape.position);
  const Quaternion turn = normalised(object.turn * shape.turn);
  return {{at.x, at.y, at.z}, {turn.x, turn.y, turn.z, turn.w}};
}

/// About the object's own pose where it has one: a shape without a pose is there.
template <class Poses>
void poses(SceneText& out, std::string_view name, const Poses& poses, std::size_t shapes,
           const std::optional<Placed>& about = {}) {
  const std::size_t count = about ? std::max<std::size_t>(shapes, poses._length) : poses._length;
  out.list(name, count, [&](std::size_t i) {
    if (!about) return pose(out, poses._buffer[i]);
    const Placed shape = i < poses._length ? placed(out, poses._buffer[i]) : Placed{};
    pose(out, composed(*about, shape));
  });
}

template <class Primitives>
void primitives(SceneText& out, const Primitives& all) {
  out.list("primitives", all._length, [&](std::size_t i) {
    const auto& one = all._buffer[i];
    out.object([&] {
      out.integer("type", one.type_);
      out.list("dimensions", one.dimensions_._length,
               [&](std::size_t d) { out.number(one.dimensions_._buffer[d]); });
      // Of a prism, which droverd refuses; with another type it says nothing and is noted.
      if (one.polygon_.points_._length > 0) out.list("polygon", 0, [](std::size_t) {});
    });
  });
}

template <class Meshes>
void meshes(SceneText& out, const Meshes& all) {
  out.list("meshes", all._length, [&](std::size_t i) {
    const auto& mesh = all._buffer[i];
    out.object([&] {
      out.list("triangles", mesh.triangles_._length, [&](std::size_t t) {
        out.object([&] {
          out.list("vertex_indices", 3, [&](std::size_t v) {
            out.integer(mesh.triangles_._buffer[t].vertex_indices_[v]);
          });
        });
      });
      out.list("vertices", mesh.vertices_._length, [&](std::size_t v) {
        const auto& at = mesh.vertices_._buffer[v];
        out.object([&] {
          out.number("x", at.x_);
          out.number("y", at.y_);
          out.number("z", at.z_);
        });
      });
    });
  });
}

template <class Planes>
void planes(SceneText& out, const Planes& all) {
  out.list("planes", all._length, [&](std::size_t i) {
    out.object(
        [&] { out.list("coef", 4, [&](std::size_t c) { out.number(all._buffer[i].coef_[c]); }); });
  });
}

void shapes(SceneText& out, const moveit_msgs_msg_dds__CollisionObject_& message) {
  std::optional<Placed> about;
  if (!is_no_move(message.pose_)) out.pathed("pose", [&] { about = placed(out, message.pose_); });
  const std::size_t poses_told =
      message.primitive_poses_._length + message.mesh_poses_._length + message.plane_poses_._length;
  if (message.operation_ == kMove && poses_told == 0)
    out.refuse(
        "there is none: MOVE needs a pose for each shape here, the object's own is not "
        "enough. ADD replaces it as a whole",
        "primitive_poses");
  primitives(out, message.primitives_);
  poses(out, "primitive_poses", message.primitive_poses_, message.primitives_._length, about);
  meshes(out, message.meshes_);
  poses(out, "mesh_poses", message.mesh_poses_, message.meshes_._length, about);
  planes(out, message.planes_);
  poses(out, "plane_poses", message.plane_poses_, message.planes_._length, about);
  // Not known to droverd, which says so.
  if (message.subframe_names_._length > 0) out.list("subframe_names", 0, [](std::size_t) {});
}

void joint(SceneText& out, const moveit_msgs_msg_dds__JointConstraint_& one) {
  out.text("joint_name", one.joint_name_);
  out.number("position", one.position_);
  out.number("tolerance_above", one.tolerance_above_);
  out.number("tolerance_below", one.tolerance_below_);
  out.number("weight", one.weight_);
}

void position(SceneText& out, const moveit_msgs_msg_dds__PositionConstraint_& one) {
  header(out, one.header_);
  out.text("link_name", one.link_name_);
  vector(out, "target_point_offset", one.target_point_offset_);
  out.object("constraint_region", [&] {
    const auto& region = one.constraint_region_;
    primitives(out, region.primitives_);
    poses(out, "primitive_poses", region.primitive_poses_, region.primitives_._length);
    meshes(out, region.meshes_);
    poses(out, "mesh_poses", region.mesh_poses_, region.meshes_._length);
  });
  out.number("weight", one.weight_);
}

void orientation(SceneText& out, const moveit_msgs_msg_dds__OrientationConstraint_& one) {
  header(out, one.header_);
  quaternion(out, "orientation", one.orientation_);
  out.text("link_name", one.link_name_);
  out.number("absolute_x_axis_tolerance", one.absolute_x_axis_tolerance_);
  out.number("absolute_y_axis_tolerance", one.absolute_y_axis_tolerance_);
  out.number("absolute_z_axis_tolerance", one.absolute_z_axis_tolerance_);
  if (one.parameterization_ != 0) out.integer("parameterization", one.parameterization_);
  out.number("weight", one.weight_);
}

void stamped(SceneText& out, std::string_view name,
             const geometry_msgs_msg_dds__PoseStamped_& one) {
  out.object(name, [&] {
    header(out, one.header_);
    out.member("pose", [&] { pose(out, one.pose_); });
  });
}

void visibility(SceneText& out, const moveit_msgs_msg_dds__VisibilityConstraint_& one) {
  out.number("target_radius", one.target_radius_);
  stamped(out, "target_pose", one.target_pose_);
  out.integer("cone_sides", one.cone_sides_);
  stamped(out, "sensor_pose", one.sensor_pose_);
  out.number("max_view_angle", one.max_view_angle_);
  out.number("max_range_angle", one.max_range_angle_);
  out.integer("sensor_view_direction", one.sensor_view_direction_);
  out.number("weight", one.weight_);
}

template <class Constraints, class Write>
void each(SceneText& out, std::string_view name, const Constraints& all, Write write) {
  out.list(name, all._length,
           [&](std::size_t i) { out.object([&] { write(out, all._buffer[i]); }); });
}

}  // namespace

Result<std::string, SceneRefusal> read_collision_object(
    const moveit_msgs_msg_dds__CollisionObject_& message) {
  SceneText out;
  out.object([&] {
    out.text("id", message.id_);
    out.integer("operation", message.operation_);
    if (message.operation_ == kRemove) return;  // what else it carries says nothing
    header(out, message.header_);
    out.object("type", [&] {
      out.text("key", message.type_.key_);
      out.text("db", message.type_.db_);
    });
    shapes(out, message);
  });
  return out.take();
}

Result<std::string, SceneRefusal> read_constraints(
    const moveit_msgs_msg_dds__Constraints_& message) {
  SceneText out;
  out.object([&] {
    out.text("name", message.name_);
    each(out, "joint_constraints", message.joint_constraints_, joint);
    each(out, "position_constraints", message.position_constraints_, position);
    each(out, "orientation_constraints", message.orientation_constraints_, orientation);
    each(out, "visibility_constraints", message.visibility_constraints_, visibility);
  });
  return out.take();
}

}  // namespace drover::ros2
