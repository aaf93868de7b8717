// drover-guard: stops the wheels when droverd dies or hangs.
//
// It gets descriptors and stop frames from droverd at start, then watches a counter in shared
// memory. When the counter stands still longer than the limit, or the socket closes, it sends the
// stop frames every 10 ms until a new droverd has taken over and asks for the bus. It opens no
// device, knows no protocol and shares no code path with what it watches.
#include <fcntl.h>
#include <linux/gpio.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <systemd/sd-daemon.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>

#include "guard/stop_set.h"
#include "guard/watch.h"

namespace {

using drover::Duration;
using drover::GuardMessage;
using drover::GuardShared;
using drover::GuardVerb;
using drover::Time;

constexpr Duration kCycle = std::chrono::milliseconds(10);
constexpr const char* kDefaultSocket = "/run/drover/guard.sock";

Time now() {
  timespec t{};
  ::clock_gettime(CLOCK_MONOTONIC, &t);
  return Time{std::chrono::seconds(t.tv_sec) + Duration(t.tv_nsec)};
}

int listen_at(const char* path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (std::strlen(path) >= sizeof address.sun_path) return -1;
  std::strcpy(address.sun_path, path);
  const int fd = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  ::unlink(path);
  if (::bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) return -1;
  ::chmod(path, 0660);
  return ::listen(fd, 4) == 0 ? fd : -1;
}

class Guard final {
 public:
  explicit Guard(int listener) : listener_(listener) {}

  /// One clock reading and one wait a cycle: it is to cost a small board nothing.
  void run() {
    Time next = now() + kCycle;
    for (;;) {
      const Time t = now();
      if (t >= next) {
        cycle(t);
        next += kCycle;
        if (next <= t) next = t + kCycle;  // it was stopped or held up: no cycle twice
      }
      const timespec wait{0, (next - t).count()};
      pollfd fds[] = {{listener_, POLLIN, 0}, {daemon_, POLLIN, 0}};
      if (::ppoll(fds, 2, &wait, nullptr) <= 0) continue;
      if (fds[1].revents != 0) receive();
      if (fds[0].revents != 0) accept_daemon();
    }
  }

 private:
  void cycle(Time t) {
    const bool was_holding = holding_;
    holding_ = watch_.step(beats(), t);
    if (holding_ && !was_holding) set_.begin_hold();
    if (holding_ && may_hold()) set_.play(t);
    // Drives that nobody can stop are the hardware watchdog's.
    if (!holding_ || !may_hold() || set_.in_command(t)) pulse();
    if (shared_ != nullptr) {
      shared_->guard_beats.fetch_add(1, std::memory_order_relaxed);
      shared_->guard_holds.store(holding_ ? 1 : 0, std::memory_order_release);
      shared_->unsent.store(set_.unsent(), std::memory_order_relaxed);
    }
    if (holding_ && !was_holding) tell_of_hold(t);
    if (++cycles_ % 20 == 0) ::sd_notify(0, "WATCHDOG=1");
  }

  /// One edge a cycle. A line that is gone is closed, so that droverd can open it again.
  void pulse() {
    if (pulse_line_ < 0) return;
    pulse_high_ = !pulse_high_;
    gpio_v2_line_values values{};
    values.mask = 1;
    values.bits = pulse_high_ ? 1 : 0;
    if (::ioctl(pulse_line_, GPIO_V2_LINE_SET_VALUES_IOCTL, &values) == 0) return;
    std::fprintf(stderr, "drover-guard: the watchdog's line is gone (%s)\n", std::strerror(errno));
    ::close(pulse_line_);
    pulse_line_ = -1;
  }

  void tell_of_hold(Time t) const {
    if (daemon_ < 0) {
      std::fprintf(stderr, "drover-guard: droverd is gone: ");
    } else {
      std::fprintf(stderr, "drover-guard: droverd's heartbeat is %.0f ms old: ",
                   drover::to_s(watch_.age(t)) * 1e3);
    }
    std::fprintf(stderr, "stopping %zu axes with %zu messages\n", set_.axes(), set_.messages());
  }

  bool may_hold() const {
    if (shared_ == nullptr) return true;
    const auto may = shared_->may_hold.load(std::memory_order_relaxed);
    return may != drover::GuardMayHold::released && may != drover::GuardMayHold::cut;
  }

  std::uint64_t beats() const {
    return shared_ == nullptr ? 0 : shared_->daemon_beats.load(std::memory_order_acquire);
  }

  void accept_daemon() {
    const int fd = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (fd < 0) return;
    if (daemon_ >= 0) {  // one daemon at a time; the first keeps the guard
      ::close(fd);
      return;
    }
    daemon_ = fd;
  }

