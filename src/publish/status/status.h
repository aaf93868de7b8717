// The whole state as one JSON object: what `drover status --json` prints.
#pragma once

#include <cstdint>
#include <string>

#include "drover/snapshot.h"

namespace drover::publish {

/// The program that shows the robot to ROS 2.
struct Ros2Status {
  bool configured = false;
  bool connected = false;  ///< it was heard lately
  // As it says:
  std::string mode;
  std::string network;            ///< in use: interface and address; empty: none, or not this mode
  std::string unused;             ///< networks where nobody sees the robot or stops it
  std::string reason;             ///< what is wrong with it; empty: nothing
  std::int64_t readers = 0;       ///< of its topics
  std::int64_t incompatible = 0;  ///< readers or writers that ask for another quality of service
  // Messages of the planning scene by ROS 2 users:
  std::uint64_t scene_done = 0;
  std::uint64_t scene_refused = 0;
  std::uint64_t scene_unanswered = 0;  ///< of a flood: neither
  std::string scene_refusal;           ///< the last one, in words
};

/// What the snapshot does not know.
struct DaemonStatus {
  std::string robot;
  bool broker_connected = false;
  std::string broker_text;  ///< why it is not connected
  double uptime_s = 0;
  Time now = kNever;  ///< when it is shown
  std::uint64_t telemetry_dropped = 0;
  std::uint64_t answers_lost = 0;  ///< on `feedback`: no connection to the broker took them
  std::uint64_t scene_messages_unanswered = 0;  ///< of a flood
  std::uint64_t events_lost = 0;
  std::string stop_trouble;                    ///< why a stop would be forgotten over a boot
  std::uint64_t joint_commands_unread = 0;     ///< of a flood
  std::string joint_commands_rivals;           ///< programs that write at once now
  std::uint64_t joint_commands_of_rivals = 0;  ///< refused for that
  Ros2Status ros2;
};

/// `snapshot` as it is seen now (as_seen). Angles in rad and degrees by their names' suffix; absent
/// values are null.
std::string status_json(const Snapshot& snapshot, const DaemonStatus& daemon);

}  // namespace drover::publish
