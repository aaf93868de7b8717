// Every message that drover-ros2 writes or hears, with another value in each member: the bytes that
// our types (idlc, Cyclone DDS) make of it are those that Fast-CDR makes of the definition, and
// each side reads the other's.
#include <dds/dds.h>
// Behind it:
#include <dds/ddsi/ddsi_serdata.h>
#include <moveit_msgs.h>
#include <unistd.h>

#include <algorithm>
#include <limits>

#include "integration/ros2_fastdds_bytes.h"
#include "integration/ros2_user.h"
#include "ros2/arena.h"
#include "ros2/topics.h"

namespace drover::test {
namespace {

using fast::Bytes;
using ros2::Topic;

/// Puts another value into each member: texts and lists of changing lengths, so that what follows
/// them begins anywhere.
class Filler {
 public:
  explicit Filler(std::size_t length) : length_(length) {}

  template <fast::Composed M>
  void fill(M& message) {
    std::apply([this](auto&... part) { (fill(part), ...); }, M::parts(message));
  }
  template <class T>
  void fill(std::vector<T>& list) {
    list.resize(length_);
    for (auto& one : list) fill(one);
  }
  void fill(fast::SolidPrimitive& primitive) {
    std::apply([this](auto&... part) { (fill(part), ...); },
               fast::SolidPrimitive::parts(primitive));
    primitive.dimensions.resize(std::min<std::size_t>(length_, 3));
  }
  template <class T, std::size_t kSize>
  void fill(std::array<T, kSize>& list) {
    for (auto& one : list) fill(one);
  }
  void fill(std::string& text) {
    ++next_;
    text = std::string(next_ % 9, 'x') + std::to_string(next_);
  }
  void fill(bool& flag) { flag = true; }
  template <class T>
  requires std::is_integral_v<T>
  void fill(T& number) { number = static_cast<T>(std::is_signed_v<T> ? -++next_ : ++next_); }
  template <class T>
  requires std::is_floating_point_v<T>
  void fill(T& number) {
    number = ++next_ % 7 == 0 ? std::numeric_limits<T>::quiet_NaN()
                              : static_cast<T>(-1.0 / 3) * static_cast<T>(next_);
  }

 private:
  std::size_t length_;
  int next_ = 0;
};

// The same values in our types, member by member by their names.

class Ours {
 public:
  char* of(const std::string& text) { return arena_.text(text); }
  template <class T, std::size_t kSize>
  static void copy(T (&to)[kSize], const std::array<T, kSize>& from) {
    std::copy(from.begin(), from.end(), to);
  }
  template <class Sequence, class T>
  void list(Sequence& to, const std::vector<T>& from) {
    auto* one = arena_.fill(to, from.size());
    for (const auto& value : from) {
      if constexpr (std::is_arithmetic_v<T>)
        *one++ = value;
      else
        *one++ = of(value);
    }
  }

