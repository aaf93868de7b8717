// The same place on earth in the maps of two origins.
#pragma once

#include "drover/path.h"
#include "scene/world/planar_pose.h"

namespace drover::scene {

/// A latitude and a longitude on earth, all finite.
bool is_origin(const GeodeticPoint& origin);
bool same_origin(const GeodeticPoint& a, const GeodeticPoint& b);

/// `pose` is of the map about `from`; the result is of the map about `to`. It turns by what east
/// differs at the two origins (convergence). Heights stay: z is above the ground under the thing,
/// and an origin whose height was mended may lift no fence off the ground.
Pose2 moved(const Pose2& pose, const GeodeticPoint& from, const GeodeticPoint& to);
Pose moved(const Pose& pose, const GeodeticPoint& from, const GeodeticPoint& to);

}  // namespace drover::scene
