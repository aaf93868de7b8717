// Where on a whole path a task begins, and which end of a loop it drives to.
#pragma once

#include <cstddef>

#include "drover/path.h"
#include "drover/viewpoint.h"
#include "scene/plane/point.h"

namespace drover::scene {

/// The whole way of a task that starts at this pose, along a path that track::check_path lets pass,
/// as the engine begins it (track/path_search.h).
WayLeft way_of_start(const Path& path, std::size_t target, const Pose2& pose);

}  // namespace drover::scene
