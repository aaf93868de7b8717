// Joint commands as they stand on the wire: AimRT packets with protobuf, by hand, or JSON.
//
// It shares nothing with the gateway's decoder on purpose: an error there must not hide here.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "drover/time.h"

namespace drover::mission {

/// Of the document, and of AimRT 1.x.
inline constexpr std::string_view kJointCommandTopic =
    "/channel/%2Fjoint_command/pb%3Aaimrt.protocols.sensor.JointCommand";
inline constexpr std::string_view kJointCommandArrayTopic =
    "/channel/%2Fjoint_command/pb%3Aaimrt.protocols.sensor.JointCommandArray";

struct JointCommandLine {
  Time time = kNever;
  std::map<std::string, double> velocities_radps;  ///< by joint
  bool sound() const;  ///< known joints and finite numbers only: to be followed as a whole
  bool rests() const;  ///< each velocity is 0
};

/// A payload in hexadecimal digits. Throws std::runtime_error when it is no such packet.
JointCommandLine parse_joint_command(Time time, std::string_view hex);

/// From a message whose velocities are 0 until the last one before a silence; of sound messages
/// only.
struct Stream {
  Time begin = kNever;
  Time last = kNever;
};
/// The gateway's time-out (health.joint_command_timeout_s, default).
inline constexpr Duration kStreamTimeout = std::chrono::milliseconds(100);
std::vector<Stream> streams(const std::vector<JointCommandLine>& commands);

}  // namespace drover::mission
