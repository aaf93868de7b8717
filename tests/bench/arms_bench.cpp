// What 24 joints outside the base cost the daemon's own control thread: three arms of eight DAMIAO
// motors, each on a bus of its own, that follow a stream of joint commands at 100 Hz, 500 cycles a
// second. Each motor is told its set point in each cycle, and answers: more than a bus of 1 Mbit/s
// carries (seven do); a socket has no such limit.
//
//   bench_arms SECONDS       prints "tick_ns longest_ns overruns ticks allocations thrown": CPU
//                            time of the control thread for a tick, its longest step (wall), ticks
//                            that came too late in the time that was measured, and how many there
//                            were, of all runs; how often the thread allocated in all its life;
//                            how many runs were thrown away, as an arm did not follow at their end
//   bench_arms --configuration   prints the robot's configuration, for droverd --check
#include <cmath>
#include <cstdio>
#include <iostream>
#include <optional>

#include "drover/registry.h"
#include "tests/bench/running_robot.h"

namespace {

using namespace drover;

constexpr std::size_t kArms = 3;
constexpr std::size_t kJointsOfEach = 8;
constexpr std::size_t kJoints = kArms * kJointsOfEach;
constexpr double kTick_Hz = 500;
constexpr int kTicksPerCommand = 5;

/// The base is a chassis on a serial line that is not there: what is measured are the arms.
std::string configuration(const std::string& folder) {
  std::string links;
  std::string devices;
  std::string groups;
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const auto bus = "can" + std::to_string(arm);
    links += '"' + bus + R"(": {"can": ")" + (folder.empty() ? bus : "unix:" + folder + "/" + bus) +
             "\"},\n    ";
    std::string joints;
    for (std::size_t i = 1; i <= kJointsOfEach; ++i) {
      const auto joint = "arm" + std::to_string(arm) + "_" + std::to_string(i);
      devices += '"' + joint + R"(": {"driver": "damiao", "link": ")" + bus +
                 R"(", "options": {"id": )" + std::to_string(i) +
                 R"(, "model": "DM4310", "setpoint_period_s": 0.0015}},)" + "\n    ";
      joints += (joints.empty() ? "" : ",\n      ") + ('"' + joint) +
                R"(": {"min_rad": -1.5, "max_rad": 1.5, "max_velocity_radps": 2,
        "max_effort_Nm": 7, "stiffness_Nmprad": 60, "damping_Nmsprad": 2})";
    }
    groups += ",\n    \"arm" + std::to_string(arm) + R"(": {"joints": {)" + joints + "}}";
  }
  const auto run = folder.empty() ? std::string("/run/drover") : folder;
  return R"({
  "control": {"tick_Hz": 500},
  "links": {
    )" + links +
         R"("chassis": {"serial": "/dev/drover/chassis", "baud": 115200},
    "gnss": {"serial": "/dev/drover/gnss", "baud": 115200}},
  "devices": {
    )" + devices +
         R"("chassis": {"driver": "gt01_serial", "link": "chassis", "accept": ["no_watchdog"]},
    "gnss": {"driver": "nmea0183", "link": "gnss"}},
  "groups": {
    "base": {"kind": "twist", "device": "chassis", "track_m": 0.5, "hold": "brake"})" +
         groups + R"(},
  "guard": {"required": false, "socket": ")" +
         run + R"(/guard.sock"},
  "mqtt": {"host": "127.0.0.1", "port": 1883},
  "accept": ["no_estop", "no_relay", "no_guard", "no_tilt", "falls"]
})";
}

