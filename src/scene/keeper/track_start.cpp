#include "scene/keeper/track_start.h"

#include <cstdint>

#include "scene/keeper/way_line.h"
#include "track/path_search.h"

namespace drover::scene {

WayLeft way_of_start(const Path& path, std::size_t target, const Pose2& pose) {
  const track::Vector at{pose.x_m, pose.y_m};
  const track::Gears gears = track::gears_of(path);
  const std::size_t goal = track::target_ahead(path.points, target, at, pose.yaw_rad, gears);
  const track::PathStart start = track::find_start(path.points, goal, at, pose.yaw_rad, gears);
  WayLeft way;
  way.path = path.number;
  way.forwards = start.forwards;
  way.flipped = start.flipped;
  way.target = static_cast<std::uint32_t>(goal);
  way.segment = static_cast<std::uint32_t>(start.forwards ? start.segment : start.segment + 1);
  way.along_m = start.along_m;
  if (!start.forwards)
    way.along_m =
        length_m(point_of(path, start.segment + 1) - point_of(path, start.segment)) - start.along_m;
  return way;
}

}  // namespace drover::scene
