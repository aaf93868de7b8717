// drover-ros2 as it is shipped, between a droverd and a ROS 2 user on the same computer.
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>

#include <cmath>

#include "drover/angle.h"
#include "integration/ros2_rig.h"
#include "json/located_json.h"
#include "link/unique_fd.h"
#include "ros2/writer_names.h"
#include "runtime/clock.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
using ros2::Topic;
using testing::HasSubstr;

class Ros2 : public Ros2Rig {
 protected:
  explicit Ros2(User user = User::humble, const std::string& more = "") : Ros2Rig(user, more) {
    AxisSnapshot axis;
    axis.joint = "left";
    axis.health = SourceState::fresh;
    axis.motion = {0, 1, 2, 3};
    (void)seen_.axes.push_back(axis);
    seen_.imu.configured = seen_.gnss.configured = seen_.battery.configured = true;
    seen_.imu.health = seen_.gnss.health = seen_.battery.health = SourceState::fresh;
    seen_.imu.sample.acceleration_mps2 = {0, 0, 9.81};
    SensorSnapshot receiver;
    receiver.name = "gnss";
    receiver.in_use = true;
    (void)seen_.sensors.push_back(receiver);
    seen_.gnss.position = {.latitude_deg = 48,
                           .longitude_deg = 11,
                           .altitude_msl_m = 500,
                           .undulation_m = 46,
                           .quality = FixQuality::rtk_fixed};
    seen_.odometry.x_m = 1.5;
    seen_.odometry.vx_mps = 0.25;
    seen_.origin_set = true;
    seen_.pose.x_m = 20;
    seen_.pose.yaw_rad = kPi / 2;
    seen_.pose.position_sigma_m = seen_.pose.yaw_sigma_rad = 0.01;
    seen_.battery.sample.current_A = -2;
    const auto bumper = static_cast<std::size_t>(Line::bumper);
    seen_.line_configured[bumper] = true;
    seen_.line_health[bumper] = SourceState::fresh;
    (void)seen_.why.push_back("the e-stop is pressed");
  }

  /// A sample of it comes, and is as it should.
  template <class Message>
  void expect(Topic topic, const std::function<bool(const Message&)>& right) {
    for (const auto reliability : {DDS_RELIABILITY_RELIABLE, DDS_RELIABILITY_BEST_EFFORT}) {
      const dds_entity_t from = reader(topic, reliability);
      EXPECT_TRUE(play_until([&] {
        const auto* message = newest<Message>(from);
        return message != nullptr && right(*message);
      })) << ros2::topic_kinds()[static_cast<std::size_t>(topic)].name
          << " reliability " << reliability << "\n"
          << log();
    }
  }
  std::int64_t asked(std::string_view key) const {
    const auto request = json::parse(last_request_);
    const auto* node = request ? request->root.find(key) : nullptr;
    return node == nullptr ? -1 : node->integer().value_or(-1);
  }
};

TEST_F(Ros2, SeesTheRobotOnEveryTopicReliableAndBestEffort) {
  open_daemon();
  start_program();
  expect<sensor_msgs_msg_dds__JointState_>(Topic::joint_states, [](const auto& m) {
    return m.name_._length == 1 && m.velocity_._buffer[0] == 2 && m.header_.stamp_.sec_ > 1e9;
  });
  expect<aimrt_msgs_msg_dds__JointStateArray_>(Topic::joint_state, [](const auto& m) {
    return m.joints_._length == 1 && m.joints_._buffer[0].effort_ == 3;
  });
  expect<sensor_msgs_msg_dds__Imu_>(Topic::imu, [](const auto& m) {
    return m.linear_acceleration_.z_ == 9.81 && m.orientation_covariance_[0] == -1;
  });
  expect<sensor_msgs_msg_dds__NavSatFix_>(Topic::fix, [](const auto& m) {
    return m.altitude_ == 546 && std::string_view(m.header_.frame_id_) == "gnss";
  });
  expect<nav_msgs_msg_dds__Odometry_>(Topic::odom, [](const auto& m) {
    return m.pose_.pose_.position_.x_ == 1.5 && m.twist_.twist_.linear_.x_ == 0.25;
  });
  expect<geometry_msgs_msg_dds__PoseWithCovarianceStamped_>(
      Topic::rtk_pose, [](const auto& m) { return m.pose_.pose_.position_.x_ == 20; });
  expect<tf2_msgs_msg_dds__TFMessage_>(Topic::tf,
                                       [](const auto& m) { return m.transforms_._length == 2; });
  expect<sensor_msgs_msg_dds__BatteryState_>(
      Topic::battery_state, [](const auto& m) { return m.current_ == -2 && m.present_; });
  expect<sensor_msgs_msg_dds__LaserScan_>(Topic::scan, [](const auto& m) {
    return m.ranges_._length == 450 && m.range_max_ == 12 &&
           std::string_view(m.header_.frame_id_) == "lidar";
  });
  expect<diagnostic_msgs_msg_dds__DiagnosticArray_>(Topic::diagnostics, [](const auto& m) {
    return m.status_._length > 2 &&
           std::string_view(m.status_._buffer[0].message_) == "the e-stop is pressed";
  });
  expect<aimrt_msgs_msg_dds__TouchSensorStateArray_>(
      Topic::touch_state, [](const auto& m) { return m.names_._length == 1; });
  EXPECT_TRUE(play_until([this] { return asked("readers") == 22; })) << last_request_;
  EXPECT_EQ(asked("incompatible"), 0);
}

