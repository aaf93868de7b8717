// The AimRT channel: what is published at each beat, and what becomes of a joint command.
//
// Pure, as the command service: time is an argument, and what must be done is appended to actions.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "publish/aimrt/joint_command.h"
#include "publish/command_service.h"
#include "publish/token_bucket.h"

namespace drover::publish::aimrt {

/// Field names are the configuration file's keys.
struct ChannelConfig {
  std::string joint_state = "/joint_state";
  std::string imu_state = "/imu_state";
  std::string touch_state = "/touch_state";
  std::string joint_command = "/joint_command";
  JointCommandRules rules;
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

  /// MQTT topic to subscribe to.
  const std::string& command_topic() const { return joint_command_topic_; }

  /// What to publish now. Joints once a control cycle at most, an inertial sample once: what is not
  /// looked at any more is silent here too. Touch where such a line is configured, at each
  /// change and ten times a second.
  std::vector<Telemetry> telemetry(const Snapshot& snapshot, Duration wall_minus_monotonic);

  /// A message on command_topic(): a JointTargets or JointTargetsRefused for the engine, and now
  /// and then a line for the log. `retained` is the broker's flag.
  void on_command(std::string_view payload, const Arrival& arrival, Time now,
                  Duration wall_minus_monotonic, Actions& out);
  /// Messages of a flood that nobody looked at, so far.
  std::uint64_t unread() const { return unread_; }

 private:
  bool touch_is_due(const Snapshot& snapshot);
  Result<JointTargets, Reason> judged(std::string_view payload, const Arrival& arrival,
                                      Duration wall);

  std::string joint_state_topic_;
  std::string imu_state_topic_;
  std::string touch_state_topic_;
  std::string joint_command_topic_;
  JointCommandRules rules_;
  std::uint64_t joint_sequence_ = 0;
  std::uint64_t imu_sequence_ = 0;
  std::uint64_t touch_sequence_ = 0;
  Time last_joints_ = kNever;
  Time last_imu_ = kNever;
  Time last_touch_ = kNever;
  std::array<bool, kLineCount> touched_{};
  std::uint64_t last_stamp_ns_ = 0;
  std::uint64_t commands_ = 0;
  std::uint64_t unread_ = 0;
  TokenBucket command_bucket_;
  TokenBucket flood_bucket_;  ///< a flood is told of, and the telling is no flood
  TokenBucket log_bucket_;
};

}  // namespace drover::publish::aimrt