  static builtin_interfaces_msg_dds__Time_ of(const fast::Time& m) {
    builtin_interfaces_msg_dds__Time_ o{};
    o.sec_ = m.sec;
    o.nanosec_ = m.nanosec;
    return o;
  }
  std_msgs_msg_dds__Header_ of(const fast::Header& m) {
    std_msgs_msg_dds__Header_ o{};
    o.stamp_ = of(m.stamp);
    o.frame_id_ = of(m.frame_id);
    return o;
  }
  static std_msgs_msg_dds__Bool_ of(const fast::Bool& m) { return {m.data}; }
  static geometry_msgs_msg_dds__Vector3_ of(const fast::Vector3& m) {
    geometry_msgs_msg_dds__Vector3_ o{};
    o.x_ = m.x;
    o.y_ = m.y;
    o.z_ = m.z;
    return o;
  }
  static geometry_msgs_msg_dds__Quaternion_ of(const fast::Quaternion& m) {
    geometry_msgs_msg_dds__Quaternion_ o{};
    o.x_ = m.x;
    o.y_ = m.y;
    o.z_ = m.z;
    o.w_ = m.w;
    return o;
  }
  static geometry_msgs_msg_dds__Pose_ of(const fast::Pose& m) {
    geometry_msgs_msg_dds__Pose_ o{};
    o.position_ = {m.position.x, m.position.y, m.position.z};
    o.orientation_ = of(m.orientation);
    return o;
  }
  static geometry_msgs_msg_dds__PoseWithCovariance_ of(const fast::PoseWithCovariance& m) {
    geometry_msgs_msg_dds__PoseWithCovariance_ o{};
    o.pose_ = of(m.pose);
    copy(o.covariance_, m.covariance);
    return o;
  }
  geometry_msgs_msg_dds__PoseWithCovarianceStamped_ of(const fast::PoseWithCovarianceStamped& m) {
    geometry_msgs_msg_dds__PoseWithCovarianceStamped_ o{};
    o.header_ = of(m.header);
    o.pose_ = of(m.pose);
    return o;
  }
  static geometry_msgs_msg_dds__Twist_ of(const fast::Twist& m) {
    geometry_msgs_msg_dds__Twist_ o{};
    o.linear_ = of(m.linear);
    o.angular_ = of(m.angular);
    return o;
  }
  geometry_msgs_msg_dds__TwistStamped_ of(const fast::TwistStamped& m) {
    geometry_msgs_msg_dds__TwistStamped_ o{};
    o.header_ = of(m.header);
    o.twist_ = of(m.twist);
    return o;
  }
  nav_msgs_msg_dds__Odometry_ of(const fast::Odometry& m) {
    nav_msgs_msg_dds__Odometry_ o{};
    o.header_ = of(m.header);
    o.child_frame_id_ = of(m.child_frame_id);
    o.pose_ = of(m.pose);
    o.twist_.twist_ = of(m.twist.twist);
    copy(o.twist_.covariance_, m.twist.covariance);
    return o;
  }
  geometry_msgs_msg_dds__TransformStamped_ of(const fast::TransformStamped& m) {
    geometry_msgs_msg_dds__TransformStamped_ o{};
    o.header_ = of(m.header);
    o.child_frame_id_ = of(m.child_frame_id);
    o.transform_.translation_ = of(m.transform.translation);
    o.transform_.rotation_ = of(m.transform.rotation);
    return o;
  }
  tf2_msgs_msg_dds__TFMessage_ of(const fast::TFMessage& m) {
    tf2_msgs_msg_dds__TFMessage_ o{};
    list(o.transforms_, m.transforms);
    return o;
  }
  sensor_msgs_msg_dds__JointState_ of(const fast::JointState& m) {
    sensor_msgs_msg_dds__JointState_ o{};
    o.header_ = of(m.header);
    list(o.name_, m.name);
    list(o.position_, m.position);
    list(o.velocity_, m.velocity);
    list(o.effort_, m.effort);
    return o;
  }
  sensor_msgs_msg_dds__Imu_ of(const fast::Imu& m) {
    sensor_msgs_msg_dds__Imu_ o{};
    o.header_ = of(m.header);
    o.orientation_ = of(m.orientation);
    copy(o.orientation_covariance_, m.orientation_covariance);
    o.angular_velocity_ = of(m.angular_velocity);
    copy(o.angular_velocity_covariance_, m.angular_velocity_covariance);
    o.linear_acceleration_ = of(m.linear_acceleration);
    copy(o.linear_acceleration_covariance_, m.linear_acceleration_covariance);
    return o;
  }
  sensor_msgs_msg_dds__NavSatFix_ of(const fast::NavSatFix& m) {
    sensor_msgs_msg_dds__NavSatFix_ o{};
    o.header_ = of(m.header);
    o.status_.status_ = m.status.status;
    o.status_.service_ = m.status.service;
    o.latitude_ = m.latitude;
    o.longitude_ = m.longitude;
    o.altitude_ = m.altitude;
    copy(o.position_covariance_, m.position_covariance);
    o.position_covariance_type_ = m.position_covariance_type;
    return o;
  }
  sensor_msgs_msg_dds__BatteryState_ of(const fast::BatteryState& m) {
    sensor_msgs_msg_dds__BatteryState_ o{};
    o.header_ = of(m.header);
    o.voltage_ = m.voltage;
    o.temperature_ = m.temperature;
    o.current_ = m.current;
    o.charge_ = m.charge;
    o.capacity_ = m.capacity;
    o.design_capacity_ = m.design_capacity;
    o.percentage_ = m.percentage;
    o.power_supply_status_ = m.power_supply_status;
    o.power_supply_health_ = m.power_supply_health;
    o.power_supply_technology_ = m.power_supply_technology;
    o.present_ = m.present;
    list(o.cell_voltage_, m.cell_voltage);
    list(o.cell_temperature_, m.cell_temperature);
    o.location_ = of(m.location);
    o.serial_number_ = of(m.serial_number);
    return o;
  }
  sensor_msgs_msg_dds__LaserScan_ of(const fast::LaserScan& m) {
    sensor_msgs_msg_dds__LaserScan_ o{};
    o.header_ = of(m.header);
    o.angle_min_ = m.angle_min;
    o.angle_max_ = m.angle_max;
    o.angle_increment_ = m.angle_increment;
    o.time_increment_ = m.time_increment;
    o.scan_time_ = m.scan_time;
    o.range_min_ = m.range_min;
    o.range_max_ = m.range_max;
    list(o.ranges_, m.ranges);
    list(o.intensities_, m.intensities);
    return o;
  }
  diagnostic_msgs_msg_dds__KeyValue_ of(const fast::KeyValue& m) {
    diagnostic_msgs_msg_dds__KeyValue_ o{};
    o.key_ = of(m.key);
    o.value_ = of(m.value);
    return o;
  }
  diagnostic_msgs_msg_dds__DiagnosticStatus_ of(const fast::DiagnosticStatus& m) {
    diagnostic_msgs_msg_dds__DiagnosticStatus_ o{};
    o.level_ = m.level;
    o.name_ = of(m.name);
    o.message_ = of(m.message);
    o.hardware_id_ = of(m.hardware_id);
    list(o.values_, m.values);
    return o;
  }
  diagnostic_msgs_msg_dds__DiagnosticArray_ of(const fast::DiagnosticArray& m) {
    diagnostic_msgs_msg_dds__DiagnosticArray_ o{};
    o.header_ = of(m.header);
    list(o.status_, m.status);
    return o;
  }
  aimrt_msgs_msg_dds__MessageHeader_ of(const fast::MessageHeader& m) {
    aimrt_msgs_msg_dds__MessageHeader_ o{};
    o.stamp_ = of(m.stamp);
    o.frame_id_ = of(m.frame_id);
    o.sequence_ = m.sequence;
    return o;
  }
  aimrt_msgs_msg_dds__JointState_ of(const fast::AimrtJoint& m) {
    aimrt_msgs_msg_dds__JointState_ o{};
    o.name_ = of(m.name);
    o.position_ = m.position;
    o.velocity_ = m.velocity;
    o.effort_ = m.effort;
    return o;
  }
  aimrt_msgs_msg_dds__JointStateArray_ of(const fast::JointStateArray& m) {
    aimrt_msgs_msg_dds__JointStateArray_ o{};
    o.header_ = of(m.header);
    list(o.joints_, m.joints);
    return o;
  }
  aimrt_msgs_msg_dds__TouchSensorState_ of(const fast::TouchSensorState& m) {
    aimrt_msgs_msg_dds__TouchSensorState_ o{};
    list(o.pressure_, m.pressure);
    return o;
  }
  aimrt_msgs_msg_dds__TouchSensorStateArray_ of(const fast::TouchSensorStateArray& m) {
    aimrt_msgs_msg_dds__TouchSensorStateArray_ o{};
    o.header_ = of(m.header);
    list(o.names_, m.names);
    list(o.states_, m.states);
    return o;
  }
  geometry_msgs_msg_dds__PoseStamped_ of(const fast::PoseStamped& m) {
    geometry_msgs_msg_dds__PoseStamped_ o{};
    o.header_ = of(m.header);
    o.pose_ = of(m.pose);
    return o;
  }
  shape_msgs_msg_dds__SolidPrimitive_ of(const fast::SolidPrimitive& m) {
    shape_msgs_msg_dds__SolidPrimitive_ o{};
    o.type_ = m.type;
    list(o.dimensions_, m.dimensions);
    o.dimensions_._maximum = 3;
    auto* point = arena_.fill(o.polygon_.points_, m.polygon.points.size());
    for (const auto& from : m.polygon.points) {
      point->x_ = from.x;
      point->y_ = from.y;
      (point++)->z_ = from.z;
    }
    return o;
  }
  shape_msgs_msg_dds__Mesh_ of(const fast::Mesh& m) {
    shape_msgs_msg_dds__Mesh_ o{};
    auto* triangle = arena_.fill(o.triangles_, m.triangles.size());
    for (const auto& from : m.triangles) copy((triangle++)->vertex_indices_, from.vertex_indices);
    auto* vertex = arena_.fill(o.vertices_, m.vertices.size());
    for (const auto& from : m.vertices) {
      vertex->x_ = from.x;
      vertex->y_ = from.y;
      (vertex++)->z_ = from.z;
    }
    return o;
  }
  static shape_msgs_msg_dds__Plane_ of(const fast::Plane& m) {
    shape_msgs_msg_dds__Plane_ o{};
    copy(o.coef_, m.coef);
    return o;
  }
  moveit_msgs_msg_dds__CollisionObject_ of(const fast::CollisionObject& m) {
    moveit_msgs_msg_dds__CollisionObject_ o{};
    o.header_ = of(m.header);
    o.pose_ = of(m.pose);
    o.id_ = of(m.id);
    o.type_.key_ = of(m.type.key);
    o.type_.db_ = of(m.type.db);
    list(o.primitives_, m.primitives);
    list(o.primitive_poses_, m.primitive_poses);
    list(o.meshes_, m.meshes);
    list(o.mesh_poses_, m.mesh_poses);
    list(o.planes_, m.planes);
    list(o.plane_poses_, m.plane_poses);
    list(o.subframe_names_, m.subframe_names);
    list(o.subframe_poses_, m.subframe_poses);
    o.operation_ = m.operation;
    return o;
  }
  moveit_msgs_msg_dds__JointConstraint_ of(const fast::JointConstraint& m) {
    moveit_msgs_msg_dds__JointConstraint_ o{};
    o.joint_name_ = of(m.joint_name);
    o.position_ = m.position;
    o.tolerance_above_ = m.tolerance_above;
    o.tolerance_below_ = m.tolerance_below;
    o.weight_ = m.weight;
    return o;
  }
  moveit_msgs_msg_dds__PositionConstraint_ of(const fast::PositionConstraint& m) {
    moveit_msgs_msg_dds__PositionConstraint_ o{};
    o.header_ = of(m.header);
    o.link_name_ = of(m.link_name);
    o.target_point_offset_ = of(m.target_point_offset);
    list(o.constraint_region_.primitives_, m.constraint_region.primitives);
    list(o.constraint_region_.primitive_poses_, m.constraint_region.primitive_poses);
    list(o.constraint_region_.meshes_, m.constraint_region.meshes);
    list(o.constraint_region_.mesh_poses_, m.constraint_region.mesh_poses);
    o.weight_ = m.weight;
    return o;
  }
  moveit_msgs_msg_dds__OrientationConstraint_ of(const fast::OrientationConstraint& m) {
    moveit_msgs_msg_dds__OrientationConstraint_ o{};
    o.header_ = of(m.header);
    o.orientation_ = of(m.orientation);
    o.link_name_ = of(m.link_name);
    o.absolute_x_axis_tolerance_ = m.absolute_x_axis_tolerance;
    o.absolute_y_axis_tolerance_ = m.absolute_y_axis_tolerance;
    o.absolute_z_axis_tolerance_ = m.absolute_z_axis_tolerance;
    o.parameterization_ = m.parameterization;
    o.weight_ = m.weight;
    return o;
  }
  moveit_msgs_msg_dds__VisibilityConstraint_ of(const fast::VisibilityConstraint& m) {
    moveit_msgs_msg_dds__VisibilityConstraint_ o{};
    o.target_radius_ = m.target_radius;
    o.target_pose_ = of(m.target_pose);
    o.cone_sides_ = m.cone_sides;
    o.sensor_pose_ = of(m.sensor_pose);
    o.max_view_angle_ = m.max_view_angle;
    o.max_range_angle_ = m.max_range_angle;
    o.sensor_view_direction_ = m.sensor_view_direction;
    o.weight_ = m.weight;
    return o;
  }
  moveit_msgs_msg_dds__Constraints_ of(const fast::Constraints& m) {
    moveit_msgs_msg_dds__Constraints_ o{};
    o.name_ = of(m.name);
    list(o.joint_constraints_, m.joint_constraints);
    list(o.position_constraints_, m.position_constraints);
    list(o.orientation_constraints_, m.orientation_constraints);
    list(o.visibility_constraints_, m.visibility_constraints);
    return o;
  }

