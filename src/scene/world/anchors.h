// Poses of a message, placed one by one; the first that cannot be is named.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "scene/message/refusal.h"
#include "scene/world/object.h"
#include "scene/world/sighting.h"

namespace drover::scene {

/// `frame` is the header's frame in the map about `origin`.
struct Ground {
  Pose frame;
  GeodeticPoint origin;
  Sighting seen{};
};

/// One anchor for each of `poses`, appended to `anchors`. `list` names the poses in the message.
/// What is nowhere in `map`, or beyond kFarthest_m, is refused; then `anchors` says nothing.
std::optional<Refusal> anchor_all(const std::vector<Pose>& poses, std::string_view list,
                                  const Ground& ground, std::vector<Anchor>& anchors);

}  // namespace drover::scene
