#include "sim/scenario/command_stream.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace drover::sim {
namespace {

// Protobuf: a field's tag is its number and, in the lowest three bits, how its value is written.
constexpr char kName = 1 << 3 | 2;  // bytes with their length
constexpr char kJoint = 2 << 3 | 2;

struct Value {
  const char* key;
  int number;  ///< of its field
  double JointSent::*value;
};
constexpr Value kValues[] = {{"position", 2, &JointSent::position_rad},
                             {"velocity", 3, &JointSent::velocity_radps},
                             {"effort", 4, &JointSent::effort_Nm},
                             {"stiffness", 5, &JointSent::stiffness_Nmprad},
                             {"damping", 6, &JointSent::damping_Nmsprad}};
/// A velocity is always told.
bool is_told(const Value& value, const JointSent& joint) {
  return value.value == &JointSent::velocity_radps || joint.*value.value != 0;
}

/// Seven bits a byte, the lowest first.
std::string varint(std::size_t value) {
  std::string bytes;
  for (; value >= 0x80; value >>= 7U) bytes += static_cast<char>(value % 0x80 + 0x80);
  return bytes + static_cast<char>(value);
}

std::string with_length(char tag, const std::string& bytes) {
  return tag + varint(bytes.size()) + bytes;
}

std::string double_bytes(double value) {
  auto bits = std::bit_cast<std::uint64_t>(value);
  std::string bytes;
  for (int i = 0; i < 8; ++i, bits >>= 8U) bytes += static_cast<char>(bits & 0xFFU);
  return bytes;
}

}  // namespace

std::string joint_command_topic(const CommandForm& form) {
  return std::string("/channel/%2Fjoint_command/pb%3Aaimrt.protocols.sensor.") +
         (form.aimrt_1x ? "JointCommandArray" : "JointCommand");
}

std::string joint_command_packet(const std::vector<JointSent>& joints) {
  std::string packet("\x02pb\0", 4);
  for (const auto& joint : joints) {
    std::string entry = with_length(kName, joint.joint);
    for (const Value& value : kValues) {
      if (!is_told(value, joint)) continue;
      entry += static_cast<char>(value.number << 3 | 1);  // eight bytes, the lowest first
      entry += double_bytes(joint.*value.value);
    }
    packet += with_length(kJoint, entry);
  }
  return packet;
}

std::string joint_command_json_packet(const std::vector<JointSent>& joints) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& joint : joints) {
    nlohmann::ordered_json item{{"name", joint.joint}};
    for (const Value& value : kValues) {
      if (!is_told(value, joint)) continue;
      item[value.key] = joint.*value.value;
      if (std::isnan(joint.*value.value)) item[value.key] = "NaN";
    }
    list.push_back(std::move(item));
  }
  return std::string("\x04json\0", 6) + nlohmann::ordered_json{{"joints", list}}.dump();
}

void CommandStream::begin(const CommandStreamSpec& spec, Time now) {
  payload_ =
      spec.form.json ? joint_command_json_packet(spec.joints) : joint_command_packet(spec.joints);
  topic_ = joint_command_topic(spec.form);
  period_ = from_s(1 / spec.rate_Hz);
  next_ = now;
  end_ = now + spec.lasts;
}

std::optional<std::string_view> CommandStream::due(Time now) {
  if (now < next_ || now >= end_) return std::nullopt;
  next_ = std::max(next_ + period_, now);
  return payload_;
}

bool CommandStream::ends(Time now) {
  if (now < end_) return false;
  next_ = end_ = Time::max();
  return true;
}

}  // namespace drover::sim
