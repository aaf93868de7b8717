// What ROS 2 users do to drover-ros2 is nothing to droverd: a reliable reader that hangs, a
// drover-ros2 that hangs or is killed again and again, a flood of messages of 200 000 joints. A
// task is driven meanwhile; period of the set points on the bus, late ticks and memory are printed.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <thread>

#include "integration/ros2_drive_rig.h"
#include "json/located_json.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;

constexpr double kPhase_s = 4;
constexpr double kMostOfRos2_kB = 40'000;
constexpr double kMostGrown_kB = 2'000;  ///< of droverd, meanwhile: what it writes of the task

/// A thread that wants to wake each 5 ms as the gateway's does, with no more right to it: how often
/// this machine let it wake more than 1 ms late.
class SameTicks final {
 public:
  SameTicks()
      : thread_([this] {
          for (auto next = Clock::now(); !stop_; next += kTick) {
            std::this_thread::sleep_until(next);
            if (Clock::now() - next > kLate) ++late_;
            if (Clock::now() > next + kTick) next = Clock::now();
          }
        }) {}
  ~SameTicks() {
    stop_ = true;
    thread_.join();
  }
  SameTicks(const SameTicks&) = delete;
  SameTicks& operator=(const SameTicks&) = delete;
  int late() const { return late_; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kTick{5};
  static constexpr std::chrono::milliseconds kLate{1};
  std::atomic<bool> stop_{false};
  std::atomic<int> late_{0};
  std::thread thread_;
};

struct Phase {
  const char* name = nullptr;
  int machine_late = 0;
  double begin_s = 0, end_s = 0;
  double cycles = 0, late = 0, sent = 0;
  double droverd_kB = 0;
};

class BesideRos2 : public MovedFromRos2 {
 protected:
  BesideRos2() : MovedFromRos2(R"("joint_command": true)") {}

  static double memory_kB(const Process& of, std::string_view key) {
    std::ifstream told("/proc/" + std::to_string(of.pid()) + "/status");
    for (std::string word; told >> word;)
      if (double kB = 0; word == key && told >> kB) return kB;
    return 0;
  }
  /// Cycles, late ticks and frames sent so far are taken from `phase`, or added to it.
  void count(Phase& phase, double sign) {
    const auto told = json::parse(drover({"status", "--json"}).text);
    ASSERT_TRUE(told);
    const auto* seen = told->root.find("status");
    ASSERT_NE(seen, nullptr);
    const auto* cycle = seen->find("cycle");
    const auto* links = seen->find("links");
    ASSERT_NE(cycle, nullptr);
    ASSERT_NE(links, nullptr);
    phase.machine_late += static_cast<int>(sign) * ticks_.late();
    phase.cycles += sign * cycle->find("count")->number().value_or(0);
    phase.late += sign * cycle->find("overruns")->number().value_or(0);
    for (const auto& link : *links->list())
      if (link.find("name")->text() != nullptr && *link.find("name")->text() == "can0")
        phase.sent += sign * link.find("sent")->number().value_or(0);
  }
  /// Says `again` every 50 ms for the whole phase.
  void play(const char* name, const std::function<void()>& again) {
    Phase phase{.name = name, .begin_s = now_s()};
    ASSERT_NO_FATAL_FAILURE(count(phase, -1));
    const double end_s = now_s() + kPhase_s;
    ASSERT_TRUE(repeat_until(
        again, 50ms, [end_s] { return now_s() > end_s; }, 60s));
    ASSERT_NO_FATAL_FAILURE(count(phase, 1));
    phase.end_s = now_s();
    phase.droverd_kB = memory_kB(daemon(), "VmRSS:");
    phases_.push_back(phase);
  }
  void tell(const std::vector<SetPoint>& points) const {
    std::printf("  %-28s %8s %8s %8s %6s %6s %9s %10s\n", "set points of a drive, ms:", "median",
                "99 %", "most", "ticks", "late", "machine's", "droverd kB");
    for (const Phase& phase : phases_) {
      std::vector<double> apart_ms;
      double last_s = 0;
      for (const SetPoint& point : points) {
        if (point.node != 1 || point.time_s < phase.begin_s || point.time_s > phase.end_s) continue;
        if (last_s > 0) apart_ms.push_back(1e3 * (point.time_s - last_s));
        last_s = point.time_s;
      }
      ASSERT_FALSE(apart_ms.empty()) << phase.name;
      std::sort(apart_ms.begin(), apart_ms.end());
      std::printf("  %-28s %8.2f %8.2f %8.2f %6.0f %6.0f %9d %10.0f\n", phase.name,
                  apart_ms[apart_ms.size() / 2], apart_ms[apart_ms.size() * 99 / 100],
                  apart_ms.back(), phase.cycles, phase.late, phase.machine_late, phase.droverd_kB);
    }
  }

