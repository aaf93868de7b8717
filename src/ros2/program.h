// drover-ros2 as a loop: droverd's lines in, ROS 2's messages out.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "drover/time.h"
#include "ros2/asked_for.h"
#include "ros2/daemon_link.h"
#include "ros2/domain.h"
#include "ros2/heard.h"
#include "ros2/networks_watch.h"
#include "ros2/robot.h"
#include "ros2/scene_relay.h"
#include "ros2/shown.h"

namespace drover::ros2 {

class Program final {
 public:
  /// `config` has a section ros2 whose mode is not off.
  explicit Program(const config::DroverConfig& config);
  /// Until `stop`; a signal wakes it.
  void run(const std::atomic<bool>& stop);

 private:
  void beat(Time now);
  void keep_domain(Time now);
  void networks_changed(const std::vector<Network>& there, Time now);
  std::optional<Network> choose(const std::vector<Network>& there) const;
  void make_domain(Time now);
  void take(std::string_view line);
  void stop_refused(const std::string& why);
  void connect(Time now);
  void way_lost();
  void hand_over_stop();
  void hear_users(Time now);
  void tell_asked(Time now);
  void say_who_sees() const;
  void say_unused() const;
  std::vector<Network> unused() const;
  void say_who_may() const;
  void lose_domain(const std::string& why, Time now);
  void forget_domain();
  void tell_droverd();
  void tell_users();

  const config::DroverConfig& config_;
  Reach reach_;
  Robot robot_;
  DaemonLink link_;
  std::string stop_socket_;  ///< drover-guard's
  /// Messages of the planning scene that were never looked at.
  std::atomic<std::uint64_t> scene_passed_over_{0};
  std::unique_ptr<Domain> domain_;
  std::unique_ptr<Shown> shown_;
  std::unique_ptr<Heard> users_;
  NetworksWatch networks_;
  std::optional<Network> network_;  ///< that the domain uses beside loopback
  runtime::BackOff retry_{std::chrono::seconds(1), std::chrono::seconds(60)};
  Readers readers_;
  std::string problem_;               ///< why there is no domain; empty: there is one
  std::string refusal_;               ///< what droverd has against it
  std::string said_ = "nothing yet";  ///< last of droverd
  Time connected_ = kNever;
  Time heard_ = kNever;  ///< droverd's last line
  Time next_beat_ = kNever;
  AskedFor asked_;
  SceneRelay scene_;
  bool follows_ = false;        ///< droverd tells the robot's state to this connection
  Time stopped_ = kNever;       ///< the journal was told last that users asked for a stop
  Time refusal_said_ = kNever;  ///< likewise that droverd had not done one
  bool stop_waited_ = false;    ///< and that it could not be told to droverd
};

}  // namespace drover::ros2
