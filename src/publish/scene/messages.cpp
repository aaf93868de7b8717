// The third document's messages from JSON: one, or a list of them.
#include "publish/scene/messages.h"

#include <array>
#include <cmath>
#include <utility>

#include "publish/scene/reader.h"
#include "publish/scene/words.h"
#include "text/trimmed.h"

namespace drover::publish {
namespace scene_json {
namespace {

bool is_zero(const Vector3& vector) {
  return vector.x == 0 && vector.y == 0 && vector.z == 0;
}

/// All zero is no turn, too: it is what is sent by who sets nothing.
bool is_no_turn(const Quaternion& turn) {
  return turn.x == 0 && turn.y == 0 && turn.z == 0;
}

/// What an answer names it by, whether the rest can be read or not.
std::string shown_name(const Node& message, std::string_view field) {
  const Node* node = message.find(field);
  if (node == nullptr || node->text() == nullptr) return {};
  return json::shown(*node->text(), scene::kMaxNameBytes);
}

/// As read_integer takes it.
std::uint32_t shown_seq(const Node& message) {
  const Node* header = message.find("header");
  const Node* seq = header == nullptr ? nullptr : header->find("seq");
  const auto number = seq == nullptr ? std::nullopt : seq->number();
  const bool fits =
      number && *number >= 0 && *number <= 0xFFFF'FFFF && std::trunc(*number) == *number;
  return fits ? static_cast<std::uint32_t>(*number) : 0;
}

std::string shown_operation(const Node& message) {
  const Node* node = message.find("operation");
  if (node == nullptr) return std::string(operation_word(scene::CollisionObject::ADD));
  const auto number = node->number().value_or(-1);
  for (std::uint8_t each = 0; each <= scene::CollisionObject::MOVE; ++each)
    if (number == each) return std::string(operation_word(each));
  return {};
}

template <class Message>
Result<scene::Accepted<Message>, scene::Refusal> judged(const Node& node) {
  Reading reading;
  Message message;
  read(node, Path{}, reading, message);
  if (reading.problem) return *reading.problem;
  auto accepted = scene::validate(std::move(message));
  if (!accepted.ok()) return accepted;
  for (const std::string& note : accepted->notes) scene::check::note(reading.notes, note);
  accepted.value().notes = std::move(reading.notes);
  return accepted;
}

SceneMessage<scene::CollisionObject> one(const Node& node, const scene::CollisionObject&) {
  return {shown_name(node, "id"), shown_seq(node), shown_operation(node),
          judged<scene::CollisionObject>(node)};
}

SceneMessage<scene::Constraints> one(const Node& node, const scene::Constraints&) {
  return {shown_name(node, "name"), 0, {}, judged<scene::Constraints>(node)};
}

template <class Message>
Result<SceneMessages<Message>, scene::Refusal> parse(std::string_view payload, Retain retain,
                                                     const SceneLimits& limits) {
  SceneMessages<Message> all;
  payload = text::without_end_of_string(payload);
  if (payload.empty()) return all;
  if (retain != Retain::no)
    return scene::Refusal{"", "the message was retained by the broker: publish without retain"};
  const auto parsed = json::parse(payload, {limits.max_bytes, limits.max_depth, limits.max_values});
  if (!parsed.ok()) {
    auto error = parsed.error();
    const std::string path = std::exchange(error.path, {});
    return scene::Refusal{path, error.text()};
  }
  const Node& root = parsed->root;
  if (root.list() == nullptr) {
    if (root.object() == nullptr)
      return scene::Refusal{"",
                            "must be a message or a list of them, not " + std::string(root.kind())};
    all.messages.push_back(one(root, Message{}));
    return all;
  }
  all.is_list = true;
  if (root.list()->size() > limits.max_messages)
    return scene::Refusal{"", "has " + std::to_string(root.list()->size()) + " messages, at most " +
                                  std::to_string(limits.max_messages) + " are allowed in a list"};
  for (const Node& node : *root.list()) all.messages.push_back(one(node, Message{}));
  return all;
}

}  // namespace

void refuse_later_meaning(const Node& object, const Path& path, Reading& reading,
                          const scene::CollisionObject& message) {
  const Node* node = object.find("pose");
  if (node == nullptr || message.operation == scene::CollisionObject::REMOVE) return;
  const Path place{&path, "pose"};
  scene::Pose pose;
  read(*node, place, reading, pose);
  if (reading.problem || (is_zero(pose.position_m) && is_no_turn(pose.orientation))) return;
  reading.refuse(place,
                 "is of ROS 2, where shapes are placed about it: it must be absent or no move; "
                 "add it to the poses of the shapes");
}

void refuse_later_meaning(const Node& object, const Path& path, Reading& reading,
                          const scene::OrientationConstraint&) {
  const Node* node = object.find("parameterization");
  if (node == nullptr || node->number() == 0) return;
  reading.refuse(Path{&path, "parameterization"},
                 "is of ROS 2: it must be absent or 0, the angles about x, y and z");
}

}  // namespace scene_json

Result<SceneMessages<scene::CollisionObject>, scene::Refusal> parse_collision_objects(
    std::string_view payload, Retain retain, const SceneLimits& limits) {
  return scene_json::parse<scene::CollisionObject>(payload, retain, limits);
}

Result<SceneMessages<scene::Constraints>, scene::Refusal> parse_planning_constraints(
    std::string_view payload, Retain retain, const SceneLimits& limits) {
  return scene_json::parse<scene::Constraints>(payload, retain, limits);
}

}  // namespace drover::publish
