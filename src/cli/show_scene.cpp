#include "cli/show_scene.h"

#include <array>
#include <cmath>

#include "cli/layout.h"
#include "cli/scene_lists.h"
#include "drover/angle.h"
#include "scene/message/shapes.h"
#include "text/number.h"

namespace drover::cli {

namespace {

using json::Node;
using Solid = scene::SolidPrimitive;

/// Seconds since the epoch; nothing when nobody knows.
std::string when(const Node& node) {
  return date(node, "  since %Y-%m-%d %H:%M:%SZ");
}

std::string meters(double value) {
  return text::formed("%.2f", value);
}

/// "2 shapes", of a number in an answer.
std::string amount(const Node& node, const char* one, const char* many) {
  return text::counted(static_cast<std::size_t>(value_of(node)), one, many);
}

std::string object_line(const Node& object) {
  std::string out = padded(text(at(object, "id")), kNameColumns) + "  " +
                    padded(amount(at(object, "shapes"), "shape", "shapes"), 10);
  if (!at(object, "x_m").number()) {
    out += "  not placed";
  } else {
    out += quantity(at(object, "x_m"), "  x %8.2f m") + quantity(at(object, "y_m"), "  y %8.2f m");
    out += at(object, "distance_m").number()
               ? quantity(at(object, "distance_m"), "  %7.2f m from the robot")
               : "  the robot does not know where it is";
  }
  if (value_of(at(object, "triangles")) > 0)
    out += "  " + amount(at(object, "triangles"), "triangle", "triangles");
  return out + when(at(object, "arrived_s")) + "\n";
}

std::string set_line(const Node& set) {
  std::string kinds;
  for (const auto* kind : {"joint", "position", "orientation", "visibility"})
    if (value_of(at(set, kind)) > 0)
      kinds += (kinds.empty() ? "" : ", ") + amount(at(set, kind), kind, kind);
  return padded(text(at(set, "name")), kNameColumns) + "  constraints: " + kinds +
         when(at(set, "arrived_s")) + "\n";
}

/// "at x 2.00  y -0.50  z 0.60 m  yaw 90.0 deg"; roll and pitch where it is tilted.
std::string place(const Node& pose) {
  const auto& p = at(pose, "position");
  std::string out = "  at x " + meters(value_of(at(p, "x"))) + "  y " +
                    meters(value_of(at(p, "y"))) + "  z " + meters(value_of(at(p, "z"))) + " m";
  const auto& q = at(pose, "orientation");
  const double x = value_of(at(q, "x"));
  const double y = value_of(at(q, "y"));
  const double z = value_of(at(q, "z"));
  const double w = value_of(at(q, "w"));
  const std::array<double, 3> angles_rad{
      std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
      std::asin(std::fmin(1, std::fmax(-1, 2 * (w * y - z * x)))),
      std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))};
  constexpr std::array<const char*, 3> kNames{"roll", "pitch", "yaw"};
  for (std::size_t i = 0; i < angles_rad.size(); ++i) {
    const double deg = to_deg(angles_rad[i]);
    if (std::abs(deg) < 0.05) continue;
    out += std::string("  ") + kNames[i] + text::formed(" %.1f deg", deg);
  }
  return out;
}

std::string primitive(const Node& solid) {
  const auto& sizes = at(solid, "dimensions");
  const auto size = [&](std::size_t i) { return meters(value_of(entry(sizes, i))); };
  switch (at(solid, "type").integer().value_or(0)) {
    case Solid::BOX:
      return padded("box", 10) + size(Solid::BOX_X) + " x " + size(Solid::BOX_Y) + " x " +
             size(Solid::BOX_Z) + " m";
    case Solid::SPHERE: return padded("sphere", 10) + "radius " + size(Solid::SPHERE_RADIUS) + " m";
    case Solid::CYLINDER:
      return padded("cylinder", 10) + "height " + size(Solid::CYLINDER_HEIGHT) + "  radius " +
             size(Solid::CYLINDER_RADIUS) + " m";
    case Solid::CONE:
      return padded("cone", 10) + "height " + size(Solid::CONE_HEIGHT) + "  radius " +
             size(Solid::CONE_RADIUS) + " m";
    default: return "a shape of an unknown type";
  }
}

