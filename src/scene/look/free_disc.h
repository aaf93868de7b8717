// What is free about a robot of which nobody knows where it looks.
#pragma once

#include <string>

#include "scene/look/surroundings.h"

namespace drover::scene {

struct FreeDisc {
  bool free = false;     ///< the disc where it is touches nothing, and is where it may be
  double free_m = 0;     ///< so far it may be moved, in any direction
  bool blocked = false;  ///< something is within what was looked at
  std::string name;      ///< when blocked: that
};

/// Of a disc of `reach_m` about `centre`, moved by `most_m` at most. By boolean tests of larger
/// discs: known to a centimetre, never beyond what is free.
FreeDisc free_disc(const Surroundings& around, Point2 centre, double reach_m, double most_m);

}  // namespace drover::scene
