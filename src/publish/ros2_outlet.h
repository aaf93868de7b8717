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
#include "publish/token_bucket.h"
#include "scene/sensor/near_things.h"

namespace drover::publish {

/// One follows at a time. Who is silent for kLease, hung or gone, is sent nothing any more, and
/// makes way for the next.
class Ros2Outlet final : public Outlet {
 public:
  static constexpr Duration kLease = std::chrono::seconds(3);
  using Turns = std::function<std::vector<const scene::sensor::SeenTurn*>()>;

  /// `turns`: the scanners' latest ones. `may_drive`: the configuration opens cmd_vel.
  /// `joint_commands` outlives it; nullptr: the configuration does not open them.
  Ros2Outlet(double rate_Hz, Turns turns, bool may_drive = false,
             aimrt::JointCommands* joint_commands = nullptr)
      : period_(from_s(1 / rate_Hz)),
        turns_(std::move(turns)),
        may_drive_(may_drive),
        joint_commands_(joint_commands) {}

  Duration period() const override { return period_; }
  bool needs_broker() const override { return false; }
  std::vector<OutMessage> on_snapshot(const Snapshot& seen, const Moment& moment,
                                      Actions& out) override;
  bool on_line(ClientId client, std::string_view line, Time now, Actions& out) override;
  void count(DaemonStatus& status) const override;

 private:
  void follow(ClientId client, const json::Node& request, Time now, Actions& out);
  void cmd_vel(ClientId client, const json::Node& request, Time now, Actions& out);
  void joint_command(ClientId client, const json::Node& request, Time now, Actions& out);
  Result<aimrt::JointCommandHeard, Reason> read_joint_command(const json::Node& request,
                                                              Time now) const;
  bool follows(Time now) const { return heard_ != kNever && now - heard_ <= kLease; }

  Duration period_;
  Turns turns_;
  bool may_drive_;
  aimrt::JointCommands* joint_commands_;
  Duration wall_minus_monotonic_{};  ///< as of late
  ClientId client_ = 0;
  Time heard_ = kNever;
  TokenBucket requests_{20, 20};
  TokenBucket twists_{150, 50};  ///< drover-ros2 hands on a hundred a second
  TokenBucket flood_{1, 1};      ///< a flood is told of, and the telling is no flood
  std::uint64_t twist_number_ = 0;
  ros2::Told told_;
  std::string mode_;    ///< as that program says
  std::string reason_;  ///< likewise, what is wrong with it; empty: nothing
  std::int64_t readers_ = 0;
  std::int64_t incompatible_ = 0;
};

}  // namespace drover::publish
