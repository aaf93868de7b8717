// What frames cost on their way between a descriptor and the gateway, beside the bare system calls;
// what the gate costs; and what the last bytes of a position cost until it is known.
//
// A socket pair carries the frames as a bus would. Timed is the CPU time of the one side only.
#include <benchmark/benchmark.h>
#include <linux/can.h>
#include <sys/socket.h>

#include <array>
#include <ctime>
#include <string>
#include <thread>

#include "engine/gate/frame_gate.h"
#include "link/can_link.h"
#include "link/can_wire.h"
#include "tests/bench/bench_robot.h"

namespace drover::gateway {
namespace {

constexpr std::size_t kBatch = link::FrameBatch::capacity();
constexpr std::size_t kSent = 8;  // a cycle's
constexpr int kRounds = 3000;     // what is timed is a small part of each

double cpu_s() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Both ends of a bus.
struct Bus {
  Bus() {
    std::array<int, 2> fds{};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, fds.data()) != 0)
      throw std::runtime_error("no socket pair");
    near = link::UniqueFd(fds[0]);
    far = link::UniqueFd(fds[1]);
  }
  link::UniqueFd near;
  link::UniqueFd far;
};

/// Frames for one system call.
class Batch {
 public:
  explicit Batch(std::size_t count) : count_(static_cast<unsigned>(count)) {
    for (std::size_t i = 0; i < kBatch; ++i) {
      vectors_[i] = {&frames[i], sizeof(canfd_frame)};
      messages_[i].msg_hdr.msg_iov = &vectors_[i];
      messages_[i].msg_hdr.msg_iovlen = 1;
    }
  }
  void put(std::size_t i, const CanFrame& frame) {
    vectors_[i].iov_len = link::to_wire(frame, frames[i]);
  }
  int send(int fd) { return ::sendmmsg(fd, messages_.data(), count_, MSG_DONTWAIT); }
  int receive(int fd) {
    for (auto& vector : vectors_) vector.iov_len = sizeof(canfd_frame);
    return ::recvmmsg(fd, messages_.data(), count_, MSG_DONTWAIT, nullptr);
  }
  std::array<canfd_frame, kBatch> frames{};

 private:
  unsigned count_;
  std::array<iovec, kBatch> vectors_{};
  std::array<mmsghdr, kBatch> messages_{};
};

void check(bool good, benchmark::State& state) {
  if (!good) state.SkipWithError("a system call took or gave other than it should");
}

/// One side's work for `count` frames, when the other side has done its own.
template <class Before, class Work>
void each_batch(benchmark::State& state, std::size_t count, Before&& before, Work&& work) {
  for ([[maybe_unused]] auto each : state) {
    before();
    const double begin_s = cpu_s();
    work();
    state.SetIterationTime((cpu_s() - begin_s) / static_cast<double>(count));
  }
}

void receive_bare(benchmark::State& state) {
  Bus bus;
  Robot robot(4);
  Batch sent(kBatch);
  Batch heard(kBatch);
  for (std::size_t i = 0; i < kBatch; ++i) sent.put(i, robot.encoder(i % 4));
  std::uint64_t sum = 0;
  each_batch(
      state, kBatch, [&] { check(sent.send(bus.far.get()) == int{kBatch}, state); },
      [&] {
        check(heard.receive(bus.near.get()) == int{kBatch}, state);
        for (const auto& frame : heard.frames) sum += frame.can_id;
      });
  benchmark::DoNotOptimize(sum);
}
BENCHMARK(receive_bare)->UseManualTime()->Iterations(kRounds);

/// Received, decoded by its driver, and known to the engine.
void receive_whole(benchmark::State& state) {
  Bus bus;
  Robot robot(4);
  Batch sent(kBatch);
  link::CanLink link(std::move(bus.near));
  link::FrameBatch batch;
  each_batch(
      state, kBatch,
      [&] {
        robot.cycle();
        for (std::size_t i = 0; i < kBatch; ++i) sent.put(i, robot.encoder(i % 4));
        check(sent.send(bus.far.get()) == int{kBatch}, state);
      },
      [&] {
        check(link.receive({robot.now() - kTick, robot.now()}, batch), state);
        for (const auto& received : batch) robot.hear(0, received.frame);
      });
  check(batch.size() == kBatch, state);
}
BENCHMARK(receive_whole)->UseManualTime()->Iterations(kRounds);

/// At 8000 frames a second, drained on the tick: what a tick brings, after a tick of rest.
constexpr std::size_t kPaced = 40;
constexpr int kPacedRounds = 20;

template <class Work>
void each_tick(benchmark::State& state, Robot& robot, const Bus& bus, const Work& work) {
  Batch sent(kPaced);
  each_batch(
      state, kPaced,
      [&] {
        robot.cycle();
        for (std::size_t i = 0; i < kPaced; ++i) sent.put(i, robot.encoder(i % 4));
        check(sent.send(bus.far.get()) == int{kPaced}, state);
        std::this_thread::sleep_for(kTick);
      },
      work);
}

