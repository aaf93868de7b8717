// Whatever hangs, a stop is heard: threads, logs, systemd, name servers, brokers. In real time.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "integration/robot_rig.h"
#include "link/unique_fd.h"
#include "sim/scenario/held_thread.h"

namespace drover::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class Hang : public RobotRig {
 protected:
  /// Seconds from `since_s` to the first set point that is lower than what drives; -1: none.
  double slowed_after_s(double since_s) {
    float cruise = 0;
    for (const auto& point : set_points_on_the_bus()) {
      if (point.node != 1) continue;
      const float speed = std::abs(point.velocity_turnps);
      if (point.time_s <= since_s) cruise = speed;
      if (point.time_s > since_s && speed < 0.9F * cruise) return point.time_s - since_s;
    }
    return -1;
  }
  void drive_by_command_line() {
    ASSERT_EQ(drover({"task", "start", "row", "--id", "33", "--speed", "0.5"}).code, 0);
    ASSERT_TRUE(wait_until([this] { return true_speed_mps() > 0.3; }));
  }
  void wait_s(double seconds) {
    (void)wait_until([end = now_s() + seconds] { return now_s() > end; });
  }
  /// `drover stop` while the robot drives, and how long until the wheels are told.
  void expect_prompt_stop() {
    const double asked_s = now_s();
    EXPECT_EQ(drover({"stop"}).code, 0);
    std::printf("drover stop answered after %.0f ms\n", 1e3 * (now_s() - asked_s));
    EXPECT_TRUE(wait_until([this] { return at_rest(); }));
    const double slowed_s = slowed_after_s(asked_s);
    std::printf("the wheels were told after %.0f ms\n", 1e3 * slowed_s);
    EXPECT_GT(slowed_s, 0);
    EXPECT_LT(slowed_s, 1.0) << "program start included";
  }
};

TEST_F(Hang, APublishThreadThatStandsStillStopsTheRobotWithinASecondAndLeavesItToTheGuard) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(drive(16));
  ASSERT_TRUE(wait_until([this] { return true_speed_mps() > 0.4; }));
  sim::HeldThread publish(daemon().pid(), "publish");
  if (!publish.held()) GTEST_SKIP() << "no thread of another process can be held here";
  const double frozen_s = now_s();
  EXPECT_TRUE(wait_until([this] { return at_rest(); }));
  EXPECT_TRUE(
      wait_until([this] { return guard().output().find("heartbeat") != std::string::npos; }));
  EXPECT_THAT(daemon().output(), HasSubstr("publish thread stands still: the robot stops"));
  publish.let_go();
  EXPECT_TRUE(wait_for_status("NAV_ERROR"));
  const double slowed_s = slowed_after_s(frozen_s);
  std::printf("the robot slowed after %.0f ms\n", 1e3 * slowed_s);
  EXPECT_GT(slowed_s, 0);
  EXPECT_LT(slowed_s, 1.0);
}

TEST_F(Hang, AStopOverMqttIsObeyedThoughThePublishThreadStandsStillAndAnsweredWhenItGoesOn) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(drive(16));
  ASSERT_TRUE(wait_until([this] { return true_speed_mps() > 0.4; }));
  const auto before = client().heard().size();
  sim::HeldThread publish(daemon().pid(), "publish");
  if (!publish.held()) GTEST_SKIP() << "no thread of another process can be held here";
  const double asked_s = now_s();
  control(R"({"cmd_type": "manual_control", "cmd": "terminate"})");
  EXPECT_TRUE(wait_until([this] { return at_rest(); }));
  EXPECT_THAT(client().feedback(before), Not(Contains("terminate_success")));
  publish.let_go();
  EXPECT_TRUE(wait_for_feedback("terminate_success", before));
  const double slowed_s = slowed_after_s(asked_s);
  std::printf("terminate slowed the robot after %.0f ms\n", 1e3 * slowed_s);
  EXPECT_GT(slowed_s, 0);
  EXPECT_LT(slowed_s, 0.4) << "before anybody notices the thread";
}

