#include "runtime/control_loop.h"

#include <poll.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "runtime/clock.h"
#include "runtime/departure.h"

namespace drover::runtime {

namespace {

using namespace std::chrono_literals;

/// The guard's own cycle is 10 ms. It is given what it gives us, and three cycles more; then it is
/// not there.
constexpr Duration kGuardCycles = 30ms;
/// The bus is asked back when the robot was at rest and our heartbeat good for this long.
constexpr Duration kHandBackAfter = 500ms;
constexpr Duration kHandBackToCatch = 30ms;
/// The two clocks keep their distance except when somebody sets one.
constexpr Duration kMeasureClocksEach = 100ms;
/// Slower is an encoder's noise.
constexpr double kRolls_mps = 0.02;
/// Outputs are written when they change, and so often to learn whether their chip is still there.
constexpr Duration kWriteOutputsEach = 100ms;

constexpr std::size_t slot_of(Stream stream) {
  return kFirstStreamSlot + static_cast<std::size_t>(stream);
}

constexpr std::uint8_t bus_id(std::size_t slot) {
  return static_cast<std::uint8_t>(slot);
}

}  // namespace

ControlLoop::ControlLoop(const config::DroverConfig& config, Gateway& gateway, LinkKeeper& keeper,
                         const GuardMemory& guard, ControlExchange& exchange, KeepsOver keeps,
                         BatteryExchange* battery)
    : config_(config),
      gateway_(gateway),
      keeper_(keeper),
      guard_(guard),
      exchange_(exchange),
      keeps_(keeps),
      battery_(battery),
      guard_stale_(std::chrono::milliseconds(config.guard.limit_ms) + kGuardCycles),
      tick_(from_s(1 / config.control.tick_Hz)),
      stream_baud_{config.gnss.baud, config.imu.baud} {
  for (const auto& line : config.lines.line) line_count_ += line.configured ? 1 : 0;
  for (std::size_t slot = 0; slot < kLinkSlots; ++slot) {
    link_state_[slot].name = slot_name(slot);
    link_state_[slot].is_bus = slot < kMaxBuses;
    link_state_[slot].reason = "not opened yet";
  }
}

Name ControlLoop::slot_name(std::size_t slot) const {
  if (slot == slot_of(Stream::gnss)) return config_.gnss.configured ? Name("gnss") : Name();
  if (slot == slot_of(Stream::imu)) return config_.imu.configured ? Name("imu") : Name();
  if (slot == kLinesSlot) return line_count_ > 0 ? Name("lines") : Name();
  if (slot == kOutputsSlot) {
    const auto& outputs = config_.engine.output_configured;
    return std::find(outputs.begin(), outputs.end(), true) != outputs.end() ? Name("outputs")
                                                                            : Name();
  }
  return slot < config_.buses.size() ? Name(config_.buses[slot].name) : Name();
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
}

Time ControlLoop::wait(Duration longest) {
  std::array<pollfd, kStreamCount + link::kMaxLines> fds{};
  for (std::size_t i = 0; i < kStreamCount; ++i)
    fds[i] = {streams_[i] ? streams_[i]->fd() : -1, POLLIN, 0};
  std::size_t count = kStreamCount;
  if (lines_)
    for (const int fd : lines_->edge_fds()) fds[count++] = {fd, POLLIN, 0};
  const timespec time{static_cast<time_t>(longest / 1s), static_cast<long>((longest % 1s).count())};
  const int ready = ::ppoll(fds.data(), count, &time, nullptr);
  const Time now = monotonic_now();
  if (ready <= 0) return now;
  const auto is_ready = [](const pollfd& fd) { return fd.revents != 0; };
  for (std::size_t i = 0; i < kStreamCount; ++i)
    if (is_ready(fds[i])) read_stream(i, now);
  if (std::any_of(fds.begin() + kStreamCount, fds.begin() + static_cast<std::ptrdiff_t>(count),
                  is_ready)) {
    std::array<bool, link::kMaxLines> edged{};
    lines_->drain_edges(edged);
    read_lines(now, edged);
  }
  return now;
}

/// Returns the time at its end.
Time ControlLoop::cycle(Time begin, std::uint64_t late) {
  ++stats_.cycles;
  stats_.overruns += late;
  watch_sleep(begin);
  take_links(begin);
  drain_can(begin);
  read_lines(begin);
  watch_guard(begin);
  take_battery();
  watch_program(begin);
  take_commands(begin);

  const bool guard_alive = guard_seen_ + guard_stale_ > begin && keeper_.guard_equipped() &&
                           guard_.shared().set_refused.load(std::memory_order_relaxed) == 0;
  apply(begin, gateway::Tick{guard_alive, guard_has_bus_, guard_latched_});
  // Before the events go: who hears that a path is released may delete it.
  if (exchange_.recorder != nullptr) exchange_.recorder->output(gateway_);
  const auto& out = gateway_.output();
  for (std::size_t bus = 0; bus < gateway_.bus_count(); ++bus) {
    const auto& frames = out.frames[bus];
    if (can_[bus] && !frames.empty()) send(bus, {frames.begin(), frames.size()}, begin);
  }
  for (std::size_t i = 0; i < kStreamCount; ++i) serve_stream(i, out.streams[i], begin);
  write_outputs(out.engine.outputs, begin);

  keep(out.engine.remembered);
  // A daemon that half hangs leaves the robot to the guard, once it is at rest.
  if (!program_.leaves_to_guard(begin, exchange_.at_rest.load(std::memory_order_relaxed)))
    guard_.shared().daemon_beats.fetch_add(1, std::memory_order_release);
  exchange_.beats.fetch_add(1, std::memory_order_relaxed);
  for (const auto& event : out.engine.events)
    if (!exchange_.events.push(event)) exchange_.lost_events.fetch_add(1);
  if (!out.engine.events.empty()) exchange_.events_ready.notify();
  // After the events: who waits for it may end the thread that tells them.
  const bool task = gateway_.snapshot().nav.status == NavStatus::run;
  const bool rolls = std::abs(gateway_.snapshot().pose.vx_mps) > kRolls_mps;
  const auto& slowing = out.engine.slowing_permitted;
  const bool slows = std::find(slowing.begin(), slowing.end(), true) != slowing.end();
  exchange_.at_rest.store(!out.engine.motion_permitted && !slows && !task && !rolls,
                          std::memory_order_release);
  return publish(begin);
}

void ControlLoop::recall(const Remembered& remembered) {
  apply(monotonic_now(), gateway::Recalled{remembered});
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

void ControlLoop::watch_program(Time now) {
  const char* reported = exchange_.trouble.load(std::memory_order_acquire);
  const auto looks = exchange_.looks.load(std::memory_order_relaxed);
  if (program_.update(reported, looks, now)) apply(now, gateway::ProgramTrouble{program_.why()});
}

/// Looks at guard and clock just before the system call: what was decided before a hold-up must
/// not move wheels that the guard has stopped meanwhile.
void ControlLoop::send(std::size_t bus, std::span<const CanFrame> frames, Time decided) {
  auto& can = *can_[bus];
  while (!frames.empty()) {
    const auto count = std::min(frames.size(), link::FrameBatch::capacity());
    const bool holds = guard_.shared().guard_holds.load(std::memory_order_acquire) != 0;
    if (!may_leave({decided, guard_has_bus_}, {monotonic_now(), holds}, tick_)) {
      stats_.late_frames += frames.size();
      break;
    }
    if (!can.send(frames.first(count))) return lose(bus, can.error(), decided);
    frames = frames.subspan(count);
  }
  const auto& counters = can.counters();
  apply(decided, gateway::FramesSent{bus_id(bus), counters.sent, counters.send_refused});
}

/// The monotonic clock stands still while the computer sleeps: all that was heard looks young.
void ControlLoop::watch_sleep(Time now) {
  constexpr Duration kSleep = 1s;
  const Duration asleep = asleep_since_boot();
  const Duration slept = asleep - asleep_;
  asleep_ = asleep;
  if (stats_.cycles > 1 && slept > kSleep) apply(now, gateway::Suspended{to_s(slept)});
}

void ControlLoop::take_links(Time now) {
  for (auto& dead : going_back_)
    if (dead.opened()) (void)keeper_.give_back(dead);
  LinkHandover arrived;
  while (keeper_.take(arrived)) {
    const auto slot = arrived.slot;
    link_state_[slot].up = arrived.opened();
    link_state_[slot].reason = arrived.problem;
    if (!arrived.opened()) {
      if (slot < kMaxBuses) apply(now, gateway::BusLost{bus_id(slot), arrived.problem});
      continue;
    }
    if (is_stream(slot)) {
      const auto stream = slot - kFirstStreamSlot;
      streams_[stream] = std::move(arrived.serial);
      apply(now, gateway::StreamUp{static_cast<Stream>(stream)});
    } else if (slot == kOutputsSlot) {
      outputs_ = std::move(arrived.outputs);
      outputs_written_ = kNever;
    } else if (slot == kLinesSlot) {
      lines_ = std::move(arrived.lines);
    } else {
      can_[slot] = std::move(arrived.can);
      apply(now, gateway::BusUp{bus_id(slot)});
    }
  }
}

void ControlLoop::lose(std::size_t slot, int error, Time now) {
  auto& dead = going_back_[slot];
  dead.slot = slot;
  const auto name = link_state_[slot].name.view();
  if (error == 0) {
    dead.problem.format("%.*s: changes to %d baud", static_cast<int>(name.size()), name.data(),
                        dead.reopen_baud);
  } else {
    dead.reopen_baud = 0;
    dead.problem.format("%.*s: lost (%s)", static_cast<int>(name.size()), name.data(),
                        ::strerrordesc_np(error));
  }
  link_state_[slot].up = false;
  link_state_[slot].reason = dead.problem;
  // Not waited for any more: a descriptor that hung up is always ready and would spin the loop.
  if (is_stream(slot)) {
    dead.serial = std::move(streams_[slot - kFirstStreamSlot]);
  } else if (slot == kLinesSlot) {
    dead.lines = std::move(lines_);
    apply(now, gateway::LinesLost{});
  } else if (slot == kOutputsSlot) {
    dead.outputs = std::move(outputs_);
  } else {
    dead.can = std::move(can_[slot]);
    apply(now, gateway::BusLost{bus_id(slot), dead.problem});
  }
  (void)keeper_.give_back(dead);
}

void ControlLoop::read_stream(std::size_t stream, Time now) {
  const auto slot = kFirstStreamSlot + stream;
  std::array<std::uint8_t, 1024> buffer{};
  std::size_t size = 0;
  if (!streams_[stream]->read(buffer, size)) return lose(slot, streams_[stream]->error(), now);
  if (size == 0) return;
  link_state_[slot].received += size;
  // The first byte came in before the last one: take the wire's time off.
  const Duration wire = from_s(10.0 * static_cast<double>(size - 1) / stream_baud_[stream]);
  apply(now - wire, gateway::BytesHeard{static_cast<Stream>(stream), {buffer.data(), size}});
}

void ControlLoop::serve_stream(std::size_t stream, const StreamOutput& out, Time now) {
  if (!streams_[stream]) return;
  const auto slot = kFirstStreamSlot + stream;
  if (!out.bytes.empty()) {
    std::size_t taken = 0;
    if (!streams_[stream]->write(out.bytes, taken))
      return lose(slot, streams_[stream]->error(), now);
    link_state_[slot].sent += taken;
    bytes_untaken_[stream] += out.bytes.size() - taken;
  }
  if (out.reopen_baud == 0) return;
  // Setting a line's speed may block: the keeper does it.
  stream_baud_[stream] = static_cast<int>(out.reopen_baud);
  auto& dead = going_back_[slot];
  dead.reopen_baud = stream_baud_[stream];
  lose(slot, 0, now);
}

/// A line in `edged` is told at its other level first: a pulse that is over already counts too.
void ControlLoop::read_lines(Time now, const std::array<bool, link::kMaxLines>& edged) {
  if (line_count_ == 0) return;
  if (!lines_) return apply(now, gateway::LinesLost{});
  std::array<bool, link::kMaxLines> levels{};
  if (!lines_->read(levels)) return lose(kLinesSlot, lines_->error(), now);
  const bool pulses = std::find(edged.begin(), edged.end(), true) != edged.end();
  if (pulses) {
    auto before = levels;
    for (std::size_t i = 0; i < line_count_; ++i) before[i] = levels[i] != edged[i];
    apply_levels(before, now);
  }
  apply_levels(levels, now);
}

void ControlLoop::apply_levels(const std::array<bool, link::kMaxLines>& levels, Time now) {
  gateway::LevelsRead read;
  for (std::size_t i = 0; i < line_count_; ++i) (void)read.levels.push_back(levels[i]);
  apply(now, read);
}

void ControlLoop::write_outputs(const std::array<bool, kOutputCount>& on, Time now) {
  if (!outputs_) return;
  std::array<bool, kOutputCount> levels{};  // of the configured ones, in the order of Output
  std::size_t count = 0;
  for (std::size_t i = 0; i < kOutputCount; ++i)
    if (config_.engine.output_configured[i]) levels[count++] = on[i];
  if (levels == output_levels_ && now - outputs_written_ < kWriteOutputsEach) return;
  output_levels_ = levels;
  outputs_written_ = now;
  if (!outputs_->write({levels.data(), count})) lose(kOutputsSlot, outputs_->error(), now);
}

void ControlLoop::drain_can(Time now) {
  if (now - clocks_measured_ >= kMeasureClocksEach) {
    clocks_measured_ = now;
    wall_minus_monotonic_ = wall_minus_monotonic();
  }
  const link::StampWindow window{previous_drain_, now, wall_minus_monotonic_};
  previous_drain_ = now;
  constexpr int kMostBatches = 64;  // a babbling bus must not hold the cycle for ever
  for (std::size_t bus = 0; bus < gateway_.bus_count(); ++bus) {
    for (int i = 0; i < kMostBatches && can_[bus]; ++i) {
      const auto clamped = can_[bus]->counters().clamped_stamps;
      if (!can_[bus]->receive(window, batch_)) {
        lose(bus, can_[bus]->error(), now);
        break;
      }
      // Somebody has set a clock.
      if (can_[bus]->counters().clamped_stamps != clamped) clocks_measured_ = kNever;
      for (const auto& received : batch_)
        apply(received.received, gateway::FrameHeard{bus_id(bus), received.frame});
      if (batch_.size() < batch_.capacity()) break;
    }
  }
}

void ControlLoop::watch_guard(Time now) {
  const auto& shared = guard_.shared();
  const auto beats = shared.guard_beats.load(std::memory_order_acquire);
  if (beats != guard_beats_) {
    guard_beats_ = beats;
    guard_seen_ = now;
  }
  const bool holds = shared.guard_holds.load(std::memory_order_acquire) != 0;
  if (holds && !guard_has_bus_) guard_held_since_ = now;
  guard_has_bus_ = holds;
  // Who heard a stop first tells the other: this one's outlives a reboot.
  const bool latched = shared.guard_latched.load(std::memory_order_acquire) != 0;
  if (latched && !guard_latched_) (void)exchange_.stops.ask_stop();
  guard_latched_ = latched;
  const bool at_rest = gateway_.snapshot().nav.status != NavStatus::run;
  // A robot that rolls cannot wait: its drives are taken back at their own speed, not under zeros.
  const bool rolls = gateway_.snapshot().hold == HoldState::catching;
  const Duration pause = rolls ? kHandBackToCatch : kHandBackAfter;
  if (holds && !latched && at_rest && !program_.trouble() && now - guard_held_since_ > pause &&
      now - hand_back_asked_ > pause) {
    hand_back_asked_ = now;
    keeper_.request_hand_back();
  }
}

void ControlLoop::take_battery() {
  if (battery_ == nullptr) return;
  BatteryTold told;
  while (battery_->told.pop(told))
    std::visit([&](const auto& what) { apply(told.time, what); }, told.what);
}

Time ControlLoop::publish(Time now) {
  auto& snapshot = exchange_.snapshot.back();
  snapshot = gateway_.snapshot();
  snapshot.links.clear();
  for (std::size_t slot = 0; slot < kLinkSlots; ++slot) {
    auto& state = link_state_[slot];
    if (state.name.empty()) continue;
    if (slot < kMaxBuses && can_[slot]) {
      const auto& c = can_[slot]->counters();
      state.received = c.received;
      state.sent = c.sent;
      state.dropped = c.receive_overflows + c.send_refused + gateway_.no_room(slot);
      state.clamped = c.clamped_stamps;
      state.malformed = c.malformed;
      state.refused = gateway_.refused(slot);
      state.reason = gateway_.bus_trouble(slot, now);
    }
    if (is_stream(slot)) {
      const auto stream = slot - kFirstStreamSlot;
      state.dropped = gateway_.bytes_dropped(static_cast<Stream>(stream)) + bytes_untaken_[stream];
    }
    (void)snapshot.links.push_back(state);
  }
  if (battery_ != nullptr) (void)snapshot.links.push_back(battery_->link.latest());
  const Time end = monotonic_now();
  if (end - now > stats_.longest_step) stats_.longest_step = end - now;
  snapshot.cycle = stats_;
  exchange_.snapshot.publish();
  return end;
}

}  // namespace drover::runtime
