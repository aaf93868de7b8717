// From shapes with a pose in `map` to what they take of the plane between two heights.
//
// Upright boxes, cylinders, cones, spheres, all meshes and planes: exact. A cylinder or cone that
// is tilted: the section of a prism or pyramid around it. What only touches the interval from below
// or above takes nothing. Numbers that are not finite: everything.
#pragma once

#include <cstdint>

#include "scene/message/header.h"
#include "scene/message/shapes.h"
#include "scene/plane/area.h"

namespace drover::scene {

/// What the robot takes of the height above the ground, which is z = 0: from what it can drive
/// over to its top. low < high; infinite where height is not looked at.
struct Heights {
  double low_m = 0;
  double high_m = 0;
};

Area area_of(const SolidPrimitive& shape, const Pose& in_map, Heights heights);
/// Closed (each side of a triangle is there an even number of times, corners at the same place are
/// one): solid. Open: its triangles are walls.
Area area_of(const Mesh& mesh, const Pose& in_map, Heights heights);
/// A thin sheet without a side or an end. Where height is not looked at, one that is nearer to
/// level than to upright is ground or a ceiling and takes nothing, one that is upright (leaning
/// less than 1e-6) a wall; any other one takes everything, as it meets each place at some height.
Area area_of(const Plane& plane, const Pose& in_map, Heights heights);

/// Infinite on both sides.
bool is_height_ignored(Heights heights);
/// What becomes of it where height is not looked at: how it lies.
enum class PlaneLies : std::uint8_t { level, upright, between };
PlaneLies how_it_lies(const Plane& plane, const Pose& in_map);

}  // namespace drover::scene