/// Whether somebody hears it, within two seconds.
bool is_heard(dds_entity_t writer, const std::function<void()>& meanwhile) {
  dds_publication_matched_status_t matched{};
  for (int i = 0; i < 20 && matched.current_count == 0; ++i) {
    meanwhile();
    (void)dds_get_publication_matched_status(writer, &matched);
  }
  return matched.current_count > 0;
}

class Ros2Stop : public Ros2 {
 protected:
  Ros2Stop() : Ros2(User::humble, R"(, "inputs": {"e_stop": true})") {}
  static void say(dds_entity_t by, bool stop) {
    const std_msgs_msg_dds__Bool_ message{stop};
    dds_write(by, &message);
  }
  /// Of one who is heard already: his stop was told.
  void stop_by(dds_entity_t writer) {
    ASSERT_TRUE(is_heard(writer, [this] { play_for(100ms); })) << log();
    ASSERT_TRUE(play_until([&] {
      say(writer, true);
      return stops_ > 0;
    })) << log();
    play_for(1s);
  }
};

TEST_F(Ros2Stop, StopsTheRobotByTrueAndDoesNothingByFalse) {
  open_daemon();
  start_program();
  for (const auto reliability : {DDS_RELIABILITY_RELIABLE, DDS_RELIABILITY_BEST_EFFORT}) {
    const dds_entity_t writer = stop_writer(reliability);
    ASSERT_TRUE(is_heard(writer, [this] { play_for(100ms); })) << log();
    const int before = stops_;
    std_msgs_msg_dds__Bool_ message{false};
    dds_write(writer, &message);
    play_for(300ms);
    EXPECT_EQ(stops_, before);
    message.data_ = true;
    dds_write(writer, &message);
    message.data_ = false;
    dds_write(writer, &message);
    EXPECT_TRUE(play_until([&] { return stops_ > before; })) << log();
  }
  EXPECT_THAT(log(), HasSubstr("programs on this computer may stop this robot"));
  EXPECT_THAT(log(), HasSubstr("an emergency stop was asked for on /e_stop"));
}

/// Two readers hear it. Whoever resets the first stop is not stopped by its copy.
TEST_F(Ros2Stop, IsOneStopOfEachTrueThatAReliableWriterSays) {
  open_daemon();
  start_program();
  const dds_entity_t writer = stop_writer(DDS_RELIABILITY_RELIABLE);
  ASSERT_NO_FATAL_FAILURE(stop_by(writer));
  play_for(1500ms);  // what was said more than once is here
  for (int i = 0; i < 10; ++i) {
    const int before = stops_;
    say(writer, true);
    play_for(300ms);
    EXPECT_EQ(stops_, before + 1) << i;
  }
}

