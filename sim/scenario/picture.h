// The map of a drive as a person sees it: the track, what is around the robot, where it was.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/scenario/scene_object.h"
#include "sim/scenario/scene_zone.h"
#include "sim/scenario/track.h"

namespace drover::sim {

/// All in the simulator's frame.
struct Surroundings {
  std::map<std::string, TrackPose> obstacles;  ///< movable boxes of the world
  std::map<std::string, ObjectSpec> objects;   ///< by id
  std::map<std::string, ZoneSpec> zones;       ///< by name
  std::vector<TrackPose> driven;
  std::vector<TrackPose> waited;  ///< where it stood before something
};

/// The map, and below it a line with its scale and what its marks mean. `goal` is an index into the
/// track; without a `robot` nobody knows where it is.
std::vector<std::string> map_lines(const std::vector<TrackPose>& track, std::size_t goal,
                                   const Surroundings& around,
                                   const std::optional<TrackPose>& robot, bool coloured);

/// At most so many characters; what is cut off ends in an ellipsis.
std::string fitted(const std::string& text, std::size_t width);

}  // namespace drover::sim
