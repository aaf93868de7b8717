// One side of a real bus of the lab at saturation, for tests/bench/bus.
//
//   bench_bus send COUNT        sends so many frames of drives, and leaves the CPU to who reads
//   bench_bus bare COUNT        epoll and recvmmsg until it has so many, and nothing else
//   bench_bus whole COUNT       the same frames received, decoded by their drivers and known to the
//                               engine
// On can0. Exit status 1: fewer came, or they were other ones.
#include <sched.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "link/can_open.h"
#include "link/can_wire.h"
#include "tests/bench/bench_robot.h"

namespace drover::bench {
namespace {

constexpr std::size_t kDrives = 4;
constexpr int kQuiet_ms = 5000;

link::CanSettings settings() {
  return {.interface = "can0", .frames_per_cycle = 4096};
}

link::UniqueFd open_bus() {
  std::string problem;
  auto fd = link::open_can_descriptor(settings(), problem);
  if (fd.get() < 0) throw std::runtime_error(problem);
  const int bytes = 64 << 20;
  ::setsockopt(fd.get(), SOL_SOCKET, SO_RCVBUFFORCE, &bytes, sizeof bytes);
  return fd;
}

/// Waits for frames. False when none come any more.
class Waits {
 public:
  explicit Waits(int fd) : epoll_(::epoll_create1(EPOLL_CLOEXEC)) {
    epoll_event event{};
    event.events = EPOLLIN;
    ::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, fd, &event);
  }
  bool wait() const {
    epoll_event event{};
    return ::epoll_wait(epoll_.get(), &event, 1, kQuiet_ms) == 1;
  }

 private:
  link::UniqueFd epoll_;
};

struct Batch {
  static constexpr std::size_t kSize = 64;
  Batch() {
    for (std::size_t i = 0; i < kSize; ++i) {
      vectors[i] = {&frames[i], sizeof(canfd_frame)};
      messages[i].msg_hdr.msg_iov = &vectors[i];
      messages[i].msg_hdr.msg_iovlen = 1;
    }
  }
  std::array<canfd_frame, kSize> frames{};
  std::array<iovec, kSize> vectors{};
  std::array<mmsghdr, kSize> messages{};
  std::array<std::array<char, 64>, kSize> control{};
};

int send(std::size_t count) {
  gateway::Robot robot(kDrives);
  const auto bus = open_bus();
  Batch batch;
  std::size_t sent = 0;
  while (sent < count) {
    const std::size_t now = std::min(Batch::kSize, count - sent);
    for (std::size_t i = 0; i < now; ++i)
      batch.vectors[i].iov_len =
          link::to_wire(robot.encoder((sent + i) % kDrives), batch.frames[i]);
    const int n = ::sendmmsg(bus.get(), batch.messages.data(), static_cast<unsigned>(now), 0);
    if (n > 0) sent += static_cast<std::size_t>(n);
    ::sched_yield();
  }
  return 0;
}

/// With the kernel's stamps, as who decodes them needs them.
int bare(std::size_t count) {
  const auto bus = open_bus();
  const Waits waits(bus.get());
  Batch batch;
  std::size_t heard = 0;
  std::uint64_t sum = 0;
  while (heard < count && waits.wait()) {
    for (std::size_t i = 0; i < Batch::kSize; ++i) {
      batch.vectors[i].iov_len = sizeof(canfd_frame);
      batch.messages[i].msg_hdr.msg_control = batch.control[i].data();
      batch.messages[i].msg_hdr.msg_controllen = batch.control[i].size();
    }
    const int n = ::recvmmsg(bus.get(), batch.messages.data(), Batch::kSize, MSG_DONTWAIT, nullptr);
    for (int i = 0; i < n; ++i) sum += batch.frames[static_cast<std::size_t>(i)].can_id;
    if (n > 0) heard += static_cast<std::size_t>(n);
  }
  std::printf("%zu frames, %llu\n", heard, static_cast<unsigned long long>(sum));
  return heard == count ? 0 : 1;
}

int whole(std::size_t count) {
  gateway::Robot robot(kDrives);
  link::CanLink link(open_bus());
  const Waits waits(link.fd());
  link::FrameBatch batch;
  std::size_t heard = 0;
  const auto samples = [&robot] {
    std::uint64_t sum = 0;
    for (const auto& axis : robot.gateway().snapshot().axes) sum += axis.source.samples;
    return sum;
  };
  robot.tick();
  const std::uint64_t before = samples();
  while (heard < count && waits.wait()) {
    if (!link.receive({robot.now() - gateway::kTick, robot.now()}, batch)) return 1;
    for (const auto& received : batch) robot.hear(0, received.frame);
    heard += batch.size();
  }
  robot.tick();
  const std::uint64_t known = samples() - before;
  std::printf("%zu frames, %llu known\n", heard, static_cast<unsigned long long>(known));
  return heard == count && known == count ? 0 : 1;
}

}  // namespace
}  // namespace drover::bench

int main(int argc, char** argv) {
  const std::string_view what = argc == 3 ? argv[1] : "";
  const std::size_t count = argc == 3 ? std::strtoull(argv[2], nullptr, 10) : 0;
  try {
    if (what == "send") return drover::bench::send(count);
    if (what == "bare") return drover::bench::bare(count);
    if (what == "whole") return drover::bench::whole(count);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_bus: %s\n", error.what());
    return 1;
  }
  std::fputs("usage: bench_bus send|bare|whole COUNT\n", stderr);
  return 2;
}
