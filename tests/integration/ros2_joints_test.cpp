// A ROS 2 user who moves joints by /joint_command: the field robot's wheels.
#include <fstream>

#include "integration/ros2_drive_rig.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;

constexpr double kRamp_s = 1.5;  ///< from 1 rad/s, and what is on its way
constexpr double kSilent_s = 1;  ///< the rig's joint_command_timeout_s
constexpr double kRest_s = 1.8;  ///< longer than that
constexpr double kMostKept_kB = 40'000;

class MovedByJointCommands : public MovedFromRos2 {
 protected:
  MovedByJointCommands() : MovedFromRos2(R"("joint_command": true)") {}

  static void say(dds_entity_t by, double radps) {
    std::array<aimrt_msgs_msg_dds__JointCommand_, 4> joints{};
    const std::array<const char*, 4> names{"front_left", "rear_left", "front_right", "rear_right"};
    for (std::size_t i = 0; i < joints.size(); ++i) {
      joints.at(i).name_ = const_cast<char*>(names.at(i));
      joints.at(i).velocity_ = radps;
    }
    write(by, joints.data(), joints.size());
  }
  static void write(dds_entity_t by, aimrt_msgs_msg_dds__JointCommand_* joints, std::size_t count) {
    aimrt_msgs_msg_dds__JointCommandArray_ message{};
    message.header_.frame_id_ = const_cast<char*>("");
    message.joints_._buffer = joints;
    message.joints_._length = message.joints_._maximum = static_cast<std::uint32_t>(count);
    dds_write(by, &message);
  }
  /// At 50 Hz.
  bool say_until(double radps, const std::function<bool()>& done) {
    return repeat_until([&] { say(writer_, radps); }, 20ms, done);
  }
  void say_for(double radps, double seconds) {
    const double end_s = now_s() + seconds;
    (void)say_until(radps, [end_s] { return now_s() > end_s; });
  }
  bool moves() { return true_speed_mps() > 0.1; }
  /// Until it moves, after the slow first way; from rest again where something has stopped it
  /// meanwhile.
  void move_off() {
    for (int i = 0; i < 4; ++i) {
      if (i > 0) (void)drover({"reset"});
      say_for(0, kRest_s);
      if (repeat_until([&] { say(writer_, 1); }, 20ms, [this] { return moves(); }, 15s)) return;
    }
    FAIL() << status() << program_.output();
  }
  bool is_told(std::string_view text) { return daemon().output().find(text) != std::string::npos; }
  /// The most memory that drover-ros2 ever had.
  double peak_kB() const {
    std::ifstream told("/proc/" + std::to_string(program_.pid()) + "/status");
    for (std::string word; told >> word;)
      if (double kB = 0; word == "VmHWM:" && told >> kB) return kB;
    return 0;
  }
};

TEST_F(MovedByJointCommands, FollowsOneOfTwoProgramsAndStopsWhenItIsSilent) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::joint_command_kind()));
  say_for(1, 0.5);
  EXPECT_TRUE(at_rest()) << "a stream begins with velocity 0";
  EXPECT_TRUE(is_told("a stream of joint commands begins with velocity 0")) << daemon().output();
  ASSERT_NO_FATAL_FAILURE(move_off());
  const dds_entity_t other = writer(ros2::joint_command_kind());
  ASSERT_TRUE(is_heard(other));
  ASSERT_TRUE(say_until(1, [&] {
    say(other, 0);
    return is_told("joint command refused: two programs write joint commands: ");
  })) << daemon().output();
  say_for(1, 0.5);
  EXPECT_TRUE(moves()) << "the one that came first goes on";
  const double last_s = now_s();
  ASSERT_TRUE(wait_until([this] { return at_rest(); }));
  // What is not 0 is not followed without rest before it.
  say_for(1, 1);
  expect_rest_on_the_bus_from(last_s + kSilent_s + kRamp_s);
}

TEST_F(MovedByJointCommands, IsNotMovedByWhatWasQueuedWhileItsProgramHung) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::joint_command_kind()));
  ASSERT_NO_FATAL_FAILURE(move_off());
  program_.signal(SIGSTOP);
  const double hung_s = now_s();
  ASSERT_TRUE(say_until(1, [this] { return at_rest(); }));
  // Rest and motion, all of it in the queue.
  say_for(0, kRest_s);
  say_for(1, 1);
  program_.signal(SIGCONT);
  say_for(1, 2);
  EXPECT_TRUE(at_rest());
  EXPECT_TRUE(is_told("joint command refused: a message came too late")) << daemon().output();
  expect_rest_on_the_bus_from(hung_s + kSilent_s + kRamp_s);
}

TEST_F(MovedByJointCommands, RefusesByNameAndFieldAndIsNotFilledByLargeMessages) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::joint_command_kind()));
  aimrt_msgs_msg_dds__JointCommand_ joint{};
  joint.name_ = const_cast<char*>("front_left");
  joint.velocity_ = NAN;
  ASSERT_TRUE(repeat_until(
      [&] { write(writer_, &joint, 1); }, 20ms,
      [this] { return is_told("joint command refused: joint 'front_left': velocity is NaN"); }))
      << daemon().output();
  joint.velocity_ = 1;
  std::vector<aimrt_msgs_msg_dds__JointCommand_> many(200'000, joint);
  say_for(0, kRest_s);
  for (int i = 0; i < 10; ++i) {
    write(writer_, many.data(), many.size());
    write(writer_, many.data(), 1000);  // below what DDS takes at most
    say(writer_, 0);
  }
  ASSERT_TRUE(repeat_until(
      [&] { write(writer_, many.data(), 1000); }, 20ms,
      [this] {
        return drover({"status", "--json"}).text.find("it names 1000 joints, this robot has 4") !=
               std::string::npos;
      }));
  EXPECT_LT(peak_kB(), kMostKept_kB);
  EXPECT_GT(peak_kB(), 0);
  EXPECT_TRUE(at_rest());
  ASSERT_NO_FATAL_FAILURE(move_off());
}

}  // namespace
}  // namespace drover::test
