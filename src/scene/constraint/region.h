// How far a point is outside of a shape.
#pragma once

#include "scene/message/shapes.h"

namespace drover::scene {

/// Nearer than this to a region is in it: a robot on z = 0 stands in a region that begins there.
inline constexpr double kOnEdge_m = 1e-6;

/// 0 inside. `at` is in the shape's own frame. Infinite or not a number when nothing can be said.
double outside_m(const SolidPrimitive& shape, const Vector3& at);
/// Of the mesh's convex hull; at least so far when outside, to one per cent.
double outside_m(const Mesh& mesh, const Vector3& at);

}  // namespace drover::scene
