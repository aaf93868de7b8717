// The AimRT channel: what is published at each beat, and what becomes of a joint command.
//
// Pure, as the command service: time is an argument, and what must be done is appended to actions.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "publish/aimrt/joint_command.h"
#include "publish/aimrt/messages.h"
#include "publish/aimrt/packet.h"
#include "publish/aimrt/topic.h"
#include "publish/aimrt/writers.h"
#include "publish/command_service.h"
#include "publish/token_bucket.h"

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
  JointCommandRules rules;
  Duration silence = std::chrono::milliseconds(100);  ///< after which a stream has ended
  double max_commands_Hz = 250;  ///< more are not looked at: 200 a second and what came late
  double command_burst = 50;
};

struct Telemetry {
  const std::string* topic;  ///< lives as long as the channel
  std::string payload;
};

class Channel final {
 public:
  explicit Channel(const ChannelConfig& config);

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
  /// Messages of a flood that nobody looked at, so far.
  std::uint64_t unread() const { return unread_; }
  /// Programs that write at once, and which of them is followed; empty when there is one or none.
  std::string_view rivals(Time now) const;
  /// Messages that were refused for that, so far.
  std::uint64_t rivals_refused() const;

 private:
  struct Topics {
    std::vector<std::string> names;  ///< never changed: telemetry points to them
    Content content;
  };
  static Topics topics(const std::string& topic, Role role, const Wording& wording);
  Result<JointTargets, Reason> judged(Names names, std::string_view payload, const Arrival& arrival,
                                      Time now, Duration wall);
  Result<JointTargets, Reason> judged(const JointCommandMessage& message, const Writer& writer,
                                      Time now, Duration wall);
  std::vector<bool> named(const JointCommandMessage& message) const;

  Topics joint_state_;
  Topics imu_state_;
  Topics touch_state_;
  std::vector<std::string> command_topics_;  ///< by Names
  JointCommandRules rules_;
  std::uint64_t joint_sequence_ = 0;
  std::uint64_t imu_sequence_ = 0;
  std::uint64_t touch_sequence_ = 0;
  Time last_joints_ = kNever;
  Time last_imu_ = kNever;
  Quaternion orientation_;  ///< as the last message told it
  TouchPace touch_;
  std::uint64_t commands_ = 0;
  std::uint64_t unread_ = 0;
  /// Whose commands the joints of a group follow; the base is the first.
  struct Group {
    Writers writers;
    std::uint64_t last_stamp_ns = 0;
  };
  std::vector<Group> groups_;
  TokenBucket command_bucket_;
  std::string slow_down_;     ///< what is said when it is empty
  TokenBucket flood_bucket_;  ///< a flood is told of, and the telling is no flood
  TokenBucket log_bucket_;
  TokenBucket rivals_bucket_;  ///< other refusals do not drown it
};

}  // namespace drover::publish::aimrt