 private:
  ros2::Arena arena_;
};

Bytes bytes_of(const ddsi_serdata* data) {
  Bytes bytes(ddsi_serdata_size(data));
  ddsi_serdata_to_ser(data, 0, bytes.size(), bytes.data());
  return bytes;
}

class Cdr : public ::testing::Test {
 protected:
  Cdr() {
    const auto domain = static_cast<dds_domainid_t>(100 + ::getpid() % 100);
    dds_ = dds_create_domain(domain, settings_of(User::humble).c_str());
    participant_ = dds_create_participant(domain, nullptr, nullptr);
    EXPECT_GT(participant_, 0);
  }
  ~Cdr() override { dds_delete(dds_); }

  /// As a reader of the same program gets it.
  ddsi_serdata* written(const ros2::TopicKind& kind, const void* sample) {
    const dds_entity_t writer = make_writer(participant_, kind, DDS_RELIABILITY_RELIABLE);
    const dds_entity_t topic =
        dds_create_topic(participant_, kind.type, kind.name, nullptr, nullptr);
    const dds_entity_t reader = dds_create_reader(participant_, topic, nullptr, nullptr);
    EXPECT_EQ(dds_write(writer, sample), DDS_RETCODE_OK);
    ddsi_serdata* data = nullptr;
    dds_sample_info_t info{};
    EXPECT_EQ(dds_takecdr(reader, &data, 1, &info, DDS_ANY_STATE), 1);
    for (const dds_entity_t entity : {reader, topic, writer}) dds_delete(entity);
    return data;
  }
  /// What our type reads out of `bytes`, written again.
  static Bytes read_and_written(const ros2::TopicKind& kind, const ddsi_sertype* type,
                                Bytes bytes) {
    const ddsrt_iovec_t all{bytes.data(), bytes.size()};
    ddsi_serdata* came = ddsi_serdata_from_ser_iov(type, SDK_DATA, 1, &all, bytes.size());
    if (came == nullptr) return {};
    void* sample = dds_alloc(kind.type->m_size);
    EXPECT_TRUE(ddsi_serdata_to_sample(came, sample, nullptr, nullptr));
    ddsi_serdata* again = ddsi_serdata_from_sample(type, SDK_DATA, sample);
    const Bytes out = bytes_of(again);
    dds_sample_free(sample, kind.type, DDS_FREE_ALL);
    ddsi_serdata_unref(again);
    ddsi_serdata_unref(came);
    return out;
  }
  template <class M>
  void expect_equal(const ros2::TopicKind& kind) {
    SCOPED_TRACE(M::kType);
    EXPECT_STREQ(kind.type->m_typename, M::kType);
    for (const std::size_t length : {0U, 1U, 2U, 3U, 7U}) {
      M message;
      Filler(length).fill(message);
      Ours values;
      const auto ours = values.of(message);
      ddsi_serdata* data = written(kind, &ours);
      ASSERT_NE(data, nullptr);
      const Bytes cyclone = bytes_of(data);
      const Bytes by_fast = fast::to_cdr(message);
      expect_same_cdr(cyclone, by_fast);
      // Each reads the other's.
      EXPECT_EQ(read_and_written(kind, data->type, by_fast), cyclone);
      const auto read = fast::from_cdr<M>(cyclone);
      ASSERT_TRUE(read);
      EXPECT_EQ(fast::to_cdr(*read), by_fast);
      ddsi_serdata_unref(data);
    }
  }
  template <class M>
  void expect_equal(Topic topic) {
    expect_equal<M>(ros2::topic_kinds()[static_cast<std::size_t>(topic)]);
  }

