#include "scene/look/free_disc.h"

#include <optional>

#include "scene/look/sweeper.h"

namespace drover::scene {

FreeDisc free_disc(const Surroundings& around, Point2 centre, double reach_m, double most_m) {
  const Step here{{centre.x_m, centre.y_m, 0}, 0, 0};
  FreeDisc found;
  const auto is_free = [&](double moved_m) {
    const Sweeper sweeper(around, disc({0, 0}, reach_m + moved_m));
    const WayEnd end = sweeper.sweep({&here, 1});
    if (end.way.blocked) found.name = sweeper.name(end);
    return !end.way.blocked;
  };
  found.free = is_free(0);
  if (!found.free) {
    found.blocked = true;
    return found;
  }
  found.free_m = most_m;
  if (is_free(most_m)) return found;
  found.blocked = true;
  double least_m = 0;
  double blocked_m = most_m;
  while (blocked_m - least_m > kResolution_m) {
    const double middle_m = 0.5 * (least_m + blocked_m);
    (is_free(middle_m) ? least_m : blocked_m) = middle_m;
  }
  found.free_m = least_m;
  return found;
}

}  // namespace drover::scene
