// The cone between a sensor and the disc that it shall see, and what stands in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/constraint/setting.h"
#include "scene/message/constraints.h"

namespace drover::scene {

/// Poses in `map`.
struct View {
  Pose sensor;
  Pose target;
  double radius_m = 0;
  int sides = 3;
};

/// Points of the view: the sensor, then the corners of the disc (inside the circle, as MoveIt's), 3
/// to kMaxConeSides. `short_of_m` ends it before the disc.
std::vector<Vector3> corners_of(const View& view, double short_of_m);

/// In words; nothing when the view is clear. Links named `sensor_link` and `target_link` may be in
/// it: a sensor touches its own view.
std::optional<std::string> what_hides(const View& view, const Setting& setting,
                                      std::string_view sensor_link, std::string_view target_link);

}  // namespace drover::scene
