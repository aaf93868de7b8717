#include "ros2/topics.h"

#include <moveit_msgs.h>

namespace drover::ros2 {

const std::array<TopicKind, kTopicCount>& topic_kinds() {
  static const std::array<TopicKind, kTopicCount> kinds{{
      {"rt/joint_states", &sensor_msgs_msg_dds__JointState__desc,
       "a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e"},
      {"rt/joint_state", &aimrt_msgs_msg_dds__JointStateArray__desc,
       "3387f3b916f1d35eb073fd0ca2ebe528e2c0ca1cce0de5b6ddeeda62b08c0fd7"},
      {"rt/imu/data", &sensor_msgs_msg_dds__Imu__desc,
       "7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b", Kept::few},
      {"rt/gps/fix", &sensor_msgs_msg_dds__NavSatFix__desc,
       "62223ab3fe210a15976021da7afddc9e200dc9ec75231c1b6a557fc598a65404"},
      {"rt/odom", &nav_msgs_msg_dds__Odometry__desc,
       "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0"},
      {"rt/rtk_pose", &geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc,
       "26432f9803e43727d3c8f668d1fdb3c630f548af631e2f4e31382371bfea3b6e"},
      {"rt/tf", &tf2_msgs_msg_dds__TFMessage__desc,
       "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087", Kept::hundred},
      {"rt/tf_static", &tf2_msgs_msg_dds__TFMessage__desc,
       "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087", Kept::for_later},
      {"rt/battery_state", &sensor_msgs_msg_dds__BatteryState__desc,
       "4bee5dfce981c98faa6828b868307a0a73f992ed0789f374ee96c8f840e69741"},
      {"rt/scan", &sensor_msgs_msg_dds__LaserScan__desc,
       "64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828"},
      {"rt/diagnostics", &diagnostic_msgs_msg_dds__DiagnosticArray__desc,
       "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e"},
      {"rt/touch_state", &aimrt_msgs_msg_dds__TouchSensorStateArray__desc,
       "e73636276457b096f885f41951fc4dd278431633405947a9092c1ac511f777c8"},
  }};
  return kinds;
}

const TopicKind& stop_kind() {
  static const TopicKind kind{"rt/e_stop", &std_msgs_msg_dds__Bool__desc,
                              "feb91e995ff9ebd09c0cb3d2aed18b11077585839fb5db80193b62d74528f6c9"};
  return kind;
}

const TopicKind& cmd_vel_kind(bool stamped) {
  static const std::array<TopicKind, 2> kinds{{
      {"rt/cmd_vel", &geometry_msgs_msg_dds__Twist__desc,
       "9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a"},
      {"rt/cmd_vel", &geometry_msgs_msg_dds__TwistStamped__desc,
       "5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64"},
  }};
  return kinds[stamped ? 1 : 0];
}

const TopicKind& joint_command_kind() {
  static const TopicKind kind{"rt/joint_command", &aimrt_msgs_msg_dds__JointCommandArray__desc,
                              "b54f1627593fe732147b3b50e8bea84cc65db662367463cf776d86e0fa133769"};
  return kind;
}

const TopicKind& collision_object_kind() {
  static const TopicKind kind{"rt/collision_object", &moveit_msgs_msg_dds__CollisionObject__desc,
                              "74b0acd6d56be032bf4f764b2c2633f50588b5fb2bd71e97206c59052747cf7e"};
  return kind;
}

const TopicKind& planning_constraints_kind() {
  static const TopicKind kind{"rt/planning_constraints", &moveit_msgs_msg_dds__Constraints__desc,
                              "71718200459ae8fecdc4f2c9631215f7eba5ff686c701a32e231ba8b11b3592b"};
  return kind;
}

std::string hash_user_data(const char* hash) {
  return "typehash=RIHS01_" + std::string(hash) + ";";
}

}  // namespace drover::ros2
