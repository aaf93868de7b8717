// What constraints permit of the robot's place, on top of what is free about it.
#pragma once

#include <span>

#include "drover/clearance.h"
#include "scene/constraint/edge.h"
#include "scene/look/look.h"

namespace drover::scene {

struct EdgesToKeep {
  const Edges& all;   ///< with the errors of position and heading
  const Edges& bare;  ///< without them
};

/// Never more than was free; where a constraint is broken already nothing is changed. Each way ends
/// the margin before the edge, measured along it: who drives beside an edge is not held up by it,
/// and who stands before it may drive back. A task is bounded on its track alone: what lies behind
/// its goal or a corner it does not drive to. Without a heading any way ends before the nearest
/// edge. `track` is its track_way().
Clearance with_edges(Clearance found, const EdgesToKeep& edges, const LookSettings& settings,
                     const Standpoint& from, std::span<const Step> track);

}  // namespace drover::scene
