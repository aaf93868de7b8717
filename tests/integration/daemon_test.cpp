// The whole gateway as it is shipped: real processes, a real broker, frames on a bus, in real time.
#include <gmock/gmock.h>
#include <signal.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "integration/robot_rig.h"
#include "json/located_json.h"

namespace drover::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class Daemon : public RobotRig {};

/// Frames that were on their way when the reason to stop came do not count.
constexpr double kGrace_s = 2.0;

TEST_F(Daemon, RefusesWhatIsNotExactlyACommandAndMovesNothing) {
  ASSERT_NO_FATAL_FAILURE(start_broker());
  // A start that lies on the broker since some other day.
  const auto retained = R"({"cmd_type": "task_control", "cmd": "start_task", "name": "row", "id": 3,
              "speed": 0.5})";
  control(retained, true);
  ASSERT_NO_FATAL_FAILURE(start_sim());
  ASSERT_NO_FATAL_FAILURE(start_guard());
  start_daemon();
  ASSERT_TRUE(wait_for_locate());
  EXPECT_TRUE(client().feedback().empty()) << "it is not even brought";
  ASSERT_NO_FATAL_FAILURE(save_track("row", 3));
  // The broker brings it at once to who listens, without the mark of a stored one.
  const auto live = client().heard().size();
  control(retained, true);
  EXPECT_TRUE(wait_for_feedback("start_task_failse", live));

  const auto start_with = [](const std::string& members) {
    return R"({"cmd_type": "task_control", "cmd": "start_task", )" + members + "}";
  };
  for (const auto& members :
       {R"("name": "nobody", "id": 2, "speed": 0.5)", R"("name": "row", "id": 1.9, "speed": 0.5)",
        R"("name": "row", "id": true, "speed": 0.5)",
        R"("name": "row", "id": 4294967297, "speed": 0.5)",
        R"("name": "row", "id": 0, "speed": 0.5)",
        R"("name": "row", "id": 2, "id": 3, "speed": 0.5)",
        R"("name": "row", "id": 2, "speed": NaN)"}) {
    const auto before = client().heard().size();
    control(start_with(members));
    EXPECT_TRUE(wait_until([&] { return !client().feedback(before).empty(); })) << members;
    EXPECT_THAT(client().feedback(before), testing::Each(HasSubstr("_failse"))) << members;
  }
  EXPECT_EQ(status_text("nav", "status"), "NAV_FREE");
  stop_daemon();
  for (const auto& point : set_points_on_the_bus())
    ASSERT_EQ(point.velocity_turnps, 0) << "node " << point.node;
}

TEST_F(Daemon, RefusesASecondDaemonOfTheSameRobot) {
  start_daemon();
  ASSERT_TRUE(wait_until([this] { return drover({"status"}).code == 0; }));
  const auto second = droverd({"-c", (folder() / "drover.json").string()});
  EXPECT_EQ(second.code, 2);
  EXPECT_THAT(second.text, HasSubstr("runs already"));
  EXPECT_EQ(drover({"status"}).code, 0) << "the first one goes on";
}

TEST_F(Daemon, PicksUpEachPartWhenItAppears) {
  start_daemon();  // alone: no bus, no receiver, no lines, no guard, no broker
  ASSERT_TRUE(wait_until([this] { return drover({"status"}).code == 0; }));
  const auto link_is_up = [this](std::string_view name) {
    const auto answer = json::parse(drover({"status", "--json"}).text);
    const auto* status = answer ? answer->root.find("status") : nullptr;
    const auto* links = status != nullptr ? status->find("links") : nullptr;
    if (links == nullptr || links->list() == nullptr) return false;
    for (const auto& link : *links->list())
      if (*link.find("name")->text() == name) return *link.find("up")->boolean();
    return false;
  };
  for (const char* name : {"can0", "gnss", "lines"}) EXPECT_FALSE(link_is_up(name)) << name;

  ASSERT_NO_FATAL_FAILURE(start_sim());
  for (const char* name : {"can0", "gnss", "lines"})
    EXPECT_TRUE(wait_until([&] { return link_is_up(name); })) << name;
  ASSERT_NO_FATAL_FAILURE(start_guard());
  EXPECT_TRUE(
      wait_until([this] { return daemon().output().find("guard watches") != std::string::npos; }));
  ASSERT_NO_FATAL_FAILURE(start_broker());
  EXPECT_TRUE(wait_for_locate());
  ASSERT_NO_FATAL_FAILURE(drive(1));
  EXPECT_TRUE(wait_for_status("NAV_SUCCESS"));
}

TEST_F(Daemon, FindsReceiverAndInertialSensorAgainAfterTheirCablesWerePulled) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  const auto sensor = [this] { return status_text("sensor", "imu") == "true"; };
  const auto receiver = [this] { return status_number("rtk", "status") == 4; };
  ASSERT_TRUE(wait_until([&] { return sensor() && receiver(); }));
  sim({"imu", "unplug"});
  EXPECT_TRUE(wait_until([&] { return !sensor() && receiver(); }));
  sim({"gnss", "unplug"});
  EXPECT_TRUE(wait_until([&] { return !receiver(); }));
  sim({"imu", "plug"});
  EXPECT_TRUE(wait_until([&] { return sensor() && !receiver(); }));
  sim({"gnss", "plug"});
  EXPECT_TRUE(wait_until([&] { return sensor() && receiver(); }));
}

