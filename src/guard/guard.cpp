#include "guard/guard.h"

#include <linux/gpio.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "guard/clock.h"

namespace drover::guard {

namespace {
constexpr Duration kCycle = std::chrono::milliseconds(10);
constexpr std::uint64_t kCyclesToWatchdog = 20;
}  // namespace

Guard::Guard(int daemon_listener, int stop_listener, uid_t daemon_uid, Speech& speech,
             Notify& notify)
    : daemon_listener_(daemon_listener),
      stop_port_(stop_listener, *this),
      daemon_uid_(daemon_uid),
      speech_(speech),
      notify_(notify),
      keep_(notify) {}

/// Two clock readings and one wait a cycle: it is to cost a small board nothing.
void Guard::run() {
  Time next = now();
  for (;;) {
    const Time t = now();
    if (t >= next) {
      cycle(t);
      next += kCycle;
      if (next <= t) next = t + kCycle;  // it was stopped or held up: no cycle twice
    }
    const timespec wait{0, std::max<long>(0, (next - now()).count())};
    std::array<pollfd, 2 + StopPort::kPollFds> fds{};
    fds[0] = {daemon_listener_, POLLIN, 0};
    fds[1] = {daemon_, POLLIN, 0};
    stop_port_.poll_fds(fds.data() + 2);
    if (::ppoll(fds.data(), fds.size(), &wait, nullptr) <= 0) continue;
    stop_port_.serve(fds.data() + 2);
    if (fds[1].revents != 0) receive();
    if (fds[0].revents != 0) accept_daemon();
  }
}

void Guard::cycle(Time t) {
  const bool was_holding = holding_;
  act(t);
  publish();
  // Words come last, and none of them waits.
  tell(t, was_holding);
  ++cycles_;
  if (!ready_told_) ready_told_ = notify_.say("READY=1");
  if (cycles_ % kCyclesToWatchdog == 0) notify_.say("WATCHDOG=1");
  if (set_.died() != died_) {  // a store that keeps it open would keep its name taken as well
    died_ = set_.died();
    keep_.keep(set_, limit_ms_);
    speech_.say("drover-guard: a line is gone, and closed");
  }
  keep_.step(set_, memory_);
}

void Guard::act(Time t) {
  const bool was_holding = holding_;
  holding_ = watch_.step(beats(), t) || keep_.state().latched.load() != 0;
  if (holding_ && !was_holding) set_.begin_hold();
  // A stop from outside: what droverd can hold, and the recipe cannot, it holds while it lives.
  const bool daemon_holds = keep_.state().latched.load() != 0 && set_is_his_ && daemon_ >= 0 &&
                            beats() > 0 && !watch_.late(t);
  // A base that was let go stays so, and an arm beside it, under which somebody may be, does not
  // fall.
  const bool all = may_hold();
  const bool plays = holding_ && (all || !daemon_holds);
  auto whose = StopSet::Whose::all;
  if (!all) whose = StopSet::Whose::daemons;
  if (daemon_holds) whose = StopSet::Whose::not_daemons;
  if (plays) set_.play(t, whose);
  // A droverd that lives sees by itself that its drives are not there.
  const bool alone = daemon_ < 0 || watch_.late(t);
  if (!holding_) supply_cut_ = false;
  if (plays && alone && !supply_cut_ && set_.runs_on(t)) cut_supply();
  // Drives that nobody can stop are the hardware watchdog's.
  if (!plays || set_.in_command(t)) pulse();
}

void Guard::publish() {
  auto& kept = keep_.state();
  kept.holding.store(holding_ ? 1 : 0);
  if (shared_ == nullptr) return;
  shared_->latched_by_uid.store(kept.latched_by_uid.load(), std::memory_order_relaxed);
  shared_->guard_latched.store(kept.latched.load(), std::memory_order_release);
  shared_->set_refused.store(offered_ ? 1 : 0, std::memory_order_relaxed);
  shared_->unsaid.store(speech_.unsaid() + notify_.unsaid(), std::memory_order_relaxed);
  shared_->unsent.store(set_.unsent(), std::memory_order_relaxed);
  shared_->guard_holds.store(holding_ ? 1 : 0, std::memory_order_release);
  shared_->guard_beats.fetch_add(1, std::memory_order_release);
}

void Guard::tell(Time t, bool was_holding) {
  if (!holding_ || was_holding) return;
  FixedText<64> cause;
  if (keep_.state().latched.load() != 0) {
    cause.format("stopped by user %u", keep_.state().latched_by_uid.load());
  } else if (daemon_ < 0) {
    cause = "droverd is gone";
  } else {
    cause.format("droverd's heartbeat is %.0f ms old", to_s(watch_.age(t)) * 1e3);
  }
  const auto words = cause.view();
  speech_.say("drover-guard: %.*s: %s (axes %zu, messages %zu)", static_cast<int>(words.size()),
              words.data(), may_hold() ? "stopping the drives" : "the drives were released",
              set_.axes(), set_.messages());
}

/// One edge a cycle. A line that is gone is closed, so that droverd can open it again.
void Guard::pulse() {
  if (pulse_line_ < 0) return;
  pulse_high_ = !pulse_high_;
  gpio_v2_line_values values{};
  values.mask = 1;
  values.bits = pulse_high_ ? 1 : 0;
  if (::ioctl(pulse_line_, GPIO_V2_LINE_SET_VALUES_IOCTL, &values) == 0) return;
  speech_.say("drover-guard: the watchdog's line is gone (%s)", ::strerrordesc_np(errno));
  ::close(pulse_line_);
  pulse_line_ = -1;
}

/// What nothing reaches, and nothing else stops. The line stays the guard's: a droverd that only
/// hung writes it anew, and it outlives the next one's end as well.
void Guard::cut_supply() {
  supply_cut_ = true;
  if (relay_line_ < 0) return;
  gpio_v2_line_values values{};
  values.mask = 1;
  // What cannot be written falls when the last who has it lets it go.
  if (::ioctl(relay_line_, GPIO_V2_LINE_SET_VALUES_IOCTL, &values) != 0)
    ::close(std::exchange(relay_line_, -1));
  speech_.say("drover-guard: a drive that would run on is not reached: the enable relay is opened");
}

/// droverd's word while it runs; a new daemon has none before its first cycle, and then the last
/// one's counts.
bool Guard::may_hold() {
  auto& kept = keep_.state().may_hold;
  if (shared_ != nullptr && beats() > 0)
    kept.store(shared_->may_hold.load(std::memory_order_relaxed));
  const auto may = kept.load();
  return may != GuardMayHold::released && may != GuardMayHold::cut;
}

std::uint64_t Guard::beats() const {
  return shared_ == nullptr ? 0 : shared_->daemon_beats.load(std::memory_order_acquire);
}

void Guard::stop(uid_t by) {
  auto& kept = keep_.state();
  if (kept.latched.load() != 0) return;
  kept.latched_by_uid.store(by);
  kept.latched.store(1);
  watch_.lost();  // after the reset droverd has to ask for the bus
  cycle(now());   // not when its time comes
}

void Guard::reset(uid_t by) {
  if (keep_.state().latched.exchange(0) != 0)
    speech_.say("drover-guard: the stop was reset by user %u", static_cast<unsigned>(by));
  if (offered_) use_next();
  publish();
}

std::string_view Guard::state() {
  const auto& kept = keep_.state();
  const Time t = now();
  const char* daemon = daemon_ < 0 ? "gone" : watch_.late(t) ? "late" : "alive";
  const std::uint64_t unsaid = speech_.unsaid() + notify_.unsaid();
  state_text_.format(
      "{\"latched\":%s,\"latched_by_uid\":%u,\"holds\":%s,\"may_hold\":%s,\"axes\":%zu,"
      "\"axes_never_reached\":%zu,"
      "\"in_command\":%s,\"droverd\":\"%s\",\"set_refused\":%s,\"unsent\":%llu,\"unsaid\":%llu}",
      kept.latched.load() != 0 ? "true" : "false", kept.latched_by_uid.load(),
      holding_ ? "true" : "false", may_hold() ? "true" : "false", set_.axes(),
      set_.axes_never_reached(), !holding_ || set_.in_command(t) ? "true" : "false", daemon,
      offered_ ? "true" : "false", static_cast<unsigned long long>(set_.unsent()),
      static_cast<unsigned long long>(unsaid));
  return state_text_.view();
}

void Guard::take_over(std::vector<Kept> kept) {
  int memory = -1;
  if (!keep_.restore(std::move(kept), set_, limit_ms_, memory)) {
    keep_.keep(set_, limit_ms_);  // a stop may come before the first set
    return;
  }
  GuardMessage hello;
  hello.limit_ms = limit_ms_;
  if (memory >= 0 && begin_set(hello, memory)) use_memory(next_memory_, next_shared_);
  next_memory_ = -1;
  next_shared_ = nullptr;
  watch_.begin(beats(), std::chrono::milliseconds(limit_ms_), now());
  // The heartbeat tells whether droverd is there; who held before does not wait for it.
  if (keep_.state().holding.load() != 0 || shared_ == nullptr) watch_.lost();
  speech_.say("drover-guard: goes on with %zu axes where the one before it ended", set_.axes());
}

}  // namespace drover::guard
