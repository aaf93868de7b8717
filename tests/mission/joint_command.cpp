#include "mission/joint_command.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace drover::mission {
namespace {

// The field robot's.
constexpr std::array<std::string_view, 4> kJoints{"front_left", "rear_left", "front_right",
                                                  "rear_right"};

std::string bytes_of_hex(std::string_view digits) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
  return bytes;
}

/// Protobuf fields, of those kinds that a JointCommand has.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}
  bool end() const { return bytes_.empty(); }
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = static_cast<std::uint8_t>(take(1)[0]);
      value |= (byte & 0x7FULL) << shift;
      if (byte < 0x80) return value;
    }
    throw std::runtime_error("a number without an end");
  }
  std::string_view bytes() { return take(varint()); }
  double number() {
    std::uint64_t bits = 0;
    const auto eight = take(8);
    for (std::size_t i = 8; i > 0; --i) bits = bits << 8U | static_cast<std::uint8_t>(eight[i - 1]);
    return std::bit_cast<double>(bits);
  }

 private:
  std::string_view take(std::size_t count) {
    if (count > bytes_.size()) throw std::runtime_error("cut short");
    const auto taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  std::string_view bytes_;
};

// Field number, and in the lowest three bits how its value is written.
constexpr std::uint64_t kJoint = 2 << 3 | 2;
constexpr std::uint64_t kName = 1 << 3 | 2;
constexpr std::uint64_t kVelocity = 3 << 3 | 1;
/// Position, effort, stiffness and damping: no wheel follows them.
constexpr bool is_of_an_arm(std::uint64_t tag) {
  return tag == (2 << 3 | 1) || tag == (4 << 3 | 1) || tag == (5 << 3 | 1) || tag == (6 << 3 | 1);
}

std::map<std::string, double> velocities_in_json(std::string_view text) {
  std::map<std::string, double> velocities_radps;
  const auto message = nlohmann::json::parse(text);
  for (const auto& joint : message.at("joints")) {
    const auto& velocity = joint.at("velocity");
    velocities_radps[joint.at("name").get<std::string>()] =
        velocity == "NaN" ? NAN : velocity.get<double>();
  }
  return velocities_radps;
}

}  // namespace

bool JointCommandLine::sound() const {
  return !velocities_radps.empty() &&
         std::all_of(velocities_radps.begin(), velocities_radps.end(), [](const auto& joint) {
           return std::isfinite(joint.second) &&
                  std::find(kJoints.begin(), kJoints.end(), joint.first) != kJoints.end();
         });
}

bool JointCommandLine::rests() const {
  return std::all_of(velocities_radps.begin(), velocities_radps.end(),
                     [](const auto& joint) { return joint.second == 0; });
}

JointCommandLine parse_joint_command(Time time, std::string_view hex) {
  constexpr std::string_view kPacket("\x02pb\0", 4);
  constexpr std::string_view kJsonPacket("\x04json\0", 6);
  const auto bytes = bytes_of_hex(hex);
  if (bytes.starts_with(kJsonPacket))
    return {time, velocities_in_json(std::string_view(bytes).substr(kJsonPacket.size()))};
  if (!bytes.starts_with(kPacket)) throw std::runtime_error("is no packet");
  JointCommandLine line{time, {}};
  for (Fields message(std::string_view(bytes).substr(kPacket.size())); !message.end();) {
    if (message.varint() != kJoint) throw std::runtime_error("a field that no scenario sends");
    std::string name;
    double velocity_radps = 0;
    for (Fields joint(message.bytes()); !joint.end();) {
      const auto tag = joint.varint();
      if (tag == kName) name = joint.bytes();
      if (tag == kVelocity) velocity_radps = joint.number();
      if (is_of_an_arm(tag)) (void)joint.number();
      if (tag != kName && tag != kVelocity && !is_of_an_arm(tag))
        throw std::runtime_error("another field of a joint");
    }
    line.velocities_radps[name] = velocity_radps;
  }
  return line;
}

std::vector<Stream> streams(const std::vector<JointCommandLine>& commands) {
  std::vector<Stream> found;
  for (const auto& command : commands) {
    if (!command.sound()) continue;
    const bool goes_on = !found.empty() && command.time - found.back().last <= kStreamTimeout;
    if (goes_on) {
      found.back().last = command.time;
    } else if (command.rests()) {
      found.push_back({command.time, command.time});
    }
  }
  return found;
}

}  // namespace drover::mission
