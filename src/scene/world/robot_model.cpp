#include "scene/world/robot_model.h"

#include "text/frame_name.h"

namespace drover::scene {

bool same_frame(std::string_view a, std::string_view b) {
  return text::without_slash(a) == text::without_slash(b);
}

std::optional<Pose> link_on_base(const RobotModel& robot, std::string_view name) {
  for (const Link& link : robot.links) {
    if (same_frame(link.name, name)) return link.on_base;
  }
  if (same_frame(kBaseLink, name)) return Pose{};
  return std::nullopt;
}

}  // namespace drover::scene
