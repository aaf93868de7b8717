// drover-ros2 as it is shipped, and a ROS 2 user whose DDS is not ours: Fast DDS, with messages
// written down from ROS 2's definitions.
#include <signal.h>

#include <cmath>

#include "drover/angle.h"
#include "integration/ros2_fastdds_bytes.h"
#include "integration/ros2_fastdds_user.h"
#include "integration/ros2_rig.h"
#include "json/located_json.h"
#include "runtime/clock.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;

constexpr double kUnknown = 1e6;  ///< a variance of what nobody knows

class FastDds : public Ros2Rig {
 protected:
  explicit FastDds(const std::string& more = "", fast::Told told = fast::Told::by_our_file)
      : Ros2Rig(User::humble, more), told_(told), began_ns_(wall_ns()) {
    AxisSnapshot axis;
    axis.joint = "left";
    axis.health = SourceState::fresh;
    axis.motion = {0, 1.25, -2.5, 3};
    (void)seen_.axes.push_back(axis);
    axis.joint = "right";
    axis.health = SourceState::never_heard;
    (void)seen_.axes.push_back(axis);
    seen_.imu.configured = seen_.gnss.configured = seen_.battery.configured = true;
    seen_.imu.health = seen_.gnss.health = seen_.battery.health = SourceState::fresh;
    seen_.imu.sample.acceleration_mps2 = {0.1, -0.2, 9.81};
    seen_.imu.sample.angular_velocity_radps = {0.01, 0.02, -0.3};
    seen_.imu.angular_velocity_sigma_radps = 0.5;
    seen_.imu.acceleration_sigma_mps2 = 0.25;
    SensorSnapshot receiver;
    receiver.name = "gnss";
    receiver.in_use = true;
    (void)seen_.sensors.push_back(receiver);
    seen_.gnss.position = {.latitude_deg = -48.5,
                           .longitude_deg = -11.25,
                           .altitude_msl_m = 500,
                           .undulation_m = 46,
                           .quality = FixQuality::rtk_fixed,
                           .sigma_east_m = 0.25,
                           .sigma_north_m = 0.5};
    seen_.odometry = {.x_m = 1.5,
                      .y_m = -0.5,
                      .yaw_rad = -kPi / 2,
                      .vx_mps = 0.25,
                      .wz_radps = -0.125,
                      .x_var = 1,
                      .xy_var = 2,
                      .y_var = 3,
                      .x_yaw_var = 4,
                      .y_yaw_var = 5,
                      .yaw_var = 6,
                      .vx_var = 7,
                      .wz_var = 8};
    seen_.origin_set = true;
    seen_.pose.x_m = 20;
    seen_.pose.y_m = -3;
    seen_.pose.yaw_rad = kPi / 2;
    seen_.pose.position_sigma_m = 0.5;
    seen_.pose.yaw_sigma_rad = 0.25;
    seen_.battery.sample.voltage_V = 48.5;
    seen_.battery.sample.current_A = -2;
    seen_.battery.sample.soc_percent = 75;
    seen_.battery.sample.flow = BatteryFlow::discharging;
    for (const auto line : {Line::bumper, Line::zone_near}) {
      const auto i = static_cast<std::size_t>(line);
      seen_.line_configured[i] = true;
      seen_.line_health[i] = SourceState::fresh;
      seen_.line_active[i] = line == Line::bumper;
    }
    (void)seen_.why.push_back("the e-stop is pressed");
  }

  /// The program first, then the user: a sample that is written by whoever was there before is
  /// lost when its reader does not know him yet (DDS tells each side for itself).
  void start_all() {
    open_daemon();
    start_program();
    ASSERT_TRUE(play_until([this] {
      return log().find("tells of the robot") != std::string::npos;
    })) << log();
    join();
  }
  /// Ten a second: DDS tells each side for itself that the other is there.
  template <class M>
  bool say_until(fast::Writer<M>& writer, const M& message, const std::function<bool()>& done) {
    Time next = kNever;
    return play_until([&] {
      if (const Time now = runtime::monotonic_now(); now >= next) {
        next = now + 100ms;
        (void)writer.write(message);
      }
      return done();
    });
  }
  void join() {
    user_ =
        std::make_unique<fast::User>(domain(), told_, DROVER_SOURCE_DIR "/config/ros2/fastdds.xml");
  }

