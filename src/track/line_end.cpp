// How a recorded line ends.
#include "track/line_end.h"

#include <algorithm>
#include <array>
#include <span>

#include "drover/angle.h"

namespace drover::track {
namespace {

constexpr double kMost_m = 4;
constexpr double kLeast_m = 1;
constexpr double kApart_m = 0.1;
constexpr std::size_t kFewest = 4;
// Of an arc, rms.
constexpr double kNoise_m = 0.014;
constexpr double kMostBeside_m = 0.03;  // where there is none so near: a chord is farther off
constexpr int kIterations = 5;

/// A point of the route, so far back from its last one, along it.
struct Mark {
  Vector place;
  double back_m = 0;
};
using Marks = std::span<const Mark>;

/// The last points of the route, none before `first`, each `kApart_m` from the next at least: how
/// many there are. Points, and nothing between them: a chord lies on the inner side of a bend.
std::size_t mark_back(const Route& route, std::size_t first, std::span<Mark> marks) {
  std::size_t count = 0;
  double back_m = 0;
  for (std::size_t k = route.size() - 1; count < marks.size() && back_m <= kMost_m; --k) {
    if (count == 0 || back_m - marks[count - 1].back_m >= kApart_m)
      marks[count++] = {route.point(k), back_m};
    if (k == first) break;
    back_m += route.segment_m(k - 1);
  }
  return count;
}

Vector towards(double direction_rad) {
  return {std::cos(direction_rad), std::sin(direction_rad)};
}

/// An arc, or a straight line, by its last point.
struct Arc {
  Vector end;
  double direction_rad = 0;
  double curvature_radpm = 0;

  /// How far left of it a place is that lies so far back along it.
  double left_m(const Mark& mark) const {
    const double turned_rad = curvature_radpm * mark.back_m;
    const Vector there =
        end - chord_m(mark.back_m, turned_rad) * towards(direction_rad - turned_rad / 2);
    return cross(towards(direction_rad - turned_rad), mark.place - there);
  }
};

/// By what an arc misses places: aside, turned and bent, by least squares.
struct Miss {
  double aside_m = 0;
  double turned_rad = 0;
  double bent_radpm = 0;
};

Miss miss(const Arc& arc, Marks marks) {
  double s1 = 0, s2 = 0, s3 = 0, s4 = 0;
  double e0 = 0, e1 = 0, e2 = 0;
  for (const Mark& mark : marks) {
    const double s = -mark.back_m;
    const double e = arc.left_m(mark);
    s1 += s;
    s2 += s * s;
    s3 += s * s * s;
    s4 += s * s * s * s;
    e0 += e;
    e1 += s * e;
    e2 += s * s * e;
  }
  // Cramer's rule; of three places and more it always has an answer.
  const auto n = static_cast<double>(marks.size());
  const double c00 = s2 * s4 - s3 * s3, c01 = s2 * s3 - s1 * s4, c02 = s1 * s3 - s2 * s2;
  const double c11 = n * s4 - s2 * s2, c12 = s1 * s2 - n * s3, c22 = n * s2 - s1 * s1;
  const double per = 1 / (n * c00 + s1 * c01 + s2 * c02);
  return {per * (c00 * e0 + c01 * e1 + c02 * e2), per * (c01 * e0 + c11 * e1 + c12 * e2),
          2 * per * (c02 * e0 + c12 * e1 + c22 * e2)};
}

Arc fit(Marks marks) {
  const Vector way = marks.front().place - marks.back().place;
  Arc arc{marks.front().place, std::atan2(way.y, way.x), 0};
  for (int i = 0; i < kIterations; ++i) {
    const Miss by = miss(arc, marks);
    arc.end = arc.end + by.aside_m * towards(arc.direction_rad + kPi / 2);
    arc.direction_rad += by.turned_rad;
    arc.curvature_radpm += by.bent_radpm;
  }
  return arc;
}

double rms_beside_m(const Arc& arc, Marks marks) {
  double sum_m2 = 0;
  for (const Mark& mark : marks) sum_m2 += arc.left_m(mark) * arc.left_m(mark);
  return std::sqrt(sum_m2 / static_cast<double>(marks.size()));
}

}  // namespace

std::optional<LineEnd> line_end(const Route& route, std::size_t first) {
  std::array<Mark, static_cast<std::size_t>(kMost_m / kApart_m) + 1> all;
  std::optional<LineEnd> longest;
  for (Marks marks(all.data(), mark_back(route, first, all));
       marks.size() >= kFewest && marks.back().back_m >= kLeast_m;
       marks = marks.first(marks.size() - 1)) {
    const Arc arc = fit(marks);
    const double beside_m = rms_beside_m(arc, marks);
    const LineEnd end{arc.end, towards(arc.direction_rad), arc.curvature_radpm};
    if (beside_m <= kNoise_m) return end;
    if (beside_m <= kMostBeside_m && !longest) longest = end;
  }
  return longest;
}

}  // namespace drover::track
