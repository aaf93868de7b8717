// A program's stream of joint commands, as AimRT's MQTT plugin sends it.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drover/time.h"

namespace drover::sim {

/// Any name, known to the robot or not; any number, NaN too. What is 0 is not written.
struct JointSent {
  std::string joint;
  double velocity_radps = 0;
  double position_rad = 0;
  double effort_Nm = 0;
  double stiffness_Nmprad = 0;
  double damping_Nmsprad = 0;
};

/// How a program writes: the document's names or AimRT 1.x's, protobuf or JSON.
struct CommandForm {
  bool aimrt_1x = false;
  bool json = false;
};

std::string joint_command_topic(const CommandForm& form);

/// AimRT's MQTT payload (one byte length, "pb", no context) around a protobuf JointCommand: field
/// 2 the joints, of each field 1 the name, 2 the position, 3 the velocity, 4 the effort, 5 the
/// stiffness and 6 the damping. Made by hand, so that an error of the
/// gateway's own encoder does not hide here.
std::string joint_command_packet(const std::vector<JointSent>& joints);
/// The same as JSON ("json" for "pb"); NaN is a text there.
std::string joint_command_json_packet(const std::vector<JointSent>& joints);

struct CommandStreamSpec {
  std::vector<JointSent> joints;
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
