// drover-ros2 as an outlet: a program of its own that follows the robot's state over the daemon's
// socket. It says each second that it is there; a row of lines goes to it meanwhile. Where the
// configuration opens it, it hands on what ROS 2 users want the base and other joints to do.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "json/located_json.h"
#include "publish/aimrt/joint_commands.h"
#include "publish/outlet.h"
#include "publish/ros2/line.h"
#include "publish/scene_topics.h"
#include "publish/token_bucket.h"
#include "scene/sensor/near_things.h"

namespace drover::publish {

/// What the configuration opens to ROS 2 users. What is pointed to outlives the outlet.
struct Ros2Inputs {
  bool cmd_vel = false;
  bool sideways = false;  ///< the base can
  aimrt::JointCommands* joint_commands = nullptr;
  SceneTopics* scene = nullptr;
  bool collision_object = false;
  bool planning_constraints = false;
};

/// One follows at a time. Who is gone, or silent for kLease as one that hangs, is sent nothing any
/// more, and makes way for the next.
class Ros2Outlet final : public Outlet {
 public:
  static constexpr Duration kLease = std::chrono::seconds(3);
  using Turns = std::function<std::vector<const scene::sensor::SeenTurn*>()>;

  /// How old a message of the scene may be that says "now".
  static constexpr Duration kOldestScene = std::chrono::milliseconds(300);

  /// `turns`: the scanners' latest ones.
  Ros2Outlet(double rate_Hz, Turns turns, const Ros2Inputs& inputs = {})
      : period_(from_s(1 / rate_Hz)), turns_(std::move(turns)), inputs_(inputs) {}

  Duration period() const override { return period_; }
  bool needs_broker() const override { return false; }
  std::vector<OutMessage> on_snapshot(const Snapshot& seen, const Moment& moment,
                                      Actions& out) override;
  bool on_line(ClientId client, std::string_view line, Time now, Actions& out) override;
  void on_gone(ClientId client) override {
    if (client == client_) heard_ = kNever;
  }
  void count(DaemonStatus& status) const override;

 private:
  void follow(ClientId client, const json::Node& request, Time now, Actions& out);
  void cmd_vel(ClientId client, const json::Node& request, Time now, Actions& out);
  void joint_command(ClientId client, const json::Node& request, Time now, Actions& out);
  void scene_message(ClientId client, const json::Node& request, Time now, Actions& out);
  aimrt::JointCommands::Heard read_joint_command(const json::Node& request, Time now) const;
  bool follows(Time now) const { return heard_ != kNever && now - heard_ <= kLease; }
  bool hands_on(ClientId client, Time now) const { return client == client_ && follows(now); }

  Duration period_;
  Turns turns_;
  Ros2Inputs inputs_;
  Duration wall_minus_monotonic_{};  ///< as of late
  ClientId client_ = 0;
  Time heard_ = kNever;
  Time since_ = kNever;  ///< it follows without a gap
  TokenBucket requests_{20, 20};
  TokenBucket twists_{150, 50};  ///< drover-ros2 hands on a hundred a second
  TokenBucket flood_{1, 1};      ///< a flood is told of, and the telling is no flood
  std::uint64_t twist_number_ = 0;
  ros2::Told told_;
  // As that program says:
  std::string mode_;
  std::string network_;  ///< that it uses
  std::string unused_;   ///< networks
  std::string reason_;   ///< what is wrong with it; empty: nothing
  std::int64_t readers_ = 0;
  std::int64_t incompatible_ = 0;
};

}  // namespace drover::publish
