#include "scene/world/robot_model.h"

namespace drover::scene {
namespace {

std::string_view bare_link(std::string_view name) {
  if (name.starts_with('/')) name.remove_prefix(1);
  return name;
}

}  // namespace

bool same_frame(std::string_view a, std::string_view b) {
  return bare_link(a) == bare_link(b);
}

std::optional<Pose> link_on_base(const RobotModel& robot, std::string_view name) {
  for (const Link& link : robot.links) {
    if (same_frame(link.name, name)) return link.on_base;
  }
  if (same_frame(kBaseLink, name)) return Pose{};
  return std::nullopt;
}

}  // namespace drover::scene
