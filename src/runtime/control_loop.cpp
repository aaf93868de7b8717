#include "runtime/control_loop.h"

#include <sys/prctl.h>

#include <algorithm>
#include <cmath>

#include "runtime/clock.h"
#include "runtime/hand_back.h"

namespace drover::runtime {

namespace {

using namespace std::chrono_literals;

/// Slower is an encoder's noise.
constexpr double kRolls_mps = 0.02;

}  // namespace

ControlLoop::ControlLoop(const config::DroverConfig& config, Gateway& gateway, LinkKeeper& keeper,
                         SerialLoop& serial, const GuardMemory& guard, ControlExchange& exchange,
                         KeepsOver keeps, std::span<const std::unique_ptr<SlowLink>> slow)
    : config_(config),
      gateway_(gateway),
      keeper_(keeper),
      serial_(serial),
      guard_(guard),
      exchange_(exchange),
      keeps_(keeps),
      slow_(slow),
      tick_(from_s(1 / config.control.tick_Hz)),
      open_(gateway.wiring().links.size()),
      guard_watch_(std::chrono::milliseconds(config.guard.limit_ms)),
      hold_ups_(std::chrono::milliseconds(config.guard.limit_ms)) {
  const auto& links = gateway.wiring().links;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].wire == Wire::registers) continue;  // the thread that polls it tells of it
    link_state_[i].name = links[i].name;
    link_state_[i].is_bus = links[i].wire == Wire::can;
    open_[i].baud = config.links[links[i].place].baud;
  }
  const auto& outputs = config.engine.output_configured;
  if (std::find(outputs.begin(), outputs.end(), true) != outputs.end())
    link_state_[kOutputsSlot].name = "outputs";
  for (auto& state : link_state_) state.reason = "not opened yet";
  wait_.reserve(1 + links.size() * link::kMaxLines);
}

/// The wait ends at the tick's time or with bytes and edges, which are worth a wake-up at once. Of
/// CAN the kernel keeps each frame's time, so that it can wait for the tick.
void ControlLoop::run(const std::atomic<bool>& stop) {
  // Else the kernel would add up to 50 us to each wait of a thread without real-time priority.
  ::prctl(PR_SET_TIMERSLACK, 1);
  Time now = monotonic_now();
  Time next = now + tick_;
  while (!stop.load(std::memory_order_relaxed)) {
    if (now >= next) {
      const auto late = static_cast<std::uint64_t>((now - next) / tick_);
      next += tick_ * static_cast<std::int64_t>(late + 1);
      now = cycle(now, late);
    }
    now = wait(std::max(Duration::zero(), next - now));
  }
  // Nobody would take the last step of a cut: the guard keeps the relay as it finds it.
  const auto& last = gateway_.output().engine;
  auto outputs = last.outputs;
  outputs[static_cast<std::size_t>(Output::enable_relay)] &= !last.unsettled;
  write_outputs(outputs, now);
}

Time ControlLoop::wait(Duration longest) {
  wait_.assign(1, {serial_.ready_fd(), POLLIN, 0});
  for (const auto& link : open_) {
    if (!link.lines) continue;
    for (const int fd : link.lines->edge_fds()) wait_.push_back({fd, POLLIN, 0});
  }
  const timespec time{static_cast<time_t>(longest / 1s), static_cast<long>((longest % 1s).count())};
  const int ready = ::ppoll(wait_.data(), wait_.size(), &time, nullptr);
  const Time now = monotonic_now();
  if (ready > 0) hear_ready(now);
  return now;
}

/// In the order in which `wait` put them down: what is lost here is not looked for again.
void ControlLoop::hear_ready(Time now) {
  auto fd = wait_.cbegin();
  if ((fd++)->revents != 0) hear_streams(now);
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (!open_[i].lines) continue;
    const auto end = fd + static_cast<std::ptrdiff_t>(open_[i].lines->edge_fds().size());
    const bool edges = std::any_of(fd, end, [](const pollfd& each) { return each.revents != 0; });
    fd = end;
    if (!edges) continue;
    std::array<bool, link::kMaxLines> edged{};
    open_[i].lines->drain_edges(edged);
    read_lines(i, now, edged);
  }
}

