// Upright things that a scenario puts in the robot's way.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drover::sim {

/// In the world's frame; what does not belong to its kind is 0.
struct Solid {
  enum class Kind { box, cylinder, sphere, cone, prism };
  Kind kind = Kind::box;
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;  ///< of the middle of its height
  double yaw_rad = 0;
  double length_m = 0;  ///< box: along its own x
  double width_m = 0;   ///< box: along its own y
  double height_m = 0;  ///< of all but the sphere
  double radius_m = 0;  ///< of the cone: at its foot; its tip is up
  /// Prism: a convex polygon about x and y, counter-clockwise, before it is turned by the yaw.
  std::vector<std::array<double, 2>> corners_m;

  bool operator==(const Solid&) const = default;
};

/// As commands and records call it.
std::string_view word(Solid::Kind kind);
/// Nothing: there is no such solid.
std::optional<Solid::Kind> kind_of(std::string_view word);

inline constexpr std::size_t kMaxCorners = 16;

/// What is wrong with it, in words; empty: nothing.
std::string problem_of(const Solid& solid);

/// The whole height, of a sphere too.
double height_of(const Solid& solid);

}  // namespace drover::sim
