// A stop on /e_stop that drover-ros2 has in hand when it is asked to end, on the whole robot: as
// `systemctl restart droverd` does, also with a droverd that hangs.
#include "integration/ros2_drive_rig.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

class AStopInItsHand : public MovedFromRos2 {
 protected:
  AStopInItsHand() : MovedFromRos2(R"("e_stop": true)") {}

  void say_stop() {
    const std_msgs_msg_dds__Bool_ message{true};
    dds_write(writer_, &message);
  }
  /// And has told it, where somebody listens.
  bool has_heard() {
    return wait_until(
        [this] {
          return program_.output().find("an emergency stop was asked for") != std::string::npos;
        },
        5s);
  }
  void kill_daemon() {
    daemon().signal(SIGKILL);
    ASSERT_TRUE(daemon().wait(5s));
  }
  void end_program() {
    program_.signal(SIGTERM);
    EXPECT_EQ(program_.wait(5s), 0) << program_.output();
  }
  bool is_stopped() {
    return drover({"status", "--json"}).text.find("\"stopped_until_told\":true") !=
           std::string::npos;
  }
  /// The next droverd, to whom nobody says it any more.
  void expect_stopped_at_the_next_droverd() {
    start_daemon();
    EXPECT_TRUE(wait_until([this] { return is_stopped(); }, 10s)) << program_.output() << status();
  }
};

TEST_F(AStopInItsHand, IsTakenByTheGuardWhileDroverdHangs) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::stop_kind()));
  daemon().signal(SIGSTOP);
  say_stop();
  ASSERT_TRUE(has_heard()) << program_.output();
  end_program();
  EXPECT_THAT(program_.output(), HasSubstr("drover-guard has taken it"));
  ASSERT_NO_FATAL_FAILURE(kill_daemon());
  expect_stopped_at_the_next_droverd();
  // The e-stop's line is not known yet just after the start.
  EXPECT_TRUE(wait_until([this] { return drover({"reset"}).code == 0; }, 20s));
  EXPECT_FALSE(is_stopped());
}

TEST_F(AStopInItsHand, IsTakenByTheGuardWhileDroverdIsAway) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::stop_kind()));
  ASSERT_NO_FATAL_FAILURE(kill_daemon());
  say_stop();
  ASSERT_TRUE(has_heard()) << program_.output();
  end_program();
  expect_stopped_at_the_next_droverd();
}

TEST_F(AStopInItsHand, IsToldThoughTheOneBeforeWasToldThisMoment) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::stop_kind()));
  say_stop();
  ASSERT_TRUE(wait_until([this] { return is_stopped(); }, 5s));
  // Ten a second are told: these come sooner than that after the one before.
  for (int i = 0; i < 4; ++i) {
    say_stop();
    std::this_thread::sleep_for(20ms);
  }
  ASSERT_EQ(drover({"reset"}).code, 0);
  say_stop();
  std::this_thread::sleep_for(20ms);  // it has come
  end_program();
  EXPECT_TRUE(wait_until([this] { return is_stopped(); }, 5s));
}

TEST_F(AStopInItsHand, IsLostWithAWordWhereNobodyTakesIt) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::stop_kind()));
  ASSERT_NO_FATAL_FAILURE(kill_daemon());
  guard().signal(SIGKILL);
  ASSERT_TRUE(guard().wait(5s));
  say_stop();
  ASSERT_TRUE(has_heard()) << program_.output();
  end_program();
  EXPECT_THAT(program_.output(), HasSubstr("an emergency stop is lost"));
}

/// Its answer came while drover-ros2 hung: it was done, and a person's reset holds.
TEST_F(AStopInItsHand, IsNotToldAgainWhereItsAnswerWasNotReadYet) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::stop_kind()));
  daemon().signal(SIGSTOP);
  say_stop();
  ASSERT_TRUE(has_heard()) << program_.output();
  program_.signal(SIGSTOP);
  daemon().signal(SIGCONT);
  ASSERT_TRUE(wait_until([this] { return is_stopped(); }, 5s));
  std::this_thread::sleep_for(300ms);  // it is done, and so answered
  ASSERT_NO_FATAL_FAILURE(kill_daemon());
  start_daemon();
  ASSERT_TRUE(wait_until([this] { return is_stopped(); }, 10s));
  ASSERT_TRUE(wait_until([this] { return drover({"reset"}).code == 0; }, 20s));
  program_.signal(SIGCONT);
  EXPECT_FALSE(wait_until([this] { return is_stopped(); }, 3s)) << program_.output();
}

}  // namespace
}  // namespace drover::test
