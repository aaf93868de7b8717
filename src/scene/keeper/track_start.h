// Where on a whole path a task begins, and which end of a loop it drives to.
//
// The same place as the engine finds (src/engine/navigate/path_search.h), which no file here may
// include; tests/unit/scene/keeper/track_start_test.cpp holds them together.
#pragma once

#include <cstddef>
#include <cstdint>

#include "drover/path.h"
#include "drover/viewpoint.h"
#include "scene/plane/point.h"

namespace drover::scene {

/// It has two points and more, all finite, not all the same, none 1000 m from the one before it,
/// and one of that index: what the engine would not refuse (it refuses more).
bool is_track(const Path& path, std::size_t target);

/// The whole way of a task that starts at this pose, along a path that is_track: from its point
/// nearest to the pose, of several legs about equally near (0.3 m) from the one that it looks
/// along; on a closed loop to the target's other end where that is the one ahead.
WayLeft way_of_start(const Path& path, std::size_t target, const Pose2& pose);

}  // namespace drover::scene