void paced_bare(benchmark::State& state) {
  Bus bus;
  Robot robot(4);
  Batch heard(kBatch);
  std::uint64_t sum = 0;
  each_tick(state, robot, bus, [&] {
    check(heard.receive(bus.near.get()) == int{kPaced}, state);
    for (std::size_t i = 0; i < kPaced; ++i) sum += heard.frames[i].can_id;
  });
  benchmark::DoNotOptimize(sum);
}
BENCHMARK(paced_bare)->UseManualTime()->Iterations(kPacedRounds);

void paced_whole(benchmark::State& state) {
  Bus bus;
  Robot robot(4);
  link::CanLink link(std::move(bus.near));
  link::FrameBatch batch;
  each_tick(state, robot, bus, [&] {
    check(link.receive({robot.now() - kTick, robot.now()}, batch), state);
    for (const auto& received : batch) robot.hear(0, received.frame);
  });
  check(batch.size() == kPaced, state);
}
BENCHMARK(paced_whole)->UseManualTime()->Iterations(kPacedRounds);

void send_bare(benchmark::State& state) {
  Bus bus;
  Robot robot(4);
  Batch sent(kSent);
  Batch heard(kBatch);
  for (std::size_t i = 0; i < kSent; ++i) sent.put(i, robot.encoder(i % 4));
  each_batch(
      state, kSent, [&] { (void)heard.receive(bus.far.get()); },
      [&] { check(sent.send(bus.near.get()) == int{kSent}, state); });
}
BENCHMARK(send_bare)->UseManualTime()->Iterations(kRounds);

void send_whole(benchmark::State& state) {
  Bus bus;
  Robot robot(4);
  Batch heard(kBatch);
  link::CanLink link(std::move(bus.near));
  std::array<CanFrame, kSent> frames;
  for (std::size_t i = 0; i < kSent; ++i) frames[i] = robot.encoder(i % 4);
  each_batch(
      state, kSent, [&] { (void)heard.receive(bus.far.get()); },
      [&] { check(link.send(frames), state); });
  check(link.counters().send_refused == 0, state);
}
BENCHMARK(send_whole)->UseManualTime()->Iterations(kRounds);

/// A set point that may leave.
void gate(benchmark::State& state) {
  const DriverEntry* const odrive = find_driver("odrive");
  Options options(odrive->options);
  options.set("node", 3.0);
  const Made made = odrive->make(options, {});
  engine::FrameGate gate;
  gate.add(0, *made.actuator);
  const CanFrame frame = make_frame(3U << 5U | 0x0DU, {0, 0, 0x80, 0x3F, 0, 0, 0, 0});
  const engine::Permission permitted{.motion = kAllChannels};
  const Time now{std::chrono::seconds(100)};
  for ([[maybe_unused]] auto each : state) {
    const auto verdict = gate.admit(0, frame, *made.actuator, permitted, now);
    benchmark::DoNotOptimize(verdict);
  }
  if (gate.counts(0).passed == 0) state.SkipWithError("the gate refused all");
}
BENCHMARK(gate);

/// The last bytes of a sentence, and the cycle after which its position is in the snapshot.
void last_byte_to_pose(benchmark::State& state) {
  const std::string sentence =
      "$GNGGA,084711.00,4807.03800000,N,01131.00000000,E,4,28,0.6,545.4,M,46.9,M,1.0,0000*";
  unsigned sum = 0;
  for (std::size_t i = 1; sentence[i] != '*'; ++i) sum ^= static_cast<unsigned char>(sentence[i]);
  std::array<char, 8> end{};
  const int size = std::snprintf(end.data(), end.size(), "%02X\r\n", sum);
  const auto bytes = [](const char* text, std::size_t count) {
    return std::span(reinterpret_cast<const std::uint8_t*>(text), count);
  };
  Robot robot(4);
  const auto line = static_cast<LinkId>(robot.gateway().bus_count());
  robot.gateway().apply({robot.now(), LinkUp{line}});
  for ([[maybe_unused]] auto each : state) {
    for (int i = 0; i < 20; ++i) robot.cycle();  // a receiver's tenth of a second
    robot.gateway().apply({robot.now(), BytesHeard{line, bytes(sentence.data(), sentence.size())}});
    const double begin_s = cpu_s();
    robot.gateway().apply({robot.now(), BytesHeard{line, bytes(end.data(), std::size_t(size))}});
    robot.tick();
    state.SetIterationTime(cpu_s() - begin_s);
  }
  if (robot.gateway().snapshot().gnss.source.samples == 0)
    state.SkipWithError("no position was read");
}
BENCHMARK(last_byte_to_pose)->UseManualTime()->Iterations(kRounds);

}  // namespace
}  // namespace drover::gateway

BENCHMARK_MAIN();