/// Returns the time at its end.
Time ControlLoop::cycle(Time begin, std::uint64_t late) {
  ++stats_.cycles;
  stats_.overruns += late;
  watch_hold_ups(begin);
  take_links(begin);
  drain_can(begin);
  for (std::size_t link = 0; link < open_.size(); ++link)
    if (wire_of(link) == Wire::levels) read_lines(link, begin);
  watch_guard(begin);
  take_slow_links();
  hear_scene(begin);
  watch_program(begin);
  take_commands(begin);

  const bool guard_alive = guard_watch_.alive(begin) && keeper_.guard_equipped();
  apply(begin,
        gateway::Tick{guard_alive, guard_watch_.holds(begin), guard_watch_.latched(),
                      guard_watch_.refuses_set(), leaves_to_guard_ || guard_watch_.missed_us()});
  // Before the events go: who hears that a path is released may delete it.
  if (exchange_.recorder != nullptr) exchange_.recorder->output(gateway_);
  show_scene();
  const auto& out = gateway_.output();
  for (std::size_t bus = 0; bus < gateway_.bus_count(); ++bus) {
    const auto& frames = out.frames[bus];
    if (open_[bus].can && !frames.empty()) send(bus, {frames.begin(), frames.size()}, begin);
  }
  for (const auto& stream : out.streams) serve_stream(stream, begin);
  write_outputs(out.engine.outputs, begin);

  keep(out.engine.remembered);
  // A daemon that half hangs leaves the robot to the guard, once it is at rest.
  leaves_to_guard_ =
      program_.leaves_to_guard(begin, exchange_.at_rest.load(std::memory_order_relaxed));
  if (!leaves_to_guard_) guard_.shared().daemon_beats.fetch_add(1, std::memory_order_release);
  exchange_.beats.fetch_add(1, std::memory_order_relaxed);
  for (const auto& event : out.engine.events)
    if (!exchange_.events.push(event)) exchange_.lost_events.fetch_add(1);
  if (!out.engine.events.empty()) exchange_.events_ready.notify();
  // After the events: who waits for it may end the thread that tells them.
  const bool task = gateway_.snapshot().nav.status == NavStatus::run;
  // What was moving when its wheels were heard last may be moving still.
  if (const double vx_mps = gateway_.snapshot().worst_vx_mps; std::isfinite(vx_mps))
    last_vx_mps_ = vx_mps;
  const auto& slowing = out.engine.slowing_permitted;
  const bool slows = out.engine.base.slowing_permitted ||
                     std::find(slowing.begin(), slowing.end(), true) != slowing.end();
  const bool moves = out.engine.motion_permitted || slows || task || rolls();
  exchange_.at_rest.store(!moves && !out.engine.unsettled, std::memory_order_release);
  return publish(begin);
}

void ControlLoop::recall(const Remembered& remembered) {
  apply(monotonic_now(), gateway::Recalled{remembered});
}

void ControlLoop::recall(const LearnedValues& learned) {
  apply(monotonic_now(), gateway::LearnedRecalled{learned});
}

/// The guard must know, too, what it may do with drives that nobody commands.
void ControlLoop::keep(const Remembered& remembered) {
  const auto may_hold = remembered.released    ? GuardMayHold::released
                        : remembered.power_cut ? GuardMayHold::cut
                                               : GuardMayHold::hold;
  guard_.shared().may_hold.store(may_hold, std::memory_order_release);
  if (!keeps_.memory.keep(remembered)) return;
  keeps_.storage.stop.back() = {true, remembered};
  keeps_.storage.stop.publish();
  keeps_.storage.jobs_ready.notify();
}

void ControlLoop::take_commands(Time now) {
  intake_.take(exchange_.commands, exchange_.stops, now,
               [&](const Command& command) { apply(now, gateway::CommandGiven{command}); });
}

void ControlLoop::hear_scene(Time now) {
  if (exchange_.scene == nullptr) return;
  const FoundClearance& found = exchange_.scene->clearance.latest();
  if (found.number == clearance_) return;
  clearance_ = found.number;
  apply(now, gateway::ClearanceFound{found.clearance});
}

/// What it looks from.
void ControlLoop::show_scene() {
  if (exchange_.scene == nullptr) return;
  exchange_.scene->viewpoint.back() = gateway_.viewpoint();
  exchange_.scene->viewpoint.publish();
}

