// The `feedback` topic: which word tells what, and the message around it.
//
// RTK navigation protocol, "操作反馈 feedback". The document spells failure "failse".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace drover::publish {

inline constexpr std::string_view kTopicBaseStatus = "base_status";
inline constexpr std::string_view kTopicTrajectoryData = "trajectory_data";
inline constexpr std::string_view kTopicFeedback = "feedback";
inline constexpr std::string_view kTopicControl = "mqtt_control";

/// What a request asks for. `start_nav` is nobody's request: it is the second answer to start_task.
enum class Verb : std::uint8_t {
  get_all_trajectory,
  save_trajectory,
  delete_trajectory,
  delete_all_trajectory,
  start_task,
  cancel_task,
  init_rtk_data,
  start_nav,
  reset_stop,       ///< not of this protocol: the command line's
  terminate,        ///< of a later edition
  find_heading,     ///< the command line's
  release,          ///< the command line's
  hold,             ///< the command line's
  accept_position,  ///< the command line's
  forget_learned,   ///< the command line's
};

std::string_view verb_name(Verb verb);
/// The document has a word for every verb's success except get_all_trajectory's, whose success is
/// the trajectory_data message itself.
std::string success_cmd(Verb verb);
std::string failure_cmd(Verb verb);

/// `{"cmd": ..., "cmd_type": "feedback"}`, with `reason` (of a failure) or `note` (of a success)
/// added when they are not empty.
std::string feedback_text(std::string_view cmd, std::string_view reason, std::string_view note);

}  // namespace drover::publish
