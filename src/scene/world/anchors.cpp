#include "scene/world/anchors.h"

#include <cmath>

#include "drover/rotation.h"
#include "scene/message/check.h"
#include "scene/world/place.h"
#include "scene/world/rigid.h"
#include "scene/world/words.h"

namespace drover::scene {
namespace {

/// All zero is what a client sends that set none.
Quaternion set_turn(const Quaternion& q) {
  const bool unset = q.w == 0 && q.x == 0 && q.y == 0 && q.z == 0;
  return unset ? Quaternion{} : normalised(q);
}

bool is_near_enough(const Vector3& at) {
  return std::abs(at.x) <= kFarthest_m && std::abs(at.y) <= kFarthest_m &&
         std::abs(at.z) <= kFarthest_m;
}

}  // namespace

std::optional<Refusal> anchor_all(const std::vector<Pose>& poses, std::string_view list,
                                  const Ground& ground, std::vector<Anchor>& anchors) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose own{poses[i].position_m, set_turn(poses[i].orientation)};
    const Pose pose = rigid::product(ground.frame, own);
    if (!rigid::is_finite(pose)) return Refusal{check::element(std::string(list), i), "not finite"};
    if (!is_near_enough(pose.position_m))
      return Refusal{
          check::element(std::string(list), i) + ".position",
          "farther than " + words::number(kFarthest_m / 1000, 0) + " km from the origin of map"};
    anchors.push_back({pose, ground.origin});
  }
  return std::nullopt;
}

}  // namespace drover::scene