TEST_F(Hang, TheEndIsHeardThoughThePublishThreadStandsStill) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(drive(16));
  ASSERT_TRUE(wait_until([this] { return true_speed_mps() > 0.4; }));
  sim::HeldThread publish(daemon().pid(), "publish");
  if (!publish.held()) GTEST_SKIP() << "no thread of another process can be held here";
  const double asked_s = now_s();
  daemon().signal(SIGTERM);
  EXPECT_TRUE(wait_until([this] { return at_rest(); }));
  EXPECT_TRUE(wait_until(
      [this] { return daemon().output().find("publish does not end") != std::string::npos; }));
  publish.let_go();
  EXPECT_EQ(daemon().wait(std::chrono::seconds(20)), 0);
  const double slowed_s = slowed_after_s(asked_s);
  std::printf("SIGTERM slowed the robot after %.0f ms\n", 1e3 * slowed_s);
  EXPECT_GT(slowed_s, 0);
  EXPECT_LT(slowed_s, 0.5);
}

TEST_F(Hang, NobodyWaitsForALogAndASystemdThatAreNotRead) {
  // systemd's end, which is never read.
  const auto notify = (folder() / "notify").string();
  link::UniqueFd socket(::socket(AF_UNIX, SOCK_DGRAM, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, notify.c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(socket.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  // The log is a pipe that is full already.
  const auto fifo = (folder() / "log.fifo").string();
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  link::UniqueFd reader(::open(fifo.c_str(), O_RDWR | O_NONBLOCK));
  const std::string full(4096, 'x');
  while (::write(reader.get(), full.data(), full.size()) > 0) {
  }
  ASSERT_NO_FATAL_FAILURE(start_broker());
  ASSERT_NO_FATAL_FAILURE(start_sim());
  ASSERT_NO_FATAL_FAILURE(start_guard());
  start_daemon("export NOTIFY_SOCKET=" + notify + "; exec 2> " + fifo);
  ASSERT_TRUE(wait_for_locate());
  ASSERT_NO_FATAL_FAILURE(drive(16));
  for (int i = 0; i < 5; ++i) EXPECT_EQ(drover({"task", "start", "nobody", "--id", "1"}).code, 1);
  wait_s(3);  // longer than systemd's socket takes messages
  EXPECT_GT(true_speed_mps(), 0.3);
  expect_prompt_stop();
  stop_daemon();
}

TEST_F(Hang, AMuteNameServerHoldsUpNeitherTaskNorStop) {
  // One that never answers.
  link::UniqueFd mute(::socket(AF_INET, SOCK_DGRAM, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = ::htons(53);
  address.sin_addr.s_addr = ::htonl(0x7F000009);  // 127.0.0.9
  if (::geteuid() != 0 ||
      ::bind(mute.get(), reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    GTEST_SKIP() << "only root may play a name server";
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(save_track("row", 16));
  stop_daemon();

  const auto resolver = (folder() / "resolv.conf").string();
  std::ofstream(resolver) << "nameserver 127.0.0.9\n";
  set_broker_host("broker.example");
  start_daemon("mount --bind " + resolver + " /etc/resolv.conf", {"/usr/bin/unshare", "-m"});
  // Refused while the guard has the bus.
  ASSERT_TRUE(wait_until([this] {
    return drover({"task", "start", "row", "--id", "33", "--speed", "0.5"}).code == 0;
  }));
  ASSERT_TRUE(wait_until([this] { return true_speed_mps() > 0.3; }));
  wait_s(3);
  EXPECT_GT(true_speed_mps(), 0.3) << "the task goes on";
  expect_prompt_stop();
  EXPECT_THAT(daemon().output(), HasSubstr("broker.example"));
  stop_daemon();
}

TEST_F(Hang, AStartThatABrokerHeldBackMovesNothingButAStopIsObeyed) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(save_track("row", 8));
  wait_s(1.5);
  const auto before = client().heard().size();
  broker().signal(SIGSTOP);
  start_task("row", 17);
  const double stopped_s = now_s();
  while (now_s() < stopped_s + 3) ::usleep(50'000);
  broker().signal(SIGCONT);
  EXPECT_TRUE(wait_for_feedback("start_task_failse", before));
  control(R"({"cmd_type": "task_control", "cmd": "cancel_task"})");
  EXPECT_TRUE(wait_for_feedback("cancel_task_success", before));
  EXPECT_THAT(client().feedback(before), Not(Contains("start_task_success")));
  stop_daemon();
  for (const auto& point : set_points_on_the_bus()) ASSERT_EQ(point.velocity_turnps, 0);
}

}  // namespace
}  // namespace drover::test