  void receive() {
    GuardMessage message;
    iovec vector{&message, sizeof message};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr header{};
    header.msg_iov = &vector;
    header.msg_iovlen = 1;
    header.msg_control = control.data();
    header.msg_controllen = control.size();
    const auto n = ::recvmsg(daemon_, &header, MSG_CMSG_CLOEXEC);
    if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
    int fd = -1;
    if (n > 0)
      if (const auto* c = CMSG_FIRSTHDR(&header); c != nullptr && c->cmsg_type == SCM_RIGHTS)
        std::memcpy(&fd, CMSG_DATA(c), sizeof fd);
    if (n != sizeof message || message.version != drover::kGuardVersion || !obey(message, fd)) {
      if (fd >= 0) ::close(fd);
      if (n > 0) std::fprintf(stderr, "drover-guard: a message was not understood\n");
      drop_daemon();
    }
  }

  void drop_daemon() {
    ::close(daemon_);
    daemon_ = -1;
    watch_.lost();
    cycle(now());  // do not wait for its time
  }

  /// Takes `fd` when it returns true.
  bool obey(const GuardMessage& message, int fd) {
    switch (message.verb) {
      case GuardVerb::hello:
        next_.clear();
        limit_ = std::chrono::milliseconds(message.limit_ms);
        return map_shared(fd);
      case GuardVerb::link: return next_.add_link(message, fd);
      case GuardVerb::axis: return fd < 0 && next_.add_axis(message);
      case GuardVerb::stop_message: return fd < 0 && next_.add_message(message);
      case GuardVerb::watch: take_set(); return fd < 0;
      case GuardVerb::hand_back: watch_.hand_back(now()); return fd < 0;
      case GuardVerb::pulse_line: return take_pulse_line(fd);
      default: return false;
    }
    return false;
  }

  void take_set() {
    const bool covers = next_.covers(set_);
    if (covers) {
      set_.swap(next_);
      if (holding_) set_.begin_hold();
    } else {
      std::fprintf(stderr, "drover-guard: a new set lacks %s: the old one stays\n",
                   next_.lacks(set_).data());
    }
    next_.clear();
    if (shared_ != nullptr) shared_->set_refused.store(covers ? 0 : 1, std::memory_order_relaxed);
    watch_.begin(beats(), limit_, now());
  }

  bool take_pulse_line(int fd) {
    if (fd < 0) return false;
    if (pulse_line_ >= 0) ::close(pulse_line_);
    pulse_line_ = fd;
    return true;
  }

  bool map_shared(int fd) {
    if (fd < 0) return false;
    // A file that shrinks under a mapping would kill us with SIGBUS: only a sealed one is believed.
    const int seals = ::fcntl(fd, F_GET_SEALS);
    struct stat info {};
    if (seals < 0 || (seals & F_SEAL_SHRINK) == 0 || ::fstat(fd, &info) != 0 ||
        info.st_size < static_cast<off_t>(sizeof(GuardShared)))
      return false;
    void* memory = ::mmap(nullptr, sizeof(GuardShared), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    if (memory == MAP_FAILED) return false;
    if (shared_ != nullptr) ::munmap(shared_, sizeof(GuardShared));
    shared_ = static_cast<GuardShared*>(memory);
    ::close(fd);
    return true;
  }

  int listener_;
  int daemon_ = -1;
  GuardShared* shared_ = nullptr;
  drover::guard::StopSet set_;
  drover::guard::StopSet next_;
  drover::guard::Watch watch_;
  Duration limit_ = std::chrono::milliseconds(50);
  bool holding_ = false;
  int pulse_line_ = -1;
  bool pulse_high_ = false;
  std::uint64_t cycles_ = 0;
};

void become_real_time() {
  sched_param priority{};
  priority.sched_priority = 70;  // above droverd's control thread: it must run when that one spins
  if (::sched_setscheduler(0, SCHED_FIFO, &priority) != 0)
    std::fprintf(stderr, "drover-guard: no real-time priority (%s)\n", std::strerror(errno));
  ::prctl(PR_SET_TIMERSLACK, 1);  // without that priority: 50 us of slack are the rule
  ::mlockall(MCL_CURRENT | MCL_FUTURE);
}

}  // namespace

int main(int argc, char** argv) {
  const char* path = kDefaultSocket;
  if (argc == 3 && std::strcmp(argv[1], "--socket") == 0) {
    path = argv[2];
  } else if (argc != 1) {
    const bool asked = argc == 2 && std::strcmp(argv[1], "--help") == 0;
    std::fprintf(asked ? stdout : stderr,
                 "drover-guard [--socket PATH]   (default %s)\n"
                 "Stops the drives with the frames droverd gave it when droverd dies or hangs.\n",
                 kDefaultSocket);
    return asked ? 0 : 2;
  }
  ::signal(SIGPIPE, SIG_IGN);
  const int listener = listen_at(path);
  if (listener < 0) {
    std::fprintf(stderr, "drover-guard: cannot listen at %s: %s\n", path, std::strerror(errno));
    return 2;
  }
  become_real_time();
  ::sd_notify(0, "READY=1");
  static Guard guard(listener);
  guard.run();
}
