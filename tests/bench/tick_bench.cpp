// What a control tick costs the daemon's own control thread, with wires that this program holds.
//
//   bench_tick DRIVES SECONDS [FRAMES]   each drive says FRAMES (default 2) a tick, four or eight
//                                        drives to a bus
//
// Prints "tick_ns longest_ns overruns frames thread": CPU time of the control thread for a tick,
// its longest step (wall), ticks that came too late, frames that it took in from the start on, its
// thread's number.
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "tests/bench/bench_robot.h"
#include "tests/bench/running_robot.h"

namespace {

using namespace drover;

/// The drives on all buses: each tick a heartbeat and the encoder's word, or more of those.
class Drives final {
 public:
  Drives(const bench::Buses& buses, std::size_t count, std::size_t frames)
      : buses_(buses), count_(count), frames_(frames), per_bus_(gateway::drives_per_bus(count)) {}
  void say() const {
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
  const bench::Buses& buses_;
  std::size_t count_;
  std::size_t frames_;
  std::size_t per_bus_;
};

int run(std::size_t count, double seconds, std::size_t frames) {
  const test::TempFolder folder;
  const std::size_t per_bus = gateway::drives_per_bus(count);
  const auto buses = bench::make_buses(folder.path(), (count + per_bus - 1) / per_bus);
  const Drives drives(buses, count, frames);
  bench::RunningRobot robot(gateway::configuration(count, folder.path()), folder.path());
  const auto say = [&] { drives.say(); };
  robot.begin(buses, say);
  const bench::Spent spent = robot.measure(seconds, buses, say);
  const Snapshot& seen = robot.seen();
  std::uint64_t received = 0;
  for (const auto& link : seen.links) received += link.received;
  std::size_t fresh = 0;
  for (const auto& axis : seen.axes) fresh += axis.health == SourceState::fresh ? 1 : 0;
  std::printf("%.0f %lld %llu %llu %d\n", spent.tick_ns,
              static_cast<long long>(seen.cycle.longest_step.count()),
              static_cast<unsigned long long>(seen.cycle.overruns),
              static_cast<unsigned long long>(received), robot.thread());
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
