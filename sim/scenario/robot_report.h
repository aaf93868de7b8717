// What the robot says over MQTT, read as an operator's program reads it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/track.h"

namespace drover::sim {

/// The last base_status and feedback, and the events that follow from them.
class RobotReport {
 public:
  /// Each returns the names of the events, see mission.h. Text that is no such message tells
  /// nothing.
  std::vector<std::string> on_base_status(std::string_view payload);
  std::vector<std::string> on_feedback(std::string_view payload);
  std::vector<std::string> on_scene_feedback(std::string_view payload);

  bool heard() const { return heard_; }
  const Fix& fix() const { return fix_; }
  const std::string& locate() const { return locate_; }
  const std::string& nav_status() const { return nav_status_; }
  bool obstacle() const { return obstacle_; }
  /// On its way, for what is in it.
  bool waits() const { return held_; }
  int rtk_status() const { return rtk_status_; }
  double speed_mps() const { return speed_mps_; }
  double turn_radps() const { return turn_radps_; }
  /// Reasons, one line.
  const std::string& why() const { return why_; }
  const std::string& last_feedback() const { return last_feedback_; }

 private:
  bool heard_ = false;
  Fix fix_;
  std::string locate_ = "LOCATE_UNINIT";
  std::string nav_status_ = "NAV_FREE";
  bool obstacle_ = false;
  bool held_ = false;  // by an obstacle, while driving
  int rtk_status_ = 0;
  double speed_mps_ = 0;
  double turn_radps_ = 0;
  std::string why_;
  std::string last_feedback_;
};

}  // namespace drover::sim
