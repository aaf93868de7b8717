#include "store/gears.h"

#include <algorithm>
#include <cmath>

#include "track/legs.h"

namespace drover::store {
namespace {

/// From the route's point `first` to its point `last`.
bool recorded_backwards(const Path& path, std::span<const double> looks_rad, std::size_t first,
                        std::size_t last) {
  double ahead_m = 0;
  double back_m = 0;
  for (std::size_t i = first; i < last; ++i) {
    const double x_m = path.points[i + 1].x_m - path.points[i].x_m;
    const double y_m = path.points[i + 1].y_m - path.points[i].y_m;
    for (const std::size_t end : {i, i + 1}) {
      // Of the point between two parts nobody knows whose it is.
      const bool between =
          (end == first && first != 0) || (end == last && last + 1 != path.points.size());
      if (between || !std::isfinite(looks_rad[end])) continue;
      const double along_m = x_m * std::cos(looks_rad[end]) + y_m * std::sin(looks_rad[end]);
      (along_m < 0 ? back_m : ahead_m) += std::abs(along_m);
    }
  }
  return back_m > 0 && back_m >= 3 * ahead_m;
}

}  // namespace

void set_gears(Path& path, std::span<const double> looks_rad, TrackDrive drive) {
  path.backwards.clear();
  path.either = drive == TrackDrive::either;
  const std::size_t count = path.points.size();
  const bool untold = drive == TrackDrive::recorded && looks_rad.size() != count;
  if (drive == TrackDrive::ahead || count < 2 || untold) return;
  std::vector<std::uint8_t> backwards(count - 1, 0);
  const track::Route route(path.points, count - 1, true);
  bool other_way = false;
  each_leg(route, track::kCusp_rad, INFINITY, [&](const track::Leg& leg) {
    const bool back =
        path.either ? other_way : recorded_backwards(path, looks_rad, leg.first, leg.last);
    std::fill(backwards.begin() + static_cast<std::ptrdiff_t>(leg.first),
              backwards.begin() + static_cast<std::ptrdiff_t>(leg.last),
              static_cast<std::uint8_t>(back ? 1 : 0));
    other_way = !other_way;
  });
  const bool any = std::find(backwards.begin(), backwards.end(), 1) != backwards.end();
  if (any || path.either) path.backwards = std::move(backwards);
}

}  // namespace drover::store
