// A mesh between two heights: its triangles, cut to the interval and seen from above, are walls.
// What is solid and touched by no wall is solid all the way from the lower height to the upper one,
// so one section of a closed mesh, at any height between, tells the rest: nothing is decomposed,
// concave stays concave.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "scene/plane/areas.h"
#include "scene/plane/motion3.h"
#include "scene/plane/section.h"

namespace drover::scene {
namespace {

using Triangle = std::array<const Vector3*, 3>;

bool is_judgeable(const Mesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [](const Vector3& v) { return is_finite(v); }) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const MeshTriangle& t) {
           return t[0] < count && t[1] < count && t[2] < count;
         });
}

/// For each vertex the first one that is at the same place: files of triangles repeat each corner.
std::vector<std::uint32_t> welded(const std::vector<Vector3>& vertices) {
  const auto place = [&](std::uint32_t i) {
    const Vector3& v = vertices[i];
    return std::tie(v.x, v.y, v.z);
  };
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return place(a) < place(b) || (place(a) == place(b) && a < b);
  });
  std::vector<std::uint32_t> first(vertices.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool again = k > 0 && place(order[k]) == place(order[k - 1]);
    first[order[k]] = again ? first[order[k - 1]] : order[k];
  }
  return first;
}

enum class Skin { open, closed, directed };

/// Closed: each side there an even number of times; directed: as often one way as the other.
Skin skin_of(const Mesh& mesh, const std::vector<std::uint32_t>& same) {
  struct Uses {
    int count = 0;
    int balance = 0;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Uses> sides;
  for (const MeshTriangle& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = same[triangle[i]];
      const std::uint32_t b = same[triangle[(i + 1) % 3]];
      if (a == b) continue;  // its other two sides are the same one, there and back
      Uses& uses = sides[std::minmax(a, b)];
      ++uses.count;
      uses.balance += a < b ? 1 : -1;
    }
  }
  Skin skin = Skin::directed;
  for (const auto& [side, uses] : sides) {
    if (uses.count % 2 != 0) return Skin::open;
    if (uses.balance != 0) skin = Skin::closed;
  }
  return skin;
}

/// The part of a triangle between the heights, seen from above; nothing for one that misses.
void add_wall(const Triangle& triangle, Heights heights, std::vector<Piece>& walls) {
  const auto [low, high] = std::minmax({triangle[0]->z, triangle[1]->z, triangle[2]->z});
  if (misses(low, high, heights)) return;
  std::vector<Point2> points;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3& a = *triangle[i];
    const Vector3& b = *triangle[(i + 1) % 3];
    if (a.z >= heights.low_m && a.z <= heights.high_m) points.push_back({a.x, a.y});
    for (const double height_m : {heights.low_m, heights.high_m})
      if ((a.z < height_m) != (b.z < height_m)) points.push_back(crossing(a, b, height_m));
  }
  walls.push_back(piece_of(std::move(points)));
}

/// Where the triangle crosses a height, with the inside of a directed mesh always on one hand.
void add_side(const Triangle& triangle, double height_m, std::vector<Side>& sides) {
  Side side;
  int ends = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3& a = *triangle[i];
    const Vector3& b = *triangle[(i + 1) % 3];
    if ((a.z < height_m) == (b.z < height_m)) continue;
    (a.z < height_m ? side.from : side.to) = crossing(a, b, height_m);
    ++ends;
  }
  if (ends == 2) sides.push_back(side);
}

/// Any height of the interval would do; this one is finite when the interval is not.
double height_of_section_m(const std::vector<Vector3>& vertices, Heights heights) {
  double lowest_m = heights.high_m;
  double highest_m = heights.low_m;
  for (const Vector3& v : vertices) {
    lowest_m = std::min(lowest_m, v.z);
    highest_m = std::max(highest_m, v.z);
  }
  return 0.5 * (std::clamp(lowest_m, heights.low_m, heights.high_m) +
                std::clamp(highest_m, heights.low_m, heights.high_m));
}

}  // namespace

Area area_of(const Mesh& mesh, const Pose& in_map, Heights heights) {
  const Motion3 motion = motion_of(in_map);
  if (!is_interval(heights) || !is_judgeable(mesh) || !is_finite(motion))
    return area_of_everything();
  const std::vector<std::uint32_t> same = welded(mesh.vertices);
  const Skin skin = skin_of(mesh, same);
  std::vector<Vector3> in_map_m;
  in_map_m.reserve(mesh.vertices.size());
  for (const Vector3& vertex : mesh.vertices) in_map_m.push_back(moved(motion, vertex));

  const double section_m = height_of_section_m(in_map_m, heights);
  std::vector<Piece> walls;
  Outline outline{{}, skin == Skin::directed};
  for (const MeshTriangle& t : mesh.triangles) {
    const Triangle triangle{&in_map_m[same[t[0]]], &in_map_m[same[t[1]]], &in_map_m[same[t[2]]]};
    add_wall(triangle, heights, walls);
    if (skin != Skin::open) add_side(triangle, section_m, outline.sides);
  }
  if (walls.empty()) return {};  // it ends where the interval begins
  Area area = area_of(std::move(walls));
  if (!outline.sides.empty()) area.outlines.push_back(std::move(outline));
  return area;
}

}  // namespace drover::scene
