// Values of fields.h from JSON. What is absent stays as it is; the first problem ends the reading.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "json/located_json.h"
#include "publish/scene/fields.h"
#include "scene/message/check.h"
#include "scene/message/validate.h"
#include "text/number.h"

namespace drover::publish::scene_json {

using json::Node;

/// Where a value stands; spelled out only when something is to be said of it.
struct Path {
  static constexpr std::size_t kNoIndex = std::numeric_limits<std::size_t>::max();
  const Path* parent = nullptr;
  std::string_view name{};
  std::size_t index = kNoIndex;

  std::string text() const {
    const std::string before = parent == nullptr ? "" : parent->text();
    if (index != kNoIndex) return scene::check::element(before, index);
    return name.empty() ? before : scene::check::member(before, name);
  }
};

struct Reading {
  std::optional<scene::Refusal> problem{};
  scene::check::Notes notes{};

  void refuse(const Path& path, const std::string& why) {
    if (!problem) problem = scene::Refusal{path.text(), why};
  }
  void expect(const Path& path, const std::string& what, const Node& node) {
    refuse(path, "must be " + what + ", not " + std::string(node.kind()));
  }
};

template <class Value>
void read(const Node& node, const Path& path, Reading& reading, Value& value);

/// Takes the fields of one object.
class FieldReader {
 public:
  FieldReader(const Node& object, const Path& path, Reading& reading)
      : object_(object), path_(path), reading_(reading) {}

  void operator()(const Name& name, auto&& value) {
    const Node* node = nullptr;
    const Path path{&path_, name.spellings[0]};
    for (const std::string_view spelling : name.spellings) {
      const Node* found = spelling.empty() ? nullptr : object_.find(spelling);
      if (found == nullptr) continue;
      ++known_;
      if (node != nullptr)
        reading_.refuse(path, "is there twice, the second time as " + std::string(spelling));
      node = found;
    }
    if (node != nullptr && !reading_.problem) read(*node, path, reading_, value);
  }
  std::size_t known() const { return known_; }

 private:
  const Node& object_;
  const Path& path_;
  Reading& reading_;
  std::size_t known_ = 0;
};

/// The names of a message that `object` has and the message has not.
template <class Message>
void note_unknown(const Node& object, const Path& path, Reading& reading, Message& message) {
  std::vector<std::string_view> known;
  fields(message, [&known](const Name& name, auto&&) {
    known.insert(known.end(), name.spellings.begin(), name.spellings.end());
  });
  for (const json::Member& member : *object.object()) {
    bool found = false;
    for (const std::string_view name : known) found = found || member.key == name;
    if (found && !member.key.empty()) continue;
    const std::string shown = member.key.empty() ? "\"\"" : json::shown(member.key, 40);
    scene::check::note(reading.notes, scene::check::member(path.text(), shown), "unknown, ignored");
  }
}

// Fields of later editions that turn the meaning of the others around; elsewhere there are none.
template <class Message>
void refuse_later_meaning(const Node&, const Path&, Reading&, const Message&) {}
void refuse_later_meaning(const Node& object, const Path& path, Reading& reading,
                          const scene::CollisionObject& message);
void refuse_later_meaning(const Node& object, const Path& path, Reading& reading,
                          const scene::OrientationConstraint& message);

template <class Message>
void read_message(const Node& node, const Path& path, Reading& reading, Message& message) {
  if (node.object() == nullptr) return reading.expect(path, "an object", node);
  FieldReader reader(node, path, reading);
  fields(message, reader);
  if (reading.problem) return;
  refuse_later_meaning(node, path, reading, message);
  if (reader.known() < node.object()->size()) note_unknown(node, path, reading, message);
}

/// Programs that know no integers send 2.0.
template <class Integer>
void read_integer(const Node& node, const Path& path, Reading& reading, Integer& value) {
  constexpr auto kLeast = std::numeric_limits<Integer>::min();
  constexpr auto kMost = std::numeric_limits<Integer>::max();
  const auto number = node.number();
  if (!number) return reading.expect(path, "an integer", node);
  if (*number >= kLeast && *number <= kMost && std::trunc(*number) == *number) {
    value = static_cast<Integer>(*number);
    return;
  }
  reading.refuse(
      path, "must be an integer from " + std::to_string(kLeast) + " to " + std::to_string(kMost));
}

template <class Element>
void read_elements(const std::vector<Node>& nodes, const Path& path, Reading& reading,
                   std::span<Element> elements) {
  for (std::size_t i = 0; i < elements.size() && !reading.problem; ++i)
    read(nodes[i], Path{&path, {}, i}, reading, elements[i]);
}

template <class Element>
void read_list(const Node& node, const Path& path, Reading& reading, std::vector<Element>& list) {
  if (node.list() == nullptr) return reading.expect(path, "a list", node);
  // No list of any message may be longer: room for elements is not taken before they are read.
  if (node.list()->size() > scene::kMaxVertices) {
    return reading.refuse(path, "has " + std::to_string(node.list()->size()) +
                                    " elements, at most " + std::to_string(scene::kMaxVertices) +
                                    " are allowed");
  }
  list.assign(node.list()->size(), Element{});
  read_elements(*node.list(), path, reading, std::span(list));
}

/// As many as there is room for.
template <class Element, std::size_t size>
void read_list(const Node& node, const Path& path, Reading& reading,
               const std::span<Element, size>& list) {
  if (node.list() == nullptr) return reading.expect(path, "a list", node);
  if (node.list()->size() != size) {
    return reading.refuse(path, "has " + text::counted(node.list()->size(), "number", "numbers") +
                                    ": it must have " + std::to_string(size));
  }
  read_elements(*node.list(), path, reading, std::span<Element>(list));
}

template <class Value>
void read(const Node& node, const Path& path, Reading& reading, Value& value) {
  if constexpr (std::same_as<Value, double>) {
    if (!node.number()) return reading.expect(path, "a number", node);
    value = *node.number();
  } else if constexpr (std::integral<Value>) {
    read_integer(node, path, reading, value);
  } else if constexpr (std::same_as<Value, std::string>) {
    if (node.text() == nullptr) return reading.expect(path, "a text", node);
    value = *node.text();
  } else if constexpr (requires { read_list(node, path, reading, value); }) {
    read_list(node, path, reading, value);
  } else {
    // Of an orientation that is there the absent numbers are 0; one that is not there is no turn.
    if constexpr (std::same_as<Value, Quaternion>) value = {0, 0, 0, 0};
    read_message(node, path, reading, value);
  }
}

}  // namespace drover::publish::scene_json
