#include "scene/world/amount.h"

#include <array>
#include <string>

#include "scene/world/stored_bytes.h"

namespace drover::scene {
namespace {

struct Limited {
  std::size_t Amount::*count;
  const char* path;  ///< of the message
  const char* name;
};
constexpr std::array<Limited, 7> kLimited{{{&Amount::objects, "id", "objects"},
                                           {&Amount::constraints, "", "constraints"},
                                           {&Amount::shapes, "primitives", "shapes"},
                                           {&Amount::triangles, "meshes", "triangles"},
                                           {&Amount::vertices, "meshes", "vertices"},
                                           {&Amount::texts, "", "texts of the store"},
                                           {&Amount::bytes, "", "bytes of the store"}}};

void count_mesh(Amount& amount, const Mesh& mesh) {
  amount.triangles += mesh.triangles.size();
  amount.vertices += mesh.vertices.size();
}

}  // namespace

Amount amount_of_shapes(const Object& object) {
  Amount amount{.bytes = stored_bytes_of_shapes(object)};
  amount.shapes = object.primitives.size() + object.meshes.size() + object.planes.size();
  for (const auto& mesh : object.meshes) count_mesh(amount, mesh.shape);
  return amount;
}

Amount amount_of(const Object& object) {
  return sum(amount_of_shapes(object),
             {.objects = 1, .texts = 1, .bytes = stored_bytes_of_head(object)});
}

Amount amount_of(const Constraints& set) {
  Amount amount{.texts = 1, .bytes = stored_bytes(set)};
  amount.constraints = set.joint_constraints.size() + set.position_constraints.size() +
                       set.orientation_constraints.size() + set.visibility_constraints.size();
  for (const PositionConstraint& position : set.position_constraints) {
    const BoundingVolume& region = position.constraint_region;
    amount.shapes += region.primitives.size() + region.meshes.size();
    for (const Mesh& mesh : region.meshes) count_mesh(amount, mesh);
  }
  return amount;
}

Amount sum(const Amount& a, const Amount& b) {
  Amount amount = a;
  for (const Limited& limited : kLimited) amount.*limited.count += b.*limited.count;
  return amount;
}

Amount without(const Amount& all, const Amount& part) {
  Amount amount = all;
  for (const Limited& limited : kLimited) amount.*limited.count -= part.*limited.count;
  return amount;
}

std::optional<Refusal> too_much(const Amount& there, const Amount& more) {
  for (const Limited& limited : kLimited) {
    const std::size_t before = there.*limited.count;
    const std::size_t added = more.*limited.count;
    const std::size_t most = kMost.*limited.count;
    if (added == 0 || before + added <= most) continue;
    return Refusal{limited.path, std::to_string(added) + " more " + limited.name + " beside " +
                                     std::to_string(before) + ": at most " + std::to_string(most) +
                                     " are kept"};
  }
  return std::nullopt;
}

}  // namespace drover::scene
