// The messages of ROS 2 Humble that drover-ros2 writes and hears, written down from their public
// definitions (common_interfaces, geometry2, AimRT) and not from its IDL: what it gets wrong is not
// wrong here in the same way. `parts` are the members in the order of the wire.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace drover::test::fast {

// builtin_interfaces, std_msgs
struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  static auto parts(auto& m) { return std::tie(m.sec, m.nanosec); }
};
struct Header {
  Time stamp;
  std::string frame_id;
  static auto parts(auto& m) { return std::tie(m.stamp, m.frame_id); }
};
struct Bool {
  static constexpr const char* kType = "std_msgs::msg::dds_::Bool_";
  bool data = false;
  static auto parts(auto& m) { return std::tie(m.data); }
};

// geometry_msgs, nav_msgs, tf2_msgs
struct Vector3 {  ///< and Point
  double x = 0;
  double y = 0;
  double z = 0;
  static auto parts(auto& m) { return std::tie(m.x, m.y, m.z); }
};
struct Quaternion {
  double x = 0;
  double y = 0;
  double z = 0;
  double w = 0;
  static auto parts(auto& m) { return std::tie(m.x, m.y, m.z, m.w); }
};
struct Pose {
  Vector3 position;
  Quaternion orientation;
  static auto parts(auto& m) { return std::tie(m.position, m.orientation); }
};
struct PoseWithCovariance {
  Pose pose;
  std::array<double, 36> covariance{};
  static auto parts(auto& m) { return std::tie(m.pose, m.covariance); }
};
struct PoseWithCovarianceStamped {
  static constexpr const char* kType = "geometry_msgs::msg::dds_::PoseWithCovarianceStamped_";
  Header header;
  PoseWithCovariance pose;
  static auto parts(auto& m) { return std::tie(m.header, m.pose); }
};
struct Twist {
  static constexpr const char* kType = "geometry_msgs::msg::dds_::Twist_";
  Vector3 linear;
  Vector3 angular;
  static auto parts(auto& m) { return std::tie(m.linear, m.angular); }
};
struct TwistStamped {
  static constexpr const char* kType = "geometry_msgs::msg::dds_::TwistStamped_";
  Header header;
  Twist twist;
  static auto parts(auto& m) { return std::tie(m.header, m.twist); }
};
struct TwistWithCovariance {
  Twist twist;
  std::array<double, 36> covariance{};
  static auto parts(auto& m) { return std::tie(m.twist, m.covariance); }
};
struct Odometry {
  static constexpr const char* kType = "nav_msgs::msg::dds_::Odometry_";
  Header header;
  std::string child_frame_id;
  PoseWithCovariance pose;
  TwistWithCovariance twist;
  static auto parts(auto& m) { return std::tie(m.header, m.child_frame_id, m.pose, m.twist); }
};
struct Transform {
  Vector3 translation;
  Quaternion rotation;
  static auto parts(auto& m) { return std::tie(m.translation, m.rotation); }
};
struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Transform transform;
  static auto parts(auto& m) { return std::tie(m.header, m.child_frame_id, m.transform); }
};
struct TFMessage {
  static constexpr const char* kType = "tf2_msgs::msg::dds_::TFMessage_";
  std::vector<TransformStamped> transforms;
  static auto parts(auto& m) { return std::tie(m.transforms); }
};

