#include "sim/robot/object_command.h"

#include <charconv>
#include <cmath>
#include <vector>

#include "drover/angle.h"

namespace drover::sim {
namespace {

using Numbers = std::vector<double>;

std::optional<Numbers> numbers(std::span<const std::string_view> words) {
  Numbers values;
  for (const auto word : words) {
    double value = 0;
    const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
    if (result.ec != std::errc{} || result.ptr != word.data() + word.size() ||
        !std::isfinite(value))
      return std::nullopt;
    values.push_back(value);
  }
  return values;
}

constexpr const char* kUsage =
    "error: say: obstacle NAME box X Y YAW_DEG LENGTH WIDTH HEIGHT [Z], cylinder|cone X Y RADIUS "
    "HEIGHT [Z], sphere X Y RADIUS [Z], prism X Y HEIGHT Z X1 Y1 X2 Y2 X3 Y3 ..., move X Y SPEED, "
    "or remove";

/// How many numbers it has at the least: a prism with its Z, the others without.
std::size_t least_count(Solid::Kind kind) {
  switch (kind) {
    case Solid::Kind::box: return 6;
    case Solid::Kind::cylinder:
    case Solid::Kind::cone:
    case Solid::Kind::prism: return 4;
    case Solid::Kind::sphere: return 3;
  }
  return 0;
}

/// From X Y on, with at least so many numbers.
Solid solid_of(Solid::Kind kind, const Numbers& n, const Plant& plant) {
  Solid solid;
  solid.kind = kind;
  solid.x_m = n[0];
  solid.y_m = n[1];
  std::optional<double> z_m;
  const auto with_z = [&](std::size_t at) {
    if (n.size() > at) z_m = n[at];
  };
  switch (kind) {
    case Solid::Kind::box:
      solid.yaw_rad = to_rad(n[2]);
      solid.length_m = n[3];
      solid.width_m = n[4];
      solid.height_m = n[5];
      with_z(6);
      break;
    case Solid::Kind::cylinder:
    case Solid::Kind::cone:
      solid.radius_m = n[2];
      solid.height_m = n[3];
      with_z(4);
      break;
    case Solid::Kind::sphere:
      solid.radius_m = n[2];
      with_z(3);
      break;
    case Solid::Kind::prism:
      solid.height_m = n[2];
      with_z(3);
      for (std::size_t i = 4; i + 1 < n.size(); i += 2) solid.corners_m.push_back({n[i], n[i + 1]});
      break;
  }
  solid.z_m = z_m.value_or(plant.ground_m(n[0], n[1]) + height_of(solid) / 2);
  return solid;
}

}  // namespace

bool is_object_command(std::span<const std::string_view> words) {
  return !words.empty() && (kind_of(words[0]) || words[0] == "move");
}

std::string command_object(Plant& plant, std::string_view name,
                           std::span<const std::string_view> words) {
  if (words.empty()) return kUsage;
  const auto unknown = [name] { return "error: there is no obstacle '" + std::string(name) + "'"; };
  if (words[0] == "remove") return plant.remove_object(name) ? "ok" : unknown();
  const auto values = numbers(words.subspan(1));
  if (!values) return kUsage;
  if (words[0] == "move") {
    if (values->size() != 3 || !((*values)[2] > 0)) return kUsage;
    return plant.move_object(name, (*values)[0], (*values)[1], (*values)[2]) ? "ok" : unknown();
  }
  const auto kind = kind_of(words[0]);
  if (!kind || values->size() < least_count(*kind)) return kUsage;
  const bool prism = *kind == Solid::Kind::prism;
  if (prism ? values->size() % 2 != 0 : values->size() > least_count(*kind) + 1) return kUsage;
  const auto problem = plant.put_object(name, solid_of(*kind, *values, plant));
  return problem.empty() ? "ok" : "error: obstacle " + std::string(name) + ": " + problem;
}

}  // namespace drover::sim