  static std::int64_t wall_ns() {
    return (runtime::monotonic_now().time_since_epoch() + runtime::wall_minus_monotonic()).count();
  }
  std::string now_here(const fast::Time& stamp) const {
    const std::int64_t at_ns = std::int64_t{stamp.sec} * 1'000'000'000 + stamp.nanosec;
    if (at_ns < began_ns_ - 1'000'000'000 || at_ns > wall_ns())
      return "stamped " + std::to_string(at_ns) + ", now it is " + std::to_string(wall_ns());
    return {};
  }
  /// One comes to each kind of reader that is `ready`, and is `right`; Fast-CDR makes of it the
  /// bytes that it came as.
  template <class M>
  void expect(
      const std::string& topic, const std::function<void(const M&)>& right,
      const std::function<bool(const M&)>& ready = [](const M&) { return true; }) {
    for (const bool reliable : {true, false}) {
      // What is kept for who comes later goes to reliable readers only, as ROS 2's are.
      if (topic == "tf_static" && !reliable) continue;
      SCOPED_TRACE(topic + (reliable ? ", reliable" : ", best effort"));
      const auto from = user_->reader<M>("rt/" + topic,
                                         {.reliable = reliable, .for_later = topic == "tf_static"});
      std::optional<fast::Seen<M>> seen;
      ASSERT_TRUE(play_until([&] {
        seen = from->newest();
        return seen && ready(seen->message);
      })) << from->writers()
          << " writers\n"
          << log();
      right(seen->message);
      expect_same_cdr(seen->bytes, fast::to_cdr(seen->message));
      EXPECT_EQ(from->refused(), 0);
    }
  }
  std::int64_t asked(std::string_view key) const {
    const auto request = json::parse(last_request_);
    const auto* node = request ? request->root.find(key) : nullptr;
    return node == nullptr ? -1 : node->integer().value_or(-1);
  }

  fast::Told told_;
  std::unique_ptr<fast::User> user_;
  std::int64_t began_ns_;
};

TEST_F(FastDds, SeesJointsAndTheBaseMove) {
  join();
  open_daemon();
  start_program();
  expect<fast::JointState>("joint_states", [this](const auto& m) {
    EXPECT_EQ(now_here(m.header.stamp), "");
    EXPECT_EQ(m.header.frame_id, "base_link");
    EXPECT_THAT(m.name, ElementsAre("left", "right"));
    EXPECT_THAT(m.position, ElementsAre(1.25, IsNan()));
    EXPECT_THAT(m.velocity, ElementsAre(-2.5, IsNan()));
    EXPECT_THAT(m.effort, ElementsAre(3, IsNan()));
  });
  expect<fast::JointStateArray>("joint_state", [this](const auto& m) {
    EXPECT_EQ(now_here(m.header.stamp), "");
    EXPECT_EQ(m.header.frame_id, "base_link");
    EXPECT_GT(m.header.sequence, 0U);
    ASSERT_EQ(m.joints.size(), 2U);
    EXPECT_EQ(m.joints[0].name, "left");
    EXPECT_EQ(m.joints[0].position, 1.25);
    EXPECT_EQ(m.joints[0].velocity, -2.5);
    EXPECT_EQ(m.joints[0].effort, 3);
    EXPECT_EQ(m.joints[1].name, "right");
  });
  expect<fast::Odometry>("odom", [this](const auto& m) {
    EXPECT_EQ(now_here(m.header.stamp), "");
    EXPECT_EQ(m.header.frame_id, "odom");
    EXPECT_EQ(m.child_frame_id, "base_link");
    EXPECT_EQ(m.pose.pose.position.x, 1.5);
    EXPECT_EQ(m.pose.pose.position.y, -0.5);
    EXPECT_NEAR(m.pose.pose.orientation.z, -std::sqrt(0.5), 1e-12) << "clockwise";
    EXPECT_NEAR(m.pose.pose.orientation.w, std::sqrt(0.5), 1e-12);
    EXPECT_THAT(m.pose.covariance,
                ElementsAre(1, 2, 0, 0, 0, 4, 2, 3, 0, 0, 0, 5, 0, 0, kUnknown, 0, 0, 0,  //
                            0, 0, 0, kUnknown, 0, 0, 0, 0, 0, 0, kUnknown, 0, 4, 5, 0, 0, 0, 6));
    EXPECT_EQ(m.twist.twist.linear.x, 0.25);
    EXPECT_EQ(m.twist.twist.angular.z, -0.125);
    EXPECT_EQ(m.twist.covariance[0], 7);
    EXPECT_EQ(m.twist.covariance[35], 8);
  });
  expect<fast::PoseWithCovarianceStamped>("rtk_pose", [this](const auto& m) {
    EXPECT_EQ(now_here(m.header.stamp), "");
    EXPECT_EQ(m.header.frame_id, "map");
    EXPECT_EQ(m.pose.pose.position.x, 20);
    EXPECT_EQ(m.pose.pose.position.y, -3);
    EXPECT_NEAR(m.pose.pose.orientation.z, std::sqrt(0.5), 1e-12);
    EXPECT_EQ(m.pose.covariance[0], 0.25);
    EXPECT_EQ(m.pose.covariance[7], 0.25);
    EXPECT_EQ(m.pose.covariance[35], 0.0625);
  });
  expect<fast::TFMessage>("tf", [this](const auto& m) {
    ASSERT_EQ(m.transforms.size(), 2U);
    EXPECT_EQ(now_here(m.transforms[0].header.stamp), "");
    EXPECT_EQ(m.transforms[0].header.frame_id, "odom");
    EXPECT_EQ(m.transforms[0].child_frame_id, "base_link");
    EXPECT_EQ(m.transforms[0].transform.translation.y, -0.5);
    EXPECT_NEAR(m.transforms[0].transform.rotation.z, -std::sqrt(0.5), 1e-12);
    EXPECT_EQ(m.transforms[1].header.frame_id, "map");
    EXPECT_EQ(m.transforms[1].child_frame_id, "odom");
    // Half a turn between them.
    EXPECT_NEAR(m.transforms[1].transform.translation.x, 20 + 1.5, 1e-9);
    EXPECT_NEAR(m.transforms[1].transform.translation.y, -3 - 0.5, 1e-9);
  });
}

TEST_F(FastDds, SeesSensorsAndHowTheyAre) {
  join();
  open_daemon();
  start_program();
  expect<fast::Imu>("imu/data", [this](const auto& m) {
    EXPECT_EQ(now_here(m.header.stamp), "");
    EXPECT_EQ(m.header.frame_id, "base_link");
    EXPECT_EQ(m.orientation_covariance[0], -1) << "it has none";
    EXPECT_EQ(m.angular_velocity.z, -0.3);
    EXPECT_THAT(m.angular_velocity_covariance, ElementsAre(0.25, 0, 0, 0, 0.25, 0, 0, 0, 0.25));
    EXPECT_EQ(m.linear_acceleration.x, 0.1);
    EXPECT_EQ(m.linear_acceleration.y, -0.2);
    EXPECT_EQ(m.linear_acceleration.z, 9.81);
    EXPECT_EQ(m.linear_acceleration_covariance[4], 0.0625);
  });
  expect<fast::NavSatFix>("gps/fix", [this](const auto& m) {
    EXPECT_EQ(now_here(m.header.stamp), "");
    EXPECT_EQ(m.header.frame_id, "gnss");
    EXPECT_EQ(m.status.status, 2);
    EXPECT_EQ(m.status.service, 15);
    EXPECT_EQ(m.latitude, -48.5);
    EXPECT_EQ(m.longitude, -11.25);
    EXPECT_EQ(m.altitude, 546);
    EXPECT_THAT(m.position_covariance, ElementsAre(0.0625, 0, 0, 0, 0.25, 0, 0, 0, 1));
    EXPECT_EQ(m.position_covariance_type, 2);
  });
  expect<fast::BatteryState>("battery_state", [this](const auto& m) {
    EXPECT_EQ(now_here(m.header.stamp), "");
    EXPECT_EQ(m.voltage, 48.5F);
    EXPECT_EQ(m.current, -2);
    EXPECT_EQ(m.percentage, 0.75F);
    EXPECT_THAT(std::vector({m.temperature, m.charge, m.capacity, m.design_capacity}),
                Each(IsNan()));
    EXPECT_EQ(m.power_supply_status, 2);
    EXPECT_EQ(m.power_supply_health, 1);
    EXPECT_TRUE(m.present);
  });
  expect<fast::LaserScan>("scan", [this](const auto& m) {
    EXPECT_EQ(now_here(m.header.stamp), "");
    EXPECT_EQ(m.header.frame_id, "lidar");
    EXPECT_EQ(m.range_max, 12);
    EXPECT_FLOAT_EQ(m.scan_time, 0.1F);
    ASSERT_EQ(m.ranges.size(), 450U);
    ASSERT_EQ(m.intensities.size(), 450U);
    for (std::size_t i = 0; i < m.ranges.size(); ++i) {
      const double bearing_rad =
          m.angle_min + static_cast<double>(i) * static_cast<double>(m.angle_increment);
      if (std::abs(bearing_rad - 0.5) < m.angle_increment / 2) {
        EXPECT_EQ(m.ranges[i], 2.5F);
        EXPECT_EQ(m.intensities[i], 9);
      } else {
        EXPECT_THAT(m.ranges[i], IsNan()) << bearing_rad;
      }
    }
  });
  expect<fast::TouchSensorStateArray>("touch_state", [this](const auto& m) {
    EXPECT_EQ(now_here(m.header.stamp), "");
    EXPECT_THAT(m.names, ElementsAre("bumper", "zone_near"));
    ASSERT_EQ(m.states.size(), 2U);
    EXPECT_THAT(m.states[0].pressure, ElementsAre(1));
    EXPECT_THAT(m.states[1].pressure, ElementsAre(0));
  });
  expect<fast::DiagnosticArray>(
      "diagnostics",
      [this](const auto& m) {
        EXPECT_EQ(now_here(m.header.stamp), "");
        EXPECT_EQ(m.status[0].name, "drover: robot");
        EXPECT_EQ(m.status[0].hardware_id, "with a lidar");
        EXPECT_EQ(m.status[0].level, 1);
        EXPECT_EQ(m.status.back().name, "drover: drover-ros2");
        ASSERT_FALSE(m.status.back().values.empty());
        EXPECT_EQ(m.status.back().values[0].key, "readers");
      },
      [](const auto& m) {
        return !m.status.empty() && m.status[0].message == "the e-stop is pressed";
      });
  expect<fast::TFMessage>("tf_static", [this](const auto& m) {
    ASSERT_EQ(m.transforms.size(), 2U);
    EXPECT_EQ(m.transforms[0].header.frame_id, "base_link");
    EXPECT_EQ(m.transforms[0].child_frame_id, "gnss");
    EXPECT_EQ(m.transforms[0].transform.translation.x, -0.05);
    EXPECT_EQ(m.transforms[0].transform.translation.z, 0.5);
    EXPECT_EQ(m.transforms[1].child_frame_id, "lidar");
    EXPECT_EQ(m.transforms[1].transform.rotation.w, 1);
  });
}

class FastDdsOfJazzy : public FastDds {
 protected:
  FastDdsOfJazzy() : FastDds("", fast::Told::by_jazzy) {}
};

TEST_F(FastDdsOfJazzy, SeesTheRobot) {
  join();
  open_daemon();
  start_program();
  expect<fast::Odometry>("odom", [](const auto& m) { EXPECT_EQ(m.pose.pose.position.x, 1.5); });
}

class FastDdsMayStop : public FastDds {
 protected:
  FastDdsMayStop() : FastDds(R"(, "inputs": {"e_stop": true})") {}
};

TEST_F(FastDdsMayStop, StopsTheRobotByTrueAndDoesNothingByFalse) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  for (const bool reliable : {true, false}) {
    SCOPED_TRACE(reliable ? "reliable" : "best effort");
    const auto writer = user_->writer<fast::Bool>("rt/e_stop", {.reliable = reliable});
    ASSERT_TRUE(play_until([&] { return writer->readers() > 0; })) << log();
    play_for(1500ms);  // whatever was said before, more than once perhaps, is here
    const int before = stops_;
    ASSERT_TRUE(writer->write({false}));
    play_for(1500ms);  // until it is known on both sides
    EXPECT_EQ(stops_, before);
    EXPECT_TRUE(say_until<fast::Bool>(*writer, {true}, [&] { return stops_ > before; })) << log();
  }
}

