// Where a robot is by what ROS 2 topics tell, for tests that are readers of them.
#pragma once

#include <dds/dds.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "drover/angle.h"
#include "ros2/topics.h"

namespace drover::test {

/// On the ground.
struct GroundPlace {
  double x_m = 0, y_m = 0, yaw_rad = 0;
};

/// `b`, which is told from `a`, as `a` is told.
inline GroundPlace within(const GroundPlace& a, const GroundPlace& b) {
  const double c = std::cos(a.yaw_rad);
  const double s = std::sin(a.yaw_rad);
  return {a.x_m + c * b.x_m - s * b.y_m, a.y_m + s * b.x_m + c * b.y_m,
          wrap_rad(a.yaw_rad + b.yaw_rad)};
}

inline double yaw_of(const geometry_msgs_msg_dds__Quaternion_& q) {
  return std::atan2(2 * (q.w_ * q.z_ + q.x_ * q.y_), 1 - 2 * (q.y_ * q.y_ + q.z_ * q.z_));
}
inline GroundPlace place_of(const geometry_msgs_msg_dds__Pose_& pose) {
  return {pose.position_.x_, pose.position_.y_, yaw_of(pose.orientation_)};
}
inline GroundPlace place_of(const geometry_msgs_msg_dds__Transform_& to) {
  return {to.translation_.x_, to.translation_.y_, yaw_of(to.rotation_)};
}
inline double seconds_of(const std_msgs_msg_dds__Header_& header) {
  return header.stamp_.sec_ + 1e-9 * header.stamp_.nanosec_;
}

/// Every sample that has come.
template <class Message, class Look>
void take_each(dds_entity_t reader, const Look& look) {
  for (;;) {
    void* sample = nullptr;
    dds_sample_info_t info{};
    if (dds_take(reader, &sample, &info, 1, 1) != 1) return;
    if (info.valid_data) look(*static_cast<const Message*>(sample));
    dds_return_loan(reader, &sample, 1);
  }
}

/// The messages of /odom in a row. REP 105: it drifts, and never jumps.
class OdometryWay {
 public:
  void take(const nav_msgs_msg_dds__Odometry_& message) {
    EXPECT_STREQ(message.header_.frame_id_, "odom");
    EXPECT_STREQ(message.child_frame_id_, "base_link");
    const GroundPlace now = place_of(message.pose_.pose_);
    const double at_s = seconds_of(message.header_);
    if (place) {
      const double since_s = at_s - at_s_;
      EXPECT_GT(since_s, 0);
      EXPECT_LT(std::hypot(now.x_m - place->x_m, now.y_m - place->y_m), 0.01 + 1.0 * since_s);
      EXPECT_LT(std::abs(wrap_rad(now.yaw_rad - place->yaw_rad)), 0.02 + 1.5 * since_s);
    }
    place = now;
    at_s_ = at_s;
    ++count;
  }

  std::optional<GroundPlace> place;
  std::size_t count = 0;

 private:
  double at_s_ = 0;
};

}  // namespace drover::test
