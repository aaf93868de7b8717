// What one set of constraints is judged in.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "scene/constraint/robot_state.h"
#include "scene/world/object.h"
#include "scene/world/robot_model.h"

namespace drover::scene {

/// What of a link must be inside a position's region.
struct Extent {
  /// About the target point, in the link's frame. Empty: the point alone, as the document says.
  std::vector<Vector3> outline;
  double margin_m = 0;  ///< level, around every point of it: two sigma of the position
  double turn_rad = 0;  ///< two sigma of the heading: as much wider, times the point's way to base
};

struct Terms {
  Extent extent;
  double joint_horizon_s = 0;  ///< joints must be inside now and, at their velocity, after it
};

/// `ahead` judges a place where the robot is not yet: what is not known there is left out.
enum class Moment : std::uint8_t { now_here, ahead };

struct Setting {
  const RobotModel& robot;
  const RobotState& state;
  const std::vector<Object>& objects;
  const Terms& terms;
  /// The map that the constraints came in, seen from the map in force: as it is at the robot.
  Pose2 their_map;
  Moment moment = Moment::now_here;
};

/// In `map`, with the tilt where it is known; nothing when the robot has no such link.
std::optional<Pose> link_in_map(const Setting& setting, std::string_view link);
/// Of a frame_id; the global one is the constraints' map.
std::optional<Pose> frame_of(const Setting& setting, std::string_view frame_id);
/// The same of a robot that looks so.
std::optional<Pose> link_if_looking(const Setting& setting, std::string_view link, double yaw_rad);
std::optional<Pose> frame_if_looking(const Setting& setting, std::string_view frame_id,
                                     double yaw_rad);

}  // namespace drover::scene
