#include "scene/constraint/setting.h"

#include "drover/rotation.h"
#include "scene/message/frames.h"
#include "scene/world/rigid.h"

namespace drover::scene {

std::optional<Pose> link_in_map(const Setting& setting, std::string_view link) {
  return link_if_looking(setting, link, setting.state.base.yaw_rad);
}

std::optional<Pose> frame_of(const Setting& setting, std::string_view frame_id) {
  return frame_if_looking(setting, frame_id, setting.state.base.yaw_rad);
}

std::optional<Pose> link_if_looking(const Setting& setting, std::string_view link, double yaw_rad) {
  const auto on_base = link_on_base(setting.robot, link);
  if (!on_base) return std::nullopt;
  const Pose2& base = setting.state.base;
  const Tilt tilt = setting.state.tilt.value_or(Tilt{});
  return rigid::product(
      Pose{{base.x_m, base.y_m, 0}, from_angles(tilt.roll_rad, tilt.pitch_rad, yaw_rad)}, *on_base);
}

std::optional<Pose> frame_if_looking(const Setting& setting, std::string_view frame_id,
                                     double yaw_rad) {
  if (is_global_frame(frame_id)) return upright(setting.their_map);
  return link_if_looking(setting, frame_id, yaw_rad);
}

}  // namespace drover::scene
