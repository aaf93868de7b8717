// JointCommand: from bytes to velocities for the engine, or to the reason why not.
//
// Pure: names, limits and time are arguments. Nothing is repaired: one bad joint refuses the whole
// message, so that no joint moves as part of a motion that was never asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drover/command.h"
#include "drover/result.h"

namespace drover::publish::aimrt {

/// A longer message is not even decoded: sixteen joints need a fifth of it.
inline constexpr std::size_t kMaxCommandBytes = 16 * 1024;

struct JointCommandEntry {
  std::string name;
  double position_rad = 0;
  double velocity_radps = 0;
  double effort_Nm = 0;
  double stiffness = 0;  ///< N*m/rad
  double damping = 0;    ///< N*m*s/rad
};

struct JointCommandMessage {
  std::uint64_t stamp_ns = 0;  ///< wall time; 0: none
  std::uint64_t sequence = 0;  ///< the program's own count; 0: none
  std::string frame_id;
  std::vector<JointCommandEntry> joints;
};

/// A joint of the robot, and what it can be told.
struct JointRule {
  JointRule(std::string joint) : name(std::move(joint)) {}
  JointRule(const char* joint) : name(joint) {}
  JointRule(std::string joint, JointFollows values, std::size_t of_group)
      : name(std::move(joint)), follows(values), group(of_group) {}

  std::string name;
  std::optional<JointFollows> follows;  ///< none: a wheel of the base, which follows a velocity
  std::size_t group = 0;                ///< whose owners it has; 0: the base's
  bool carries_weight = false;          ///< left without any torque it falls
  Duration timeout{};  ///< so far apart its commands may be; 0: no farther than a wheel's
};

struct JointCommandRules {
  std::vector<JointRule> joints;  ///< by AxisId
  Duration max_age = std::chrono::milliseconds(250);
};

/// The end when there is none of that name.
std::vector<JointRule>::const_iterator find_joint(const JointCommandRules& rules,
                                                  std::string_view name);

/// Protobuf bytes; fields of other numbers are passed over. Refuses, with the place, one of another
/// wire type, which protobuf passes over too: its joint would be told 0. The reason is empty where
/// nothing is known but that it is no JointCommand.
Result<JointCommandMessage, Reason> decode_joint_command(std::string_view bytes);

/// Protobuf's JSON: both spellings of a field, numbers as texts, null for absent. Refuses, with the
/// place, unknown fields, keys that come twice and numbers that are none.
Result<JointCommandMessage, Reason> decode_joint_command_json(std::string_view text);

/// `wall` is now since the epoch, `last_stamp_ns` that of the last message that was accepted, 0
/// when there is none. A wheel follows a velocity: with stiffness 0 a position has no weight, so it
/// is checked and not used. What other joints follow their rule says; a value that a joint does not
/// follow has to be 0. One that carries a weight is not let fall by a command that holds it by
/// nothing, as a position alone does. What is beyond the limits is for the engine to clamp.
Result<JointTargets, Reason> accept_joint_command(const JointCommandMessage& message,
                                                  const JointCommandRules& rules, Duration wall,
                                                  std::uint64_t last_stamp_ns);

}  // namespace drover::publish::aimrt
