#include "scene/world/place.h"

#include "scene/message/frames.h"
#include "scene/world/rigid.h"
#include "scene/world/words.h"

namespace drover::scene {
namespace {

std::string frames_of(const RobotModel& robot) {
  std::string names = "map, base_link";
  for (const Link& link : robot.links) {
    if (!same_frame(link.name, kBaseLink)) names += ", " + link.name;
  }
  return names;
}

Time monotonic(const Stamp& stamp, const Placement& placement) {
  if (stamp == Stamp{}) return placement.arrived;
  const Duration wall = std::chrono::seconds(stamp.sec) + std::chrono::nanoseconds(stamp.nsec);
  return Time{wall - placement.wall_ahead};
}

}  // namespace

std::optional<Refusal> frame_refusal(std::string_view frame_id, const RobotModel& robot,
                                     std::string_view header_path) {
  if (is_global_frame(frame_id)) return std::nullopt;
  const std::string path = std::string(header_path) + ".frame_id";
  if (is_no_frame(frame_id))
    return Refusal{path, "no frame: what has none cannot be placed; allowed: " + frames_of(robot)};
  if (!link_on_base(robot, frame_id))
    return Refusal{path,
                   "unknown frame " + words::quoted(frame_id) + "; allowed: " + frames_of(robot)};
  return std::nullopt;
}

Result<PlacedFrame, Refusal> frame_in_map(const Header& header, const Placement& placement) {
  if (auto refused = frame_refusal(header.frame_id, placement.robot, "header")) return *refused;
  if (is_global_frame(header.frame_id)) return PlacedFrame{};
  if (header.stamp == Stamp{} && !placement.late.empty())
    return Refusal{"header.stamp",
                   "0 means now, but this may be older: " + std::string(placement.late)};
  const auto base = placement.poses.at(monotonic(header.stamp, placement), placement.arrived);
  if (!base) return Refusal{"header.stamp", base.error()};
  const Pose on_base = *link_on_base(placement.robot, header.frame_id);
  return PlacedFrame{rigid::product(upright(base->pose), on_base),
                     {place_of(base->pose), base->position_sigma_m, base->yaw_sigma_rad}};
}

}  // namespace drover::scene
