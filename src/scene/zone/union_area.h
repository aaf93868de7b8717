// How much ground polygons take together: where they overlap it counts once.
#pragma once

#include <vector>

#include "scene/zone/project.h"

namespace drover::scene {

/// Of good polygons (check_zone): the edges of one do not cross. With so many edges side by side
/// that it would take longer than about 50 ms, the sum of their areas, which is too much by what
/// they overlap.
double united_area_m2(const std::vector<MapPolygon>& polygons);

}  // namespace drover::scene
