// The third document's messages as JSON: text in, checked values or a refusal each, and text out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drover/result.h"
#include "json/json_text.h"
#include "publish/arrival.h"
#include "scene/message/validate.h"

namespace drover::publish {

inline constexpr std::string_view kTopicCollisionObject = "collision_object";
inline constexpr std::string_view kTopicPlanningConstraints = "planning_constraints";

struct SceneLimits {
  std::size_t max_bytes = std::size_t{2} << 20;
  std::size_t max_depth = 10;        ///< what the deepest message needs, in a list
  std::size_t max_values = 300'000;  ///< ten thousand triangles have 170 000
  std::size_t max_messages = 1000;
};

/// Of what was stored by us: an object is a list of messages (scene::in_messages), in sum as large
/// as the scene may be, and every field is written out.
inline constexpr SceneLimits kStoredSceneLimits{std::size_t{48} << 20, 10, 3'000'000, 1000};

/// One message of a payload, and what can be said of it although it may be refused.
template <class Message>
struct SceneMessage {
  std::string name;         ///< the object's id, the constraints' name; as it may be shown
  std::uint32_t seq = 0;    ///< of its header; 0: none
  std::string operation{};  ///< "ADD" and so on; empty: unknown, or it has none
  Result<scene::Accepted<Message>, scene::Refusal> result;
};

template <class Message>
struct SceneMessages {
  bool is_list = false;  ///< it came as a list, though of one
  std::vector<SceneMessage<Message>> messages;
};

/// Each message of a list is judged by itself. The whole is refused when it is no JSON, beyond the
/// limits, neither an object nor a list of them, or retained. An empty payload, which takes a
/// retained one back, is no message.
Result<SceneMessages<scene::CollisionObject>, scene::Refusal> parse_collision_objects(
    std::string_view payload, Retain retain, const SceneLimits& limits = {});
Result<SceneMessages<scene::Constraints>, scene::Refusal> parse_planning_constraints(
    std::string_view payload, Retain retain, const SceneLimits& limits = {});

/// Every field, in the document's order; read again it gives the same value to the bit. An object
/// that APPENDs made larger than a message is written as scene::in_messages gives it.
void write_scene(json::JsonText& out, const scene::CollisionObject& object);
void write_scene(json::JsonText& out, const scene::Constraints& constraints);

}  // namespace drover::publish
