// drover-ros2 as a loop: droverd's lines in, ROS 2's messages out.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "drover/time.h"
#include "ros2/daemon_link.h"
#include "ros2/domain.h"
#include "ros2/heard.h"
#include "ros2/robot.h"
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
  void make_domain(Time now);
  void take(std::string_view line);
  void hear_users(Time now);
  void hear_stop(Time now);
  void hear_twists(Time now);
  void hand_on_twist(Time now);
  void say_who_may() const;
  void forget_domain();
  void tell_droverd();
  void tell_users();

  const config::DroverConfig& config_;
  Reach reach_;
  Robot robot_;
  DaemonLink link_;
  std::unique_ptr<Domain> domain_;
  std::unique_ptr<Shown> shown_;
  std::unique_ptr<Heard> users_;
  std::vector<std::string> networks_;        ///< for which the domain was made
  std::vector<std::string> other_networks_;  ///< that were there at the last beat, if others
  runtime::BackOff retry_{std::chrono::seconds(1), std::chrono::seconds(60)};
  Readers readers_;
  std::string problem_;               ///< why there is no domain; empty: there is one
  std::string refusal_;               ///< what droverd has against it
  std::string said_ = "nothing yet";  ///< last of droverd
  Time connected_ = kNever;
  Time heard_ = kNever;  ///< droverd's last line
  Time next_beat_ = kNever;
  Time stopped_ = kNever;  ///< last, as users asked
  struct Asked {
    Twist twist;
    Time came = kNever;
  };
  std::optional<Asked> asked_;  ///< of the base, not handed on yet
  Time handed_on_ = kNever;     ///< the last
  Time refused_ = kNever;       ///< droverd was told last that one was refused
};

}  // namespace drover::ros2
