// What the control thread shows the scene's thread, and what it goes by.
#pragma once

#include <cstdint>

#include "drover/clearance.h"
#include "drover/triple_buffer.h"
#include "drover/viewpoint.h"

namespace drover::runtime {

/// An answer of the scene; each has another number, from 1.
struct FoundClearance {
  std::uint64_t number = 0;
  Clearance clearance;
};

struct SceneSight {
  TripleBuffer<Viewpoint> viewpoint;       ///< control → scene, in each cycle
  TripleBuffer<FoundClearance> clearance;  ///< scene → control
};

}  // namespace drover::runtime
