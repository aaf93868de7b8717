// From a message's header to a pose in `map`.
#pragma once

#include <string_view>

#include "drover/result.h"
#include "drover/time.h"
#include "scene/message/header.h"
#include "scene/message/refusal.h"
#include "scene/world/pose_history.h"
#include "scene/world/robot_model.h"
#include "scene/world/sighting.h"

namespace drover::scene {

/// What places a message: the robot, where it was, and when the message came.
struct Placement {
  const RobotModel& robot;
  const PoseHistory& poses;
  Time arrived = kNever;
  /// Wall time since the epoch at `arrived`, less `arrived`: stamps are wall time.
  Duration wall_ahead{0};
  /// Why it may have been sent long before; empty: it came at once.
  std::string_view late{};
};

/// Farther from the origin nothing is placed: there the map is no plane any more.
inline constexpr double kFarthest_m = 100'000;

/// Nothing when the frame can place something; `header_path` is the header's in the message.
std::optional<Refusal> frame_refusal(std::string_view frame_id, const RobotModel& robot,
                                     std::string_view header_path);

/// A header's frame in `map`, and how well that is known.
struct PlacedFrame {
  Pose in_map;
  Sighting seen;
};

/// The header's frame in `map`. A frame of the robot is where it was at the stamp; a stamp of zero
/// means now, which a message that came late cannot say. For `map` the stamp says nothing.
Result<PlacedFrame, Refusal> frame_in_map(const Header& header, const Placement& placement);

}  // namespace drover::scene
