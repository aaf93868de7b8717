// The robot as the scene needs it: its frames and what it is made of.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scene/message/header.h"
#include "scene/message/shapes.h"

namespace drover::scene {

inline constexpr std::string_view kBaseLink = "base_link";

/// Something convex; a mesh counts as its convex hull.
struct RobotBody {
  std::variant<SolidPrimitive, Mesh> shape;
  Pose on_link;
};

/// A named frame that is fixed on the base: a sensor, a mast, the base itself.
struct Link {
  std::string name;
  Pose on_base;                   ///< REP 103: x ahead, y left, z up; z = 0 is the ground
  std::vector<RobotBody> bodies;  ///< may be none: a frame only
};

/// base_link is a frame of every robot, named here or not.
struct RobotModel {
  std::vector<Link> links;
};

/// Where a link is on the base; nothing when the robot has none of that name. A slash before the
/// name, as ROS 1 has it, does not count.
std::optional<Pose> link_on_base(const RobotModel& robot, std::string_view name);
bool same_frame(std::string_view a, std::string_view b);

}  // namespace drover::scene
