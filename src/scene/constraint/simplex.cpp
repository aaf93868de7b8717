#include "scene/constraint/simplex.h"

#include <cmath>
#include <limits>
#include <span>

#include "drover/rotation.h"

namespace drover::scene {
namespace {

constexpr double kFlat = 1e-10;  // sine of the angle under which a corner is no corner

/// Shares of the corners in the origin's foot on what they span; none when they are flat.
struct Foot {
  std::array<double, 4> shares{};
  bool exists = false;

  bool is_inside(std::size_t corners) const {
    if (!exists) return false;
    for (std::size_t i = 0; i < corners; ++i) {
      if (!(shares[i] >= 0)) return false;
    }
    return true;
  }
};

Foot foot_on_line(const Vector3& a, const Vector3& b) {
  const Vector3 ab = b - a;
  const double square = dot(ab, ab);
  if (!(square > 0)) return {};
  const double share = -dot(a, ab) / square;
  return {{1 - share, share}, true};
}

Foot foot_on_triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const Vector3 normal = cross(ab, ac);
  const double square = dot(normal, normal);
  if (!(square > kFlat * kFlat * dot(ab, ab) * dot(ac, ac))) return {};
  return {{dot(normal, cross(b, c)) / square, dot(normal, cross(c, a)) / square,
           dot(normal, cross(a, b)) / square},
          true};
}

Foot foot_in_tetrahedron(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const Vector3 ad = d - a;
  const double volume = dot(ab, cross(ac, ad));
  const double size = length(ab) * length(ac) * length(ad);
  if (!(std::abs(volume) > kFlat * size)) return {};
  const double of_b = -dot(a, cross(ac, ad)) / volume;
  const double of_c = -dot(ab, cross(a, ad)) / volume;
  const double of_d = -dot(ab, cross(ac, a)) / volume;
  return {{1 - of_b - of_c - of_d, of_b, of_c, of_d}, true};
}

Foot foot_on(std::span<const Vector3> corners) {
  switch (corners.size()) {
    case 1: return {{1}, true};
    case 2: return foot_on_line(corners[0], corners[1]);
    case 3: return foot_on_triangle(corners[0], corners[1], corners[2]);
    default: return foot_in_tetrahedron(corners[0], corners[1], corners[2], corners[3]);
  }
}

Vector3 at_shares(std::span<const Vector3> corners, const Foot& foot) {
  Vector3 point;
  for (std::size_t i = 0; i < corners.size(); ++i) point = point + foot.shares[i] * corners[i];
  return point;
}

}  // namespace

bool Simplex::add(const Vector3& corner) {
  for (std::size_t i = 0; i < size_; ++i) {
    const Vector3& there = corners_[i];
    if (there.x == corner.x && there.y == corner.y && there.z == corner.z) return false;
  }
  if (size_ == corners_.size()) return false;
  corners_[size_++] = corner;
  return true;
}

// Fifteen subsets at most: to try them all is slower than to walk through regions, and has no case
// that could be forgotten.
Simplex::Nearest Simplex::reduce_to_nearest() {
  std::array<Vector3, 4> best_corners{};
  std::size_t best_size = 0;
  Nearest best;
  double best_square = std::numeric_limits<double>::infinity();
  for (unsigned subset = 1; subset < 1U << size_; ++subset) {
    std::array<Vector3, 4> chosen{};
    std::size_t size = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      if ((subset >> i & 1U) != 0) chosen[size++] = corners_[i];
    }
    const std::span<const Vector3> corners(chosen.data(), size);
    const Foot foot = foot_on(corners);
    if (!foot.is_inside(size)) continue;
    const bool encloses = size == 4;
    const Vector3 point = encloses ? Vector3{} : at_shares(corners, foot);
    const double square = dot(point, point);
    if (square >= best_square) continue;
    best = {point, encloses};
    best_square = square;
    best_corners = chosen;
    best_size = size;
  }
  if (best_size > 0) {
    corners_ = best_corners;
    size_ = best_size;
  }
  return best;
}

}  // namespace drover::scene
