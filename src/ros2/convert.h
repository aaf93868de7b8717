// What droverd tells, as messages of ROS 2: REP 103 (axes and units), 105 (frames), 145 (IMU), 117
// (ranges). Pure; what a message points to lives in the arena.
#pragma once

#include <aimrt_msgs.h>
#include <diagnostic_msgs.h>
#include <nav_msgs.h>
#include <sensor_msgs.h>
#include <tf2_msgs.h>

#include <span>

#include "ros2/arena.h"
#include "ros2/told.h"

namespace drover::ros2 {

inline constexpr const char* kMapFrame = "map";
inline constexpr const char* kOdomFrame = "odom";
inline constexpr const char* kBaseFrame = "base_link";

builtin_interfaces_msg_dds__Time_ time_of(Stamp_ns at_ns);

/// Of an axis, counter-clockwise about z.
geometry_msgs_msg_dds__Quaternion_ about_z(double yaw_rad);
/// Yaw first, then pitch, then roll.
geometry_msgs_msg_dds__Quaternion_ quaternion(double roll_rad, double pitch_rad, double yaw_rad);

// convert_motion.cpp:
sensor_msgs_msg_dds__JointState_ joint_state(const JointsTold& joints, Arena& arena);
/// `sequence`: counts the messages, from 1.
aimrt_msgs_msg_dds__JointStateArray_ joint_state_array(const JointsTold& joints,
                                                       std::uint32_t sequence, Arena& arena);
sensor_msgs_msg_dds__Imu_ imu(const ImuTold& imu, Arena& arena);
nav_msgs_msg_dds__Odometry_ odometry(const OdometryTold& way, Arena& arena);
geometry_msgs_msg_dds__PoseWithCovarianceStamped_ rtk_pose(Stamp_ns at_ns, const PoseTold& pose,
                                                           Arena& arena);
/// odom -> base_link, and map -> odom where the place is known: one tree, so that the pose is
/// map -> odom -> base_link.
tf2_msgs_msg_dds__TFMessage_ frames(const OdometryTold& way, const std::optional<PoseTold>& pose,
                                    Arena& arena);

// convert_sensors.cpp:
sensor_msgs_msg_dds__NavSatFix_ nav_sat_fix(const FixTold& fix, Arena& arena);
sensor_msgs_msg_dds__BatteryState_ battery_state(const BatteryTold& battery, Arena& arena);
/// What a scanner takes for an obstacle.
struct RangeLimits {
  double min_m = 0;
  double max_m = 0;
};
/// `angles` equal parts of the turn, the same in each whatever the scanner measured: who makes maps
/// relies on it. The nearest of each; NaN where nothing is known (REP 117), which is not
/// "free". The stamp is the middle of the turn and time_increment 0: a scanner may turn clockwise,
/// which LaserScan has no word for.
sensor_msgs_msg_dds__LaserScan_ laser_scan(const ScanTold& scan, const RangeLimits& limits,
                                           std::size_t angles, Arena& arena);

// convert_state.cpp:
diagnostic_msgs_msg_dds__DiagnosticArray_ diagnostics(Stamp_ns at_ns, std::string_view robot,
                                                      std::span<const DiagnosticTold> told,
                                                      Arena& arena);
aimrt_msgs_msg_dds__TouchSensorStateArray_ touch_state(const TouchTold& touch,
                                                       std::uint32_t sequence, Arena& arena);

/// A frame of a sensor on the base.
struct FixedFrame {
  std::string name;
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;
  double roll_rad = 0;
  double pitch_rad = 0;
  double yaw_rad = 0;
};
tf2_msgs_msg_dds__TFMessage_ fixed_frames(Stamp_ns at_ns, std::span<const FixedFrame> frames,
                                          Arena& arena);

}  // namespace drover::ros2