/// Who sees the robot is heard, too, whichever of this computer's addresses he sends to.
class FastDdsToldToStay : public FastDds, public testing::WithParamInterface<fast::Told> {
 protected:
  FastDdsToldToStay() : FastDds(R"(, "inputs": {"e_stop": true})", GetParam()) {}
};

TEST_P(FastDdsToldToStay, StopsTheRobot) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  const auto writer = user_->writer<fast::Bool>("rt/e_stop", {.reliable = true});
  ASSERT_TRUE(play_until([&] { return writer->readers() > 0; })) << log();
  EXPECT_TRUE(say_until<fast::Bool>(*writer, {true}, [&] { return stops_ > 0; })) << log();
}

INSTANTIATE_TEST_SUITE_P(Each, FastDdsToldToStay,
                         testing::Values(fast::Told::by_our_file, fast::Told::by_humble,
                                         fast::Told::by_jazzy),
                         [](const auto& one) {
                           return one.param == fast::Told::by_our_file ? "ByOurFile"
                                  : one.param == fast::Told::by_humble ? "ByHumble"
                                                                       : "ByJazzy";
                         });

class FastDdsMayMoveJoints : public FastDds {
 protected:
  FastDdsMayMoveJoints() : FastDds(R"(, "inputs": {"joint_command": true})") {}
};

