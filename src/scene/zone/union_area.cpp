// How much ground polygons take together: where they overlap it counts once.
#include "scene/zone/union_area.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "scene/zone/measures.h"

namespace drover::scene {
namespace {

/// Looks at an edge.
constexpr std::size_t kMostLooks = 2'000'000;

/// From its lower to its upper end; level ones bound nothing.
struct Edge {
  Point2 low;
  Point2 high;
  std::size_t polygon = 0;

  double x_at(double y_m) const {
    const double part = (y_m - low.y_m) / (high.y_m - low.y_m);
    return low.x_m + part * (high.x_m - low.x_m);
  }
};

std::vector<Edge> edges_of(const std::vector<MapPolygon>& polygons) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const auto add = [&](const MapRing& ring) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        Edge edge{ring[k], ring[(k + 1) % ring.size()], i};
        if (edge.low.y_m > edge.high.y_m) std::swap(edge.low, edge.high);
        if (edge.low.y_m < edge.high.y_m) edges.push_back(edge);
      }
    };
    add(polygons[i].outer);
    for (const MapRing& hole : polygons[i].holes) add(hole);
  }
  const auto lower = [](const Edge& a, const Edge& b) { return a.low.y_m < b.low.y_m; };
  std::sort(edges.begin(), edges.end(), lower);
  return edges;
}

/// Where two edges cross.
std::optional<double> crossing_y(const Edge& a, const Edge& b) {
  const double low_m = std::max(a.low.y_m, b.low.y_m);
  const double high_m = std::min(a.high.y_m, b.high.y_m);
  if (!(low_m < high_m)) return std::nullopt;
  const double at_low_m = a.x_at(low_m) - b.x_at(low_m);
  const double at_high_m = a.x_at(high_m) - b.x_at(high_m);
  if ((at_low_m < 0) == (at_high_m < 0) || at_low_m == at_high_m) return std::nullopt;
  return low_m + (high_m - low_m) * at_low_m / (at_low_m - at_high_m);
}

/// Every height at which the order of the edges changes, from below. Nothing: too many looks.
std::optional<std::vector<double>> levels_of(const std::vector<Edge>& edges, std::size_t& looks) {
  std::vector<double> levels;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    levels.push_back(edges[i].low.y_m);
    levels.push_back(edges[i].high.y_m);
    for (std::size_t k = i + 1; k < edges.size(); ++k) {
      if (edges[k].low.y_m >= edges[i].high.y_m) break;
      if (++looks > kMostLooks) return std::nullopt;
      if (edges[k].polygon == edges[i].polygon) continue;
      if (const auto y_m = crossing_y(edges[i], edges[k])) levels.push_back(*y_m);
    }
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

/// How much of the line at `y_m` the polygons take whose edges cross there.
double covered_m(const std::vector<const Edge*>& there, double y_m, std::size_t polygons) {
  std::vector<std::pair<double, std::size_t>> crossings;
  crossings.reserve(there.size());
  for (const Edge* edge : there) crossings.emplace_back(edge->x_at(y_m), edge->polygon);
  std::sort(crossings.begin(), crossings.end());
  std::vector<bool> inside(polygons, false);
  std::size_t count = 0;
  double begin_m = 0;
  double sum_m = 0;
  for (const auto& [x_m, polygon] : crossings) {
    const std::size_t before = count;
    inside[polygon] = !inside[polygon];
    count += inside[polygon] ? 1 : -std::size_t{1};
    if (before == 0) begin_m = x_m;
    if (count == 0) sum_m += x_m - begin_m;
  }
  return sum_m;
}

/// Between two levels every edge is straight and none crosses another, so that the middle line
/// tells the mean width.
std::optional<double> area_by_levels_m2(const std::vector<MapPolygon>& polygons) {
  const auto edges = edges_of(polygons);
  std::size_t looks = 0;
  const auto levels = levels_of(edges, looks);
  if (!levels) return std::nullopt;
  double sum_m2 = 0;
  std::vector<const Edge*> there;
  auto next = edges.begin();
  for (std::size_t i = 0; i + 1 < levels->size(); ++i) {
    const double low_m = (*levels)[i];
    const double high_m = (*levels)[i + 1];
    std::erase_if(there, [low_m](const Edge* edge) { return edge->high.y_m <= low_m; });
    for (; next != edges.end() && next->low.y_m <= low_m; ++next) there.push_back(&*next);
    looks += there.size() + polygons.size() / 8;
    if (looks > kMostLooks) return std::nullopt;
    sum_m2 += (high_m - low_m) * covered_m(there, (low_m + high_m) / 2, polygons.size());
  }
  return sum_m2;
}

}  // namespace

double united_area_m2(const std::vector<MapPolygon>& polygons) {
  if (polygons.size() > 1)
    if (const auto area_m2 = area_by_levels_m2(polygons)) return *area_m2;
  double sum_m2 = 0;
  for (const MapPolygon& polygon : polygons) sum_m2 += area_m2(polygon);
  return sum_m2;
}

}  // namespace drover::scene
