// The AimRT channel: what is published at each beat, and joint commands as they come in packets.
//
// Pure, as the command service: time is an argument, and what must be done is appended to actions.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "publish/aimrt/joint_commands.h"
#include "publish/aimrt/messages.h"
#include "publish/aimrt/packet.h"
#include "publish/aimrt/topic.h"
#include "publish/arrival.h"

namespace drover::publish::aimrt {

/// How one state goes out: under one family's name of its message or both, written in one way.
struct Wording {
  std::vector<Names> names{Names::document};
  Content content = Content::pb;
};

/// Names of topics are the configuration file's keys.
struct ChannelConfig {
  std::string joint_state = "/joint_state";
  std::string imu_state = "/imu_state";
  std::string touch_state = "/touch_state";
  std::string joint_command = "/joint_command";
  Wording joint_state_wording;
  Wording imu_state_wording;
  Wording touch_state_wording;
};

struct Telemetry {
  const std::string* topic;  ///< lives as long as the channel
  std::string payload;
};

class Channel final {
 public:
  /// `commands` is others' too, and outlives it.
  Channel(const ChannelConfig& config, JointCommands& commands);

  /// MQTT topics to subscribe to: commands are heard under the names of both families.
  const std::vector<std::string>& command_topics() const { return command_topics_; }
  /// Whose names the topic of a message has; nothing when no joint command comes on it.
  std::optional<Names> command_names(std::string_view topic) const;

  /// What to publish now. Joints once a control cycle at most, an inertial sample once: what is not
  /// looked at any more is silent here too. Touch where such a line is configured, at each
  /// change and ten times a second.
  std::vector<Telemetry> telemetry(const Snapshot& snapshot, Duration wall_minus_monotonic);

  /// A message under these names: a JointTargets or JointTargetsRefused for the engine, and now
  /// and then a line for the log. Limits and owner are the same for all names and contents.
  void on_command(Names names, std::string_view payload, const Arrival& arrival, Time now,
                  Duration wall_minus_monotonic, Actions& out);

 private:
  struct Topics {
    std::vector<std::string> names;  ///< never changed: telemetry points to them
    Content content;
  };
  static Topics topics(const std::string& topic, Role role, const Wording& wording);

  Topics joint_state_;
  Topics imu_state_;
  Topics touch_state_;
  std::vector<std::string> command_topics_;  ///< by Names
  JointCommands& commands_;
  std::uint64_t joint_sequence_ = 0;
  std::uint64_t imu_sequence_ = 0;
  std::uint64_t touch_sequence_ = 0;
  Time last_joints_ = kNever;
  Time last_imu_ = kNever;
  Quaternion orientation_;  ///< as the last message told it
  TouchPace touch_;
};

}  // namespace drover::publish::aimrt
