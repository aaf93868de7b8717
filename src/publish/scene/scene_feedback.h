// The `scene_feedback` topic: an answer to each message of the planning scene.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "publish/scene/messages.h"
#include "scene/message/refusal.h"

namespace drover::publish {

inline constexpr std::string_view kTopicSceneFeedback = "scene_feedback";

struct SceneAnswer {
  std::string_view topic;  ///< of what is answered
  std::string name{};      ///< the object's id, the constraints' name
  std::uint32_t seq = 0;   ///< of its header; 0: none
  std::string operation{};
  std::optional<scene::Refusal> refusal{};  ///< nothing: it is done
  std::vector<std::string> notes{};
};

/// What the message alone gives. Who follows it adds why that was not possible.
SceneAnswer answer_to(const SceneMessage<scene::CollisionObject>& message);
SceneAnswer answer_to(const SceneMessage<scene::Constraints>& message);
/// To a payload of which no message could be read.
SceneAnswer answer_to(std::string_view topic, scene::Refusal refusal);

/// Of one that is refused: "collision_object 'box1': primitives: why".
std::string refusal_in_words(const SceneAnswer& answer);

/// One object, or a list of them in the order of what is answered.
std::string scene_feedback_text(const SceneAnswer& answer);
std::string scene_feedback_text(std::span<const SceneAnswer> answers);

}  // namespace drover::publish
