// What constraints permit of the place of a robot that does not know where it looks.
#pragma once

#include "drover/clearance.h"
#include "scene/constraint/edge.h"
#include "scene/look/look.h"

namespace drover::scene {

/// As with_edges does, whichever way it drives; a turn takes nothing out of what already holds
/// wherever it looks.
Clearance with_edge_disc(Clearance found, const Edges& edges, const LookSettings& settings,
                         const Standpoint& from);

}  // namespace drover::scene