std::string plane(const Node& plane) {
  const auto& coef = at(plane, "coef");
  const auto term = [&](std::size_t i, const char* form) {
    return text::formed(form, value_of(entry(coef, i)));
  };
  return padded("plane", 10) + term(0, "%g x ") + term(1, "%+g y ") + term(2, "%+g z ") +
         term(3, "%+g = 0");
}

std::string mesh(const Node& mesh) {
  return padded("mesh", 10) + text::counted(count(at(mesh, "triangles")), "triangle", "triangles");
}

template <class Text>
std::string shapes(const Node& message, const char* list, const char* poses, Text words) {
  std::string out;
  for (std::size_t i = 0; i < count(at(message, list)); ++i)
    out += words(entry(at(message, list), i)) + place(entry(at(message, poses), i)) + "\n";
  return out;
}

std::string object_text(const Node& messages) {
  std::string out;
  line(out, "object", text(at(entry(messages, 0), "id")) + "  in the map");
  for (std::size_t i = 0; i < count(messages); ++i) {
    const auto& message = entry(messages, i);
    out += shapes(message, "primitives", "primitive_poses", primitive);
    out += shapes(message, "meshes", "mesh_poses", mesh);
    out += shapes(message, "planes", "plane_poses", plane);
  }
  return out;
}

std::string joint_text(const Node& joint) {
  const double position = value_of(at(joint, "position"));
  return text(at(joint, "joint_name")) +
         text::formed("  from %.4g", position - value_of(at(joint, "tolerance_below"))) +
         text::formed(" to %.4g", position + value_of(at(joint, "tolerance_above")));
}

std::string frame_of(const Node& constraint) {
  return "  of frame " + text(at(at(constraint, "header"), "frame_id"));
}

std::string position_text(const Node& position) {
  const auto& region = at(position, "constraint_region");
  const auto shapes_of_it = count(at(region, "primitives")) + count(at(region, "meshes"));
  return text(at(position, "link_name")) + "  inside of " +
         text::counted(shapes_of_it, "shape", "shapes") + frame_of(position);
}

std::string orientation_text(const Node& orientation) {
  return text(at(orientation, "link_name")) + "  within" +
         quantity(at(orientation, "absolute_x_axis_tolerance"), " %.3g") +
         quantity(at(orientation, "absolute_y_axis_tolerance"), " %.3g") +
         quantity(at(orientation, "absolute_z_axis_tolerance"), " %.3g rad about x, y, z") +
         frame_of(orientation);
}

std::string visibility_text(const Node& visibility) {
  std::string out = "target of radius" + quantity(at(visibility, "target_radius"), " %.2f m");
  for (const auto& [key, words] :
       {std::pair{"max_view_angle", "view"}, {"max_range_angle", "range"}})
    if (value_of(at(visibility, key)) > 0)
      out += std::string("  ") + words + " angle" + quantity(at(visibility, key), " to %.3g rad");
  return out;
}

void constraint_lines(std::string& out, const Node& set, const char* key, const char* label,
                      std::string (*words)(const Node&)) {
  for (std::size_t i = 0; i < count(at(set, key)); ++i)
    out += padded(label, 12) + words(entry(at(set, key), i)) + "\n";
}

std::string set_text(const Node& set) {
  std::string out = padded("constraints", 12) + text(at(set, "name")) + "\n";
  constraint_lines(out, set, "joint_constraints", "joint", joint_text);
  constraint_lines(out, set, "position_constraints", "position", position_text);
  constraint_lines(out, set, "orientation_constraints", "orientation", orientation_text);
  constraint_lines(out, set, "visibility_constraints", "visibility", visibility_text);
  return out;
}

}  // namespace

std::string show_scene(const Node& answer) {
  std::string out = nothing_is_free(answer, "drover scene accept-loss gives up what is lost");
  const auto& objects = at(answer, "objects");
  const auto& sets = at(answer, "constraints");
  for (std::size_t i = 0; i < count(objects); ++i) out += object_line(entry(objects, i));
  for (std::size_t i = 0; i < count(sets); ++i) out += set_line(entry(sets, i));
  if (count(objects) + count(sets) == 0) out += "no object and no constraint\n";
  return out;
}

std::string show_scene_entry(const Node& answer) {
  std::string out;
  if (at(answer, "object").list() != nullptr) out += object_text(at(answer, "object"));
  if (at(answer, "constraints").object() != nullptr) out += set_text(at(answer, "constraints"));
  return out;
}

}  // namespace drover::cli
