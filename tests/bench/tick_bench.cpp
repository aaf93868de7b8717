// What a control tick costs the daemon's own control thread, with wires that this program holds.
//
//   bench_tick DRIVES SECONDS [FRAMES]   each drive says FRAMES (default 2) a tick, four or eight
//                                        drives to a bus
//
// Prints "tick_ns longest_ns overruns frames thread": CPU time of the control thread for a tick,
// its longest step (wall), ticks that came too late, frames that it took in from the start on, its
// thread's number.
#include <pthread.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "runtime/clock.h"
#include "runtime/control_loop.h"
#include "tests/bench/bench_robot.h"
#include "tests/support/temp_folder.h"
#include "tests/support/wires.h"

namespace {

using namespace drover;
using namespace std::chrono_literals;

/// The drives on all buses: each tick a heartbeat and the encoder's word, or more of those.
class Drives final {
 public:
  Drives(const std::string& folder, std::size_t count, std::size_t frames)
      : count_(count), frames_(frames), per_bus_(gateway::drives_per_bus(count)) {
    for (std::size_t i = 0; i * per_bus_ < count; ++i)
      buses_.push_back(std::make_unique<test::Bus>(folder + "/can" + std::to_string(i)));
  }
  bool connected() {
    bool all = true;
    for (auto& bus : buses_) all = bus->connected() && all;
    return all;
  }
  void say() {
    for (std::size_t i = 0; i < count_; ++i) {
      const auto node = static_cast<std::uint32_t>(i % per_bus_ + 1) << 5U;
      const test::Bus& bus = *buses_[i / per_bus_];
      bus.put(make_frame(node | 1U, {0, 0, 0, 0, gateway::kRunning, 0, 0, 0}));
      for (std::size_t k = 1; k < frames_; ++k)
        bus.put(make_frame(node | 9U, {0, 0, 0, 0, 0, 0, 0, 0}));
    }
    for (const auto& bus : buses_) (void)bus->take();
  }

 private:
  std::size_t count_;
  std::size_t frames_;
  std::size_t per_bus_;
  std::vector<std::unique_ptr<test::Bus>> buses_;
};

double cpu_s(pthread_t thread) {
  clockid_t clock{};
  timespec time{};
  if (::pthread_getcpuclockid(thread, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

int run(std::size_t count, double seconds, std::size_t frames) {
  const test::TempFolder folder;
  Drives drives(folder.path(), count, frames);
  const auto loaded = config::load_text(gateway::configuration(count, folder.path()));
  for (const auto& problem : loaded.problems) throw std::runtime_error(problem.text("robot"));
  gateway::Gateway gateway(loaded.config);
  const runtime::GuardMemory guard;
  runtime::LinkKeeper keeper(loaded.config, gateway.wiring(), guard, gateway.duties());
  const auto exchange = std::make_unique<runtime::ControlExchange>();
  const auto storage = std::make_unique<runtime::StorageExchange>();
  std::vector<std::string> report;
  runtime::RobotMemory memory(folder.path(), "a boot", loaded.text, report);
  runtime::ControlLoop control(loaded.config, gateway, keeper, guard, *exchange,
                               {memory, *storage});
  std::atomic<bool> stop{false};
  std::atomic<int> number{0};
  std::thread keeps([&] { keeper.run(stop); });
  std::thread controls([&] {
    number = ::gettid();
    control.run(stop);
  });

  auto next = std::chrono::steady_clock::now();
  bool heard = false;
  const auto live = [&](double for_s) {
    for (double t = 0; t < for_s; t += to_s(gateway::kTick)) {
      if (heard = drives.connected(); heard) drives.say();
      std::this_thread::sleep_until(next += gateway::kTick);
    }
  };
  for (int i = 0; i < 10 && !heard; ++i) live(1);  // it opens its links one after the other
  live(0.5);
  const auto received = [&] {
    std::uint64_t sum = 0;
    for (const auto& link : exchange->snapshot.latest().links) sum += link.received;
    return sum;
  };
  const double cpu_before_s = cpu_s(controls.native_handle());
  const auto ticks_before = exchange->beats.load();
  live(seconds);
  const double spent_s = cpu_s(controls.native_handle()) - cpu_before_s;
  const auto ticks = exchange->beats.load() - ticks_before;
  const Snapshot& robot = exchange->snapshot.latest();
  std::size_t fresh = 0;
  for (const auto& axis : robot.axes) fresh += axis.health == SourceState::fresh ? 1 : 0;
  std::printf("%.0f %lld %llu %llu %d\n", 1e9 * spent_s / static_cast<double>(ticks),
              static_cast<long long>(robot.cycle.longest_step.count()),
              static_cast<unsigned long long>(robot.cycle.overruns),
              static_cast<unsigned long long>(received()), number.load());
  stop = true;
  keeper.wake();
  controls.join();
  keeps.join();
  if (fresh == count) return 0;
  std::cerr << "only " << fresh << " of " << count << " drives are heard\n";
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::cerr << "bench_tick DRIVES SECONDS [FRAMES]\n";
    return 2;
  }
  return run(std::stoul(argv[1]), std::stod(argv[2]), argc == 4 ? std::stoul(argv[3]) : 2);
}