TEST_F(FastDdsMayMoveJoints, TellsThemWhereToGo) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  for (const bool reliable : {true, false}) {
    SCOPED_TRACE(reliable ? "reliable" : "best effort");
    last_joint_line_.clear();
    const auto writer =
        user_->writer<fast::JointCommandArray>("rt/joint_command", {.reliable = reliable});
    fast::JointCommandArray message;
    message.joints = {{"left", 0.5, 1.5, -2.5, 40, 0.25}};
    EXPECT_TRUE(say_until<fast::JointCommandArray>(*writer, message, [&] {
      return last_joint_line_.find("left") != std::string::npos;
    })) << log();
    for (const char* part : {R"(\"velocity\":1.5)", R"(\"position\":0.5)", R"(\"effort\":-2.5)",
                             R"(\"stiffness\":40)", R"(\"damping\":0.25)"})
      EXPECT_THAT(last_joint_line_, HasSubstr(part));
  }
}

class FastDdsMayChangeTheScene : public FastDds {
 protected:
  FastDdsMayChangeTheScene()
      : FastDds(R"(, "inputs": {"collision_object": true, "planning_constraints": true})") {}
};

TEST_F(FastDdsMayChangeTheScene, PutsObjectsAndConstraintsIntoIt) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  const auto is_told = [this](std::string_view text) {
    return last_scene_line_.find(text) != std::string::npos;
  };
  const auto objects = user_->writer<fast::CollisionObject>("rt/collision_object", {});
  fast::CollisionObject crate;
  crate.header.frame_id = "map";
  crate.pose.position = {3, 0, 0};
  crate.id = "crate";
  crate.primitives = {{1, {0.5, 0.25, 2}, {}}};
  ASSERT_TRUE(play_until([&] { return objects->readers() > 0; })) << log();
  EXPECT_TRUE(say_until<fast::CollisionObject>(*objects, crate, [&] { return is_told("crate"); }))
      << log();
  EXPECT_TRUE(is_told(R"(\"dimensions\":[0.5,0.25,2])")) << last_scene_line_;
  EXPECT_TRUE(is_told(R"(\"position\":{\"x\":3,)")) << last_scene_line_;
  const auto sets = user_->writer<fast::Constraints>("rt/planning_constraints", {});
  fast::Constraints row;
  row.name = "row";
  row.joint_constraints = {{"base/y", 1.5, 0.5, 0.25, 1}};
  ASSERT_TRUE(play_until([&] { return sets->readers() > 0; })) << log();
  EXPECT_TRUE(say_until<fast::Constraints>(*sets, row, [&] { return is_told("base/y"); })) << log();
  EXPECT_TRUE(is_told(R"(\"tolerance_below\":0.25)")) << last_scene_line_;
}

