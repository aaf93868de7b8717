// A ROS 2 user who drives by /cmd_vel: drover-ros2, droverd and the simulated robot as they are
// shipped, and a writer that is plain DDS.
#include <fstream>
#include <thread>

#include "integration/ros2_drive_rig.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

constexpr double kRamp_s = 1.5;  ///< from 0.4 m/s, and what is on its way
constexpr double kSilent_s = 0.3;

class DrivenByCmdVel : public MovedFromRos2 {
 protected:
  DrivenByCmdVel() : MovedFromRos2(R"("e_stop": true, "cmd_vel": "twist")") {}

  static void say(dds_entity_t by, double vx_mps, double wz_radps = 0) {
    const geometry_msgs_msg_dds__Twist_ message{{vx_mps, 0, 0}, {0, 0, wz_radps}};
    dds_write(by, &message);
  }
  /// Says so at 20 Hz until `done`; false: not in time.
  bool say_until(dds_entity_t by, double vx_mps, const std::function<bool()>& done) {
    return repeat_until([&] { say(by, vx_mps); }, 50ms, done);
  }
  void say_for(dds_entity_t by, double vx_mps, double seconds) {
    const double end_s = now_s() + seconds;
    (void)say_until(by, vx_mps, [end_s] { return now_s() > end_s; });
  }
  bool moves() { return true_speed_mps() > 0.2; }
  void start_robot() { MovedFromRos2::start_robot(ros2::cmd_vel_kind(false)); }
  /// Until it moves.
  void drive_off() {
    say_for(writer_, 0, 0.8);
    ASSERT_TRUE(say_until(writer_, 0.4, [this] { return moves(); }))
        << drover({"status"}).text << program_.output();
  }
};

TEST_F(DrivenByCmdVel, MovesAsToldAndStopsWhenItIsSilent) {
  ASSERT_NO_FATAL_FAILURE(start_robot());
  say_for(writer_, 0.4, 1);
  EXPECT_LT(true_speed_mps(), 0.01) << "a stream begins with a zero twist";
  EXPECT_THAT(status(), HasSubstr("cmd_vel begins with a zero twist"));
  ASSERT_NO_FATAL_FAILURE(drive_off());
  EXPECT_THAT(status(), HasSubstr("cmd_vel, stops 0.3 s after its last message"));
  say(writer_, 0.4);
  const double last_s = now_s();
  ASSERT_TRUE(wait_until([this] { return at_rest(); }));
  (void)wait_until([] { return false; }, 2s);
  EXPECT_THAT(status(), HasSubstr("cmd_vel fell silent"));
  // What is not 0 is not followed without rest before it.
  say_for(writer_, 0.4, 1);
  expect_rest_on_the_bus_from(last_s + kSilent_s + kRamp_s);
}

TEST_F(DrivenByCmdVel, IsNotMovedByWhatWasQueuedWhileItsProgramHung) {
  ASSERT_NO_FATAL_FAILURE(start_robot());
  ASSERT_NO_FATAL_FAILURE(drive_off());
  program_.signal(SIGSTOP);
  const double hung_s = now_s();
  say_for(writer_, 0.4, 2);
  ASSERT_TRUE(say_until(writer_, 0.4, [this] { return at_rest(); }));
  // Rest and motion, all of it in the queue.
  say_for(writer_, 0, 1);
  say_for(writer_, 0.4, 1);
  program_.signal(SIGCONT);
  say_for(writer_, 0.4, 2);
  EXPECT_TRUE(at_rest());
  EXPECT_THAT(daemon().output(), HasSubstr("cmd_vel refused"));
  expect_rest_on_the_bus_from(hung_s + kSilent_s + kRamp_s);
}

TEST_F(DrivenByCmdVel, StopsWhenItsProgramIsKilledAndFollowsTheNextOneFromRest) {
  ASSERT_NO_FATAL_FAILURE(start_robot());
  ASSERT_NO_FATAL_FAILURE(drive_off());
  program_.signal(SIGKILL);
  (void)program_.wait(5s);
  ASSERT_TRUE(say_until(writer_, 0.4, [this] { return at_rest(); }));
  start_program();
  say_for(writer_, 0.4, 3);
  EXPECT_TRUE(at_rest());
  ASSERT_TRUE(wait_until([&] {
    say_for(writer_, 0, 1);
    return status().find("cmd_vel, stops") != std::string::npos;
  })) << status()
      << program_.output();
  ASSERT_NO_FATAL_FAILURE(drive_off());
}

TEST_F(DrivenByCmdVel, IsStoppedByTheEmergencyStopWhateverIsSaid) {
  ASSERT_NO_FATAL_FAILURE(start_robot());
  const dds_entity_t stop = writer(ros2::stop_kind());
  ASSERT_TRUE(is_heard(stop));
  ASSERT_NO_FATAL_FAILURE(drive_off());
  // A flood of a thousand a second is before it.
  for (int i = 0; i < 500; ++i) {
    say(writer_, 0.4);
    std::this_thread::sleep_for(1ms);
  }
  const std_msgs_msg_dds__Bool_ message{true};
  dds_write(stop, &message);
  const double stop_s = now_s();
  for (int i = 0; i < 500; ++i) {
    say(writer_, 0.4);
    std::this_thread::sleep_for(1ms);
  }
  ASSERT_TRUE(say_until(writer_, 0.4, [this] { return at_rest(); }));
  say_for(writer_, 0, 0.8);
  say_for(writer_, 0.4, 1);
  EXPECT_TRUE(at_rest());
  EXPECT_THAT(status(), HasSubstr("reset the stop first"));
  expect_rest_on_the_bus_from(stop_s + 0.5);
}

TEST_F(DrivenByCmdVel, IsMovedByNeitherOfTwoPrograms) {
  ASSERT_NO_FATAL_FAILURE(start_robot());
  ASSERT_NO_FATAL_FAILURE(drive_off());
  const dds_entity_t other = writer(ros2::cmd_vel_kind(false));
  ASSERT_TRUE(is_heard(other));
  ASSERT_TRUE(say_until(writer_, 0.4, [&] {
    say(other, 0);
    return at_rest();
  }));
  EXPECT_THAT(status(), HasSubstr("two programs write it, neither is followed: "));
  EXPECT_THAT(daemon().output(), HasSubstr("cmd_vel refused: two programs write it"));
  dds_delete(other);
  say_for(writer_, 0.4, 2);
  EXPECT_TRUE(at_rest()) << "it begins from rest again";
  ASSERT_NO_FATAL_FAILURE(drive_off());
}

TEST_F(DrivenByCmdVel, RefusesByNameWhatItsBaseCannot) {
  ASSERT_NO_FATAL_FAILURE(start_robot());
  say_for(writer_, 0, 0.8);
  const geometry_msgs_msg_dds__Twist_ sideways{{0.4, 0.3, 0}, {0, 0, 0}};
  ASSERT_TRUE(wait_until([&] {
    dds_write(writer_, &sideways);
    return daemon().output().find(
               "cmd_vel refused: linear.y is 0.3: this base cannot go "
               "sideways") != std::string::npos;
  })) << daemon().output();
  EXPECT_TRUE(at_rest());
}

}  // namespace
}  // namespace drover::test