void ControlLoop::watch_program(Time now) {
  const char* reported = exchange_.trouble.load(std::memory_order_acquire);
  const auto looks = exchange_.looks.load(std::memory_order_relaxed);
  if (program_.update(reported, looks, now)) apply(now, gateway::ProgramTrouble{program_.why()});
}

/// The monotonic clock stands still while the computer sleeps: all that was heard looks young.
void ControlLoop::watch_hold_ups(Time now) {
  const auto& groups = gateway_.snapshot().groups;
  const bool joints = std::any_of(groups.begin(), groups.end(), [](const GroupSnapshot& group) {
    return group.state == GroupState::following;
  });
  const bool moved = joints || !exchange_.at_rest.load(std::memory_order_relaxed);
  const HoldUp found = hold_ups_.update(now, asleep_since_boot(), moved);
  if (found.kind == HoldUp::Kind::slept) apply(now, gateway::Suspended{to_s(found.lasted)});
  if (found.kind == HoldUp::Kind::stops) apply(now, gateway::HeldUp{to_s(found.lasted)});
  if (found.kind == HoldUp::Kind::told) tell_hold_up(found.lasted, now);
}

/// It changes nothing, so it is no input.
void ControlLoop::tell_hold_up(Duration lasted, Time now) {
  Notice notice{Notice::Level::warning, {}};
  notice.text.format(
      "droverd stood still for %.0f ms while the robot moved, and nobody steered meanwhile: this "
      "computer is too busy, or was paused",
      1e3 * to_s(lasted));
  if (!exchange_.events.push(Event{now, notice})) exchange_.lost_events.fetch_add(1);
  exchange_.events_ready.notify();
}

/// The base, as far as somebody knew it.
bool ControlLoop::rolls() const {
  return std::abs(last_vx_mps_) > kRolls_mps;
}

GuardSigns ControlLoop::guard_signs() const {
  const auto& shared = guard_.shared();
  return {shared.guard_beats.load(std::memory_order_acquire),
          shared.guard_holds.load(std::memory_order_acquire) != 0,
          shared.guard_latched.load(std::memory_order_acquire) != 0,
          shared.set_refused.load(std::memory_order_relaxed) != 0};
}

void ControlLoop::watch_guard(Time now) {
  // Who heard a stop first tells the other: this one's outlives a reboot.
  if (guard_watch_.update(guard_signs(), now)) (void)exchange_.stops.ask_stop();
  const auto& robot = gateway_.snapshot();
  const bool calm = robot.nav.status != NavStatus::run && !program_.trouble();
  if (guard_watch_.ask_back(calm, cannot_wait(robot, !rolls()), now)) keeper_.request_hand_back();
}

Time ControlLoop::publish(Time now) {
  auto& snapshot = exchange_.snapshot.back();
  snapshot = gateway_.snapshot();
  snapshot.links.clear();
  for (std::size_t slot = 0; slot < kLinkSlots; ++slot) {
    auto& state = link_state_[slot];
    if (state.name.empty()) continue;
    if (state.is_bus && open_[slot].can) {
      const auto& c = open_[slot].can->counters();
      state.received = c.received;
      state.sent = c.sent;
      state.dropped = c.receive_overflows + c.send_refused + gateway_.no_room(slot);
      state.clamped = c.clamped_stamps;
      state.malformed = c.malformed;
      state.refused = gateway_.refused(slot);
      state.reason = gateway_.bus_trouble(slot, now);
    }
    if (slot < open_.size() && wire_of(slot) == Wire::bytes) {
      const auto link = static_cast<LinkId>(slot);
      state.dropped = gateway_.bytes_dropped(link) + open_[slot].bytes_untaken;
      state.refused = gateway_.refused(link);
    }
    (void)snapshot.links.push_back(state);
  }
  for (const auto& slow : slow_) (void)snapshot.links.push_back(slow->exchange.link.latest());
  const Time end = monotonic_now();
  if (end - now > stats_.longest_step) stats_.longest_step = end - now;
  snapshot.cycle = stats_;
  exchange_.snapshot.publish();
  return end;
}

}  // namespace drover::runtime
