#include "sim/plant/solid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace drover::sim {
namespace {

constexpr double kLargest_m = 100;
constexpr std::pair<Solid::Kind, std::string_view> kSolidWords[] = {
    {Solid::Kind::box, "box"},
    {Solid::Kind::cylinder, "cylinder"},
    {Solid::Kind::sphere, "sphere"},
    {Solid::Kind::cone, "cone"},
    {Solid::Kind::prism, "prism"}};

bool is_length(double value_m) {
  return value_m > 0 && value_m <= kLargest_m;
}

bool is_convex(const std::vector<std::array<double, 2>>& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto& a = corners[i];
    const auto& b = corners[(i + 1) % n];
    const auto& c = corners[(i + 2) % n];
    if (!((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) > 0)) return false;
  }
  return true;
}

}  // namespace

std::string_view word(Solid::Kind kind) {
  for (const auto& [each, name] : kSolidWords)
    if (each == kind) return name;
  return "";
}

std::optional<Solid::Kind> kind_of(std::string_view word) {
  for (const auto& [kind, name] : kSolidWords)
    if (name == word) return kind;
  return std::nullopt;
}

double height_of(const Solid& solid) {
  return solid.kind == Solid::Kind::sphere ? 2 * solid.radius_m : solid.height_m;
}

std::string problem_of(const Solid& solid) {
  using Kind = Solid::Kind;
  const bool round =
      solid.kind == Kind::cylinder || solid.kind == Kind::sphere || solid.kind == Kind::cone;
  for (const double place : {solid.x_m, solid.y_m, solid.z_m, solid.yaw_rad})
    if (!(std::abs(place) <= 1e4)) return "its place is no number, or too far away";
  if (!is_length(height_of(solid)) || (round && !is_length(solid.radius_m)) ||
      (solid.kind == Kind::box && !(is_length(solid.length_m) && is_length(solid.width_m))))
    return "its sizes must be above 0 and at most 100 m";
  if (solid.kind != Kind::prism) return "";
  if (solid.corners_m.size() < 3 || solid.corners_m.size() > kMaxCorners)
    return "a prism has 3 to 16 corners";
  if (std::any_of(solid.corners_m.begin(), solid.corners_m.end(), [](const auto& corner) {
        return !(std::hypot(corner[0], corner[1]) <= kLargest_m);
      }))
    return "a corner of the prism is too far away";
  return is_convex(solid.corners_m) ? "" : "the prism's corners must be convex, counter-clockwise";
}

}  // namespace drover::sim
