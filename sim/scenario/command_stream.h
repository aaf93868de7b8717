// A program's stream of joint commands, as AimRT's MQTT plugin sends it.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drover/time.h"

namespace drover::sim {

struct JointVelocity {
  std::string joint;          ///< any name, known to the robot or not
  double velocity_radps = 0;  ///< any number, NaN too
};

/// How a program writes: the document's names or AimRT 1.x's, protobuf or JSON.
struct CommandForm {
  bool aimrt_1x = false;
  bool json = false;
};

std::string joint_command_topic(const CommandForm& form);

/// AimRT's MQTT payload (one byte length, "pb", no context) around a protobuf JointCommand: field
/// 2 the joints, of each field 1 the name and 3 the velocity. Made by hand, so that an error of the
/// gateway's own encoder does not hide here.
std::string joint_command_packet(const std::vector<JointVelocity>& joints);
/// The same as JSON ("json" for "pb"); NaN is a text there.
std::string joint_command_json_packet(const std::vector<JointVelocity>& joints);

struct CommandStreamSpec {
  std::vector<JointVelocity> joints;
  double rate_Hz = 50;
  Duration lasts{};
  CommandForm form{};
};

/// Pure: says when which message is due.
class CommandStream final {
 public:
  /// From now on, instead of what was sent so far.
  void begin(const CommandStreamSpec& spec, Time now);
  /// When it has something to do; Time::max(): never.
  Time next() const { return std::min(next_, end_); }
  /// The message to send now. A late caller skips messages: it sends no burst.
  std::optional<std::string_view> due(Time now);
  /// Where that message goes.
  const std::string& topic() const { return topic_; }
  /// True once, when its time is over.
  bool ends(Time now);

 private:
  std::string payload_;
  std::string topic_;
  Duration period_{};
  Time next_ = Time::max();
  Time end_ = Time::max();
};

}  // namespace drover::sim
