#include "scene/plane/area.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "scene/plane/overlap.h"

namespace drover::scene {
namespace {

Circle circle_around(const std::vector<Piece>& pieces) {
  if (pieces.empty()) return {};
  Point2 low = pieces.front().around.centre;
  Point2 high = low;
  for (const Piece& piece : pieces) {
    const Circle& c = piece.around;
    low = {std::min(low.x_m, c.centre.x_m - c.radius_m),
           std::min(low.y_m, c.centre.y_m - c.radius_m)};
    high = {std::max(high.x_m, c.centre.x_m + c.radius_m),
            std::max(high.y_m, c.centre.y_m + c.radius_m)};
  }
  const Point2 centre = 0.5 * (low + high);
  double radius_m = 0;
  for (const Piece& piece : pieces)
    radius_m = std::max(radius_m, length_m(piece.around.centre - centre) + piece.around.radius_m);
  return {centre, radius_m};
}

constexpr Circle kEverywhere{{0, 0}, std::numeric_limits<double>::infinity()};

template <class T>
void move_behind(std::vector<T>& to, std::vector<T>& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

Point2 nearest_in_strip(const Strip& strip, Point2 from) {
  const double at_m = dot(strip.normal, from);
  if (at_m < strip.low_m) return from + (strip.low_m - at_m) * strip.normal;
  if (at_m > strip.high_m) return from + (strip.high_m - at_m) * strip.normal;
  return from;
}

}  // namespace

Area area_of_everything() {
  Area area;
  area.strips.emplace_back();
  area.around = kEverywhere;
  return area;
}

Area area_of(std::vector<Piece> pieces) {
  Area area;
  area.around = circle_around(pieces);
  area.pieces = std::move(pieces);
  // A piece of everything has no middle.
  if (!is_finite(area.around.centre)) area.around = kEverywhere;
  return area;
}

Area area_of_rings(const std::vector<std::vector<Point2>>& rings) {
  std::vector<Piece> walls;
  Outline outline;
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Side side{ring[i], ring[(i + 1) % ring.size()]};
      walls.push_back(piece_of({side.from, side.to}));
      outline.sides.push_back(side);
    }
  }
  Area area = area_of(std::move(walls));
  if (!outline.sides.empty()) area.outlines.push_back(std::move(outline));
  return area;
}

Area union_of(std::vector<Area> areas) {
  Area all;
  for (Area& area : areas) {
    move_behind(all.pieces, area.pieces);
    move_behind(all.strips, area.strips);
    move_behind(all.outlines, area.outlines);
  }
  all.around = all.strips.empty() ? circle_around(all.pieces) : kEverywhere;
  if (!is_finite(all.around.centre)) all.around = kEverywhere;
  return all;
}

// What is solid grows by its walls.
Area widened(Area area, double by_m) {
  if (area.empty()) return area;
  if (!(by_m >= 0)) return area_of_everything();
  for (Piece& piece : area.pieces) piece = widened(std::move(piece), by_m);
  for (Strip& strip : area.strips) {
    strip.low_m -= by_m;
    strip.high_m += by_m;
  }
  area.around.radius_m += by_m;
  return area;
}

Point2 nearest(const Area& area, Point2 from) {
  if (is_inside(area, from)) return from;
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  Point2 best = area.around.centre;
  double best2 = kEndless;
  const auto look = [&](Point2 there) {
    const double away2 = squared(there - from);
    if (!(away2 < best2)) return;
    best = there;
    best2 = away2;
  };
  for (const Strip& strip : area.strips) look(nearest_in_strip(strip, from));
  for (const Piece& piece : area.pieces) look(nearest(piece, from));
  return best;
}

}  // namespace drover::scene
