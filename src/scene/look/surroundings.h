// All that the robot must not touch, and where it may be.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drover/fixed_text.h"
#include "scene/plane/field.h"

namespace drover::scene {

/// All in `map`. Its number grows with each change.
struct Surroundings {
  std::uint64_t number = 0;
  /// What of it is not known, so that nothing is free: a store that could not be read, a zone that
  /// could not be placed. An empty scene has to be said to be one.
  Reason problem = "the scene was not read yet";
  Field field;     ///< objects
  Field keep_out;  ///< zones by their names, which may be those of objects as well
  std::vector<std::string> keep_in_names;
  std::vector<Area> keep_in;  ///< by those; none: no bound
  bool constrained = false;   ///< there are constraints

  /// Nothing that a place would have to be known for.
  bool is_empty() const {
    return field.size() == 0 && keep_out.size() == 0 && keep_in.empty() && !constrained;
  }
};

}  // namespace drover::scene
