// The place by ROS 2 while the receiver's jumps: /odom goes on as wheels and gyro do, what is in
// `map` moves.
#include <cmath>
#include <optional>

#include "integration/ros2_drive_rig.h"
#include "integration/ros2_places.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;

constexpr double kJump_m = 3;
constexpr const char* kJumpNorth = "jump:3:90";

double apart_m(const GroundPlace& a, const GroundPlace& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

class PlaceByRos2 : public MovedFromRos2 {
 protected:
  PlaceByRos2()
      : MovedFromRos2(R"("cmd_vel": "twist")"),
        odom_reader_(reader(ros2::Topic::odom)),
        pose_reader_(reader(ros2::Topic::rtk_pose)),
        tf_reader_(reader(ros2::Topic::tf)) {}

  void take() {
    take_each<nav_msgs_msg_dds__Odometry_>(odom_reader_, [this](const auto& m) { odom_.take(m); });
    take_each<geometry_msgs_msg_dds__PoseWithCovarianceStamped_>(
        pose_reader_, [this](const auto& m) { rtk_pose_ = place_of(m.pose_.pose_); });
    take_each<tf2_msgs_msg_dds__TFMessage_>(tf_reader_, [this](const auto& m) {
      for (std::uint32_t i = 0; i < m.transforms_._length; ++i)
        if (std::string_view(m.transforms_._buffer[i].child_frame_id_) == "odom")
          odom_in_map_ = place_of(m.transforms_._buffer[i].transform_);
    });
  }
  /// At 20 Hz, and hears meanwhile.
  bool say_until(double vx_mps, const std::function<bool()>& done) {
    return repeat_until(
        [&] {
          take();
          const geometry_msgs_msg_dds__Twist_ message{{vx_mps, 0, 0}, {0, 0, 0}};
          dds_write(writer_, &message);
        },
        50ms, done, 60s);
  }
  void say_for(double vx_mps, double seconds) {
    const double end_s = now_s() + seconds;
    ASSERT_TRUE(say_until(vx_mps, [end_s] { return now_s() > end_s; }));
  }
  /// Drives so far by /odom.
  void drive(double way_m) {
    const GroundPlace begin = *odom_.place;
    ASSERT_TRUE(say_until(0.4, [&] { return apart_m(*odom_.place, begin) > way_m; }))
        << status() << program_.output();
  }
  void receiver(const char* state) { ASSERT_EQ(sim({"gnss", state}), "ok\n"); }
  /// Once: from each time on the place is looked for anew.
  void accept() {
    std::string said;
    for (int i = 0; i < 30 && said != "done\n"; ++i) {
      ASSERT_NO_FATAL_FAILURE(say_for(0, 1));
      said = drover({"position", "accept"}).text;
    }
    ASSERT_EQ(said, "done\n") << status();
  }
  struct Places {
    GroundPlace odom, pose, odom_in_map;
  };
  Places now() const { return {*odom_.place, *rtk_pose_, *odom_in_map_}; }
  /// A person believes the receiver, which is elsewhere: map moves to there, /odom does not. Found
  /// again elsewhere it may be there before he does (seen on busy computers); it says so, and waits
  /// for him all the same.
  void accept_and_see(double north_m, const Places& before) {
    ASSERT_NO_FATAL_FAILURE(accept());
    ASSERT_TRUE(say_until(0,
                          [&] {
                            return std::abs(rtk_pose_->y_m - before.pose.y_m - north_m) < 0.3 &&
                                   apart_m(*odom_in_map_, before.odom_in_map) > kJump_m / 2;
                          }))
        << rtk_pose_->y_m - before.pose.y_m << " m\n"
        << status();
    ASSERT_NO_FATAL_FAILURE(say_for(0, 1));
    EXPECT_LT(apart_m(*odom_.place, before.odom), 0.05);
    EXPECT_LT(std::abs(wrap_rad(odom_.place->yaw_rad - before.odom.yaw_rad)), 0.05);
  }

  dds_entity_t reader(ros2::Topic topic) const {
    return make_reader(participant_, ros2::topic_kinds().at(static_cast<std::size_t>(topic)),
                       DDS_RELIABILITY_RELIABLE);
  }

  dds_entity_t odom_reader_, pose_reader_, tf_reader_;
  OdometryWay odom_;
  std::optional<GroundPlace> rtk_pose_, odom_in_map_;
};

TEST_F(PlaceByRos2, JumpsInTheMapOnlyWhenTheReceiverDoes) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::cmd_vel_kind(false)));
  ASSERT_TRUE(say_until(0, [this] { return odom_.place && rtk_pose_ && odom_in_map_; }))
      << program_.output();
  ASSERT_NO_FATAL_FAILURE(say_for(0, 1));
  ASSERT_NO_FATAL_FAILURE(drive(0.5));

  // While it drives, then standing; and once more, found again elsewhere.
  ASSERT_NO_FATAL_FAILURE(receiver(kJumpNorth));
  ASSERT_NO_FATAL_FAILURE(drive(1));
  ASSERT_NO_FATAL_FAILURE(say_for(0, 2));
  ASSERT_NO_FATAL_FAILURE(accept_and_see(kJump_m, now()));

  const Places before = now();
  ASSERT_NO_FATAL_FAILURE(receiver("none"));
  ASSERT_NO_FATAL_FAILURE(say_for(0, 2));
  ASSERT_NO_FATAL_FAILURE(receiver("jump:0"));
  ASSERT_NO_FATAL_FAILURE(receiver("fix"));
  ASSERT_NO_FATAL_FAILURE(say_for(0, 2));
  ASSERT_NO_FATAL_FAILURE(accept_and_see(-kJump_m, before));
  EXPECT_GT(odom_.count, 200U);
}

}  // namespace
}  // namespace drover::test
