// Shapes: what each must have to be one.
#include <array>
#include <cmath>

#include "scene/message/check.h"
#include "scene/message/validate.h"
#include "text/number.h"

namespace drover::scene::check {
namespace {

struct Kind {
  std::uint8_t type;
  std::size_t dimensions;
  const char* in_words;
};

constexpr std::array kKinds = {
    Kind{SolidPrimitive::BOX, 3, "BOX has 3 dimensions: x, y, z"},
    Kind{SolidPrimitive::SPHERE, 1, "SPHERE has 1 dimension: the radius"},
    Kind{SolidPrimitive::CYLINDER, 2, "CYLINDER has 2 dimensions: height, radius"},
    Kind{SolidPrimitive::CONE, 2, "CONE has 2 dimensions: height, radius"},
};

const Kind* kind_of(const SolidPrimitive& primitive) {
  for (const Kind& kind : kKinds)
    if (kind.type == primitive.type) return &kind;
  return nullptr;
}

Problem primitive(const std::string& path, const SolidPrimitive& primitive) {
  const Kind* kind = kind_of(primitive);
  if (kind == nullptr) {
    return Refusal{member(path, "type"), "is " + std::to_string(primitive.type) +
                                             ": it must be BOX 1, SPHERE 2, CYLINDER 3 or CONE 4"};
  }
  const std::string dimensions = member(path, "dimensions");
  if (primitive.dimensions.size() != kind->dimensions) {
    return Refusal{dimensions, "has " +
                                   text::counted(primitive.dimensions.size(), "number", "numbers") +
                                   ": " + kind->in_words};
  }
  for (std::size_t i = 0; i < primitive.dimensions.size(); ++i) {
    const double size_m = primitive.dimensions[i];
    if (size_m >= kMinSize_m && size_m <= kMaxSize_m) continue;
    const std::string what =
        std::isfinite(size_m) ? "is " + text::number_text(size_m) : "is no finite number";
    return Refusal{element(dimensions, i), what + ": it must be from " +
                                               text::number_text(kMinSize_m) + " to " +
                                               text::number_text(kMaxSize_m) + " m"};
  }
  return std::nullopt;
}

Problem mesh(const std::string& path, const Mesh& mesh) {
  if (mesh.triangles.empty()) return Refusal{member(path, "triangles"), "has no triangle"};
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vector3& v = mesh.vertices[i];
    const bool good = std::abs(v.x) <= kMaxCoordinate_m && std::abs(v.y) <= kMaxCoordinate_m &&
                      std::abs(v.z) <= kMaxCoordinate_m;
    if (!good) return position(element(member(path, "vertices"), i), v);
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t index = mesh.triangles[i][corner];
      if (index < mesh.vertices.size()) continue;
      const std::string place = element(member(path, "triangles"), i) + ".vertex_indices";
      return Refusal{element(place, corner), "is " + std::to_string(index) + ": there are " +
                                                 std::to_string(mesh.vertices.size()) +
                                                 " vertices, counted from 0"};
    }
  }
  return std::nullopt;
}

Problem plane(const std::string& path, const Plane& plane) {
  const std::string coef = member(path, "coef");
  for (std::size_t i = 0; i < plane.coef.size(); ++i)
    if (!std::isfinite(plane.coef[i])) return Refusal{element(coef, i), "is no finite number"};
  constexpr double kLeast = 1e-9;
  constexpr double kMost = 1e9;
  const double normal = std::hypot(plane.coef[0], plane.coef[1], plane.coef[2]);
  if (normal == 0) return Refusal{coef, "has no direction: a, b and c are all 0"};
  if (!(normal >= kLeast && normal <= kMost)) {
    return Refusal{coef, "a, b and c have the length " + text::number_text(normal) +
                             ": it must be from 1e-9 to 1e9"};
  }
  const double away_m = plane.coef[3] / normal;
  if (std::abs(away_m) <= kMaxCoordinate_m) return std::nullopt;
  return Refusal{element(coef, 3), "is too far away: " + text::number_text(std::abs(away_m)) +
                                       " m from the origin of the frame, at most " +
                                       text::number_text(kMaxCoordinate_m) + " are allowed"};
}

Problem too_many(const std::string& path, std::size_t count, std::size_t most, const char* what) {
  if (count <= most) return std::nullopt;
  return Refusal{path, "has " + std::to_string(count) + " " + what + ", at most " +
                           std::to_string(most) + " are allowed in a message"};
}

}  // namespace

Problem primitives(const std::string& path, const std::vector<SolidPrimitive>& primitives) {
  if (auto problem = too_many(path, primitives.size(), kMaxShapes, "primitives")) return problem;
  for (std::size_t i = 0; i < primitives.size(); ++i)
    if (auto problem = primitive(element(path, i), primitives[i])) return problem;
  return std::nullopt;
}

Problem meshes(const std::string& path, const std::vector<Mesh>& meshes) {
  if (auto problem = too_many(path, meshes.size(), kMaxShapes, "meshes")) return problem;
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  for (const Mesh& each : meshes) {
    triangles += each.triangles.size();
    vertices += each.vertices.size();
  }
  if (auto problem = too_many(path, triangles, kMaxTriangles, "triangles")) return problem;
  if (auto problem = too_many(path, vertices, kMaxVertices, "vertices")) return problem;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    if (auto problem = mesh(element(path, i), meshes[i])) return problem;
  return std::nullopt;
}

Problem planes(const std::string& path, const std::vector<Plane>& planes) {
  if (auto problem = too_many(path, planes.size(), kMaxShapes, "planes")) return problem;
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (auto problem = plane(element(path, i), planes[i])) return problem;
  return std::nullopt;
}

}  // namespace drover::scene::check
