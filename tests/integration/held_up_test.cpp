// The control thread is held up between what it decides and the system call that sends it, as a
// busy or swapping computer does. In real time, on two buses.
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "integration/robot_rig.h"

namespace drover::test {
namespace {

namespace fs = std::filesystem;

/// Holds a thread of a child process at the door of the kernel: with the first frames of a cycle in
/// its hands, before they are sent.
class HeldBeforeItSends final {
 public:
  explicit HeldBeforeItSends(pid_t thread) {
    int status = 0;
    if (thread <= 0 || ::ptrace(PTRACE_SEIZE, thread, nullptr, PTRACE_O_TRACESYSGOOD) != 0) return;
    thread_ = thread;
    if (::ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr) != 0 ||
        ::waitpid(thread, &status, __WALL) != thread) {
      let_go();
      return;
    }
    bool has_heard = false;  // what comes in is read before anything is decided
    for (int calls = 0; calls < 10'000; ++calls) {
      if (::ptrace(PTRACE_SYSCALL, thread, nullptr, nullptr) != 0 ||
          ::waitpid(thread, &status, __WALL) != thread)
        break;
      __ptrace_syscall_info call{};
      ::ptrace(static_cast<__ptrace_request>(PTRACE_GET_SYSCALL_INFO), thread, sizeof call, &call);
      if (call.op != PTRACE_SYSCALL_INFO_ENTRY) continue;
      has_heard = has_heard || call.entry.nr == SYS_recvmmsg;
      if (!has_heard || call.entry.nr != SYS_sendmmsg) continue;
      held_ = true;
      return;
    }
    let_go();
  }
  ~HeldBeforeItSends() { let_go(); }
  HeldBeforeItSends(const HeldBeforeItSends&) = delete;
  HeldBeforeItSends& operator=(const HeldBeforeItSends&) = delete;

  bool held() const { return held_; }
  void let_go() {
    if (thread_ > 0) ::ptrace(PTRACE_DETACH, thread_, nullptr, nullptr);
    thread_ = -1;
    held_ = false;
  }

 private:
  pid_t thread_ = -1;
  bool held_ = false;
};

class HeldUp : public RobotRig {
 protected:
  /// The right wheels' drives are on a bus of their own.
  void put_right_wheels_on_can1() const {
    change("sim.json", R"("can": {"can0": {"kind": "unix"}})",
           R"("can": {"can0": {"kind": "unix"}, "can1": {"kind": "unix"}})");
    const auto bus = folder().string() + "/sim/can";
    const auto first = R"("can0": {"can": "unix:)" + bus + R"(0.sock"})";
    change("drover.json", first, first + R"(, "can1": {"can": "unix:)" + bus + R"(1.sock"})");
    for (const std::string joint : {"front_right", "rear_right"}) {
      const auto simulated = R"({"joint": ")" + joint + R"(", "driver": "odrive", "bus": ")";
      change("sim.json", simulated + "can0", simulated + "can1");
      const auto configured = "\"" + joint + R"(": {"driver": "odrive", "link": ")";
      change("drover.json", configured + "can0", configured + "can1");
    }
  }
  /// The one that decides and sends.
  pid_t control_thread() {
    for (const auto& entry :
         fs::directory_iterator("/proc/" + std::to_string(daemon().pid()) + "/task")) {
      std::string name;
      std::ifstream comm(entry.path() / "comm");
      std::getline(comm, name);
      if (name == "control") return std::atoi(entry.path().filename().c_str());
    }
    return -1;
  }

 private:
  void change(const char* file, const std::string& from, const std::string& to) const {
    std::ifstream stream(folder() / file);
    std::string text((std::istreambuf_iterator<char>(stream)), {});
    stream.close();
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    std::ofstream(folder() / file) << text;
  }
};

TEST_F(HeldUp, NothingOldLeavesAfterTheGuardHasTheBusButTheOneBatchAtTheDoor) {
  ASSERT_NO_FATAL_FAILURE(put_right_wheels_on_can1());
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(drive(16));
  ASSERT_TRUE(wait_until([this] { return true_speed_mps() > 0.4; }));

  HeldBeforeItSends control(control_thread());
  if (!control.held()) GTEST_SKIP() << "no thread of another process can be held here";
  const double held_s = now_s();
  ASSERT_TRUE(wait_until([this] { return at_rest(); })) << "the guard stops the wheels";
  const double let_go_s = now_s();
  control.let_go();
  EXPECT_TRUE(wait_for_status("NAV_ERROR"));
  (void)wait_until([end = now_s() + 0.5] { return now_s() > end; });
  EXPECT_TRUE(at_rest());

  // The simulated bus writes down at its tick what left before, under a sanitizer later than that.
  constexpr double kWrittenDown_s = 0.05;
  const auto points = set_points_on_the_bus();
  std::vector<SetPoint> before;
  std::vector<SetPoint> after;
  for (const auto& point : points) {
    if (point.velocity_turnps == 0) continue;
    if (point.time_s > held_s + kWrittenDown_s && point.time_s < let_go_s) before.push_back(point);
    if (point.time_s >= let_go_s) after.push_back(point);
  }
  EXPECT_TRUE(before.empty()) << before.size() << " while it stood still";
  for (const auto& point : after)
    EXPECT_EQ(point.bus, 0U) << "decided before the guard had the bus";
  EXPECT_LE(after.size(), 2U) << "one batch: a set point for each wheel of the first bus";
  std::printf("held up for %.0f ms; %zu old set points left afterwards\n",
              1e3 * (let_go_s - held_s), after.size());
  for (const unsigned node : {1U, 2U, 3U, 4U}) {
    const auto last = std::find_if(points.rbegin(), points.rend(),
                                   [node](const SetPoint& point) { return point.node == node; });
    ASSERT_NE(last, points.rend());
    EXPECT_EQ(last->velocity_turnps, 0) << "node " << node;
  }
}

}  // namespace
}  // namespace drover::test
