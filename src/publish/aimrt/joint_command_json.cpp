// JointCommand from JSON, as protobuf's mapping reads it; refused are also keys that come twice.
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>

#include "json/located_json.h"
#include "publish/aimrt/joint_command.h"

namespace drover::publish::aimrt {

namespace {

using json::Node;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Digits alone, the whole text.
template <class Number>
std::optional<Number> number_in(const std::string& text) {
  const char* const end = text.data() + text.size();
  const bool begins = !text.empty() && (text[0] == '-' || (text[0] >= '0' && text[0] <= '9'));
  Number value{};
  const auto read = std::from_chars(text.data(), end, value);
  if (!begins || read.ec != std::errc{} || read.ptr != end) return std::nullopt;
  return value;
}

/// A number, or one in quotes; null stands for 0.
std::optional<double> real(const Node& node) {
  if (node.is_null()) return 0;
  const auto* text = node.text();
  if (text == nullptr) return node.number();
  if (*text == "NaN") return kNaN;
  if (*text == "Infinity") return kInfinity;
  if (*text == "-Infinity") return -kInfinity;
  const auto value = number_in<double>(*text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::uint64_t> whole(const Node& node) {
  if (node.is_null()) return 0;
  if (const auto* text = node.text()) return number_in<std::uint64_t>(*text);
  if (const auto* large = std::get_if<std::uint64_t>(&node.value)) return *large;
  if (const auto value = node.integer(); value && *value >= 0)
    return static_cast<std::uint64_t>(*value);
  // 1.0 and 1e3 are whole too.
  const auto value = node.number();
  if (!value || !(*value >= 0 && *value < 0x1p53) || *value != std::floor(*value))
    return std::nullopt;
  return static_cast<std::uint64_t>(*value);
}

std::optional<std::string> text_of(const Node& node) {
  if (node.is_null()) return std::string();
  return node.text() == nullptr ? std::nullopt : std::optional(*node.text());
}

/// The first problem of a message; the rest is not looked at.
class Reading {
 public:
  const std::string& problem() const { return problem_; }
  bool fail(const std::string& what) {
    if (problem_.empty()) problem_ = what;
    return false;
  }
  template <class Value>
  bool take(const std::optional<Value>& value, Value& into, const std::string& where,
            const char* kind) {
    if (!value) return fail(where + " is no " + kind);
    into = *value;
    return true;
  }
  /// False where `node` has no members to read.
  bool object(const Node& node, const std::string& where) {
    if (node.object() != nullptr) return true;
    if (!node.is_null()) fail(where + " is no object");
    return false;
  }

 private:
  std::string problem_;
};

struct Spelling {
  std::string_view original;
  std::string_view camel;
};

/// Both spellings of one field are the same field.
const Node* field(Reading& reading, const Node& object, const Spelling& name) {
  const Node* first = object.find(name.original);
  const Node* second = name.camel.empty() ? nullptr : object.find(name.camel);
  if (first != nullptr && second != nullptr)
    reading.fail(std::string(name.original) + " is there twice");
  return first != nullptr ? first : second;
}

void refuse_unknown(Reading& reading, const Node& object, const std::string& where,
                    std::initializer_list<std::string_view> known) {
  for (const auto& member : *object.object()) {
    bool found = false;
    for (const auto name : known) found = found || member.key == name;
    if (!found) reading.fail(where + json::shown(member.key, 30) + " is no field of it");
  }
}

void read_header(Reading& reading, const Node& node, JointCommandMessage& message) {
  if (!reading.object(node, "header")) return;
  refuse_unknown(reading, node, "header.",
                 {"time_stamp", "timeStamp", "frame_id", "frameId", "sequence_num", "sequenceNum"});
  if (const auto* at = field(reading, node, {"time_stamp", "timeStamp"}))
    reading.take(whole(*at), message.stamp_ns, "header.time_stamp", "whole number");
  if (const auto* at = field(reading, node, {"frame_id", "frameId"}))
    reading.take(text_of(*at), message.frame_id, "header.frame_id", "text");
  if (const auto* at = field(reading, node, {"sequence_num", "sequenceNum"}))
    reading.take(whole(*at), message.sequence, "header.sequence_num", "whole number");
}

void read_joint(Reading& reading, const Node& node, const std::string& where,
                JointCommandEntry& joint) {
  if (node.object() == nullptr) {
    reading.fail(where + " is no object");
    return;
  }
  refuse_unknown(reading, node, where + ".",
                 {"name", "position", "velocity", "effort", "stiffness", "damping"});
  if (const auto* name = node.find("name"))
    reading.take(text_of(*name), joint.name, where + ".name", "text");
  const std::pair<const char*, double*> numbers[] = {{"position", &joint.position_rad},
                                                     {"velocity", &joint.velocity_radps},
                                                     {"effort", &joint.effort_Nm},
                                                     {"stiffness", &joint.stiffness},
                                                     {"damping", &joint.damping}};
  for (const auto& [key, value] : numbers)
    if (const auto* number = node.find(key))
      reading.take(real(*number), *value, where + "." + key, "number");
}

void read_joints(Reading& reading, const Node& node, JointCommandMessage& message) {
  if (node.is_null()) return;
  const auto* list = node.list();
  if (list == nullptr) {
    reading.fail("joints is no list");
    return;
  }
  for (std::size_t i = 0; i < list->size() && reading.problem().empty(); ++i) {
    message.joints.emplace_back();
    read_joint(reading, (*list)[i], "joints[" + std::to_string(i) + "]", message.joints.back());
  }
}

}  // namespace

Result<JointCommandMessage, Reason> decode_joint_command_json(std::string_view text) {
  const auto refused = [](const std::string& why) {
    return Reason("the JSON is no JointCommand: " + json::shown(why, 120));
  };
  const auto document =
      json::parse(text, {.max_bytes = kMaxCommandBytes, .max_depth = 4, .max_values = 1000});
  if (!document) return refused(document.error().text());
  const Node& root = document->root;
  if (root.object() == nullptr) return refused("it is no object");
  Reading reading;
  JointCommandMessage message;
  refuse_unknown(reading, root, "", {"header", "joints"});
  if (const auto* header = root.find("header")) read_header(reading, *header, message);
  if (const auto* joints = root.find("joints")) read_joints(reading, *joints, message);
  if (!reading.problem().empty()) return refused(reading.problem());
  return message;
}

}  // namespace drover::publish::aimrt