TEST_F(Daemon, DrivesASavedTrackToItsEnd) {
  ASSERT_NO_FATAL_FAILURE(start_new());
  wait_until_believed();
  ASSERT_NO_FATAL_FAILURE(drive(3));
  ASSERT_TRUE(wait_for_status("NAV_SUCCESS"));
  EXPECT_TRUE(wait_until([this] { return at_rest(); }));
  EXPECT_THAT(client().feedback(),
              ElementsAre("save_trajectory_success", "start_task_success", "start_nav_success"));
}

TEST_F(Daemon, StopsWhenTheTaskIsCancelledAndStartsAgainWhenTold) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(drive(8));
  auto before = client().heard().size();
  control(R"({"cmd_type": "task_control", "cmd": "cancel_task"})");
  EXPECT_TRUE(wait_for_feedback("cancel_task_success", before));
  EXPECT_TRUE(wait_until([this] { return at_rest(); }));
  // The drives may be at rest before the next message tells that the task ended.
  EXPECT_TRUE(wait_until([this] { return status_text("nav", "status") != "NAV_RUN"; }));
  before = client().heard().size();
  (void)start_until_accepted("row", 17);
  EXPECT_TRUE(wait_for_feedback("start_nav_success", before));
}

TEST_F(Daemon, StaysWhereItIsAfterAnEmergencyStopUntilANewStart) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(drive(8));
  EXPECT_EQ(sim({"estop", "press"}), "ok\n");
  EXPECT_TRUE(wait_for_status("NAV_ERROR"));
  EXPECT_TRUE(wait_until([this] { return at_rest(); }));
  EXPECT_EQ(sim({"estop", "release"}), "ok\n");
  const double released_s = now_s();
  (void)wait_until([&] { return now_s() > released_s + 2; });  // long enough to move, if it would
  EXPECT_TRUE(at_rest());
  const auto before = client().heard().size();
  // A machine that holds everything up for a moment costs it its position: a person tries again.
  const double end_s = start_until_accepted("row", 17);
  EXPECT_TRUE(wait_for_feedback("start_nav_success", before));
  stop_daemon();
  for (const auto& point : set_points_on_the_bus())
    if (point.time_s > released_s && point.time_s < end_s) {
      ASSERT_EQ(point.velocity_turnps, 0) << "node " << point.node << " at " << point.time_s;
    }
}

TEST_F(Daemon, LeavesTheWheelsToTheGuardWhenItIsKilled) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(drive(8));
  daemon().signal(SIGKILL);
  ASSERT_EQ(daemon().wait(std::chrono::seconds(20)), 128 + SIGKILL);
  const double killed_s = now_s();
  EXPECT_TRUE(wait_until([this] { return at_rest(); }));
  (void)wait_until([&] { return now_s() > killed_s + kGrace_s + 0.5; });
  const double restarted_s = now_s();
  start_daemon();
  const auto before = client().heard().size();
  ASSERT_TRUE(wait_until([&] { return client().last("drover/online") == "1"; }));
  ASSERT_TRUE(wait_until([&] {
    return client().heard().size() > before && status_text("nav", "locate") == "LOCATE_TRUE" &&
           now_s() > restarted_s + 2;
  }));
  EXPECT_EQ(status_text("nav", "status"), "NAV_FREE");
  EXPECT_TRUE(at_rest());
  stop_daemon();

  std::array<int, 5> guard_frames{};
  for (const auto& point : set_points_on_the_bus()) {
    if (point.time_s < killed_s + kGrace_s) continue;
    ASSERT_EQ(point.velocity_turnps, 0) << "node " << point.node << " at " << point.time_s;
    if (point.time_s < restarted_s && point.node < guard_frames.size()) ++guard_frames[point.node];
  }
  for (std::size_t node = 1; node < guard_frames.size(); ++node)
    EXPECT_GT(guard_frames[node], 3) << "set points while no daemon lived, node " << node;
}

TEST_F(Daemon, DrivesAgainAfterTheGuardHandedTheBusBack) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  daemon().signal(SIGKILL);
  (void)daemon().wait(std::chrono::seconds(20));
  start_daemon();
  ASSERT_TRUE(wait_until([this] { return drover({"status"}).code == 0; }));
  ASSERT_TRUE(wait_for_locate());
  ASSERT_NO_FATAL_FAILURE(save_track("row", 2));
  // Refused with a reason while the guard has the bus, accepted once it gave it back.
  (void)start_until_accepted("row", 5);
  EXPECT_TRUE(wait_for_status("NAV_SUCCESS"));
}