// sensor_msgs
struct JointState {
  static constexpr const char* kType = "sensor_msgs::msg::dds_::JointState_";
  Header header;
  std::vector<std::string> name;
  std::vector<double> position;
  std::vector<double> velocity;
  std::vector<double> effort;
  static auto parts(auto& m) {
    return std::tie(m.header, m.name, m.position, m.velocity, m.effort);
  }
};
struct Imu {
  static constexpr const char* kType = "sensor_msgs::msg::dds_::Imu_";
  Header header;
  Quaternion orientation;
  std::array<double, 9> orientation_covariance{};
  Vector3 angular_velocity;
  std::array<double, 9> angular_velocity_covariance{};
  Vector3 linear_acceleration;
  std::array<double, 9> linear_acceleration_covariance{};
  static auto parts(auto& m) {
    return std::tie(m.header, m.orientation, m.orientation_covariance, m.angular_velocity,
                    m.angular_velocity_covariance, m.linear_acceleration,
                    m.linear_acceleration_covariance);
  }
};
struct NavSatStatus {
  std::int8_t status = 0;
  std::uint16_t service = 0;
  static auto parts(auto& m) { return std::tie(m.status, m.service); }
};
struct NavSatFix {
  static constexpr const char* kType = "sensor_msgs::msg::dds_::NavSatFix_";
  Header header;
  NavSatStatus status;
  double latitude = 0;
  double longitude = 0;
  double altitude = 0;
  std::array<double, 9> position_covariance{};
  std::uint8_t position_covariance_type = 0;
  static auto parts(auto& m) {
    return std::tie(m.header, m.status, m.latitude, m.longitude, m.altitude, m.position_covariance,
                    m.position_covariance_type);
  }
};
struct BatteryState {
  static constexpr const char* kType = "sensor_msgs::msg::dds_::BatteryState_";
  Header header;
  float voltage = 0;
  float temperature = 0;
  float current = 0;
  float charge = 0;
  float capacity = 0;
  float design_capacity = 0;
  float percentage = 0;
  std::uint8_t power_supply_status = 0;
  std::uint8_t power_supply_health = 0;
  std::uint8_t power_supply_technology = 0;
  bool present = false;
  std::vector<float> cell_voltage;
  std::vector<float> cell_temperature;
  std::string location;
  std::string serial_number;
  static auto parts(auto& m) {
    return std::tie(m.header, m.voltage, m.temperature, m.current, m.charge, m.capacity,
                    m.design_capacity, m.percentage, m.power_supply_status, m.power_supply_health,
                    m.power_supply_technology, m.present, m.cell_voltage, m.cell_temperature,
                    m.location, m.serial_number);
  }
};
struct LaserScan {
  static constexpr const char* kType = "sensor_msgs::msg::dds_::LaserScan_";
  Header header;
  float angle_min = 0;
  float angle_max = 0;
  float angle_increment = 0;
  float time_increment = 0;
  float scan_time = 0;
  float range_min = 0;
  float range_max = 0;
  std::vector<float> ranges;
  std::vector<float> intensities;
  static auto parts(auto& m) {
    return std::tie(m.header, m.angle_min, m.angle_max, m.angle_increment, m.time_increment,
                    m.scan_time, m.range_min, m.range_max, m.ranges, m.intensities);
  }
};

// diagnostic_msgs
struct KeyValue {
  std::string key;
  std::string value;
  static auto parts(auto& m) { return std::tie(m.key, m.value); }
};
struct DiagnosticStatus {
  std::uint8_t level = 0;
  std::string name;
  std::string message;
  std::string hardware_id;
  std::vector<KeyValue> values;
  static auto parts(auto& m) {
    return std::tie(m.level, m.name, m.message, m.hardware_id, m.values);
  }
};
struct DiagnosticArray {
  static constexpr const char* kType = "diagnostic_msgs::msg::dds_::DiagnosticArray_";
  Header header;
  std::vector<DiagnosticStatus> status;
  static auto parts(auto& m) { return std::tie(m.header, m.status); }
};

// aimrt_msgs
struct MessageHeader {
  Time stamp;
  std::string frame_id;
  std::uint32_t sequence = 0;
  static auto parts(auto& m) { return std::tie(m.stamp, m.frame_id, m.sequence); }
};
struct AimrtJoint {
  std::string name;
  double position = 0;
  double velocity = 0;
  double effort = 0;
  static auto parts(auto& m) { return std::tie(m.name, m.position, m.velocity, m.effort); }
};
struct JointStateArray {
  static constexpr const char* kType = "aimrt_msgs::msg::dds_::JointStateArray_";
  MessageHeader header;
  std::vector<AimrtJoint> joints;
  static auto parts(auto& m) { return std::tie(m.header, m.joints); }
};
struct AimrtJointCommand {
  std::string name;
  double position = 0;
  double velocity = 0;
  double effort = 0;
  double stiffness = 0;
  double damping = 0;
  static auto parts(auto& m) {
    return std::tie(m.name, m.position, m.velocity, m.effort, m.stiffness, m.damping);
  }
};
struct JointCommandArray {
  static constexpr const char* kType = "aimrt_msgs::msg::dds_::JointCommandArray_";
  MessageHeader header;
  std::vector<AimrtJointCommand> joints;
  static auto parts(auto& m) { return std::tie(m.header, m.joints); }
};
struct TouchSensorState {
  std::vector<std::int16_t> pressure;
  static auto parts(auto& m) { return std::tie(m.pressure); }
};
struct TouchSensorStateArray {
  static constexpr const char* kType = "aimrt_msgs::msg::dds_::TouchSensorStateArray_";
  MessageHeader header;
  std::vector<std::string> names;
  std::vector<TouchSensorState> states;
  static auto parts(auto& m) { return std::tie(m.header, m.names, m.states); }
};

template <class M>
concept Composed = requires(M& m) {
  std::remove_const_t<M>::parts(m);
};

}  // namespace drover::test::fast