/// The motors' twins on their buses, with what they turn.
class Motors final {
 public:
  explicit Motors(const bench::Buses& buses) : buses_(buses) {
    const DriverEntry& entry = *find_driver("damiao");
    Options options(entry.options);
    for (const OptionSpec& spec : entry.twin_options) options.set(spec.name, spec.default_value);
    options.set("model", std::string("DM4310"));
    for (std::size_t i = 0; i < kJoints; ++i) {
      options.set("id", static_cast<double>(i % kJointsOfEach + 1));
      twins_.push_back(std::get<MakeCanTwin>(entry.make_twin)(options));
    }
  }
  /// Hears what was said to them since the last call, and answers it.
  void live(Time now) {
    for (std::size_t arm = 0; arm < kArms; ++arm) {
      const auto heard = buses_[arm]->frames();
      for (std::size_t i = 0; i < kJointsOfEach; ++i) {
        CanTwin& twin = *twins_[arm * kJointsOfEach + i];
        Shaft& shaft = shafts_[arm * kJointsOfEach + i];
        said_.clear();
        twin.on_tick(now, {&shaft, 1}, said_);
        for (const CanFrame& frame : heard) twin.on_frame(frame, now, said_);
        for (const CanFrame& frame : said_) buses_[arm]->put(frame);
        shaft.velocity_radps += 0.002 / 0.05 * (shaft.torque_Nm - 0.5 * shaft.velocity_radps);
        shaft.position_rad += 0.002 * shaft.velocity_radps;
      }
    }
  }

 private:
  const bench::Buses& buses_;
  std::vector<std::unique_ptr<CanTwin>> twins_;
  std::array<Shaft, kJoints> shafts_{};
  TwinFrames said_;
};

/// All joints swing, each by its own phase, as fast as their limits allow and no faster.
void command(runtime::ControlExchange& exchange, Time now, std::uint64_t number) {
  JointTargets targets;
  for (std::size_t i = 0; i < kJoints; ++i) {
    const double phase = 2 * to_s(now.time_since_epoch()) + 0.3 * static_cast<double>(i);
    (void)targets.joints.push_back(
        {static_cast<AxisId>(i), 0.8 * std::cos(phase), 0.4 * std::sin(phase), 0, 60, 2});
  }
  const RequestId id{RequestId::Source::aimrt, number};
  (void)exchange.commands.push(runtime::QueuedCommand{{id, now, targets}, {}});
}

/// Of all runs, also those that were thrown away.
struct Ticks {
  std::uint64_t late = 0;
  std::uint64_t all = 0;
  int thrown = 0;  ///< runs
};

/// The exit status; nothing when an arm does not follow at the end: a machine that stood still for
/// a motor's time-out is no measurement of what a tick costs. Its late ticks count.
std::optional<int> run(double seconds, Ticks& ticks) {
  const test::TempFolder folder;
  const auto buses = bench::make_buses(folder.path(), kArms);
  Motors motors(buses);
  bench::RunningRobot robot(configuration(folder.path()), folder.path());
  std::uint64_t number = 0;
  const auto say = [&] {
    const Time now = runtime::monotonic_now();
    motors.live(now);
    if (++number % kTicksPerCommand == 0) command(robot.exchange(), now, number);
  };
  robot.begin(buses, say);
  robot.live(4, buses, say);  // until all of them follow
  const bench::Spent spent = robot.measure(seconds, buses, say);
  const Snapshot seen = robot.seen();
  const auto allocations = robot.end();
  ticks.late += spent.overruns;
  ticks.all += spent.ticks;
  for (const GroupSnapshot& group : seen.groups) {
    if (group.state == GroupState::following) continue;
    std::cerr << group.name.view() << " does not follow: " << group.reason.view() << '\n';
    ++ticks.thrown;
    return std::nullopt;
  }
  std::printf("%.0f %lld %llu %llu %llu %d\n", spent.tick_ns,
              static_cast<long long>(seen.cycle.longest_step.count()),
              static_cast<unsigned long long>(ticks.late),
              static_cast<unsigned long long>(ticks.all),
              static_cast<unsigned long long>(allocations), ticks.thrown);
  return allocations == 0 && seen.axes.size() == kJoints ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "bench_arms SECONDS | --configuration\n";
    return 2;
  }
  if (std::string_view(argv[1]) == "--configuration") {
    std::cout << configuration({}) << '\n';
    return 0;
  }
  Ticks ticks;
  for (int attempt = 0; attempt < 5; ++attempt)
    if (const auto status = run(std::stod(argv[1]), ticks)) return *status;
  return 1;
}
