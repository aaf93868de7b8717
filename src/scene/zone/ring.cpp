// Rings as plane figures: in degrees that are scaled to metres.
#include "scene/zone/ring.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drover/angle.h"

namespace drover::scene {
namespace {

struct RingEdge {
  Point2 a, b;
  double left_m = 0, right_m = 0;
  std::size_t ring = 0, point = 0;  ///< where it begins
  std::size_t next = 0;             ///< where the edge after it begins
};

/// The points at which an edge of some length begins.
std::vector<std::size_t> beginnings(const std::vector<Point2>& ring) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (!(ring[i] == ring[(i + 1) % ring.size()])) found.push_back(i);
  }
  return found;
}

void append_edges(const std::vector<Point2>& ring, std::size_t number,
                  std::vector<RingEdge>& edges) {
  const auto begins = beginnings(ring);
  for (std::size_t i = 0; i < begins.size(); ++i) {
    const std::size_t at = begins[i];
    const Point2& a = ring[at];
    const Point2& b = ring[(at + 1) % ring.size()];
    edges.push_back({a, b, std::min(a.x_m, b.x_m), std::max(a.x_m, b.x_m), number, at,
                     begins[(i + 1) % begins.size()]});
  }
}

/// Twice the area of a triangle: its sign is the side of the line ab on which c lies.
double side_of_line(const Point2& a, const Point2& b, const Point2& c) {
  return cross(b - a, c - a);
}

bool in_box_of(const Point2& point, const Point2& a, const Point2& b) {
  return std::min(a.x_m, b.x_m) <= point.x_m && point.x_m <= std::max(a.x_m, b.x_m) &&
         std::min(a.y_m, b.y_m) <= point.y_m && point.y_m <= std::max(a.y_m, b.y_m);
}

bool have_a_common_point(const RingEdge& e, const RingEdge& f) {
  if (std::max(e.a.y_m, e.b.y_m) < std::min(f.a.y_m, f.b.y_m)) return false;
  if (std::max(f.a.y_m, f.b.y_m) < std::min(e.a.y_m, e.b.y_m)) return false;
  const double fa = side_of_line(e.a, e.b, f.a);
  const double fb = side_of_line(e.a, e.b, f.b);
  const double ea = side_of_line(f.a, f.b, e.a);
  const double eb = side_of_line(f.a, f.b, e.b);
  if (((fa > 0 && fb < 0) || (fa < 0 && fb > 0)) && ((ea > 0 && eb < 0) || (ea < 0 && eb > 0)))
    return true;
  return (fa == 0 && in_box_of(f.a, e.a, e.b)) || (fb == 0 && in_box_of(f.b, e.a, e.b)) ||
         (ea == 0 && in_box_of(e.a, f.a, f.b)) || (eb == 0 && in_box_of(e.b, f.a, f.b));
}

/// `second` goes on where `first` ends, along the same line and back.
bool folds_back(const RingEdge& first, const RingEdge& second) {
  return dot(first.b - first.a, second.b - second.a) < 0 &&
         side_of_line(first.a, first.b, second.b) == 0;
}

bool is_bad_pair(const RingEdge& e, const RingEdge& f) {
  const bool same = e.ring == f.ring;
  const bool e_then_f = same && e.next == f.point;
  const bool f_then_e = same && f.next == e.point;
  if (!e_then_f && !f_then_e) return have_a_common_point(e, f);
  return (e_then_f && folds_back(e, f)) || (f_then_e && folds_back(f, e));
}

}  // namespace

Point2 flat(const GeoPoint& point, const GeoPoint& zero) {
  const double narrow = std::cos(to_rad(zero.latitude_deg));
  return {(point.longitude_deg - zero.longitude_deg) * kMetresPerDegree * narrow,
          (point.latitude_deg - zero.latitude_deg) * kMetresPerDegree};
}

std::vector<Point2> flat(const GeoRing& ring, const GeoPoint& zero) {
  std::vector<Point2> points;
  points.reserve(ring.size());
  for (const GeoPoint& point : ring) points.push_back(flat(point, zero));
  return points;
}

double signed_area_m2(const std::vector<Point2>& ring) {
  double twice_m2 = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    twice_m2 += cross(ring[i], ring[(i + 1) % ring.size()]);
  }
  return twice_m2 / 2;
}

bool ring_contains(const Point2& point, const std::vector<Point2>& ring) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2& a = ring[i];
    const Point2& b = ring[(i + 1) % ring.size()];
    if ((a.y_m > point.y_m) == (b.y_m > point.y_m)) continue;
    const double cut_m = a.x_m + (point.y_m - a.y_m) / (b.y_m - a.y_m) * (b.x_m - a.x_m);
    if (point.x_m < cut_m) inside = !inside;
  }
  return inside;
}

std::optional<Crossing> find_crossing(const std::vector<std::vector<Point2>>& rings) {
  std::vector<RingEdge> edges;
  for (std::size_t i = 0; i < rings.size(); ++i) append_edges(rings[i], i, edges);
  std::stable_sort(edges.begin(), edges.end(),
                   [](const RingEdge& e, const RingEdge& f) { return e.left_m < f.left_m; });
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size() && edges[j].left_m <= edges[i].right_m; ++j) {
      if (!is_bad_pair(edges[i], edges[j])) continue;
      auto first = std::pair(edges[i].ring, edges[i].point);
      auto other = std::pair(edges[j].ring, edges[j].point);
      if (other < first) std::swap(first, other);
      return Crossing{first.first, first.second, other.first, other.second};
    }
  }
  return std::nullopt;
}

}  // namespace drover::scene
