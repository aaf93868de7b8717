// What one frame and one control cycle cost in the gateway, with few drives and with many.
#include <benchmark/benchmark.h>

#include "drover/triple_buffer.h"
#include "tests/bench/bench_robot.h"

namespace drover::gateway {
namespace {

void frame(benchmark::State& state) {
  const auto drives = static_cast<std::size_t>(state.range(0));
  Robot robot(drives);
  std::size_t drive = 0;
  for ([[maybe_unused]] auto each : state) {
    robot.hear_encoder(drive);
    drive = drive + 1 < drives ? drive + 1 : 0;
  }
}
BENCHMARK(frame)->Arg(4)->Arg(16)->Arg(64);

/// All drives heard, then the tick.
void cycle(benchmark::State& state) {
  Robot robot(static_cast<std::size_t>(state.range(0)));
  for ([[maybe_unused]] auto each : state) robot.cycle();
  benchmark::DoNotOptimize(robot.gateway().snapshot().time);
}
BENCHMARK(cycle)->Arg(4)->Arg(16)->Arg(64);

/// What a publisher's copy of the state costs.
void snapshot(benchmark::State& state) {
  Robot robot(static_cast<std::size_t>(state.range(0)));
  TripleBuffer<Snapshot> buffer;
  for ([[maybe_unused]] auto each : state) {
    buffer.back() = robot.gateway().snapshot();
    buffer.publish();
  }
  benchmark::DoNotOptimize(buffer.latest().time);
}
BENCHMARK(snapshot)->Arg(4)->Arg(64);

}  // namespace
}  // namespace drover::gateway

BENCHMARK_MAIN();