template <class M>
class FastDdsMayDrive : public FastDds {
 protected:
  static constexpr bool kStamped = std::is_same_v<M, fast::TwistStamped>;
  FastDdsMayDrive()
      : FastDds(std::string(R"(, "inputs": {"cmd_vel": ")") +
                (kStamped ? "twist_stamped" : "twist") + "\"}") {}
  static M message(const fast::Twist& twist) {
    if constexpr (kStamped)
      return {{{1, 2}, "base_link"}, twist};
    else
      return twist;
  }
};
using Twists = testing::Types<fast::Twist, fast::TwistStamped>;
TYPED_TEST_SUITE(FastDdsMayDrive, Twists);

TYPED_TEST(FastDdsMayDrive, TellsTheBaseHowToMove) {
  ASSERT_NO_FATAL_FAILURE(this->start_all());
  for (const bool reliable : {true, false}) {
    const auto writer =
        this->user_->template writer<TypeParam>("rt/cmd_vel", {.reliable = reliable});
    const auto ends_as = [this]<class Body>(const auto& is_so) {
      if (this->commands_.empty()) return false;
      const auto* body = std::get_if<Body>(&this->commands_.back().body);
      return body != nullptr && is_so(*body);
    };
    // At first also because the one before it counts as a second program.
    EXPECT_TRUE(this->say_until(*writer, this->message({{0.5, 0, 0}, {0, 0, -0.25}}), [&] {
      return ends_as.template operator()<FollowTwist>([](const auto& body) {
        return body.twist.vx_mps == 0.5 && body.twist.wz_radps == -0.25;
      });
    })) << this->log();
    EXPECT_TRUE(this->say_until(*writer, this->message({{0, 0.5, 0}, {0, 0, 0}}), [&] {
      return ends_as.template operator()<TwistRefused>([](const auto& body) {
        return body.reason.view() == "linear.y is 0.5: this base cannot go sideways";
      });
    })) << this->log();
  }
}

