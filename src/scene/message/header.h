// std_msgs/Header of ROS 1, and what says where something is.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "drover/measurement.h"

namespace drover::scene {

inline bool is_finite(const Vector3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Wall time since the epoch, as its sender's clock had it. 0.0 is "not said".
struct Stamp {
  std::uint32_t sec = 0;
  std::uint32_t nsec = 0;
  friend bool operator==(const Stamp&, const Stamp&) = default;
};

/// Source: ros-message-types, std_msgs 1.
struct Header {
  std::uint32_t seq = 0;  ///< counts up; nothing is judged by it
  Stamp stamp;
  /// "1" and "map": the global frame. A frame of the robot by its name. "0" and empty: none.
  std::string frame_id;
};

/// geometry_msgs/Pose of ROS 1: metres in the frame of the header, and a turn.
struct Pose {
  Vector3 position_m;
  Quaternion orientation;
};

}  // namespace drover::scene