TEST_F(Daemon, IsStoppedThroughTheGuardWhileItHangsAndStaysStoppedUntilReset) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(drive(8));
  daemon().signal(SIGSTOP);
  const auto stopped = drover({"stop"});
  daemon().signal(SIGCONT);
  EXPECT_EQ(stopped.code, 0) << stopped.text;
  EXPECT_THAT(stopped.text, HasSubstr("drover-guard stops the robot"));
  EXPECT_TRUE(wait_until([this] { return at_rest(); }));
  EXPECT_TRUE(wait_for_status("NAV_ERROR"));
  EXPECT_TRUE(wait_until([this] {
    return client().last("base_status").find("until drover reset") != std::string::npos;
  })) << client().last("base_status");
  EXPECT_EQ(drover({"task", "start", "row", "--id", "3"}).code, 1);
  EXPECT_TRUE(at_rest());
  const auto reset = drover({"reset"});
  EXPECT_EQ(reset.code, 0) << reset.text;
  EXPECT_TRUE(wait_until([this] { return drover({"task", "cancel"}).code == 0; }));
  ASSERT_NO_FATAL_FAILURE(save_track("again", 2));
  (void)start_until_accepted("again", 5);
  EXPECT_TRUE(wait_for_status("NAV_SUCCESS"));
}

TEST_F(Daemon, ComesToRestBeforeItEnds) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(drive(8));
  const double asked_s = now_s();
  stop_daemon();
  const double ended_s = now_s();
  EXPECT_TRUE(wait_until([this] { return at_rest(); }));
  (void)wait_until([&] { return now_s() > ended_s + 0.3; });
  bool slowed = false;
  for (const auto& point : set_points_on_the_bus()) {
    slowed = slowed || (point.time_s > asked_s && point.velocity_turnps != 0);
    if (point.time_s > ended_s) {
      ASSERT_EQ(point.velocity_turnps, 0) << "node " << point.node << " at " << point.time_s;
    }
  }
  EXPECT_TRUE(slowed) << "it ramps down, as after a cancel";
}

TEST_F(Daemon, GoesOnWithItsTaskWhileTheBrokerIsAway) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(drive(4));
  broker().signal(SIGKILL);
  (void)broker().wait(std::chrono::seconds(20));
  EXPECT_GT(true_speed_mps(), 0.05);
  const auto before = client().heard().size();
  ASSERT_NO_FATAL_FAILURE(start_broker());
  ASSERT_TRUE(wait_until([&] { return client().heard().size() > before + 3; }));
  EXPECT_TRUE(wait_for_status("NAV_SUCCESS"));
  EXPECT_THAT(client().feedback(before), testing::Not(Contains("start_task_success")));
}

TEST_F(Daemon, AnswersTheCommandLineWithoutABroker) {
  EXPECT_EQ(drover({"status"}).code, 3) << "no daemon";
  EXPECT_EQ(drover({"no-such-command"}).code, 2);
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(save_track("row", 8));
  broker().signal(SIGKILL);
  (void)broker().wait(std::chrono::seconds(20));

  const auto status = drover({"status", "--json"});
  EXPECT_EQ(status.code, 0);
  EXPECT_TRUE(json::parse(status.text).ok()) << status.text;
  for (const char* device : {"gnss", "imu", "bms", "can", "gpio"})
    EXPECT_THAT(drover({device, "--json"}).text, testing::StartsWith(R"({"ok":true,)")) << device;
  EXPECT_THAT(drover({"status"}).text, HasSubstr("front_left"));
  EXPECT_THAT(drover({"traj", "list"}).text, HasSubstr("row"));
  EXPECT_EQ(drover({"traj", "show", "row"}).code, 0);
  EXPECT_EQ(drover({"traj", "show", "nobody"}).code, 1);
  EXPECT_EQ(drover({"task", "start", "nobody", "--id", "2"}).code, 1);
  EXPECT_EQ(drover({"task", "start", "row", "--id", "1.9"}).code, 2);
  const auto start = drover({"task", "start", "row", "--id", "17", "--speed", "0.5"});
  EXPECT_EQ(start.code, 0) << start.text;
  EXPECT_TRUE(wait_until([this] { return true_speed_mps() > 0.1; }));
  EXPECT_EQ(drover({"task", "cancel"}).code, 0);
  EXPECT_TRUE(wait_until([this] { return at_rest(); }));
  EXPECT_EQ(drover({"reset"}).code, 0);
  EXPECT_EQ(drover({"traj", "delete", "row"}).code, 0);
  EXPECT_EQ(drover({"traj", "delete", "row"}).code, 1);
  EXPECT_THAT(drover({"version"}).text, HasSubstr("droverd " DROVER_VERSION));
}

TEST_F(Daemon, SaysWhatIsWrongWithAConfigurationAndEnds) {
  const auto file = (folder() / "bad.json").string();
  std::ofstream(file) << "{\"busses\": []}";
  const auto check = droverd({"--check", file});
  EXPECT_EQ(check.code, 2);
  EXPECT_THAT(check.text, HasSubstr(file + ":1:"));
  EXPECT_EQ(droverd({"-c", file}).code, 2);
  EXPECT_EQ(droverd({"--no-such-option"}).code, 2);
  EXPECT_EQ(droverd({"--check", (folder() / "drover.json").string()}).code, 0);
}

}  // namespace
}  // namespace drover::test