  std::vector<Phase> phases_;
  SameTicks ticks_;
};

TEST_F(BesideRos2, DrivesAsWithoutItWhateverItsUsersDo) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::joint_command_kind()));
  Process reader({DROVER_ROS2_READER, std::to_string(domain_)}, (folder() / "reader.log").string());
  ASSERT_TRUE(wait_until([&] { return reader.output().find("it reads") != std::string::npos; }))
      << program_.output();
  ASSERT_NO_FATAL_FAILURE(drive(15));

  ASSERT_NO_FATAL_FAILURE(play("a reader", [] {}));
  reader.signal(SIGSTOP);
  ASSERT_NO_FATAL_FAILURE(play("a reliable reader hangs", [] {}));
  reader.signal(SIGCONT);
  program_.signal(SIGSTOP);
  ASSERT_NO_FATAL_FAILURE(play("drover-ros2 hangs", [] {}));
  program_.signal(SIGCONT);
  ASSERT_NO_FATAL_FAILURE(play("killed again and again", [this] {
    program_.signal(SIGKILL);
    (void)program_.wait(5s);
    start_program();
    (void)wait_until([] { return false; }, 300ms);
  }));
  ASSERT_TRUE(is_heard(writer_)) << program_.output();
  std::vector<aimrt_msgs_msg_dds__JointCommand_> many(200'000);
  for (auto& joint : many) joint.name_ = const_cast<char*>("front_left");
  aimrt_msgs_msg_dds__JointCommandArray_ flood{};
  flood.header_.frame_id_ = const_cast<char*>("");
  flood.joints_._buffer = many.data();
  bool large = false;
  ASSERT_NO_FATAL_FAILURE(play("a flood of large messages", [&] {
    // What DDS takes, and what is too large for it.
    large = !large;
    flood.joints_._length = flood.joints_._maximum =
        static_cast<std::uint32_t>(large ? many.size() : 1000);
    dds_write(writer_, &flood);
  }));
  EXPECT_LT(memory_kB(program_, "VmHWM:"), kMostOfRos2_kB);
  EXPECT_GT(memory_kB(program_, "VmHWM:"), 0);
  std::printf("  drover-ros2 had %.0f kB at most\n", memory_kB(program_, "VmHWM:"));
  ASSERT_TRUE(wait_for_status("NAV_SUCCESS")) << status();

  const Phase& quiet = phases_.front();
  for (const Phase& phase : phases_) {
    EXPECT_LT(phase.droverd_kB, quiet.droverd_kB + kMostGrown_kB) << phase.name;
    // But for the machine's own late ticks it says as much on the bus in a cycle.
    const double in_a_cycle = quiet.sent / quiet.cycles;
    EXPECT_NEAR(phase.sent / phase.cycles, in_a_cycle,
                (0.02 + phase.late / phase.cycles) * in_a_cycle)
        << phase.name << ": of a thread that does nothing " << phase.machine_late
        << " wakes were late";
    // A thread that does nothing was late more often, too: it proves nothing, and is played again.
    if (HasFailure() && phase.machine_late > quiet.machine_late) machine_was_starved = true;
  }
  stop_daemon();
  tell(set_points_on_the_bus());
}

}  // namespace
}  // namespace drover::test
