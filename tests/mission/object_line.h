// objects.log, line by line: what the simulator put in the robot's way, and what the robot touched.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "drover/time.h"
#include "mission/flat.h"

namespace drover::mission {

struct ObjectLine {
  Time time = kNever;
  std::string verb;  ///< watching, put, at, gone, touch, leave
  std::string name;
  TrueSolid solid;              ///< of put
  std::vector<double> numbers;  ///< of at, touch, leave
};
/// Throws std::runtime_error.
ObjectLine parse_object_line(std::string_view line);

}  // namespace drover::mission
