#include "publish/scene/scene_feedback.h"

#include <utility>

#include "json/located_json.h"

namespace drover::publish {
namespace scene_json {
namespace {

/// Reasons quote what came, which may be long.
constexpr std::size_t kMaxTextBytes = 300;

template <class Message>
SceneAnswer answer(std::string_view topic, const SceneMessage<Message>& message) {
  SceneAnswer out{topic, message.name, message.seq, message.operation, {}, {}};
  if (message.result.ok()) {
    out.notes = message.result->notes;
  } else {
    out.refusal = message.result.error();
  }
  return out;
}

void write_answer(json::JsonText& out, const SceneAnswer& answer) {
  out.open('{').key("topic").text(answer.topic);
  const bool object = answer.topic == kTopicCollisionObject;
  if (!answer.name.empty()) out.key(object ? "id" : "name").text(answer.name);
  if (answer.seq != 0) out.key("seq").integer(answer.seq);
  if (!answer.operation.empty()) out.key("operation").text(answer.operation);
  out.key("result").text(answer.refusal ? "refused" : "done");
  if (answer.refusal) {
    if (!answer.refusal->path.empty())
      out.key("path").text(json::shown(answer.refusal->path, kMaxTextBytes));
    out.key("reason").text(json::shown(answer.refusal->why, kMaxTextBytes));
  }
  if (!answer.notes.empty()) {
    out.key("notes").open('[');
    for (const std::string& note : answer.notes) out.text(json::shown(note, kMaxTextBytes));
    out.close(']');
  }
  out.close('}');
}

}  // namespace
}  // namespace scene_json

SceneAnswer answer_to(const SceneMessage<scene::CollisionObject>& message) {
  return scene_json::answer(kTopicCollisionObject, message);
}

SceneAnswer answer_to(const SceneMessage<scene::Constraints>& message) {
  return scene_json::answer(kTopicPlanningConstraints, message);
}

SceneAnswer answer_to(std::string_view topic, scene::Refusal refusal) {
  SceneAnswer out{.topic = topic};
  out.refusal = std::move(refusal);
  return out;
}

std::string refusal_in_words(const SceneAnswer& answer) {
  constexpr std::size_t kMostBytes = 300;
  std::string words(answer.topic);
  if (!answer.name.empty()) words += " '" + answer.name + "'";
  if (!answer.refusal->path.empty()) words += ": " + json::shown(answer.refusal->path, kMostBytes);
  return words + ": " + json::shown(answer.refusal->why, kMostBytes);
}

std::string scene_feedback_text(const SceneAnswer& answer) {
  json::JsonText out;
  scene_json::write_answer(out, answer);
  return out.take();
}

std::string scene_feedback_text(std::span<const SceneAnswer> answers) {
  json::JsonText out;
  out.open('[');
  for (const SceneAnswer& answer : answers) scene_json::write_answer(out, answer);
  out.close(']');
  return out.take();
}

}  // namespace drover::publish