TEST_F(FastDds, IsToldOfEachReaderThatAsksForMoreThanIsOffered) {
  join();
  open_daemon();
  start_program();
  const auto odom = user_->reader<fast::Odometry>("rt/odom", {.for_later = true});
  const auto battery = user_->reader<fast::BatteryState>("rt/battery_state", {.deadline_s = 1});
  const auto imu = user_->reader<fast::Imu>("rt/imu/data", {.exclusive = true});
  EXPECT_TRUE(play_until([this] { return asked("incompatible") == 3; })) << last_request_;
  EXPECT_EQ(odom->refused(), 1);
  EXPECT_EQ(battery->refused(), 1);
  EXPECT_EQ(imu->refused(), 1);
  play_for(2s);
  EXPECT_EQ(asked("incompatible"), 3);
  EXPECT_FALSE(odom->newest() || battery->newest() || imu->newest());
  EXPECT_THAT(log(), HasSubstr("a reader of /odom asks for a durability that is not offered"));
  EXPECT_THAT(log(),
              HasSubstr("a reader of /battery_state asks for a deadline that is not offered"));
  EXPECT_THAT(log(), HasSubstr("a reader of /imu/data asks for an ownership that is not offered"));
}

TEST_F(FastDdsMayStop, IsToldOfAWriterThatIsNotHeard) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  const auto writer = user_->writer<fast::Bool>("rt/e_stop", {.exclusive = true});
  EXPECT_TRUE(play_until([this] { return asked("incompatible") == 1; })) << last_request_;
  EXPECT_GE(writer->refused(), 1);
  EXPECT_THAT(log(), HasSubstr("a writer of /e_stop offers an ownership that is not asked for, and "
                               "is not heard"));
}

}  // namespace
}  // namespace drover::test