 private:
  dds_entity_t dds_ = 0;
  dds_entity_t participant_ = 0;
};

TEST_F(Cdr, OfEachTypeIsThatOfFastCdr) {
  expect_equal<fast::JointState>(Topic::joint_states);
  expect_equal<fast::JointStateArray>(Topic::joint_state);
  expect_equal<fast::Imu>(Topic::imu);
  expect_equal<fast::NavSatFix>(Topic::fix);
  expect_equal<fast::Odometry>(Topic::odom);
  expect_equal<fast::PoseWithCovarianceStamped>(Topic::rtk_pose);
  expect_equal<fast::TFMessage>(Topic::tf);
  expect_equal<fast::TFMessage>(Topic::tf_static);
  expect_equal<fast::BatteryState>(Topic::battery_state);
  expect_equal<fast::LaserScan>(Topic::scan);
  expect_equal<fast::DiagnosticArray>(Topic::diagnostics);
  expect_equal<fast::TouchSensorStateArray>(Topic::touch_state);
  static_assert(ros2::kTopicCount == 12);
  expect_equal<fast::Bool>(ros2::stop_kind());
  expect_equal<fast::Twist>(ros2::cmd_vel_kind(false));
  expect_equal<fast::TwistStamped>(ros2::cmd_vel_kind(true));
  expect_equal<fast::CollisionObject>(ros2::collision_object_kind());
  expect_equal<fast::Constraints>(ros2::planning_constraints_kind());
}

}  // namespace
}  // namespace drover::test