TEST_F(Ros2Stop, StopsByWhatFoundNoRoomWhileItHung) {
  open_daemon();
  start_program();
  const dds_entity_t writer = stop_writer(DDS_RELIABILITY_RELIABLE);
  const dds_entity_t other = stop_writer(DDS_RELIABILITY_BEST_EFFORT);
  ASSERT_NO_FATAL_FAILURE(stop_by(writer));
  ASSERT_TRUE(is_heard(other, [this] { play_for(100ms); })) << log();
  const int before = stops_;

  program_.signal(SIGSTOP);
  // More than its socket takes.
  for (int i = 0; i < 20'000; ++i) say(other, false);
  say(writer, true);
  play_for(300ms);
  EXPECT_EQ(stops_, before);
  program_.signal(SIGCONT);
  EXPECT_TRUE(play_until([&] { return stops_ > before; })) << log();
}

/// A droverd that hangs has it in its socket, where it dies with it.
TEST_F(Ros2Stop, IsToldAgainWhereDroverdWasGoneBeforeItAnswered) {
  open_daemon();
  start_program();
  const dds_entity_t writer = stop_writer(DDS_RELIABILITY_RELIABLE);
  ASSERT_TRUE(is_heard(writer, [this] { play_for(100ms); })) << log();
  answers_stops_ = false;
  say(writer, true);
  ASSERT_TRUE(play_until([this] { return stops_ == 1; })) << log();
  play_for(1s);
  EXPECT_EQ(stops_, 1);
  close_daemon();
  open_daemon();
  answers_stops_ = true;
  ASSERT_TRUE(play_until([this] { return stops_ == 2; })) << log();
  EXPECT_THAT(log(), HasSubstr("droverd was gone before it had answered an emergency stop"));
  play_for(500ms);
  close_daemon();
  open_daemon();
  last_request_.clear();
  ASSERT_TRUE(play_until([this] { return !last_request_.empty(); })) << log();
  play_for(1s);
  EXPECT_EQ(stops_, 2) << "it was answered";
}

TEST_F(Ros2Stop, IsToldAgainAndSaidWhereDroverdHasNotDoneIt) {
  open_daemon();
  start_program();
  const dds_entity_t writer = stop_writer(DDS_RELIABILITY_RELIABLE);
  ASSERT_TRUE(is_heard(writer, [this] { play_for(100ms); })) << log();
  refused_stops_ = 2;
  say(writer, true);
  ASSERT_TRUE(play_until([this] { return stops_ == 3; })) << log();
  EXPECT_THAT(log(), HasSubstr("droverd has not done an emergency stop"));
  EXPECT_THAT(log(), HasSubstr("the control loop has not answered"));
  play_for(1s);
  EXPECT_EQ(stops_, 3) << "it was done";
  EXPECT_THAT(log(), testing::Not(HasSubstr("tells nothing"))) << "it follows on";
}

/// A journal that is stuck, or a terminal that was stopped by Ctrl-S.
TEST_F(Ros2Stop, IsToldThoughNobodyReadsTheJournal) {
  const auto journal = folder_ / "log";
  ASSERT_EQ(::mkfifo(journal.c_str(), 0600), 0);
  const link::UniqueFd nobody(::open(journal.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK));
  const std::string full(4096, 'x');
  while (::write(nobody.get(), full.data(), full.size()) > 0) {
  }
  open_daemon();
  start_program();
  const dds_entity_t writer = stop_writer(DDS_RELIABILITY_RELIABLE);
  EXPECT_TRUE(play_until([&] {
    say(writer, true);
    return stops_ > 1;
  }));
  program_.signal(SIGTERM);
  EXPECT_EQ(program_.wait(5s), 0);
}

TEST_F(Ros2Stop, IsNotPushedOutByWhatFollowsIt) {
  open_daemon();
  start_program();
  const dds_entity_t writer = stop_writer(DDS_RELIABILITY_RELIABLE);
  ASSERT_NO_FATAL_FAILURE(stop_by(writer));
  const int before = stops_;

  program_.signal(SIGSTOP);
  say(writer, true);
  for (int i = 0; i < 500; ++i) say(writer, false);
  program_.signal(SIGCONT);
  EXPECT_TRUE(play_until([&] { return stops_ > before; })) << log();
}

TEST_F(Ros2, HearsNoStopUnlessThatIsOpened) {
  open_daemon();
  start_program();
  ASSERT_TRUE(play_until([this] { return log().find("tells of the robot") != std::string::npos; }))
      << log();
  EXPECT_FALSE(is_heard(stop_writer(DDS_RELIABILITY_RELIABLE), [this] { play_for(100ms); }));
}

class Ros2Moves : public Ros2 {
 protected:
  Ros2Moves() : Ros2(User::humble, R"(, "inputs": {"cmd_vel": "twist", "joint_command": true})") {}
  dds_entity_t moving_writer(const ros2::TopicKind& kind) {
    return make_writer(participant(), kind, DDS_RELIABILITY_RELIABLE);
  }
  static Duration now() { return runtime::monotonic_now().time_since_epoch(); }
};

/// A loop that was held up must not add what it was to how long the robot follows a message.
TEST_F(Ros2Moves, ByWhatCountsFromWhenItWasSaid) {
  open_daemon();
  start_program();
  const dds_entity_t twists = moving_writer(ros2::cmd_vel_kind(false));
  const dds_entity_t joints = moving_writer(ros2::joint_command_kind());
  const auto followed = [this] {
    const FollowTwist* twist = nullptr;
    for (const Command& command : commands_)
      if (const auto* one = std::get_if<FollowTwist>(&command.body); one != nullptr) {
        twist = one;
        EXPECT_LT(command.received.time_since_epoch(), now() - 180ms);
      }
    return twist != nullptr;
  };
  EXPECT_TRUE(play_until([&] {
    const geometry_msgs_msg_dds__Twist_ message{};
    dds_write_ts(twists, &message, dds_time() - DDS_MSECS(180));
    return followed();
  })) << log();
  const auto at = [this] {
    const auto line = json::parse(last_joint_line_);
    const auto* at_ns = line ? line->root.find("at_ns") : nullptr;
    return at_ns == nullptr ? Duration{} : Duration{at_ns->integer().value_or(0)};
  };
  EXPECT_TRUE(play_until([&] {
    aimrt_msgs_msg_dds__JointCommandArray_ message{};
    message.header_.frame_id_ = const_cast<char*>("");
    dds_write_ts(joints, &message, dds_time() - DDS_MSECS(180));
    return at() > Duration{};
  })) << log();
  EXPECT_LT(at(), now() - 180ms);
}

class Ros2OfJazzy : public Ros2 {
 protected:
  Ros2OfJazzy() : Ros2(User::jazzy) {}
};

TEST_F(Ros2OfJazzy, SeesTheRobotByTheNetworksAddress) {
  open_daemon();
  start_program();
  expect<nav_msgs_msg_dds__Odometry_>(
      Topic::odom, [](const auto& m) { return m.pose_.pose_.position_.x_ == 1.5; });
}

TEST_F(Ros2, SeesTheSensorsFramesThoughItCameLater) {
  open_daemon();
  start_program();
  ASSERT_TRUE(play_until([this] { return log().find("tells of the robot") != std::string::npos; }))
      << log();
  const auto later =
      reader(Topic::tf_static, DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_TRANSIENT_LOCAL);
  EXPECT_TRUE(play_until([&] {
    const auto* message = newest<tf2_msgs_msg_dds__TFMessage_>(later);
    return message != nullptr && message->transforms_._length == 2 &&
           std::string_view(message->transforms_._buffer[1].child_frame_id_) == "lidar" &&
           message->transforms_._buffer[1].transform_.translation_.z_ == 0.35;
  })) << log();
}

TEST_F(Ros2, IsToldWhichReaderAsksForMoreThanIsOffered) {
  open_daemon();
  start_program();
  const auto wrong = reader(Topic::odom, DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_TRANSIENT_LOCAL);
  EXPECT_TRUE(play_until([this] { return asked("incompatible") == 1; })) << last_request_;
  EXPECT_THAT(log(), HasSubstr("a reader of /odom asks for a durability that is not offered"));
  EXPECT_EQ(newest<nav_msgs_msg_dds__Odometry_>(wrong), nullptr);
  dds_delete(wrong);
  EXPECT_TRUE(play_until([this] { return asked("incompatible") == 0; })) << "it is gone";
}

TEST_F(Ros2Stop, IsToldWhichWriterIsNotHeardUntilItIsGone) {
  open_daemon();
  start_program();
  dds_qos_t* qos = dds_create_qos();
  dds_qset_ownership(qos, DDS_OWNERSHIP_EXCLUSIVE);
  const auto& kind = ros2::stop_kind();
  const dds_entity_t topic =
      dds_create_topic(participant(), kind.type, kind.name, nullptr, nullptr);
  const dds_entity_t wrong = dds_create_writer(participant(), topic, qos, nullptr);
  dds_delete_qos(qos);
  ASSERT_GT(wrong, 0);
  EXPECT_TRUE(play_until([this] { return asked("incompatible") == 1; })) << last_request_;
  dds_guid_t guid{};
  ASSERT_EQ(dds_get_guid(wrong, &guid), DDS_RETCODE_OK);
  const auto named = "is not asked for, and is not heard: " + ros2::guid_text(guid);
  EXPECT_TRUE(play_until([&] { return log().find(named) != std::string::npos; })) << named << log();
  dds_delete(wrong);
  EXPECT_TRUE(play_until([this] { return asked("incompatible") == 0; })) << "it is gone";
}

TEST_F(Ros2, SeesThatDroverdIsGoneAndThatItIsBack) {
  start_program();
  const auto from = reader(Topic::diagnostics, DDS_RELIABILITY_RELIABLE);
  const auto told = [&](std::string_view what) {
    return [this, from, what] {
      const auto* message = newest<diagnostic_msgs_msg_dds__DiagnosticArray_>(from);
      return message != nullptr &&
             std::string_view(message->status_._buffer[0].message_).find(what) !=
                 std::string_view::npos;
    };
  };
  EXPECT_TRUE(play_until(told("not known"))) << log();
  open_daemon();
  EXPECT_TRUE(play_until(told("the e-stop is pressed"))) << log();
  close_daemon();
  EXPECT_TRUE(play_until(told("not known"))) << log();
  open_daemon();
  EXPECT_TRUE(play_until(told("the e-stop is pressed"))) << log();
  program_.signal(SIGTERM);
  EXPECT_EQ(program_.wait(5s), 0) << log();
}

}  // namespace
}  // namespace drover::test
