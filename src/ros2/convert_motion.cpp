#include <cmath>

#include "drover/angle.h"
#include "ros2/convert.h"

namespace drover::ros2 {
namespace {

constexpr Stamp_ns kSecond_ns = 1'000'000'000;
/// A variance of what is not known: of the height of a pose on the level, and of its tilt.
constexpr double kUnknownVariance = 1e6;
/// Of what a base on wheels cannot do.
constexpr double kSteadyVariance = 1e-6;

std_msgs_msg_dds__Header_ header(Stamp_ns at_ns, const char* frame, Arena& arena) {
  return {time_of(at_ns), arena.text(frame)};
}

aimrt_msgs_msg_dds__MessageHeader_ aimrt_header(Stamp_ns at_ns, std::uint32_t sequence,
                                                Arena& arena) {
  return {time_of(at_ns), arena.text(kBaseFrame), sequence};
}

geometry_msgs_msg_dds__Vector3_ vector(const Vector3& v) {
  return {v.x, v.y, v.z};
}

/// Diagonal; all 0: not known (REP 145).
void put_diagonal(double (&covariance)[9], double sigma) {
  const double variance = std::isfinite(sigma) ? sigma * sigma : 0;
  for (const std::size_t i : {0U, 4U, 8U}) covariance[i] = variance;
}

/// Rows and columns: x, y, z, about x, y, z.
double& at(double (&covariance)[36], std::size_t row, std::size_t column) {
  return covariance[6 * row + column];
}
void put_both(double (&covariance)[36], std::size_t row, std::size_t column, double value) {
  at(covariance, row, column) = at(covariance, column, row) = value;
}

geometry_msgs_msg_dds__TransformStamped_ transform(Stamp_ns at_ns, const char* parent,
                                                   const char* child, double x_m, double y_m,
                                                   double yaw_rad, Arena& arena) {
  return {header(at_ns, parent, arena), arena.text(child), {{x_m, y_m, 0}, about_z(yaw_rad)}};
}

}  // namespace

builtin_interfaces_msg_dds__Time_ time_of(Stamp_ns at_ns) {
  const Stamp_ns second = at_ns >= 0 ? at_ns / kSecond_ns : 0;
  return {static_cast<std::int32_t>(second),
          static_cast<std::uint32_t>(at_ns >= 0 ? at_ns % kSecond_ns : 0)};
}

geometry_msgs_msg_dds__Quaternion_ about_z(double yaw_rad) {
  return {0, 0, std::sin(yaw_rad / 2), std::cos(yaw_rad / 2)};
}

geometry_msgs_msg_dds__Quaternion_ quaternion(double roll_rad, double pitch_rad, double yaw_rad) {
  const double cr = std::cos(roll_rad / 2);
  const double sr = std::sin(roll_rad / 2);
  const double cp = std::cos(pitch_rad / 2);
  const double sp = std::sin(pitch_rad / 2);
  const double cy = std::cos(yaw_rad / 2);
  const double sy = std::sin(yaw_rad / 2);
  return {sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
          cr * cp * cy + sr * sp * sy};
}

sensor_msgs_msg_dds__JointState_ joint_state(const JointsTold& joints, Arena& arena) {
  sensor_msgs_msg_dds__JointState_ message{};
  message.header_ = header(joints.at_ns, kBaseFrame, arena);
  const std::size_t count = joints.each.size();
  auto* name = arena.fill(message.name_, count);
  auto* position = arena.fill(message.position_, count);
  auto* velocity = arena.fill(message.velocity_, count);
  auto* effort = arena.fill(message.effort_, count);
  for (const JointTold& joint : joints.each) {
    *name++ = arena.text(joint.name);
    *position++ = joint.position_rad;
    *velocity++ = joint.velocity_radps;
    *effort++ = joint.effort_Nm;
  }
  return message;
}

aimrt_msgs_msg_dds__JointStateArray_ joint_state_array(const JointsTold& joints,
                                                       std::uint32_t sequence, Arena& arena) {
  aimrt_msgs_msg_dds__JointStateArray_ message{};
  message.header_ = aimrt_header(joints.at_ns, sequence, arena);
  auto* one = arena.fill(message.joints_, joints.each.size());
  for (const JointTold& joint : joints.each)
    *one++ = {arena.text(joint.name), joint.position_rad, joint.velocity_radps, joint.effort_Nm};
  return message;
}

sensor_msgs_msg_dds__Imu_ imu(const ImuTold& imu, Arena& arena) {
  sensor_msgs_msg_dds__Imu_ message{};
  // The sample is in the axes of the base already, whatever way round the sensor is mounted.
  message.header_ = header(imu.at_ns, kBaseFrame, arena);
  message.orientation_ = {0, 0, 0, 1};
  message.orientation_covariance_[0] = -1;  // there is none
  if (imu.orientation) {
    const Quaternion& q = *imu.orientation;
    message.orientation_ = {q.x, q.y, q.z, q.w};
    put_diagonal(message.orientation_covariance_, imu.orientation_sigma_rad);
    if (std::isfinite(imu.orientation_sigma_rad) && std::isfinite(imu.yaw_sigma_rad))
      message.orientation_covariance_[8] = imu.yaw_sigma_rad * imu.yaw_sigma_rad;
  }
  message.angular_velocity_ = vector(imu.rate_radps);
  put_diagonal(message.angular_velocity_covariance_, imu.rate_sigma_radps);
  message.linear_acceleration_ = vector(imu.acceleration_mps2);
  put_diagonal(message.linear_acceleration_covariance_, imu.acceleration_sigma_mps2);
  return message;
}

nav_msgs_msg_dds__Odometry_ odometry(const OdometryTold& way, Arena& arena) {
  nav_msgs_msg_dds__Odometry_ message{};
  message.header_ = header(way.at_ns, kOdomFrame, arena);
  message.child_frame_id_ = arena.text(kBaseFrame);
  message.pose_.pose_ = {{way.x_m, way.y_m, 0}, about_z(way.yaw_rad)};
  auto& pose = message.pose_.covariance_;
  at(pose, 0, 0) = way.x_var;
  at(pose, 1, 1) = way.y_var;
  at(pose, 5, 5) = way.yaw_var;
  put_both(pose, 0, 1, way.xy_var);
  put_both(pose, 0, 5, way.x_yaw_var);
  put_both(pose, 1, 5, way.y_yaw_var);
  for (const std::size_t i : {2U, 3U, 4U}) at(pose, i, i) = kUnknownVariance;
  message.twist_.twist_ = {{way.vx_mps, way.vy_mps, 0}, {0, 0, way.wz_radps}};
  auto& twist = message.twist_.covariance_;
  at(twist, 0, 0) = way.vx_var;
  at(twist, 1, 1) = std::max(way.vy_var, kSteadyVariance);
  at(twist, 5, 5) = way.wz_var;
  for (const std::size_t i : {2U, 3U, 4U}) at(twist, i, i) = kUnknownVariance;
  return message;
}

geometry_msgs_msg_dds__PoseWithCovarianceStamped_ rtk_pose(Stamp_ns at_ns, const PoseTold& pose,
                                                           Arena& arena) {
  geometry_msgs_msg_dds__PoseWithCovarianceStamped_ message{};
  message.header_ = header(at_ns, kMapFrame, arena);
  message.pose_.pose_ = {{pose.x_m, pose.y_m, 0}, about_z(pose.yaw_rad)};
  auto& covariance = message.pose_.covariance_;
  at(covariance, 0, 0) = at(covariance, 1, 1) = pose.position_sigma_m * pose.position_sigma_m;
  at(covariance, 5, 5) = pose.yaw_sigma_rad * pose.yaw_sigma_rad;
  for (const std::size_t i : {2U, 3U, 4U}) at(covariance, i, i) = kUnknownVariance;
  return message;
}

tf2_msgs_msg_dds__TFMessage_ frames(const OdometryTold& way, const std::optional<PoseTold>& pose,
                                    Arena& arena) {
  tf2_msgs_msg_dds__TFMessage_ message{};
  auto* one = arena.fill(message.transforms_, pose ? 2 : 1);
  one[0] = transform(way.at_ns, kOdomFrame, kBaseFrame, way.x_m, way.y_m, way.yaw_rad, arena);
  if (!pose) return message;
  // The pose, and from it back along the way to where odom begins.
  const double turn_rad = wrap_rad(pose->yaw_rad - way.yaw_rad);
  const double c = std::cos(turn_rad);
  const double s = std::sin(turn_rad);
  one[1] = transform(way.at_ns, kMapFrame, kOdomFrame, pose->x_m - (c * way.x_m - s * way.y_m),
                     pose->y_m - (s * way.x_m + c * way.y_m), turn_rad, arena);
  return message;
}

}  // namespace drover::ros2
